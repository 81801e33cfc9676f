// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/oscillation.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

#include "session.hpp"

/// JSON and files of `salebra oscillate`.
namespace salebra::cli {

/// JSON of an outcome. It has the objects "friction" and "coupling" if these cycles were simulated.
Json to_json(const OscillationOutcome& outcome);
/// Writes the groups PREFIXcycle, PREFIXfriction, PREFIXcoupling and PREFIXlevels, with columns
/// over the time and maps of contact and of the energy lost.
void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome);
/// Warns of losses that have not become periodic, of an energy balance that does not close, and of
/// a requested error that was not reached.
void warn_of(const OscillationOutcome& outcome, Session& session);

}  // namespace salebra::cli
