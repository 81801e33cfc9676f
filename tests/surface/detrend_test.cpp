// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/surface/detrend.hpp>

#include "test_surfaces.hpp"

using namespace salebra;

TEST_CASE("A tilted plane is nothing once its plane is subtracted", "[detrend]") {
  const Surface tilted =
      sampled({20, 31, 2e-3, 1e-3}, false, [](double x, double y) { return 1 + 0.3 * x - 2 * y; });
  // The heights are of order 1 m: what remains is their round-off.
  CHECK(detrended(tilted, Detrend::plane).heights.abs().maxCoeff() < 1e-14);
  CHECK(std::abs(detrended(tilted, Detrend::mean).heights.mean()) < 1e-14);
  CHECK((detrended(tilted, Detrend::none).heights == tilted.heights).all());
}

TEST_CASE("The residual of the plane is orthogonal to 1, x and y, undefined points apart",
          "[detrend]") {
  Surface surface = white({24, 17, 3.0, 1.0}, false);
  surface.heights(3, 5) = surface.heights(20, 0) = std::numeric_limits<double>::quiet_NaN();
  surface.heights.col(1) += 100;
  const Surface flat = detrended(surface, Detrend::plane);
  CHECK(flat.undefined_points() == 2);
  double constant = 0, along_x = 0, along_y = 0;
  for (Index ix = 0; ix < 24; ++ix) {
    for (Index iy = 0; iy < 17; ++iy) {
      const double height = flat.heights(ix, iy);
      if (std::isnan(height)) continue;
      constant += height;
      along_x += height * static_cast<double>(ix);
      along_y += height * static_cast<double>(iy);
    }
  }
  // Sums of 406 terms up to 100 · 24: 1e-9 is 1e-15 of what is added up.
  CHECK(std::abs(constant) < 1e-9);
  CHECK(std::abs(along_x) < 1e-9);
  CHECK(std::abs(along_y) < 1e-9);
}

TEST_CASE("A single row of points has a tilt along one axis only", "[detrend]") {
  const Surface line = sampled({9, 1, 9.0, 1.0}, false, [](double x, double) { return 2 * x; });
  CHECK(detrended(line, Detrend::plane).heights.abs().maxCoeff() < 1e-13);
}

TEST_CASE("Nothing is subtracted from a surface without a defined height", "[detrend]") {
  Surface surface = white({4, 4, 1, 1}, false);
  surface.heights.setConstant(std::nan(""));
  CHECK_THROWS_AS(detrended(surface, Detrend::mean), InvalidInput);
  CHECK_THROWS_AS(detrended(surface, Detrend::plane), InvalidInput);
}

TEST_CASE("Jumps and slopes of scan lines go, each line by itself", "[detrend]") {
  // Even about the middle of each line, so that it has no slope of its own; of mean 0.
  const auto wave = [](double x, double) { return std::cos(2 * 3.14159265358979 * (x - 0.5)); };
  const Surface rough = sampled({64, 21, 1.0, 2.0}, false, wave);
  Surface scanned = rough;
  for (Index iy = 0; iy < 21; ++iy)
    for (Index ix = 0; ix < 64; ++ix)
      scanned.heights(ix, iy) += std::sin(5.0 * double(iy)) + 0.1 * double(iy) * double(ix);
  scanned.heights.col(7).tail(60).setConstant(std::nan(""));  // four points are left
  scanned.heights.col(8).setConstant(std::nan(""));
  scanned.heights.col(9).tail(63).setConstant(std::nan(""));  // one
  const Surface flat = detrended(scanned, Detrend::lines), alone = detrended(rough, Detrend::lines);
  CHECK(flat.undefined_points() == 60 + 64 + 63);
  CHECK(flat.heights(0, 9) == 0);
  for (const Index iy : {Index{0}, Index{6}, Index{20}}) {
    // Heights up to 100 m: round-off.
    CHECK((flat.heights.col(iy) - alone.heights.col(iy)).abs().maxCoeff() < 1e-12);
    double along_x = 0;
    for (Index ix = 0; ix < 64; ++ix) along_x += flat.heights(ix, iy) * double(ix);
    CHECK(std::abs(along_x) < 1e-9);
    CHECK(std::abs(flat.heights.col(iy).sum()) < 1e-11);
  }
}
