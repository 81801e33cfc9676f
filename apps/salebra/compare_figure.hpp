// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/study.hpp>
#include <vector>

#include "io/plot.hpp"

namespace salebra::cli {

/// Gap, area, stiffness and damping of all models over the pressure, with bands of 95 %, and γ of the
/// answer's table with its errors. What no model knows has no panel. One point: a square of four
/// panels. Several: a column for each, whose panels share their axes along
/// a row. varied: what tells the points apart.
Figure compare_figure(const std::vector<StudyResult>& results, const ParameterLists& varied);

}  // namespace salebra::cli
