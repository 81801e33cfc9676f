// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/study/configuration.hpp>
#include <string>

#include "options.hpp"
#include "session.hpp"
#include "study/cost.hpp"

namespace salebra::cli {

/// Prints the work, the cost and the output files of a study without running it. shard_seconds:
/// also proposes a number of shards, none of which takes longer.
void answer_dry_run(const StudyConfiguration& configuration, const StudyProcesses& processes,
                    std::optional<double> shard_seconds, Session& session);

/// The work on one surface, for the number of processes that the options name or, without them, for
/// the running processes. All processes must call.
SurfaceWork planned(const DryRunOptions& options, const Grid2D& grid, const Session& session);

/// Prints the cost of one surface without computing it. origin: how it is made, as in "filtered
/// noise, seed 3".
void answer_dry_run(const SurfaceWork& work, const std::string& origin, Session& session);

/// Formats a time as "12 s", "3 min 05 s" or "2 h 10 min".
std::string format_duration(double seconds);

}  // namespace salebra::cli
