// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/shapes.hpp>

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi;
const Grid2D grid{40, 30, 4e-3, 6e-3};
const PlanePoint middle{2e-3, 3e-3};  // grid point (20, 15)

}  // namespace

TEST_CASE("Bodies have their apex at height zero in the middle of the grid",
          "[generators][shapes]") {
  for (const Surface& surface :
       {paraboloid_surface(grid, 1.0), elliptic_paraboloid_surface(grid, 1.0, 2.0),
        sphere_surface(grid, 1e-2), ellipsoid_surface(grid, 5e-3, 6e-3, 1e-3),
        cone_surface(grid, 0.1), wedge_surface(grid, 0.1), ridge_surface(grid, 1.0),
        flat_punch_surface(grid, 5e-4, 1e-6), rounded_punch_surface(grid, 5e-4, 1.0)}) {
    CAPTURE(surface.origin);
    CHECK_NOTHROW(surface.require_complete("test"));
    CHECK_FALSE(surface.periodic);
    CHECK(surface.heights(20, 15) == 0);
    CHECK(surface.heights.maxCoeff() == 0);
    CHECK(surface.heights(0, 0) < 0);
    // Mirror symmetry about the axis, separately for x and y.
    CHECK(surface.heights(13, 15) == Approx(surface.heights(27, 15)).epsilon(1e-12));
    CHECK(surface.heights(20, 11) == Approx(surface.heights(20, 19)).epsilon(1e-12));
  }
}

TEST_CASE("Bodies have the curvature and the slope asked", "[generators][shapes]") {
  const double dx = grid.dx(), dy = grid.dy();
  const auto curvature_x = [&](const Surface& s) {
    return (s.heights(21, 15) - 2 * s.heights(20, 15) + s.heights(19, 15)) / (dx * dx);
  };
  const auto curvature_y = [&](const Surface& s) {
    return (s.heights(20, 16) - 2 * s.heights(20, 15) + s.heights(20, 14)) / (dy * dy);
  };
  const Surface paraboloid = paraboloid_surface(grid, 0.5);
  CHECK(curvature_x(paraboloid) == Approx(-2).epsilon(1e-12));
  CHECK(curvature_y(paraboloid) == Approx(-2).epsilon(1e-12));
  const Surface elliptic = elliptic_paraboloid_surface(grid, 0.5, 0.25);
  CHECK(curvature_x(elliptic) == Approx(-2).epsilon(1e-12));
  CHECK(curvature_y(elliptic) == Approx(-4).epsilon(1e-12));
  // A sphere deviates from its osculating paraboloid by a fraction (r/2R)², here dx².
  const Surface sphere = sphere_surface(grid, 0.5);
  CHECK(curvature_x(sphere) == Approx(-2).epsilon(2 * dx * dx));
  // An ellipsoid has the radii a²/c and b²/c at its apex.
  const Surface ellipsoid = ellipsoid_surface(grid, 0.1, 0.2, 0.05);
  CHECK(curvature_x(ellipsoid) == Approx(-0.05 / 0.01).epsilon(1e-4));
  CHECK(curvature_y(ellipsoid) == Approx(-0.05 / 0.04).epsilon(1e-4));
  const Surface cone = cone_surface(grid, pi / 6);
  CHECK(cone.heights(23, 19) ==
        Approx(-std::hypot(3 * dx, 4 * dy) / std::sqrt(3.0)).epsilon(1e-12));
  const Surface wedge = wedge_surface(grid, pi / 4);
  CHECK(wedge.heights(25, 3) == Approx(-5 * dx).epsilon(1e-12));
  CHECK(ridge_surface(grid, 2.0).heights(25, 3) == Approx(-25 * dx * dx / 4).epsilon(1e-12));
}

