// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/analysis/contact.hpp>
#include <string>

#include "session.hpp"

namespace salebra::cli {

class Command;

/// A file that keeps the pressures of a contact while the contact is solved. It has the format of a
/// result of `salebra contact` with only the pressures, so --initial can start from it.
struct ContactCheckpoint {
  std::string file;             ///< name of the file; empty: no checkpoint
  std::optional<double> every;  ///< time between two checkpoints, s

  void add_to(Command& command);
  /// Throws InvalidInput before the work if the file cannot be written. All processes must call.
  void check(const Session& session, const std::string& initial) const;
  /// Whether --initial names this file and the file does not exist yet. This is so in the first run
  /// of a command line that the user repeats until it finishes. All processes must call.
  bool starts_anew(const Session& session, const std::string& initial) const;
  /// Sets `options` so that a contact on this grid writes the file while it is solved. Session and
  /// grid must outlive `options`.
  void add_to(NormalContactOptions& options, Session& session, const Grid2D& grid) const;
  /// Replaces the file; if this fails, warns and keeps the old file. A contact that was stopped on
  /// a coarser grid has no pressures on this grid and is not written. Returns whether the file now
  /// holds `pressure`. All processes must call.
  bool write(Session& session, const Grid2D& grid, const Field& pressure) const;
  void remove(const Session& session) const;
};

}  // namespace salebra::cli
