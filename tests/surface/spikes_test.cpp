// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spikes.hpp>
#include <set>

#include "test_surfaces.hpp"

using namespace salebra;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
const Grid2D grid{256, 192, 256e-6, 192e-6};

/// A self-affine surface with an rms height of 0.3 µm.
Surface rough(double hurst, std::uint64_t seed = 1) {
  SelfAffineParameters parameters;
  parameters.hurst = hurst;
  parameters.rolloff = 64e-6;
  parameters.short_cutoff = 4e-6;
  parameters.rms_height = 0.3e-6;
  Surface surface = filtered_noise(grid, SelfAffineSpectrum(parameters), seed);
  surface.periodic = false;
  return surface;
}

std::set<std::pair<Index, Index>> places(const std::vector<Spike>& spikes) {
  std::set<std::pair<Index, Index>> found;
  for (const Spike& spike : spikes) found.emplace(spike.ix, spike.iy);
  return found;
}

}  // namespace

TEST_CASE("Spikes are found where they are, whatever the surface below", "[spikes]") {
  const double hurst = GENERATE(0.3, 0.8);
  INFO("H = " << hurst);
  const Surface clean = rough(hurst);
  Surface dirty = clean;
  std::mt19937 engine(3);
  std::set<std::pair<Index, Index>> expected;
  // Isolated single points, pairs and squares of four, 8 µm up or down, also at corners.
  for (Index ix = 0; ix < grid.nx; ix += 51)
    for (Index iy = 0; iy < grid.ny; iy += 38) {
      const auto kind = engine() % 3;
      const double height = engine() % 2 ? 8e-6 : -8e-6;
      for (Index jx = ix; jx <= ix + (kind > 1) && jx < grid.nx; ++jx)
        for (Index jy = iy; jy <= iy + (kind > 0) && jy < grid.ny; ++jy) {
          dirty.heights(jx, jy) += height;
          expected.emplace(jx, jy);
        }
    }
  REQUIRE(expected.size() > 50);
  const std::vector<Spike> found = find_spikes(dirty);
  CHECK(places(found) == expected);
  for (const Spike& spike : found) {
    // The surface next to a spike differs from the surface below it by less than its range of 1.5
    // µm.
    CHECK(std::abs(std::abs(spike.height) - 8e-6) < 1.5e-6);
    CHECK((spike.height > 0) ==
          (dirty.heights(spike.ix, spike.iy) > clean.heights(spike.ix, spike.iy)));
  }
  const Surface cleaned = despiked(dirty);
  CHECK(cleaned.undefined_points() == Index(expected.size()));
  // The spikes cause more than half of the slope; without 0.2 % of its points the surface has its
  // own slope.
  CHECK(difference_moments(dirty).rms_slope() > 2 * difference_moments(clean).rms_slope());
  CHECK(difference_moments(cleaned).rms_slope() ==
        Approx(difference_moments(clean).rms_slope()).epsilon(0.01));
}

TEST_CASE("A clean surface has no spikes", "[spikes]") {
  // A fraction of 2e-9 of Gaussian points exceeds six deviations: none of 2.5 million.
  for (const double hurst : {0.1, 0.3, 0.5, 0.8, 1.0})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      INFO("H = " << hurst << ", seed " << seed);
      CHECK(find_spikes(rough(hurst, seed)).empty());
    }
  // Uniform independent points, and points with a noise of few digits.
  CHECK(find_spikes(white(grid, true)).empty());
  Surface coarse = white(grid, false);
  coarse.heights = (0.6 * coarse.heights).round();  // −1, 0 or 1, of which most are 0
  CHECK(find_spikes(coarse).empty());
  CHECK(find_spikes(sampled(grid, false, [](double x, double y) { return 3 * x - y; })).empty());
}

TEST_CASE("Steps, scratches and plateaus are features, no spikes", "[spikes]") {
  const Surface clean = rough(0.8);
  const auto with = [&](const std::function<void(Field&)>& change) {
    Surface surface = clean;
    change(surface.heights);
    return find_spikes(surface);
  };
  CHECK(with([](Field& h) { h.bottomRows(100) += 5e-6; }).empty());
  CHECK(with([](Field& h) { h.block(40, 50, 30, 20) += 5e-6; }).empty());
  CHECK(with([](Field& h) { h.block(40, 50, 3, 2) += 5e-6; }).empty());  // larger than any spike
  CHECK(with([](Field& h) { h.row(77) -= 5e-6; }).empty());
  CHECK(with([](Field& h) { h.block(77, 30, 1, 90) -= 5e-6; }).empty());
  CHECK(with([](Field& h) {
          for (Index k = 20; k < 120; ++k) h(k, k) -= 5e-6;
        }).empty());
}

