// SPDX-License-Identifier: GPL-3.0-or-later
// A rectangle cut out of a surface, and the largest rectangle without undefined points.
#include <fmt/format.h>

#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/surface/crop.hpp>
#include <vector>

#include "shape.hpp"

namespace salebra {
namespace {

/// The cells between two coordinates along an axis: index of the first cell, and number of cells.
std::pair<Index, Index> cells_between(double from, double to, double step, Index points) {
  const auto text = [&](double length) { return format_quantity(length, Dimension::length); };
  const double first = std::round(from / step), last = std::round(to / step);
  require(first >= 0 && last <= static_cast<double>(points) && first <= last, "crop",
          fmt::format("{} to {}", text(from), text(to)),
          fmt::format("must lie between 0 and {}, the smaller number first",
                      text(step * static_cast<double>(points))));
  require(last - first >= 2, "crop", fmt::format("{} to {}", text(from), text(to)),
          fmt::format("must hold two points at least, which are {} apart", text(step)));
  return {static_cast<Index>(first), static_cast<Index>(last - first)};
}

}  // namespace

Surface cropped(const Surface& surface, const Rectangle& part) {
  surface.require_whole("cropping");
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  const auto [first_x, nx] = cells_between(part.x0, part.x1, grid.dx(), grid.nx);
  const auto [first_y, ny] = cells_between(part.y0, part.y1, grid.dy(), grid.ny);
  if (nx == grid.nx && ny == grid.ny) return surface;
  Surface result;
  result.grid = {nx, ny, static_cast<double>(nx) * grid.dx(), static_cast<double>(ny) * grid.dy()};
  result.heights = surface.heights.block(first_x, first_y, nx, ny);
  result.origin = surface.origin;
  return result;
}

std::optional<Rectangle> max_defined_part(const Surface& surface) {
  surface.require_whole("a search for its largest part without undefined points");
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  // For each row, finds the largest rectangle of defined points that ends in this row. `depth`
  // counts the successive defined points that end in each point of the row. The stack holds
  // increasing depths, each with the first column from which on the points are at least that deep.
  struct Step {
    Index first, depth;
  };
  std::vector<Index> depth(static_cast<std::size_t>(grid.ny) + 1,
                           0);  // a last 0 ends all rectangles
  std::vector<Step> steps;
  Index best = 0;
  std::optional<Rectangle> found;
  for (Index ix = 0; ix < grid.nx; ++ix) {
    steps.clear();
    for (Index iy = 0; iy <= grid.ny; ++iy) {
      Index& here = depth[static_cast<std::size_t>(iy)];
      if (iy < grid.ny) here = std::isnan(surface.heights(ix, iy)) ? 0 : here + 1;
      Index first = iy;
      while (!steps.empty() && steps.back().depth >= here) {
        const Step step = steps.back();
        steps.pop_back();
        first = step.first;
        if (const Index points = step.depth * (iy - first); points > best) {
          best = points;
          const auto x = [&](Index i) { return static_cast<double>(i) * grid.dx(); };
          const auto y = [&](Index i) { return static_cast<double>(i) * grid.dy(); };
          found = {x(ix + 1 - step.depth), y(first), x(ix + 1), y(iy)};
        }
      }
      steps.push_back({first, here});
    }
  }
  return found;
}

}  // namespace salebra
