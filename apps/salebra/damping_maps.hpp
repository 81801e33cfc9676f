// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/analysis/damping.hpp>
#include <string>
#include <vector>

#include "session.hpp"

namespace salebra::cli {

/// Options for maps of `salebra damping`: stresses over radius and phase, losses over friction and
/// phase.
struct MapOptions {
  std::string stress_map, friction_map;  ///< files to write; empty: no such map
  std::vector<double> friction_numbers;
  int phases = 256, radii = 400;

  void add_to(Command& command);
  bool given() const { return !stress_map.empty() || !friction_map.empty(); }
  /// Throws InvalidInput before the work if a file must not be written, or if a map does not exist
  /// for this kind of motion.
  void check(const std::vector<Motion>& motions, const Session& session) const;
  /// Writes the requested maps of the only case of the answer, and draws the last of them.
  void write(const DampingSolution& answer, int steps, Session& session) const;
};

}  // namespace salebra::cli
