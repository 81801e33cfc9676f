// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/surface/moments.hpp>

#include "base/undefined_points.hpp"
#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

TEST_CASE("Height moments of a two-valued surface", "[moments]") {
  Surface surface =
      sampled({4, 4, 1, 1}, false, [](double x, double) { return x < 0.2 ? 4.0 : 0.0; });
  // One point in four is 4, hence mean 1, variance 3, third moment (27 − 3)/4 = 6 and fourth moment
  // (81 + 3)/4 = 21.
  const HeightStatistics all = height_statistics(surface);
  CHECK(all.mean == Approx(1).epsilon(1e-15));
  CHECK(all.rms_height == Approx(std::sqrt(3.0)).epsilon(1e-15));
  CHECK(all.skewness == Approx(6 / std::pow(3, 1.5)).epsilon(1e-14));
  CHECK(all.kurtosis == Approx(21.0 / 9).epsilon(1e-14));
  CHECK(all.minimum == 0);
  CHECK(all.maximum == 4);
  surface.heights.row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  const HeightStatistics rest = height_statistics(surface);
  CHECK(rest.defined_points == 12);
  CHECK(rest.mean == 0);
  CHECK(std::isnan(rest.skewness));
}

TEST_CASE("Spectral moments of two waves are those of calculus, odd and even grids", "[moments]") {
  const Index nx = GENERATE(16, 17), ny = GENERATE(20, 21);
  const double lx = 2e-3, ly = 3e-3, a = 1e-6, b = 2e-6;
  const double qx = 2 * pi * 3 / lx, qy = 2 * pi * 2 / ly, ky = 2 * pi * 5 / ly;
  const Surface surface = sampled({nx, ny, lx, ly}, true, [&](double x, double y) {
    return 7e-6 + a * std::cos(qx * x + qy * y + 0.3) + b * std::sin(ky * y);
  });
  const SpectralMoments moments = spectral_moments(surface);
  // The waves are resolved; only the round-off of the transform remains.
  CHECK(moments.moment0 == Approx((a * a + b * b) / 2).epsilon(1e-12));
  CHECK(moments.moment2_x == Approx(a * a * qx * qx / 2).epsilon(1e-12));
  CHECK(moments.moment2_y == Approx((a * a * qy * qy + b * b * ky * ky) / 2).epsilon(1e-12));
  CHECK(moments.moment4_x == Approx(a * a * std::pow(qx, 4) / 2).epsilon(1e-12));
  CHECK(moments.moment4_y ==
        Approx((a * a * std::pow(qy, 4) + b * b * std::pow(ky, 4)) / 2).epsilon(1e-12));
}

TEST_CASE("Parseval: the spectrum of white heights holds their variance, Nyquist modes included",
          "[moments]") {
  const Index nx = GENERATE(8, 9), ny = GENERATE(6, 7, 1, 2);
  const Surface surface = white({nx, ny, 1.0, 2.0}, true);
  const double rms_height = height_statistics(surface).rms_height;
  CHECK(spectral_moments(surface).moment0 == Approx(rms_height * rms_height).epsilon(1e-13));
}

TEST_CASE("A checkerboard has its moments at the Nyquist wave number", "[moments]") {
  const Surface board = sampled({8, 6, 8.0, 6.0}, true, [](double x, double y) {
    return static_cast<int>(x + y + 0.5) % 2 == 0 ? 1.0 : -1.0;
  });
  const SpectralMoments spectral = spectral_moments(board);
  CHECK(spectral.moment2_x == Approx(pi * pi).epsilon(1e-13));
  CHECK(spectral.moment4_y == Approx(std::pow(pi, 4)).epsilon(1e-13));
  const SpectralMoments differences = difference_moments(board);
  CHECK(differences.moment2_x == Approx(4).epsilon(1e-15));
  CHECK(differences.moment4_y == Approx(16).epsilon(1e-15));
}

TEST_CASE("Difference moments tend to the spectral ones at second order", "[moments]") {
  const auto error = [](Index n) {
    const Surface wave = sampled({n, n + 1, 1.0, 1.0}, true, [](double x, double y) {
      return std::cos(2 * pi * x) * std::cos(4 * pi * y);
    });
    const SpectralMoments exact = spectral_moments(wave), approximate = difference_moments(wave);
    return std::pair(1 - approximate.moment2() / exact.moment2(),
                     1 - approximate.moment4() / exact.moment4());
  };
  const auto [slope, curvature] = error(64);
  const auto [finer_slope, finer_curvature] = error(128);
  // Errors are (q dx)²/12 and (q dx)²/6 with a relative remainder of (q dx)² ~ 0.04, and n + 1 is
  // not exactly doubled.
  CHECK(std::log2(slope / finer_slope) == Approx(2).margin(0.05));
  CHECK(std::log2(curvature / finer_curvature) == Approx(2).margin(0.05));
  CHECK(slope > 0);
}

TEST_CASE("A tilted plane has its slope and no curvature, whatever is undefined", "[moments]") {
  Surface plane =
      sampled({8, 9, 4.0, 3.0}, false, [](double x, double y) { return 3 * x - 4 * y; });
  plane.heights(2, 3) = plane.heights(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const SpectralMoments moments = difference_moments(plane);
  CHECK(moments.rms_slope() == Approx(5).epsilon(1e-14));
  CHECK(moments.moment4() < 1e-24);
}

TEST_CASE("Statistics refuse what they cannot measure", "[moments]") {
  Surface surface = white({4, 4, 1, 1}, false);
  CHECK_THROWS_AS(spectral_moments(surface), InvalidInput);
  surface.periodic = true;
  surface.heights(1, 1) = std::nan("");
  // The library names the remedy; a program adds its command for it.
  CHECK_THROWS_MATCHES(spectral_moments(surface), UndefinedPoints,
                       Catch::Message("heights: 1 undefined points cannot be used in spectral "
                                      "moments; fill them or crop them first"));
  surface.heights(1, 1) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(height_statistics(surface), InvalidInput);
  CHECK_THROWS_AS(difference_moments(white({2, 4, 1, 1}, true)), InvalidInput);
  surface.heights.resize(3, 4);
  CHECK_THROWS_WITH(height_statistics(surface), Catch::Contains("shape of the grid"));
  CHECK_THROWS_AS(height_statistics(Surface{}), InvalidInput);
}
