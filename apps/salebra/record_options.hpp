// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"
#include "results/cycle_recorder.hpp"

namespace salebra::cli {

/// Checkpoints and fields of a long cycle.
struct RecordOptions {
  std::string checkpoint, fields;
  std::optional<double> checkpoint_every;
  bool resume = false;
  std::vector<double> field_steps;

  void add_to(Command& app);
  /// Refuses, before any work, files that do not suit what is requested. cycles: names of those
  /// that are recorded. Throws InvalidInput for a step that is none of the cycle's.
  void check(int steps, const std::vector<std::string>& cycles, Session& session) const;
  /// The same as the library takes them.
  CycleRecordOptions options(int steps, const Session& session) const;

 private:
  std::vector<int> steps_of_fields(int steps) const;
};

}  // namespace salebra::cli
