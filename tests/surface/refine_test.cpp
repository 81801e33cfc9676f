// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/refine.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

// Waves that 12 × 10 points resolve, along both axes and diagonally, on a surface with `points`
// times as many points along each axis.
Surface waves(Index points) {
  const Grid2D grid{12 * points, 10 * points, 3e-6, 2e-6};
  Surface surface{grid, Field(grid.nx, grid.ny), true, ""};
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j) {
      const double x = 2 * pi * double(i) / double(grid.nx),
                   y = 2 * pi * double(j) / double(grid.ny);
      surface.heights(i, j) = 1 + std::cos(3 * x + 2 * y) + 0.5 * std::sin(5 * x - 4 * y) +
                              0.25 * std::cos(6 * x) + 0.125 * std::cos(5 * y) * std::cos(x);
    }
  return surface;
}

double max_difference(const Field& a, const Field& b) { return (a - b).abs().maxCoeff(); }

}  // namespace

TEST_CASE("Fourier interpolation of a band-limited surface is that surface") {
  for (const Index factor : {2, 3, 4}) {
    const Surface fine = refined(waves(1), factor), exact = waves(factor);
    CHECK(fine.grid == exact.grid);
    CHECK(fine.periodic);
    // Round-off of transforms of numbers of order 1. cos 5y is the shortest wave of ten points, cos
    // 6x that of twelve.
    CHECK(max_difference(fine.heights, exact.heights) < 1e-13);
  }
}

TEST_CASE("A refined surface keeps its own points, periodic or not, with odd and even counts") {
  for (const bool periodic : {true, false})
    for (const Index count : {15, 16}) {
      Surface surface{{count, 9, 1, 1}, Field(count, 9), periodic, ""};
      for (Index i = 0; i < count; ++i)
        for (Index j = 0; j < 9; ++j)
          surface.heights(i, j) = std::sin(double(7 * i * i + 3 * j + i * j));
      for (const Index factor : {1, 2, 3}) {
        const Surface fine = refined(surface, factor);
        double worst = 0;
        for (Index i = 0; i < count; ++i)
          for (Index j = 0; j < 9; ++j)
            worst = std::max(
                worst, std::abs(fine.heights(i * factor, j * factor) - surface.heights(i, j)));
        CHECK(worst < 1e-13);
      }
    }
}

TEST_CASE(
    "The spline of a smooth surface converges with the fourth power of the distance of its "
    "points") {
  const auto error = [](Index points) {
    Surface coarse{{points, points, 1, 1}, Field(points, points), false, ""}, exact = coarse;
    exact.heights.resize(2 * points, 2 * points);
    const auto height = [](double x, double y) {
      return std::exp(std::sin(2 * pi * x)) * std::cos(2 * pi * (y + 0.1));
    };
    for (Index i = 0; i < points; ++i)
      for (Index j = 0; j < points; ++j)
        coarse.heights(i, j) = height(double(i) / double(points), double(j) / double(points));
    for (Index i = 0; i < 2 * points; ++i)
      for (Index j = 0; j < 2 * points; ++j)
        exact.heights(i, j) =
            height(0.5 * double(i) / double(points), 0.5 * double(j) / double(points));
    return max_difference(refined(coarse, 2).heights, exact.heights);
  };
  const double order = std::log2(error(32) / error(64));
  // The next power in the error is the sixth, relatively at most (2π·3/32)², so the order is 4 to a
  // few tenths.
  CHECK(order == Approx(4).margin(0.3));
}

TEST_CASE("The step at the seam of a scan stays at the seam") {
  Surface scan{{64, 64, 1, 1}, Field(64, 64), false, ""};
  for (Index i = 0; i < 64; ++i) scan.heights.row(i).setConstant(double(i));
  const auto off_ramp_at_20 = [](const Surface& surface) {
    const Field fine = refined(surface, 2).heights;
    return std::abs(fine(41, 0) - 20.5);
  };
  // (2 − √3)^20 of a step of 64 is 2e-10; the ringing of Fourier interpolation there is about
  // 64/(20π).
  CHECK(off_ramp_at_20(scan) < 1e-9);
  scan.periodic = true;
  CHECK(off_ramp_at_20(scan) > 0.1);
}

TEST_CASE("Refinement names what it cannot do") {
  Surface surface = waves(1);
  CHECK_THROWS_WITH(refined(surface, 0), "factor: 0 must be >= 1");
  surface.heights(3, 4) = std::nan("");
  CHECK_THROWS_AS(refined(surface, 2), InvalidInput);
}
