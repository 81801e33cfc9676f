// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>
#include <string>

#include "session.hpp"

namespace salebra::cli {

class Command;

/// The file that keeps the pressure of a contact while it is solved: a result of `contact` with the
/// pressure alone, from which --initial starts.
struct ContactCheckpoint {
  std::string file;             ///< empty: none
  std::optional<double> every;  ///< s

  void add_to(Command& command);
  /// Refuses what cannot be written before the work. Collective.
  void check(const Session& session, const std::string& initial) const;
  /// Whether --initial names this file, which is not there yet: the first run of a command that is
  /// repeated until it ends. Collective.
  bool starts_anew(const Session& session, const std::string& initial) const;
  /// Lets a contact on that grid write it. The session and the grid outlive the options.
  void add_to(NormalContactOptions& options, Session& session, const Grid2D& grid) const;
  /// Replaces the file; where that fails, warns and keeps the old one. Nothing is written of a
  /// contact without pressure, which was stopped on a coarser grid. Returns whether the file has
  /// that pressure. Collective.
  bool write(Session& session, const Grid2D& grid, const Field& pressure) const;
  void remove(const Session& session) const;
};

}  // namespace salebra::cli
