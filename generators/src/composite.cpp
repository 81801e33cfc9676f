// SPDX-License-Identifier: GPL-3.0-or-later
// Sum of the heights of two surfaces, and rectangular part of a surface.
#include <algorithm>
#include <salebra/base/error.hpp>
#include <salebra/generators/composite.hpp>
#include <string>

#include "base/memory.hpp"

namespace salebra {
namespace {

std::string shape_of(const Grid2D& grid) {
  return std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " points";
}

}  // namespace

Surface composite_surface(const Surface& first, const Surface& second) {
  first.require_whole("a sum of surfaces");
  second.require_whole("a sum of surfaces");
  first.grid.validate();
  require(first.grid == second.grid, "second", shape_of(second.grid),
          "must have the points and the size of the first surface, " + shape_of(first.grid));
  return {first.grid, first.heights + second.heights, first.periodic && second.periodic,
          "sum of (" + first.origin + ") and (" + second.origin + ")"};
}

Surface crop_surface(const Surface& surface, Index first_x, Index first_y, Index nx, Index ny) {
  surface.require_whole("a crop");
  const Grid2D& grid = surface.grid;
  const auto check = [&](Index first, Index count, Index points, const char* axis) {
    const std::string of = std::to_string(points) + " points of the surface";
    require(count >= 1 && count <= points, std::string("n") + axis, count,
            "must lie in 1 … the " + of);
    require(first >= 0 && first < points && (surface.periodic || first + count <= points),
            std::string("first_") + axis, first, "must leave room for the part in the " + of);
  };
  check(first_x, nx, grid.nx, "x");
  check(first_y, ny, grid.ny, "y");
  Surface part{{nx, ny, static_cast<double>(nx) * grid.dx(), static_cast<double>(ny) * grid.dy()},
               uninitialised_field(nx, ny),
               false,
               "part of " + surface.origin};
  const Index before_edge = std::min(ny, grid.ny - first_y);
  for (Index x = 0; x < nx; ++x) {
    const auto row = surface.heights.row((first_x + x) % grid.nx);
    part.heights.row(x).head(before_edge) = row.segment(first_y, before_edge);
    part.heights.row(x).tail(ny - before_edge) = row.head(ny - before_edge);
  }
  return part;
}

}  // namespace salebra
