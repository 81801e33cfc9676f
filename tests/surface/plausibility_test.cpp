// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/plausibility.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "test_surfaces.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

/// A ripple of rms slope 0.083 on a tilted plane, times a factor.
Surface ripple(double factor, double tilt = 0) {
  const Grid2D grid{64, 48, 64e-6, 48e-6};
  const double wavelength = 16e-6, q = 2 * std::numbers::pi / wavelength;
  // Differences of neighbours reduce the slope by sin(q dx/2)/(q dx/2), 0.6 % here.
  const double amplitude = 0.083 * std::sqrt(2) / q;
  return sampled(grid, false, [&](double x, double y) {
    return factor * (amplitude * std::sin(q * x) + tilt * (x + y));
  });
}

}  // namespace

TEST_CASE("Heights whose unit was forgotten are doubted with the unit that is plausible",
          "[plausibility]") {
  CHECK_FALSE(warning_of_heights(ripple(1)));
  for (const auto& [factor, unit] : {std::pair(1e3, "mm"), {1e6, "\u00b5m"}, {1e9, "nm"}}) {
    const auto warning = warning_of_heights(ripple(factor));
    REQUIRE(warning);
    CHECK_THAT(*warning,
               Contains(std::string("heights in ") + unit + "? Then the rms slope would be 0.08"));
  }
  // Nanometres that were read as micrometres.
  const auto warning = warning_of_heights(ripple(1e3), 1e-6);
  REQUIRE(warning);
  CHECK_THAT(*warning, Contains("heights in nm? Then the rms slope would be 0.08"));
}

TEST_CASE("The tilt of a stage is no slope of the surface", "[plausibility]") {
  CHECK_FALSE(warning_of_heights(ripple(1, 10)));
  const auto warning = warning_of_heights(ripple(1e6, 10));
  REQUIRE(warning);
  CHECK_THAT(*warning, Contains("heights in \u00b5m? Then the rms slope would be 0.08"));
}

TEST_CASE("A slope that no unit explains is doubted without one", "[plausibility]") {
  CHECK_FALSE(warning_of_slope(1));
  CHECK_FALSE(warning_of_slope(std::numeric_limits<double>::quiet_NaN()));
  for (const double slope : {1.01, 3.0, 1e14, std::numeric_limits<double>::infinity()}) {
    const auto warning = warning_of_slope(slope);
    REQUIRE(warning);
    CHECK_THAT(*warning, Contains("is above 1") && Contains("check the unit") && !Contains("?"));
  }
}

TEST_CASE("Profiles are doubted as maps are", "[plausibility]") {
  const auto wave = [](double factor) {
    return sampled({64, 1, 64e-6, 1e-6}, false,
                   [&](double x, double) { return factor * 1e-7 * std::sin(4e5 * x); });
  };
  CHECK_FALSE(warning_of_heights(wave(1)));
  const auto warning = warning_of_heights(wave(1e6));
  REQUIRE(warning);
  CHECK_THAT(*warning, Contains("heights in \u00b5m?"));
}

TEST_CASE("Heights without pairs of neighbours are not doubted", "[plausibility]") {
  const auto spikes = [](double x, double) { return x > 0.5 ? 1e9 : 0; };
  CHECK_FALSE(warning_of_heights(sampled({1, 1, 1, 1}, false, spikes)));
  Surface holes = ripple(1e6);
  for (Index ix = 0; ix < holes.grid.nx; ++ix)
    for (Index iy = ix % 2; iy < holes.grid.ny; iy += 2)
      holes.heights(ix, iy) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(warning_of_heights(holes));
  // A hole is not a step.
  Surface hole = ripple(1);
  hole.heights(5, 5) = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(warning_of_heights(hole));
}

TEST_CASE("Values that are no heights are doubted", "[plausibility]") {
  const Field heights = ripple(1).heights;
  CHECK(warnings_of_values(heights, 1.).empty());
  const auto only = [](const Field& changed, std::optional<double> unit = 1.) {
    const auto warnings = warnings_of_values(changed, unit);
    return warnings.size() == 1 ? warnings[0] : std::to_string(warnings.size()) + " doubts";
  };
  SECTION("Whole numbers, unless the file states their unit") {
    const Field whole = 1e-9 * (1e8 * heights).round();
    CHECK_THAT(only(whole, 1e-9), Contains("whole numbers"));
    CHECK(warnings_of_values(whole, {}).empty());
    CHECK(warnings_of_values(whole, 1.).empty());
  }
  SECTION("A first row or column of one value") {
    Field changed = ripple(1, 0.1).heights;
    changed.row(0) = 0;
    CHECK_THAT(only(changed), Contains("first column"));
    changed = heights;
    changed.col(0) = 1e-7;
    CHECK_THAT(only(changed), Contains("first row"));
    CHECK(warnings_of_values(changed, {}).empty());
    // For a ripple along x each column holds one value, but the second column equals the first.
    CHECK(warnings_of_values(heights, 1.).empty());
  }
  SECTION("Repeated pits and peaks that may be marks") {
    Field changed = heights;
    changed(3, 4) = -9.999e-3;
    CHECK(warnings_of_values(changed, 1.).empty());
    changed(30, 40) = -9.999e-3;
    CHECK_THAT(only(changed), Contains("2 heights of -0.009999 are farther"));
    changed = heights;
    changed(3, 4) = changed(5, 6) = 9.999e-3;
    CHECK_THAT(only(changed), Contains("2 heights of 0.009999"));
  }
}
