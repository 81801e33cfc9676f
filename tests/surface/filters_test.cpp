// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/moments.hpp>

#include "test_surfaces.hpp"

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi;

/// The Gaussian-weighted mean around each point by the formula of the standard, as a double sum.
Field weighted_means(const Surface& surface, double cutoff) {
  const Grid2D& grid = surface.grid;
  const double width = std::sqrt(std::numbers::ln2 / pi) * cutoff;
  Field means(grid.nx, grid.ny);
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j) {
      double sum = 0, weights = 0;
      for (Index a = 0; a < grid.nx; ++a)
        for (Index b = 0; b < grid.ny; ++b) {
          if (std::isnan(surface.heights(a, b))) continue;
          const double x = double(a - i) * grid.dx(), y = double(b - j) * grid.dy();
          const double weight = std::exp(-pi * (x * x + y * y) / (width * width));
          sum += weight * surface.heights(a, b);
          weights += weight;
        }
      means(i, j) = std::isnan(surface.heights(i, j)) ? std::nan("") : sum / weights;
    }
  return means;
}

}  // namespace

TEST_CASE("A wave of the cut-off keeps half of its amplitude, in any direction and by both filters",
          "[filters]") {
  const Grid2D grid{96, 60, 3.0, 2.0};
  const auto [nx, ny] = GENERATE(std::pair(4, 0), std::pair(0, 5), std::pair(3, 4));
  const double fx = nx / grid.lx, fy = ny / grid.ly, wavelength = 1 / std::hypot(fx, fy);
  const Surface wave = sampled(
      grid, true, [&](double x, double y) { return std::sin(2 * pi * (fx * x + fy * y) + 0.3); });
  // Round-off of the transforms.
  CHECK((filtered(wave, {.s_filter = wavelength}).heights - 0.5 * wave.heights).abs().maxCoeff() <
        1e-14);
  CHECK((filtered(wave, {.l_filter = wavelength}).heights - 0.5 * wave.heights).abs().maxCoeff() <
        1e-14);
  // A cut-off of twice the wavelength leaves 2^-4, and one of half of it 2^-1/4.
  const double longer = std::min(2 * wavelength, grid.ly);
  const double kept = std::exp2(-std::pow(longer / wavelength, 2));
  CHECK((filtered(wave, {.s_filter = longer}).heights - kept * wave.heights).abs().maxCoeff() <
        1e-14);
  CHECK(
      (filtered(wave, {wavelength / 2, wavelength}).heights - 0.5 * std::exp2(-0.25) * wave.heights)
          .abs()
          .maxCoeff() < 1e-14);
}

TEST_CASE("White noise keeps the part of its variance under the squared transmission",
          "[filters]") {
  // Independent heights of variance 1/3 have equal power in all cycles per cell |f| < 1/2. The
  // filter keeps the integral of 2^(-2(c f)²), c cells to the cut-off, along each axis: √(π/(2 ln
  // 2))/c · erf(c √(2 ln 2)/2). With 512² points and c = 8 about 4600 independent values remain;
  // their variance scatters by √(2/4600) = 2 %.
  const Surface noise = white({512, 512, 1, 1}, true);
  const double c = 8, kept = std::sqrt(pi / (2 * std::numbers::ln2)) / c *
                             std::erf(c * std::sqrt(2 * std::numbers::ln2) / 2);
  const double rms = height_statistics(filtered(noise, {.s_filter = c / 512})).rms_height;
  CHECK(rms * rms == Approx(kept * kept / 3).epsilon(0.08));
}

TEST_CASE("Edges and holes renormalise the weights of the standard", "[filters]") {
  Surface patch = white({40, 33, 4.0, 3.3}, false);
  patch.heights(5, 7) = patch.heights(39, 0) = std::numeric_limits<double>::quiet_NaN();
  patch.heights += 100;
  // The sampled weights differ from the exact transmission by 2^-(λ/dx)²/4 at the shortest wave:
  // with eight cells to the cut-off by 2^-16, of heights below 1 m.
  const Field smooth = filtered(patch, {.s_filter = 0.8}).heights;
  const Field expected = weighted_means(patch, 0.8);
  CHECK((smooth.isNaN() == expected.isNaN()).all());
  const Field difference = (smooth - expected).abs();
  CHECK(difference.isNaN().select(0.0, difference).maxCoeff() < 2e-5);
  // What one filter keeps, the other removes.
  const Field sum = (smooth + filtered(patch, {.l_filter = 0.8}).heights - patch.heights).abs();
  CHECK(sum.isNaN().select(0.0, sum).maxCoeff() < 1e-12);
}

TEST_CASE("A constant stays, and a slope changes an edge by αλ/π", "[filters]") {
  const Surface flat = sampled({50, 40, 5, 4}, false, [](double, double) { return 7.0; });
  // Round-off of the transforms.
  CHECK((filtered(flat, {.s_filter = 2}).heights - 7).abs().maxCoeff() < 1e-12);
  const Surface slope = sampled({400, 1, 40, 1}, false, [](double x, double) { return x; });
  const double smooth = filtered(slope, {.s_filter = 8}).heights(0, 0);
  // The mean of half a Gaussian; the sum over cells has one half weight too many at x = 0, which
  // lowers it by dx/(αλ) = 0.1/3.76.
  CHECK(smooth == Approx(std::sqrt(std::numbers::ln2 / pi) * 8 / pi).epsilon(0.03));
}

TEST_CASE("Cut-offs that the surface cannot have are refused", "[filters]") {
  const Surface surface = white({32, 64, 3.2, 3.2}, false);
  CHECK_THROWS_WITH(filtered(surface, {.s_filter = 0.15}),
                    Catch::Contains("s_filter") && Catch::Contains("two cells"));
  CHECK_THROWS_WITH(filtered(surface, {.l_filter = 3.3}), Catch::Contains("longer than the"));
  CHECK_THROWS_WITH(filtered(surface, {1, 1}), Catch::Contains("shorter than `l_filter`"));
  CHECK_THROWS_AS(filtered(surface, {.s_filter = -1}), InvalidInput);
  Surface holes = surface;
  holes.heights.setConstant(std::nan(""));
  CHECK_THROWS_AS(filtered(holes, {.s_filter = 1}), InvalidInput);
}
