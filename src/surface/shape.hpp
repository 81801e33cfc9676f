// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>
#include <string>

namespace salebra::detail {

/// Checks a surface as Surface::require_complete_rows() does, but allows undefined heights.
inline void require_shape_of_rows(const Surface& surface) {
  surface.grid.validate();
  const Index rows = surface.partition().count();
  require(surface.heights.rows() == rows && surface.heights.cols() == surface.grid.ny, "heights",
          std::to_string(surface.heights.rows()) + " x " + std::to_string(surface.heights.cols()),
          "must have the shape of the grid, " + std::to_string(rows) + " x " +
              std::to_string(surface.grid.ny));
}

/// Like require_shape_of_rows(), for a surface in one process.
inline void require_shape(const Surface& surface) {
  surface.require_whole("this calculation");
  require_shape_of_rows(surface);
}

}  // namespace salebra::detail
