// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>

namespace salebra {

/// A rectangular part of a surface; point (ix, iy) of the surface is at x = ix·dx, y = iy·dy.
struct Rectangle {
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< m, from point (0, 0)
};

constexpr void describe(auto&& visit, std::type_identity<Rectangle>) {
  keep(visit, &Rectangle::x0, &Rectangle::y0, &Rectangle::x1, &Rectangle::y1);
}

/// Cuts out the cells within the rectangle, whose sides snap to the nearest cell borders:
///     const Surface half = cropped(surface, {0, 0, surface.grid.lx / 2, surface.grid.ly});
/// The result is not periodic. Throws InvalidInput if the rectangle exceeds the surface by more
/// than half a cell or contains fewer than two points along an axis.
Surface cropped(const Surface& surface, const Rectangle& part);

/// Finds the largest rectangle (by area) that contains no undefined point; empty if no point is
/// defined. Cost: one pass over the heights.
std::optional<Rectangle> max_defined_part(const Surface& surface);

}  // namespace salebra
