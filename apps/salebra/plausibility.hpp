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

}  // namespace salebra::cli
