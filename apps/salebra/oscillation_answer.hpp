// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/oscillation.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

#include "io/plot.hpp"
#include "session.hpp"

/// JSON, files and figures of `salebra oscillate`.
namespace salebra::cli {

/// JSON of an outcome. It has the objects "friction" and "coupling" if these cycles were simulated.
Json to_json(const OscillationOutcome& outcome);
/// Writes the groups PREFIXcycle, PREFIXfriction, PREFIXcoupling and PREFIXlevels, with columns
/// over the time and maps of contact and of the energy lost.
void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome);
/// Warns of losses that have not become periodic, of an energy balance that does not close, and of
/// a requested error that was not reached.
void warn_of(const OscillationOutcome& outcome, Session& session);

/// Fig. 3b of the paper: map of the cells, black if always in contact, grey if in contact during a
/// part of the cycle.
PlotPanel contact_panel(const OscillationOutcome& outcome, const std::string& title);
/// Fig. 3c of the paper, over the time: at equal frequencies the work W(t) divided by the loss of
/// Eq. (12), under a drag the energy released so far divided by the loss of Eq. (15). If no energy
/// is lost, the work is divided by ½K_t u² with the tangential amplitude u instead.
PlotPanel work_panel(const OscillationOutcome& outcome, const std::string& title);

/// Loops of tangential force F_x over displacement x for the cycles without slip, with friction and
/// with coupling.
PlotPanel loop_panel(const OscillationOutcome& outcome);

}  // namespace salebra::cli
