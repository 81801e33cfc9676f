// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/io/result_file.hpp>

namespace salebra::cli {

/// The coordinates x and y of the cells of a grid.
inline void write_axes(ResultGroup& group, const Grid2D& grid) {
  group.coordinate("x", positions(grid.nx, grid.dx()), "m", "position along x");
  group.coordinate("y", positions(grid.ny, grid.dy()), "m", "position along y");
}

}  // namespace salebra::cli
