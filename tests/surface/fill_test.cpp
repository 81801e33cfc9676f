// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/fill.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("Holes in a harmonic surface are filled with the surface itself", "[fill]") {
  // x² − y², xy, x and y satisfy the five-point equation exactly, even on rectangular cells.
  const Surface whole = sampled({24, 30, 2.0, 3.0}, false, [](double x, double y) {
    return 3 + x - 2 * y + x * y + x * x - y * y;
  });
  Surface holed = whole;
  holed.heights.block(3, 4, 8, 11).setConstant(undefined);
  holed.heights(20, 25) = undefined;
  const Surface result = filled(holed);
  CHECK(result.undefined_points() == 0);
  // Round-off of heights up to 10 m.
  CHECK((result.heights - whole.heights).abs().maxCoeff() < 1e-13);
}

TEST_CASE("Filled heights stay between those around them, across a periodic edge too", "[fill]") {
  Surface surface = white({16, 16, 1, 1}, true);
  surface.heights.row(0).setConstant(undefined);
  surface.heights.row(15).setConstant(undefined);
  surface.heights.row(1).setConstant(2);
  surface.heights.row(14).setConstant(5);
  const Surface result = filled(surface);
  // The filled rows form a straight line between 5 m and 2 m across the edge.
  CHECK((result.heights.row(15) - 4).abs().maxCoeff() < 1e-14);
  CHECK((result.heights.row(0) - 3).abs().maxCoeff() < 1e-14);
  surface.periodic = false;
  const Surface open = filled(surface);
  CHECK((open.heights.row(15) - 5).abs().maxCoeff() < 1e-14);
  CHECK((open.heights.row(0) - 2).abs().maxCoeff() < 1e-14);
}

TEST_CASE("Nothing can be filled where nothing is defined, and nothing need be where all is",
          "[fill]") {
  Surface surface = white({4, 5, 1, 1}, false);
  CHECK((filled(surface).heights == surface.heights).all());
  surface.heights.setConstant(undefined);
  CHECK_THROWS_WITH(filled(surface), Catch::Contains("undefined"));
}

TEST_CASE("A bowed and tilted surface is flat once its paraboloid is subtracted", "[detrend]") {
  Surface bowed = sampled({40, 25, 3e-3, 2e-3}, false, [](double x, double y) {
    return 1e-6 + 0.3 * x - y + 20 * x * x - 7 * x * y + 3 * y * y;
  });
  bowed.heights(3, 7) = undefined;
  const Surface flat = detrended(bowed, Detrend::quadratic);
  CHECK(flat.undefined_points() == 1);
  // Heights of order 3 mm have errors of 1e-15 of that, times the condition of six normal
  // equations.
  CHECK(flat.heights.isNaN().select(0.0, flat.heights).abs().maxCoeff() < 1e-16);
  // A plane does not suffice.
  const Surface bow = detrended(bowed, Detrend::plane);
  CHECK(bow.heights.isNaN().select(0.0, bow.heights).abs().maxCoeff() > 1e-6);
}
