// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

#include "results/quantity_group.hpp"

namespace salebra::cli {

/// The coordinates x and y of the cells of a grid.
inline void write_axes(QuantityGroup& group, const Grid2D& grid) {
  group.coordinate("x", positions(grid.nx, grid.dx()));
  group.coordinate("y", positions(grid.ny, grid.dy()));
}

}  // namespace salebra::cli
