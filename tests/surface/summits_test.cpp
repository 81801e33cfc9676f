// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/summits.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

TEST_CASE("An off-grid rotated paraboloid is one summit with its vertex and curvatures",
          "[summits]") {
  const double x0 = 1.13, y0 = 0.79, angle = 0.4, k1 = 5, k2 = 2;
  const Surface cap = sampled({24, 20, 2.4, 1.6}, false, [&](double x, double y) {
    const double u = std::cos(angle) * (x - x0) + std::sin(angle) * (y - y0);
    const double v = -std::sin(angle) * (x - x0) + std::cos(angle) * (y - y0);
    return 3 - (k1 * u * u + k2 * v * v) / 2;
  });
  const SummitList list = find_summits(cap);
  REQUIRE(list.summits.size() == 1);
  // Least squares reproduces a paraboloid exactly; second differences of heights ~3 over 0.1² have
  // errors of 1e-13.
  CHECK(list.summits[0].x == Approx(x0).epsilon(1e-11));
  CHECK(list.summits[0].y == Approx(y0).epsilon(1e-11));
  CHECK(list.summits[0].height == Approx(3).epsilon(1e-12));
  CHECK(list.summits[0].curvature1 == Approx(k1).epsilon(1e-11));
  CHECK(list.summits[0].curvature2 == Approx(k2).epsilon(1e-11));
  CHECK(list.summits[0].mean_radius() == Approx(2 / (k1 + k2)).epsilon(1e-11));
  CHECK(list.searched_area == Approx(22 * 18 * 0.1 * 0.08).epsilon(1e-12));
}

TEST_CASE("An egg box has its summits' density, height and radius, at second order in the step",
          "[summits]") {
  // h = a(cos qx + cos qy) has maxima of height 2a on a lattice of period λ, with curvature a q²
  // along both axes.
  const double a = 1e-6, period = 1e-4, q = 2 * pi / period;
  const auto statistics = [&](Index n) {
    const Surface box = sampled({n, n, 4 * period, 4 * period}, true, [&](double x, double y) {
      return a * (std::cos(q * x - 0.1) + std::cos(q * y + 0.2));
    });
    const SummitList list = find_summits(box);
    CHECK(list.summits.size() == 16);
    return summit_statistics(list);
  };
  const SummitStatistics coarse = statistics(64), fine = statistics(128);
  CHECK(fine.summit_density == Approx(1 / (period * period)).epsilon(1e-12));
  CHECK(fine.mean_height == Approx(2 * a).epsilon(1e-3));
  CHECK(fine.rms_height < 1e-9 * a);
  const double exact = 1 / (a * q * q);
  // The leading error is (q dx)² times a constant. The next term is (q dx)² ~ 0.04 to 0.15 of it,
  // and the vertex moves within its cell.
  CHECK(std::log2((coarse.mean_radius / exact - 1) / (fine.mean_radius / exact - 1)) ==
        Approx(2).margin(0.3));
}

TEST_CASE("Summits wrap around a periodic surface and keep off the border of another",
          "[summits]") {
  const auto ridge = [](double x, double y) { return std::cos(2 * pi * x) + std::cos(2 * pi * y); };
  CHECK(find_summits(sampled({12, 12, 1, 1}, true, ridge)).summits.size() == 1);
  CHECK(find_summits(sampled({12, 12, 1, 1}, false, ridge)).summits.empty());
}

TEST_CASE("Equal neighbours are one summit, a flat surface has none", "[summits]") {
  Surface surface = sampled({8, 8, 8, 8}, true, [](double, double) { return 0.0; });
  CHECK(find_summits(surface).summits.empty());
  CHECK(summit_statistics(find_summits(surface)).summit_density == 0);
  surface.heights(3, 3) = surface.heights(3, 4) = 1;
  CHECK(find_summits(surface).summits.size() == 1);
}

TEST_CASE("Every point above its eight neighbours is a summit, however rough the surface",
          "[summits]") {
  const Surface rough = white({64, 48, 1, 1}, true);
  // For independent heights, one point in nine is the highest of its nine; the count scatters by a
  // few per cent.
  const SummitStatistics statistics = summit_statistics(find_summits(rough));
  CHECK(statistics.summit_density == Approx(64 * 48 / 9.0).epsilon(0.1));
  CHECK(statistics.mean_radius > 0);
}

TEST_CASE("Points beside an undefined one are not searched", "[summits]") {
  Surface surface = sampled({8, 8, 8, 8}, true, [](double, double) { return 0.0; });
  surface.heights(3, 3) = 1;
  surface.heights(4, 4) = std::nan("");
  const SummitList list = find_summits(surface);
  CHECK(list.summits.empty());
  CHECK(list.searched_area == Approx(64 - 9));
  CHECK_THROWS_AS(find_summits(white({2, 8, 1, 1}, true)), InvalidInput);
}

TEST_CASE("A summit whose paraboloid has its vertex elsewhere stands on its point", "[summits]") {
  Surface surface{{5, 5, 5, 5}, Field::Constant(5, 5, -10), false, "one summit"};
  // Three rows along x; the least-squares paraboloid rises beyond the neighbours.
  surface.heights.col(1).segment(1, 3) << -2, -0.7, 0.4;
  surface.heights.col(2).segment(1, 3) << 0.9, 1, 0.99;
  surface.heights.col(3).segment(1, 3) << -2, -0.7, 0.4;
  const SummitList list = find_summits(surface);
  REQUIRE(list.summits.size() == 1);
  CHECK(list.summits.front().x == 2);
  CHECK(list.summits.front().y == 2);
  CHECK(list.summits.front().height == 1);
}
