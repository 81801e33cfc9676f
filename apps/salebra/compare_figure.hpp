// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/study/study.hpp>
#include <vector>

#include "io/plot.hpp"

namespace salebra::cli {

/// Draws gap, area, stiffness and damping of all models over the pressure, with 95 % bands, and the
/// damping constants of the study's table with their errors. A quantity that no model computes has
/// no panel. One point of the parameter grid gives a square of four panels. Several points give a
/// column each, and the panels of a row share their axes. varied: the parameters whose values are
/// the titles of the columns.
Figure compare_figure(const std::vector<StudyResult>& results, const ParameterLists& varied);

}  // namespace salebra::cli
