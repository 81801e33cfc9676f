// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/surface/crop.hpp>
#include <salebra/surface/fill.hpp>

#include "test_surfaces.hpp"

using namespace salebra;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Tries all rectangles.
Index max_points_by_search(const Surface& surface) {
  const Grid2D& grid = surface.grid;
  Index most = 0;
  for (Index x = 0; x < grid.nx; ++x)
    for (Index y = 0; y < grid.ny; ++y)
      for (Index nx = 1; x + nx <= grid.nx; ++nx)
        for (Index ny = 1; y + ny <= grid.ny; ++ny)
          if (!surface.heights.block(x, y, nx, ny).isNaN().any()) most = std::max(most, nx * ny);
  return most;
}

}  // namespace

TEST_CASE("A part keeps its points, their distances and nothing else", "[crop]") {
  const Surface whole =
      sampled({40, 30, 4.0, 6.0}, true, [](double x, double y) { return x + 10 * y; });
  // Sides move to the nearest border of a cell.
  const Surface part = cropped(whole, {0.52, 1.19, 2.48, 4.01});
  CHECK(part.grid == Grid2D{20, 14, 20 * whole.grid.dx(), 14 * whole.grid.dy()});
  CHECK_FALSE(part.periodic);
  CHECK(part.heights(0, 0) == Approx(0.5 + 12));
  CHECK(part.heights(19, 13) == Approx(2.4 + 38));
  CHECK(cropped(whole, {0, 0, 4, 6}).periodic);
  for (const Rectangle& bad : {Rectangle{-0.1, 0, 1, 1},
                               {0, 0, 4.1, 1},
                               {1, 0, 0.5, 1},
                               {1, 0, 1.1, 1},
                               {0, undefined, 1, 1}})
    CHECK_THROWS_AS(cropped(whole, bad), InvalidInput);
}

TEST_CASE("The largest part without undefined points is that of a search through all", "[crop]") {
  std::mt19937 engine(5);
  for (int round = 0; round < 200; ++round) {
    Surface surface = white({Index(2 + engine() % 9), Index(2 + engine() % 9), 3.0, 2.0}, false);
    const auto partition = 1 + engine() % 8;
    for (double& height : surface.heights.reshaped())
      if (engine() % 8 < partition) height = undefined;
    const auto part = max_defined_part(surface);
    const Index most = max_points_by_search(surface);
    REQUIRE(part.has_value() == (most > 0));
    if (!part) continue;
    const double area = (part->x1 - part->x0) * (part->y1 - part->y0);
    CHECK(area == Approx(double(most) * surface.grid.cell_area()).epsilon(1e-12));
    if (part->x1 - part->x0 < 1.9 * surface.grid.dx() ||
        part->y1 - part->y0 < 1.9 * surface.grid.dy())
      continue;
    const Surface found = cropped(surface, *part);
    CHECK(found.undefined_points() == 0);
    CHECK(found.grid.points() == most);
  }
}

TEST_CASE("Holes have a share of the points and the width of their largest square", "[fill]") {
  Surface surface = white({100, 80, 1.0, 1.6}, false);
  CHECK(holes_of(surface).points == 0);
  CHECK(holes_of(surface).few());
  surface.heights.row(17).setConstant(undefined);  // a lost line is thin
  const Holes line = holes_of(surface);
  CHECK(line.points == 80);
  CHECK(line.fraction == Approx(0.01));
  CHECK(line.width == Approx(0.02));
  CHECK(line.few());
  surface.heights.block(40, 30, 8, 12).setConstant(undefined);
  CHECK(holes_of(surface).width == Approx(8 * 0.02));
  CHECK(holes_of(surface).few());  // 8 of 80
  surface.heights.block(40, 30, 9, 12).setConstant(undefined);
  CHECK_FALSE(holes_of(surface).few());
  Surface dots = white({100, 80, 1.0, 1.6}, false);
  for (Index k = 0; k < 400; ++k) dots.heights((7 * k) % 100, (k / 100) * 20 + k % 7) = undefined;
  CHECK(holes_of(dots).few());
  dots.heights(50, 79) = undefined;
  CHECK_FALSE(holes_of(dots).few());  // one more than a twentieth of the points
}
