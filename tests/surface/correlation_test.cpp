// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/scale_dependence.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

TEST_CASE("The autocorrelation of a sinusoid is half its squared amplitude times a cosine",
          "[correlation]") {
  const Index nx = GENERATE(32, 33), ny = GENERATE(24, 25);
  const double lx = 2e-3, ly = 3e-3, amplitude = 3e-6, qx = 2 * pi * 3 / lx, qy = -2 * pi * 2 / ly;
  const Surface wave = sampled({nx, ny, lx, ly}, true, [&](double x, double y) {
    return 7 + amplitude * std::cos(qx * x + qy * y + 0.4);
  });
  const CorrelationMap map = correlation_map(wave);
  REQUIRE(map.pairs.rows() == 2 * (nx / 2) + 1);
  REQUIRE(map.pairs.cols() == ny / 2 + 1);
  double error = 0;
  for (Index i = 0; i < map.pairs.rows(); ++i) {
    for (Index j = 0; j < map.pairs.cols(); ++j) {
      const double cosine = std::cos(qx * map.lag_x(i) + qy * map.lag_y(j));
      const double variance = amplitude * amplitude / 2;
      error = std::max(error, std::abs(map.autocorrelation(i, j) / variance - cosine));
      error = std::max(error, std::abs(map.structure(i, j) / variance - 2 * (1 - cosine)));
    }
  }
  // The mean of 7 m leaves a rounding error of 1e-15 of itself in heights of 3e-6 m.
  CHECK(error < 1e-8);
  CHECK((map.pairs == static_cast<double>(nx * ny)).all());
}

TEST_CASE("Sums over pairs are those of the definition, with undefined points and without a period",
          "[correlation]") {
  const bool periodic = GENERATE(false, true);
  Surface surface = white({13, 10, 2.0, 1.0}, periodic);
  const double undefined = std::numeric_limits<double>::quiet_NaN();
  surface.heights(4, 4) = surface.heights(12, 0) = surface.heights(5, 9) = undefined;
  const double mean = height_statistics(surface).mean;
  const CorrelationMap map = correlation_map(surface);
  double error = 0;
  for (Index row = 0; row < map.pairs.rows(); ++row) {
    for (Index column = 0; column < map.pairs.cols(); ++column) {
      const Index a = row - map.origin(), b = column;
      double pairs = 0, product = 0, difference = 0;
      for (Index ix = 0; ix < 13; ++ix) {
        for (Index iy = 0; iy < 10; ++iy) {
          Index jx = ix + a, jy = iy + b;
          if (periodic) {
            jx = (jx + 13) % 13;
            jy = (jy + 10) % 10;
          }
          if (jx < 0 || jx >= 13 || jy < 0 || jy >= 10) continue;
          const double here = surface.heights(ix, iy), there = surface.heights(jx, jy);
          if (std::isnan(here + there)) continue;
          ++pairs;
          product += (here - mean) * (there - mean);
          difference += (here - there) * (here - there);
        }
      }
      REQUIRE(map.pairs(row, column) == pairs);
      error = std::max(error, std::abs(map.autocorrelation(row, column) - product / pairs));
      error = std::max(error, std::abs(map.structure(row, column) - difference / pairs));
    }
  }
  // Heights are of order 1; the sums run over 127 points.
  CHECK(error < 1e-13);
}

TEST_CASE("The structure function of a periodic surface is twice what its correlation has lost",
          "[correlation]") {
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.7, .rolloff = 0.3, .short_cutoff = 4.0 / 128, .rms_height = 1e-6});
  Surface surface = random_phase({128, 96, 1, 0.75}, spectrum, 5);
  const CorrelationMap circular = correlation_map(surface);
  // Four copies as a non-periodic surface take the route over pairs, which computes S without A.
  const double variance = std::pow(height_statistics(surface).rms_height, 2);
  CHECK(circular.autocorrelation(circular.origin(), 0) == Approx(variance).epsilon(1e-13));
  Surface tiled{{256, 192, 2, 1.5}, Field(256, 192), false, "four cells"};
  tiled.heights << surface.heights, surface.heights, surface.heights, surface.heights;
  const CorrelationMap open = correlation_map(tiled);
  const Correlation along = profile_correlation(open, Axis::x);
  // Half the length of a row of two periods is one period, where the structure function is 0 again.
  CHECK(along.structure[128] < 1e-12 * variance);
  CHECK(along.structure.size() == 129);
  const Correlation rings = radial_correlation(circular);
  REQUIRE(rings.distance.front() == 0);
  for (std::size_t k = 0; k < rings.distance.size(); ++k) {
    if (k > 0) CHECK(rings.distance[k] > rings.distance[k - 1]);
    CHECK(rings.pairs[k] > 0);
    CHECK(rings.structure[k] ==
          Approx(2 * (variance - rings.autocorrelation[k])).margin(1e-12 * variance));
  }
  CHECK(rings.distance.back() <= 0.375 * (1 + 1e-12));
}

