// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/units.hpp>
#include <salebra/figures/figure.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::figures {

/// The axis of a quantity that has this name in JSON and files. label: instead of its meaning.
Axis axis_of(std::string_view quantity, bool logarithmic = false, std::string_view label = {});
/// "25.3 nm (24.1 nm … 26.5 nm)"; without the limits where they are unknown.
std::string interval_text(double value, double low, double high, Dimension dimension);
/// "25.3 nm ± 2 %"; without the error where it is unknown, and without the value where it is no larger
/// than its error.
std::string error_text(double value, double error, Dimension dimension);
/// Whether positive values span more than 1.5 decades.
bool spans_decades(const std::vector<double>& values);
/// A map of a field over the cells of a grid, in colours.
Panel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                const Axis& scale);
/// Limit of the colour scale: the magnitude of shear stress that 2 % of the points with stress
/// exceed. Otherwise the singularities of the stress would use up the scale.
double colour_limit(const Field& shear);

}  // namespace salebra::figures