TEST_CASE("Spikes beside holes and on a flat surface are found", "[spikes]") {
  Surface surface = rough(0.8);
  surface.heights.block(100, 80, 12, 9).setConstant(undefined);
  surface.heights(99, 84) += 8e-6;
  CHECK(places(find_spikes(surface)) == std::set<std::pair<Index, Index>>{{99, 84}});
  // A point with fewer than three neighbours cannot be judged.
  surface.heights(105, 84) = 8e-6;
  CHECK(find_spikes(surface).size() == 1);

  Surface flat = sampled(grid, false, [](double, double) { return 1e-6; });
  CHECK(find_spikes(flat).empty());
  flat.heights(7, 9) = 2e-6;
  CHECK(places(find_spikes(flat)) == std::set<std::pair<Index, Index>>{{7, 9}});
  // On a periodic surface, points across the edge are neighbours too.
  Surface edge = sampled(grid, true, [](double, double) { return 0; });
  edge.heights.row(0).setConstant(1e-6);
  edge.heights(grid.nx - 1, 3) = 1e-6;
  CHECK(find_spikes(edge).empty());
  edge.periodic = false;
  CHECK(places(find_spikes(edge)) == std::set<std::pair<Index, Index>>{{grid.nx - 1, 3}});
}

TEST_CASE("Single spikes are those of the definition, on grids of any shape and with holes",
          "[spikes]") {
  const Index nx = GENERATE(3, 8, 13), ny = GENERATE(3, 5, 6, 8, 21);
  const bool periodic = GENERATE(false, true);
  const unsigned seed = GENERATE(1, 2, 3, 4);
  INFO(nx << " by " << ny << ", periodic " << periodic << ", seed " << seed);
  constexpr double threshold = 3;
  std::mt19937 engine(seed);
  std::cauchy_distribution<double> far_off;
  std::bernoulli_distribution hole(0.03);
  Surface surface =
      sampled({nx, ny, 1, 1}, periodic, [&](double, double) { return far_off(engine); });
  for (double& height : surface.heights.reshaped())
    if (hole(engine)) height = undefined;

  const auto places_around = [&](Index ix, Index iy) {
    std::vector<std::pair<Index, Index>> around;
    for (Index x = ix - 1; x <= ix + 1; ++x)
      for (Index y = iy - 1; y <= iy + 1; ++y) {
        const Index jx = periodic ? (x + nx) % nx : x, jy = periodic ? (y + ny) % ny : y;
        if ((x != ix || y != iy) && jx >= 0 && jx < nx && jy >= 0 && jy < ny &&
            !std::isnan(surface.heights(jx, jy)))
          around.emplace_back(jx, jy);
      }
    return around;
  };
  const auto neighbours = [&](Index ix, Index iy) {
    std::vector<double> heights;
    for (const auto& [jx, jy] : places_around(ix, iy)) heights.push_back(surface.heights(jx, jy));
    return heights;
  };
  const auto median = [](std::vector<double> values) {
    std::ranges::sort(values);
    return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
  };
  std::vector<double> sizes;
  for (Index ix = 0; ix < nx; ++ix)
    for (Index iy = 0; iy < ny; ++iy)
      if (const auto around = neighbours(ix, iy);
          around.size() >= 3 && !std::isnan(surface.heights(ix, iy)))
        sizes.push_back(std::abs(surface.heights(ix, iy) - median(around)));
  std::ranges::sort(sizes);
  const double least = 1.4826 * sizes[(sizes.size() - 1) / 2];

  std::map<std::pair<Index, Index>, double> found;
  for (const Spike& spike : find_spikes(surface, threshold))
    found[{spike.ix, spike.iy}] = spike.height;
  for (Index ix = 0; ix < nx; ++ix)
    for (Index iy = 0; iy < ny; ++iy) {
      const auto around = neighbours(ix, iy);
      const double height = surface.heights(ix, iy);
      if (around.size() < 3 || std::isnan(height)) continue;
      const double middle = median(around), half = (height + middle) / 2;
      if (std::ranges::any_of(around, [&](double h) { return (h > half) == (height > half); }))
        continue;  // not isolated
      // A spike found next to this point may include it.
      if (std::ranges::any_of(places_around(ix, iy),
                              [&](const auto& place) { return found.contains(place); }))
        continue;
      std::vector<double> deviations;
      for (const double h : around) deviations.push_back(std::abs(h - middle));
      const double size = std::abs(height - middle);
      const bool far = size > threshold * std::max(least, 1.4826 * median(deviations));
      INFO("at " << ix << ", " << iy << ": " << height << " above " << middle);
      CHECK(found.contains({ix, iy}) == far);
      if (far) CHECK(found[{ix, iy}] == height - middle);
    }
}

TEST_CASE("Spikes do not depend on the number of threads, and bad thresholds are refused",
          "[spikes]") {
  Surface surface = rough(0.5);
  for (Index k = 5; k < 190; k += 7) surface.heights(k, k) += 4e-6;
  const auto found = places(find_spikes(surface));
  CHECK(found.size() == 27);
  parallel::set_threads(1);
  CHECK(places(find_spikes(surface)) == found);
  parallel::set_threads(0);
  CHECK_THROWS_AS(find_spikes(surface, 2.9), InvalidInput);
  CHECK_THROWS_AS(find_spikes(surface, undefined), InvalidInput);
}