TEST_CASE("Rings weigh each distance with its pairs", "[correlation]") {
  // On a non-periodic surface, a distance along x has fewer pairs than the same distance along y.
  Surface surface = white({24, 60, 1.0, 2.5}, false);
  surface.heights(3, 3) = std::numeric_limits<double>::quiet_NaN();
  const CorrelationMap map = correlation_map(surface);
  const Correlation rings = radial_correlation(map, 2);
  double pairs = 0, distance = 0, structure = 0, product = 0;
  for (std::size_t k = 0; k < rings.pairs.size(); ++k) {
    pairs += rings.pairs[k];
    distance += rings.pairs[k] * rings.distance[k];
    structure += rings.pairs[k] * rings.structure[k];
    product += rings.pairs[k] * rings.autocorrelation[k];
  }
  for (Index row = 0; row < map.pairs.rows(); ++row) {
    for (Index column = 0; column < map.pairs.cols(); ++column) {
      const double r = std::hypot(map.lag_x(row), map.lag_y(column));
      if (r > 0.5 * (1 + 1e-9)) continue;
      pairs -= map.pairs(row, column);
      distance -= map.pairs(row, column) * r;
      structure -= map.pairs(row, column) * map.structure(row, column);
      product -= map.pairs(row, column) * map.autocorrelation(row, column);
    }
  }
  // Only rounding errors of sums of 1e5 to 1e6 remain.
  CHECK(pairs == 0);
  CHECK(std::abs(distance) < 1e-8);
  CHECK(std::abs(structure) < 1e-8);
  CHECK(std::abs(product) < 1e-8);
}

TEST_CASE("The structure function of a self-affine surface grows with twice the Hurst exponent",
          "[correlation]") {
  const double hurst = GENERATE(0.3, 0.7);
  // The roll-off is not within the cell, and the shortest waves span two cells.
  const SelfAffineSpectrum spectrum(
      {.hurst = hurst, .rolloff = 1, .short_cutoff = 2.0 / 1024, .rms_height = 1});
  const Correlation rings =
      radial_correlation(correlation_map(random_phase({1024, 1024, 1, 1}, spectrum, 2)));
  const auto at = [&](double distance) {
    std::size_t k = 0;
    while (rings.distance[k] < distance) ++k;
    return k;
  };
  const std::size_t low = at(8.0 / 1024), high = at(32.0 / 1024);
  const double slope = std::log(rings.structure[high] / rings.structure[low]) /
                       std::log(rings.distance[high] / rings.distance[low]);
  // S ∝ r^{2H} far from both cut-offs. At a hundredth of the cell they change the exponent by
  // (r/L)^{2−2H} and (a/r)^{2H}, at most 0.1.
  CHECK(slope == Approx(2 * hurst).margin(0.1));
}

