// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "options.hpp"
#include "results/cycle_recorder.hpp"

namespace salebra::cli {

/// Options for checkpoints and fields of a long simulated cycle.
struct RecordOptions {
  std::string checkpoint, fields;
  std::optional<double> checkpoint_every;
  bool resume = false;
  std::vector<double> field_steps;

  void add_to(Command& app);
  /// Throws InvalidInput before any work for files that must not be written or contradict each
  /// other, and for steps that the cycle does not have. cycles: names of the recorded cycles.
  void check(int steps, const std::vector<std::string>& cycles, Session& session) const;
  /// The options in the form of the library.
  CycleRecordOptions options(int steps, const Session& session) const;

 private:
  std::vector<int> steps_of_fields(int steps) const;
};

}  // namespace salebra::cli
