// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/study/configuration.hpp>
#include <string>

#include "options.hpp"
#include "session.hpp"
#include "study/cost.hpp"

namespace salebra::cli {

/// Answers what a study would do, what it would cost and where it would write, and does nothing of
/// it. shard_seconds: proposes shards that take no longer.
void answer_dry_run(const StudyConfiguration& configuration, const StudyProcesses& processes,
                    std::optional<double> shard_seconds, Session& session);

/// The work of the processes that options name, or of those that run. Collective.
SurfaceWork planned(const DryRunOptions& options, const Grid2D& grid, const Session& session);

/// Answers what one surface would cost, and computes nothing of it. origin: "filtered noise, seed
/// 3".
void answer_dry_run(const SurfaceWork& work, const std::string& origin, Session& session);

/// "12 s", "3 min 05 s", "2 h 10 min".
std::string format_duration(double seconds);

}  // namespace salebra::cli
