// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/io/result_file.hpp>
#include <salebra/study/study.hpp>
#include <string>
#include <vector>

/// What a file of a study holds: a dataset for each quantity over model, realisation and pressure,
/// and its mean with interval.
namespace salebra::detail {

/// The groups of one point of the parameter grid, below `where` ("" or "points/3/").
void write_study_groups(ResultFile& output, const std::string& where, const StudyResult& result);

/// What the ensembles of several points come to, side by side.
void write_study_overview(ResultGroup group, const std::vector<StudyResult>& results);

}  // namespace salebra::detail
