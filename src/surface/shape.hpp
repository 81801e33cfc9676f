// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <string>

namespace salebra::detail {

/// The check of Surface::require_complete without its demand that every height be defined.
inline void require_shape(const Surface& surface) {
  surface.grid.validate();
  require(surface.heights.rows() == surface.grid.nx && surface.heights.cols() == surface.grid.ny,
          "heights",
          std::to_string(surface.heights.rows()) + " x " + std::to_string(surface.heights.cols()),
          "must have the shape of the grid, " + std::to_string(surface.grid.nx) + " x " +
              std::to_string(surface.grid.ny));
}

}  // namespace salebra::detail
