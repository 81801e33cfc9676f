// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "loaded_surface.hpp"

namespace salebra::detail {

/// The surface on the regular grid of the points. xyz: x, y, z of each point, one point after the
/// other. Points of the grid that are missing are undefined. size_x is the step times the number of
/// points, so that the grid covers one period. Throws InvalidInput if the points do not lie on a
/// regular grid, are less than half of its points, or one is given twice. Cost: two passes over the
/// points, and sorting if they are in no order.
LoadedSurface grid_of_points(const std::filesystem::path& file, const std::vector<double>& xyz);

}  // namespace salebra::detail