TEST_CASE("Slope and curvature at a distance are those of a sinusoid seen through the stencil",
          "[scale]") {
  const double lx = 2.0, amplitude = 3e-3, q = 2 * pi * 2 / lx;
  const Surface wave = sampled({200, 5, lx, 1.0}, true,
                               [&](double x, double) { return amplitude * std::sin(q * x); });
  const ScaleDependence along = scale_dependence(wave, Axis::x);
  REQUIRE(along.spacing.size() > 10);
  CHECK(along.spacing.back() <= lx / 4);
  for (std::size_t k = 0; k < along.spacing.size(); ++k) {
    const double s = along.spacing[k], half = std::sin(q * s / 2);
    CHECK(along.profile_slope[k] ==
          Approx(amplitude * std::sqrt(2) * std::abs(half) / s).epsilon(1e-12));
    CHECK(along.profile_curvature[k] ==
          Approx(4 * half * half / (s * s) * amplitude / std::sqrt(2)).epsilon(1e-12));
    // With 100 points per wave, the crest lies on a point.
    CHECK(along.min_curvature[k] == Approx(-4 * half * half / (s * s) * amplitude).epsilon(1e-12));
    CHECK(along.stencils[k] == 1000);
  }
  const ScaleDependence across = scale_dependence(wave, Axis::y);
  CHECK(across.profile_slope.front() < 1e-15);
}

TEST_CASE("The scale-dependent slope is the root of the structure function over the distance",
          "[scale]") {
  Surface surface = white({60, 50, 2.0, 1.0}, false);
  surface.heights(7, 7) = std::numeric_limits<double>::quiet_NaN();
  const Axis axis = GENERATE(Axis::x, Axis::y);
  const ScaleDependence scales = scale_dependence(surface, axis);
  const Correlation profile = profile_correlation(correlation_map(surface), axis);
  const double step = profile.distance[1];
  for (std::size_t k = 0; k < scales.spacing.size(); ++k) {
    const auto lag = static_cast<std::size_t>(std::lround(scales.spacing[k] / step));
    // The left-hand side comes from differences, the right-hand side from transforms.
    CHECK(scales.profile_slope[k] ==
          Approx(std::sqrt(profile.structure[lag]) / scales.spacing[k]).epsilon(1e-12));
  }
}

TEST_CASE("Below the wavelength at which peaks are as sharp as the tip, a scan is not reliable",
          "[reliability]") {
  const double l = 1.0, amplitude = 1e-3, q = 2 * pi * 4 / l;
  const Surface wave = sampled({256, 128, l, 0.5}, false,
                               [&](double x, double) { return amplitude * std::cos(q * x); });
  const auto sharpness = [&](double s) {
    return amplitude * std::pow(2 * std::sin(q * s / 2) / s, 2);
  };
  // Choose the tip whose limit is reached at a spacing of 12 steps; a wave has 64.
  const double s = 12.0 / 256, radius = 0.5 / sharpness(s);
  const ReliabilityLimit limit = short_wavelength_limit(wave, {.tip_radius = radius});
  CHECK(limit.pixel == Approx(2.0 / 256));
  // For oblong cells the longer side is relevant.
  const Surface oblong = sampled({64, 256, 1, 1}, false, [](double, double) { return 0.0; });
  CHECK(short_wavelength_limit(oblong, {}).pixel == Approx(2.0 / 64));
  // The limit is interpolated linearly, but 12 steps are a node.
  CHECK(limit.tip.value() == Approx(2 * s).epsilon(1e-9));
  CHECK(limit.wavelength() == limit.tip.value());
  CHECK(short_wavelength_limit(wave, {.tip_radius = 0.4 / sharpness(1.0 / 256)}).tip.value() == 0);
  CHECK(std::isinf(short_wavelength_limit(wave, {.tip_radius = 1e6}).tip.value()));
  CHECK(short_wavelength_limit(wave, {.resolution = 0.02}).wavelength() == 0.02);
}

TEST_CASE("A parabola that is not periodic has one curvature, at its edges and beside a hole too",
          "[scale]") {
  Surface bowl = sampled({41, 30, 41.0, 60.0}, false,
                         [](double x, double y) { return 0.5 * x * x + 0.1 * y * y; });
  bowl.heights(20, 10) = std::numeric_limits<double>::quiet_NaN();
  const ScaleDependence along = scale_dependence(bowl, Axis::x);
  for (std::size_t k = 0; k < along.spacing.size(); ++k) {
    CHECK(along.profile_curvature[k] == Approx(1).epsilon(1e-10));
    // Three stencils of a row contain the hole.
    CHECK(along.stencils[k] == (41 - 2 * std::lround(along.spacing[k])) * 30 - 3);
  }
  // The cells are 1 by 2.
  CHECK(short_wavelength_limit(bowl, {}).pixel == 4);
}
