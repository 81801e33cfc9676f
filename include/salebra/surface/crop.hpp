// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>

namespace salebra {

/// A part of a surface whose point (ix, iy) lies at x = ix·dx, y = iy·dy.
struct Rectangle {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< m, from the surface's own corner
};

constexpr void describe(auto&& visit, std::type_identity<Rectangle>) {
  keep(visit, &Rectangle::x0, &Rectangle::y0, &Rectangle::x1, &Rectangle::y1);
}

/// The cells within the rectangle, whose sides are moved to the nearest borders of cells. A part is
/// not periodic. Throws InvalidInput where the rectangle leaves the surface by more than half a cell
/// or holds less than two points along an axis.
Surface cropped(const Surface& surface, const Rectangle& part);

/// The rectangle of the largest area in which every point is defined; nothing where no point is.
/// Cost: one pass.
std::optional<Rectangle> largest_defined_part(const Surface& surface);

}  // namespace salebra
