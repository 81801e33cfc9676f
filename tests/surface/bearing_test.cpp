// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/surface/bearing.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// A surface with the heights c((k + ½)/N) in shuffled order.
Surface with_curve(Index nx, Index ny, const std::function<double(double)>& curve) {
  Surface surface{{nx, ny, 1, 1}, Field(nx, ny), false, "test"};
  const double points = static_cast<double>(nx * ny);
  for (Index k = 0; k < nx * ny; ++k) {
    const Index shuffled = (k * 7919) % (nx * ny);
    surface.heights.data()[k] = curve((static_cast<double>(shuffled) + 0.5) / points);
  }
  return surface;
}

}  // namespace

TEST_CASE("A linear bearing curve is all core: Sk is its whole range, Spk and Svk are nothing",
          "[bearing]") {
  const double range = 4e-6;
  const BearingCurve curve(with_curve(100, 80, [&](double p) { return 1 + range * (0.5 - p); }));
  const CoreParameters core = core_parameters(curve);
  // Heights of 1 m have rounding errors of 1e-16 m in a range of 4e-6 m.
  CHECK(core.core_height == Approx(range).epsilon(1e-9));
  CHECK(core.peak_height < 1e-9 * range);
  CHECK(core.valley_depth < 1e-9 * range);
  CHECK(curve.height(0.25) == Approx(1 + range / 4).epsilon(1e-15));
  CHECK(curve.area_fraction(1 + range / 4) == Approx(0.25).epsilon(1e-9));
  CHECK(curve.area_fraction(2) == 0);
  CHECK(curve.area_fraction(0) == 1);
}

TEST_CASE("Peaks and valleys on a linear core have the triangles of their areas", "[bearing]") {
  // Core from 1 to −1 over 0.1 <= p <= 0.9, quadratic peaks above it, and linear valleys below it.
  const auto height = [](double p) {
    const double core = (0.5 - p) * 2.5;
    const double peak = p < 0.1 ? 300 * (0.1 - p) * (0.1 - p) : 0;
    const double valley = p > 0.9 ? 20 * (p - 0.9) : 0;
    return core + peak - valley;
  };
  const BearingCurve curve(with_curve(400, 250, height));
  const CoreParameters core = core_parameters(curve);
  CHECK(core.core_height == Approx(2.5).epsilon(1e-9));
  // The limits are c0 = ±1.25 m. Above, core + peak = 1.25 where 2.5 p = 300 (0.1 − p)²; p is the
  // smaller root.
  const double b = 0.2 + 2.5 / 300, p1 = (b - std::sqrt(b * b - 0.04)) / 2;
  // ∫_0^p1 (300 (0.1 − p)² − 2.5 p) dp = 100 (0.1³ − (0.1 − p1)³) − 1.25 p1²; Spk = 2 area/p1.
  const double above = 100 * (1e-3 - std::pow(0.1 - p1, 3)) - 1.25 * p1 * p1;
  // With 100 000 points, the level first half cell of the polygon causes an error of 1e-5.
  CHECK(core.peak_fraction == Approx(p1).epsilon(1e-4));
  CHECK(core.peak_height == Approx(2 * above / p1).epsilon(1e-4));
  // Below, 2.5 (1 − p) = 20 (p − 0.9) at p2. The triangle from there to p = 1 has the height
  // 20·0.1 = 2 m.
  const double p2 = (2.5 + 18) / 22.5;
  CHECK(core.core_fraction == Approx(p2).epsilon(1e-4));
  CHECK(core.valley_depth == Approx(2).epsilon(1e-3));
}

TEST_CASE("Sk of a Gaussian surface is that of the straight line through its quantiles",
          "[bearing]") {
  const BearingCurve curve(with_curve(200, 200, [](double p) { return normal_quantile(1 - p); }));
  const CoreParameters core = core_parameters(curve);
  // The flattest 40 % lie in the middle, up to z = Φ⁻¹(0.7). With x = p − ½ in ±0.2, their
  // least-squares slope is −∫ x Φ⁻¹(½ + x) dx / ∫ x² dx; integration by parts gives
  // ∫ (Φ − ½) z φ dz = erf(z)/(2√π) − 2·0.2 φ(z).
  const double z = normal_quantile(0.7), phi = std::exp(-z * z / 2) / std::sqrt(2 * pi);
  const double slope = (std::erf(z) / (2 * std::sqrt(pi)) - 0.4 * phi) / (2 * 0.008 / 3);
  CHECK(core.core_height == Approx(slope).epsilon(1e-4));
  CHECK(core.peak_height == Approx(core.valley_depth).epsilon(1e-9));
  CHECK(core.peak_fraction == Approx(1 - core.core_fraction).epsilon(1e-9));
}

