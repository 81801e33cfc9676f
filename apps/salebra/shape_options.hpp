// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <string>

#include "command.hpp"

namespace salebra::cli {

/// An analytic shape on a grid.
struct ShapeOptions {
  std::string shape, center = "off-grid";
  std::optional<double> radius, radius_x, radius_y, semi_x, semi_y, semi_z, angle, depth,
      edge_radius, amplitude, center_x, center_y, count_x, count_y;

  void add_to(Command& app);
  bool given() const { return !shape.empty(); }
  /// Throws InvalidInput that names an option that is missing, or one that the shape has no use
  /// for.
  Surface surface(const Grid2D& grid) const;
};

}  // namespace salebra::cli
