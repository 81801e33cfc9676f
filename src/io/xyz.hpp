// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "loaded_surface.hpp"

namespace salebra::detail {

/// The regular grid on which points (x, y, z), given one after the other, lie. Points of the grid
/// that are missing are undefined. size_x is the step times the number of points, so that a grid is
/// a period long.
/// Throws InvalidInput if the points are on no regular grid, fill less than half of it, or one is
/// given twice. Cost: two passes of the points, and a sort of those that come in no order.
LoadedSurface grid_of_points(const std::filesystem::path& file, const std::vector<double>& xyz);

}  // namespace salebra::detail
