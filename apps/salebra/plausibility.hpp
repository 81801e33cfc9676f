// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

/// What is allowed and most likely a slip of the user's hand. Each function returns lines for
/// Session::warn().
namespace salebra::cli {

/// Cells ten times as long as wide.
std::vector<std::string> doubts_of_cells(const Grid2D& grid);

/// Slow motion, case (b), that moves on by more than a contact spot in one normal cycle: what
/// sticks then is no longer the same spot when it opens. A radius that is not known is NaN.
std::vector<std::string> doubts_of_path(double drag_velocity, double angular_frequency,
                                        double spot_radius);

}  // namespace salebra::cli
