// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/oscillation.hpp>
#include <string>
#include <vector>

#include "options.hpp"

/// Options --friction and --coupled of `salebra oscillate`, which simulate the same cycle with
/// Coulomb friction, and also with Dundurs' coupling of pressures and tangential displacements.
namespace salebra::cli {

struct FrictionOptions {
  std::optional<double> friction_coefficient, dundurs;
  bool coupled = false;
  int max_periods = 6;

  void add_to(Command& app);
  bool given() const { return friction_coefficient || coupled; }
  /// The option that was given, for error messages.
  std::string name() const { return friction_coefficient ? "--friction" : "--coupled"; }
  /// Throws InvalidInput before any work for options that contradict each other.
  void check() const;
  /// Throws InvalidInput, before the cycles are simulated, if a coupled contact would open.
  void check(const Oscillation& motion, double indentation) const;
  /// Sets the options of the simulated cycles: μ, number of periods and, with --coupled, the
  /// coupling constant β/(πE*) (β: Dundurs' constant) from --dundurs or the material.
  void apply(CycleOptions& cycle, const MaterialOptions& bodies, const Body& body) const;
  /// Names of the recorded cycles in the order in which they run; the cycle without slip is the
  /// first.
  std::vector<std::string> cycles() const;
};

}  // namespace salebra::cli
