// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/io/result_file.hpp>
#include <salebra/results/cycle_recorder.hpp>
#include <string>
#include <vector>

#include "options.hpp"
#include "oscillation_case.hpp"
#include "session.hpp"

/// What `oscillate` adds with --friction and --coupled: the same cycle with Coulomb's law, and with
/// Dundurs' coupling.
namespace salebra::cli {

struct FrictionOptions {
  std::optional<double> friction_coefficient, dundurs;
  bool coupled = false;
  int max_periods = 6;

  void add_to(Command& app);
  bool given() const { return friction_coefficient || coupled; }
  /// The option that was given, for messages.
  std::string name() const { return friction_coefficient ? "--friction" : "--coupled"; }
  /// Refuses, before any work, options that do not suit each other.
  void check() const;
  /// Refuses, before the cycles, a coupled contact that opens.
  void check(const Oscillation& motion, double indentation) const;
  /// The options of the cycles: μ, periods and, with --coupled, β/(πE*) by --dundurs or the
  /// material options.
  void apply(CycleOptions& cycle, const MaterialOptions& bodies, const Material& material) const;
  /// Names of the recorded cycles in the order of their runs, the one without slip first.
  std::vector<std::string> cycles() const;
};

/// The cycle of `outcome` once more, from first contact, with friction and, with --coupled, with
/// coupling too. A stopped cycle comes back as it is.
void run_with_friction(const FrictionOptions& options, const CycleOptions& cycle,
                       CycleRecorder& recorder, OscillationOutcome& outcome);

/// The objects "friction" and, of a coupled cycle, "coupling".
void add_friction(Json& object, const FrictionOptions& options, const CycleOptions& cycle,
                  const OscillationOutcome& outcome);
/// The loops F_x over x of a cycle with friction, of the coupled one, and without slip.
PlotPanel loop_panel(const FrictionOptions& options, const OscillationOutcome& outcome);
/// Groups `friction` and `coupling`: the loop and, on x and y, where it is lost.
void write_friction(ResultFile& file, const CycleOptions& cycle, const OscillationOutcome& outcome);
/// Warns of a loss that is not steady yet, and of two sums of it that differ.
void warn_of_friction(const CycleOptions& cycle, const OscillationOutcome& outcome,
                      Session& session);

}  // namespace salebra::cli
