// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

/// Input that is allowed and most likely a mistake, in words for a warning.
namespace salebra {

/// A root mean square slope h' above 1, and thus E*h' above E*: surfaces of machines and
/// instruments have 0.001 to 1, and linear elasticity holds for slopes below 1. As a rule the unit
/// of the heights was forgotten. The words name the unit with which the slope would be plausible,
/// where there is one among mm, µm and nm.
/// unit  of the heights as they were given, m
std::optional<std::string> warning_of_slope(double rms_slope, double unit = 1);

/// warning_of_slope() of the heights less their mean plane, by differences of neighbouring points.
/// Undefined points take no part; nothing is said of a map without pairs of neighbours along both
/// axes. A profile has one. Cost: one pass. Collective of a surface that is spread over processes.
std::optional<std::string> warning_of_heights(const Surface& surface, double unit = 1);

/// Values that are most likely no heights, of a map or a profile in one process. Where the file
/// states no unit: whole numbers, as of a converter, and a first row or column of one value. In
/// all: a repeated lowest or highest value that is farther from all others than these span, as marks
/// of undefined points are.
/// unit  of the heights as they were given, m; nothing where the file states it
/// Cost: one pass.
std::vector<std::string> warnings_of_values(const Field& heights, std::optional<double> unit);

}  // namespace salebra
