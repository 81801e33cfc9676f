// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/damping.hpp>
#include <string>
#include <vector>

#include "session.hpp"

namespace salebra::cli {

/// Maps of `damping`: stresses over radius and phase, losses over friction and phase.
struct MapOptions {
  std::string stress_map, friction_map;  ///< files; empty: none
  std::vector<double> friction_numbers;
  int phases = 256, radii = 400;

  void add_to(Command& command);
  bool given() const { return !stress_map.empty() || !friction_map.empty(); }
  /// Throws InvalidInput, before the work, for names that may not be written and for motions that
  /// have no such map.
  void check(const std::vector<Motion>& motions, const Session& session) const;
  /// Writes the maps of the one case, and draws the last.
  void write(const DampingSolution& answer, int steps, Session& session) const;
};

}  // namespace salebra::cli