TEST_CASE("The integral of a bearing curve is that of its polygon", "[bearing]") {
  Surface surface = white({9, 7, 1, 1}, false);
  surface.heights(2, 2) = std::numeric_limits<double>::quiet_NaN();
  surface.heights(3, 3) = surface.heights(4, 4);
  const BearingCurve curve(surface);
  const double from = GENERATE(0.0, 0.003, 0.3), to = GENERATE(0.31, 0.999, 1.0);
  // The midpoint rule loses its second order at the kinks of the polygon.
  double sum = 0;
  constexpr int steps = 200000;
  for (int k = 0; k < steps; ++k) sum += curve.height(from + (to - from) * (k + 0.5) / steps);
  CHECK(curve.integral(from, to) == Approx(sum / steps * (to - from)).margin(1e-8));
  CHECK_THROWS_AS(curve.height(1.01), InvalidInput);
}

TEST_CASE("Fraction and height of a bearing curve are each other's inverse", "[bearing]") {
  const BearingCurve curve(white({20, 20, 1, 1}, false));
  for (const double p : {0.01, 0.2, 0.5, 0.77, 0.99})
    CHECK(curve.area_fraction(curve.height(p)) == Approx(p).epsilon(1e-12));
}

TEST_CASE("A histogram of heights integrates to 1 and has the density of its distribution",
          "[histogram]") {
  const BearingCurve curve(with_curve(200, 200, [](double p) { return normal_quantile(1 - p); }));
  const HeightHistogram histogram = height_histogram(curve);
  CHECK(std::accumulate(histogram.points.begin(), histogram.points.end(), Index{0}) == 40000);
  double sum = 0;
  for (std::size_t k = 0; k < histogram.height.size(); ++k) {
    sum += histogram.height_density[k] * histogram.width;
    const double z = histogram.height[k];
    const double exact = std::exp(-z * z / 2) / std::sqrt(2 * pi);
    // Quantiles are evenly spaced: a bin is off by at most one point on either side, and by the
    // curvature of the density.
    CHECK(histogram.height_density[k] ==
          Approx(exact).margin(2 / (40000 * histogram.width) +
                               0.4 * std::pow(histogram.width, 2) / 24));
  }
  CHECK(sum == Approx(1).epsilon(1e-12));
  const HeightHistogram level =
      height_histogram(BearingCurve(with_curve(4, 4, [](double) { return 3.0; })));
  CHECK(level.points == std::vector<Index>{16});
}

TEST_CASE("Of equal heights the middle stands for all", "[bearing]") {
  Surface surface{{2, 2, 1, 1}, Field(2, 2), false, "four points"};
  surface.heights << 1, 2, 2, 3;
  CHECK(BearingCurve(surface).area_fraction(2) == 0.5);
}

TEST_CASE("Left to itself, a histogram has the bins of Freedman and Diaconis", "[bearing]") {
  Surface surface{{80, 100, 1, 1}, Field(80, 100), false, "even heights"};
  for (Index k = 0; k < 8000; ++k) surface.heights.data()[k] = static_cast<double>(k) / 7999;
  // Half the range lies between the quartiles, so the width 2·½/20 is a twentieth of the range.
  const std::size_t bins = height_histogram(BearingCurve(surface), 0).points.size();
  CHECK(bins >= 19);
  CHECK(bins <= 20);
}

TEST_CASE("Heights of any distribution fall along the bearing curve", "[bearing]") {
  // Sorting uses intervals of the range. Hard cases: one point far away, steps, numbers of all
  // magnitudes.
  Surface surface = white({150, 140, 1, 1}, false, 3);
  SECTION("one point far away") { surface.heights(70, 3) = 1e12; }
  SECTION("steps") { surface.heights = (3 * surface.heights).round(); }
  SECTION("all magnitudes") { surface.heights = (300 * surface.heights).exp(); }
  SECTION("undefined points") {
    surface.heights.row(17) = std::numeric_limits<double>::quiet_NaN();
  }
  std::vector<double> sorted;
  for (const double height : surface.heights.reshaped())
    if (!std::isnan(height)) sorted.push_back(height);
  std::ranges::sort(sorted, std::greater{});
  const BearingCurve curve(surface);
  CHECK(curve.heights() == sorted);
  // The integral equals the mean of the heights; the polygon is level beyond the first and the
  // last.
  double mean = 0;
  for (const double height : sorted) mean += height / static_cast<double>(sorted.size());
  CHECK(curve.integral(0, 1) == Approx(mean).epsilon(1e-9));
}