TEST_CASE("Punches are flat up to their radius", "[generators][shapes]") {
  const Grid2D fine{400, 400, 1.0, 1.0};
  const Surface sharp = flat_punch_surface(fine, 0.3, 1e-3, off_grid_center(fine));
  const double area = double((sharp.heights == 0).count()) * fine.cell_area();
  // Number of lattice points in a disc with a radius of 120 cells: the error is about 120^{2/3} of
  // 45000 cells.
  CHECK(area == Approx(pi * 0.09).epsilon(1e-3));
  CHECK(sharp.heights.minCoeff() == -1e-3);
  const Surface rounded = rounded_punch_surface(fine, 0.3, 2.0);
  CHECK(rounded.heights(200 + 119, 200) == 0);
  CHECK(rounded.heights(200 + 160, 200) == Approx(-0.01 / 4).epsilon(1e-10));
}

TEST_CASE("A body follows its centre off the grid", "[generators][shapes]") {
  const PlanePoint center = off_grid_center(grid);
  CHECK((center.x - middle.x) / grid.dx() == Approx(0.31));
  CHECK((center.y - middle.y) / grid.dy() == Approx(0.17));
  const Surface moved = paraboloid_surface(grid, 0.5, center);
  // Find the vertex of the parabola through three points of the row.
  const double left = moved.heights(19, 15), right = moved.heights(21, 15);
  const double curvature = left - 2 * moved.heights(20, 15) + right;
  CHECK((left - right) / (2 * curvature) == Approx(0.31).epsilon(1e-9));
}

TEST_CASE("Pyramids repeat with square cross-sections", "[generators][shapes]") {
  const Grid2D cell{64, 48, 1.0, 0.75};
  const Surface pyramids = pyramids_surface(cell, 4, 4, 0.2);
  CHECK(pyramids.periodic);
  CHECK(pyramids.heights(8, 6) == 0);
  CHECK((pyramids.heights == 0).count() == 16);
  CHECK(pyramids.heights(8 + 3, 6 + 1) == Approx(-std::tan(0.2) * 3 * cell.dx()));
  CHECK(pyramids.heights(8 + 3, 6 + 3) == Approx(-std::tan(0.2) * 3 * cell.dx()));
  CHECK((pyramids.heights.topRows(16) - pyramids.heights.bottomRows(16)).abs().maxCoeff() < 1e-15);
  const Surface moved = pyramids_surface(cell, 4, 4, 0.2, {2 * cell.dx(), 3 * cell.dy()});
  CHECK(moved.heights(10, 9) == Approx(0).margin(1e-15));
}

TEST_CASE("Sinusoids have their waves and amplitude", "[generators][shapes]") {
  const Grid2D cell{64, 32, 2.0, 1.0};
  const Surface waves = sinusoid_surface(cell, 1e-6, 4, 1);
  CHECK(waves.periodic);
  CHECK(waves.heights(0, 0) == 1e-6);
  CHECK(waves.heights(8, 0) == Approx(-1e-6));
  CHECK(waves.heights(0, 16) == Approx(-1e-6));
  CHECK(waves.heights.square().mean() == Approx(1e-12 / 4).epsilon(1e-12));
  const Surface straight = sinusoid_surface(cell, 1e-6, 0, 2, {0, 0.25});
  CHECK(straight.heights(11, 8) == Approx(1e-6));
  CHECK(straight.heights.square().mean() == Approx(1e-12 / 2).epsilon(1e-12));
}

TEST_CASE("Shapes refuse what has no shape", "[generators][shapes]") {
  CHECK_THROWS_WITH(paraboloid_surface(grid, 0), Catch::Contains("radius: 0 must"));
  CHECK_THROWS_AS(cone_surface(grid, pi / 2), InvalidInput);
  CHECK_THROWS_AS(cone_surface(grid, -0.1), InvalidInput);
  CHECK_THROWS_AS(paraboloid_surface(grid, 1, PlanePoint{std::nan(""), 0}), InvalidInput);
  CHECK_THROWS_AS(paraboloid_surface({0, 4, 1, 1}, 1), InvalidInput);
  CHECK_THROWS_AS(pyramids_surface(grid, 0, 1, 0.1), InvalidInput);
  CHECK_THROWS_AS(pyramids_surface(grid, 1, 16, 0.1), InvalidInput);
  CHECK_THROWS_AS(sinusoid_surface(grid, 1e-6, 0, 0), InvalidInput);
  CHECK_THROWS_AS(sinusoid_surface(grid, 1e-6, 11, 0), InvalidInput);
}
