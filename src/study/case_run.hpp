// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/study/study.hpp>
#include <vector>

namespace salebra::detail {

/// The seeds of a point; one, 0, for a measured surface.
std::vector<std::uint64_t> seeds_of(const StudyConfiguration& configuration);

/// The realisations of one point of the parameter grid, computed side by side and looked at in the order of their seeds. result has
/// configuration and pressures, and receives the rest. start: what the whole run had finished before.
void run_case(StudyResult& result, const StudyRun& run, const RealisationReport& start);

}  // namespace salebra::detail
