// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

/// Warnings for heights that are valid input but most likely a mistake of the user.
namespace salebra {

/// Warns if the root mean square slope h' is above 1, i.e. if E*h' exceeds E*. Surfaces of machines
/// and instruments have slopes of 0.001 to 1, and linear elasticity holds for slopes below 1. The
/// usual cause is a forgotten unit of the heights. The warning names the unit among mm, µm and nm
/// that makes the slope plausible, if there is one.
/// unit  of the heights as the user gave them, m
std::optional<std::string> warning_of_slope(double rms_slope, double unit = 1);

/// warning_of_slope() for the heights less their mean plane, from differences of neighbouring
/// points. Undefined points are ignored. A map without pairs of neighbours along both axes gives no
/// warning; a line profile needs pairs along one axis only. Cost: one pass. Collective for a
/// surface whose rows are distributed over processes.
std::optional<std::string> warning_of_heights(const Surface& surface, double unit = 1);

/// Warns of values in a map or profile, held by one process, that are most likely no heights. If
/// the file states no unit, it looks for whole numbers, as from an A/D converter, and for a first
/// row or column with a single value. It always looks for a lowest or highest value that occurs
/// repeatedly and is farther from all other values than their range, like values that mark
/// undefined points.
/// unit  of the heights as the user gave them, m; empty if the file states it
/// Cost: one pass.
std::vector<std::string> warnings_of_values(const Field& heights, std::optional<double> unit);

}  // namespace salebra
