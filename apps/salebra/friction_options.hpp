// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/oscillation.hpp>
#include <string>
#include <vector>

#include "options.hpp"

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

}  // namespace salebra::cli
