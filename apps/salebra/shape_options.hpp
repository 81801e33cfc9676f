// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <string>

#include "command.hpp"

namespace salebra::cli {

/// Options of an analytic shape on a grid.
struct ShapeOptions {
  std::string shape, center = "off-grid";
  std::optional<double> radius, radius_x, radius_y, semi_x, semi_y, semi_z, angle, depth,
      edge_radius, amplitude, center_x, center_y, count_x, count_y;

  void add_to(Command& app);
  bool given() const { return !shape.empty(); }
  /// The surface of the shape. Throws InvalidInput if an option of the shape is missing, or an
  /// option was given that the shape does not use.
  Surface surface(const Grid2D& grid) const;
};

}  // namespace salebra::cli
