// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/figures/figure.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::figures {

/// The axis of a quantity that has this name in JSON and files.
Axis axis_of(std::string_view quantity, bool logarithmic = false);
/// Whether positive values span more than 1.5 decades.
bool spans_decades(const std::vector<double>& values);
/// A map of a field over the cells of a grid, in colours.
Panel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                const Axis& scale);

}  // namespace salebra::figures
