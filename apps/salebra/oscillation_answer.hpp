// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/oscillation.hpp>
#include <salebra/io/result_file.hpp>
#include <string>

#include "io/plot.hpp"
#include "session.hpp"

/// How `oscillate` tells its outcomes.
namespace salebra::cli {

/// With the objects "friction" and "coupling" of the cycles that there are.
Json to_json(const OscillationOutcome& outcome);
/// Groups PREFIXcycle, PREFIXfriction, PREFIXcoupling and PREFIXlevels: columns over time, where
/// the contact is, and where energy is lost.
void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome);
/// Warns of losses that are not steady yet, of sums that differ, of an error that was not reached.
void warn_of(const OscillationOutcome& outcome, Session& session);

/// Fig. 3b: black always in contact, grey during a part of the cycle.
PlotPanel contact_panel(const OscillationOutcome& outcome, const std::string& title);
/// Fig. 3c: W(t) over Eq. (12) for equal frequencies; the energy released so far over Eq. (15) for
/// drag. Over ½Ku² where nothing is lost.
PlotPanel work_panel(const OscillationOutcome& outcome, const std::string& title);

/// The loops F_x over x of a cycle with friction, of the coupled one, and without slip.
PlotPanel loop_panel(const OscillationOutcome& outcome);

}  // namespace salebra::cli
