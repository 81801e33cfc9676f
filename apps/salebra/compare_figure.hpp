// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>
#include <salebra/io/plot.hpp>
#include <salebra/study/study.hpp>
#include <vector>

namespace salebra::cli {

// Slopes of A/A0 over p/(E*h') at small loads.
inline const double bgt_slope = std::sqrt(2 * std::numbers::pi);
inline const double persson_slope = std::sqrt(8 / std::numbers::pi);

/// Force–gap, area–load, stiffness–load and damping–force of all models, with bands of 95 %. One
/// point: a square of four panels. Several: a column for each, whose panels share their axes along
/// a row. varied: what tells the points apart.
Figure compare_figure(const std::vector<StudyResult>& results, const ParameterLists& varied);

}  // namespace salebra::cli
