// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/damping/frictional_cycle.hpp>
#include <salebra/io/result_file.hpp>

#include "options.hpp"
#include "oscillation_case.hpp"
#include "session.hpp"

/// What `oscillate` adds with --friction and --coupled: the same cycle with Coulomb's law, and with Dundurs' coupling.
namespace salebra::cli {

struct FrictionOptions {
  std::optional<double> friction_coefficient, dundurs;
  bool coupled = false;
  int max_periods = 6;

  void add_to(Command& app);
  bool given() const { return friction_coefficient || coupled; }
  /// The option that was given, for messages.
  std::string name() const { return friction_coefficient ? "--friction" : "--coupled"; }
  /// Before any work: that the options suit each other.
  void check() const;
  /// Before the cycles: that a coupled contact stays closed.
  void check(const Oscillation& motion, double indentation) const;
  /// β/(πE*), 1/Pa: --dundurs, or what the material options say of the two bodies.
  double coupling(const MaterialOptions& bodies, const Material& material) const;
};

struct FrictionOutcome {
  std::optional<double> friction_coefficient;  ///< none: infinite
  double dundurs = 0;
  FrictionalCycleResult cycle;
  std::optional<FrictionalCycleResult> coupled;

  bool converged() const { return cycle.converged && (!coupled || coupled->converged); }
  bool interrupted() const { return cycle.interrupted || (coupled && coupled->interrupted); }
};

/// What to do at each step of the cycle without coupling, and the state that it goes on from.
struct FrictionRecord {
  std::function<void(const FrictionalCycleState&)> on_state = {};
  const FrictionalCycleState* resume = nullptr;
};

/// The cycle of `run` once more, from first contact; steps, direction, boundary and lateral are those of `steps`. A stopped
/// cycle comes back as it is.
FrictionOutcome run_with_friction(const FrictionOptions& options, const OscillationCase& run,
                                  const CycleOptions& steps, double coupling,
                                  const FrictionRecord& record, Session& session);

/// The objects "friction" and, of a coupled cycle, "coupling". `stuck` has the cycle without slip.
void add_friction(Json& object, const FrictionOutcome& outcome, const OscillationOutcome& stuck);
/// The loops F_x over x of a cycle with friction, of the coupled one, and without slip.
PlotPanel loop_panel(const FrictionOutcome& outcome, const OscillationOutcome& stuck);
/// Groups `friction` and `coupling`: the loop and, on x and y, where it is lost.
void write_friction(ResultFile& file, const FrictionOutcome& outcome, const Grid2D& grid);
/// What the numbers alone do not tell: that a loss is not steady yet, or that its two sums differ.
void warn_of_friction(const FrictionOutcome& outcome, const OscillationOutcome& stuck,
                      Session& session);

}  // namespace salebra::cli
