// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cycle_checkpoint.hpp"
#include "cycle_fields.hpp"

namespace salebra {

/// Options for saving the state and the fields of a long cycle while it runs.
struct CycleRecordOptions {
  std::filesystem::path checkpoint = {};  ///< file of the state; empty: no checkpoint
  /// Time between two checkpoints, s, >= 0; 0: write one after every step.
  double checkpoint_every = 60;
  bool resume = false;  ///< continue from the checkpoint if it exists
  /// Prefix of the files of CycleFields; empty: write no fields.
  std::filesystem::path fields = {};
  std::vector<int> field_steps = {};  ///< steps at which fields are written
  WriteOptions writing =
      {};  ///< options for the fields; overwrite also discards an existing checkpoint

  /// Throws InvalidInput if checkpoint_every is not >= 0, and for an existing checkpoint that would
  /// be replaced.
  void check() const;
};

/// The surface of recorded cycles and a solver of its normal contact, both needed to write fields.
struct RecordedContact {
  const Surface& surface;  ///< must outlive the recorder
  std::function<NormalContactState(double indentation)> normal_at;
};

/// Runs simulated cycles one after the other. Writes checkpoints at intervals of time and fields at
/// chosen steps. A checkpoint holds the last state of each finished cycle and of the current one.
/// It is kept if anything stops the cycle.
class CycleRecorder {
 public:
  /// Reads the checkpoint if `resume` is set and the file exists.
  /// throws  InvalidInput if a checkpoint would be replaced or was written with other settings
  CycleRecorder(CycleRecordOptions options, CycleSettings settings, Provenance provenance);
  /// Does the same and, if fields are written, also writes the mesh of each cycle; its files have
  /// the prefix `fields` + name. names: one for each cycle, in the order in which the cycles will
  /// run.
  CycleRecorder(CycleRecordOptions options, CycleSettings settings, Provenance provenance,
                RecordedContact contact, const std::vector<std::string>& names);

  /// Runs a cycle: calls simulate() with `resume` and `on_state` of the options set, and returns
  /// its result.
  CycleResult run(CycleOptions options,
                  const std::function<CycleResult(const CycleOptions&)>& simulate);
  /// Removes the checkpoint. To be called after the results are saved.
  void done() const;

 private:
  using Clock = std::chrono::steady_clock;
  void record(std::size_t cycle, int steps, CycleState state);
  void write_checkpoint();

  CycleRecordOptions options_;
  CycleSettings settings_;
  Provenance provenance_;
  std::function<NormalContactState(double)> normal_at_;
  std::vector<CycleFields> fields_;  // one for each cycle
  std::vector<CycleState> states_;   // the last state of each cycle
  std::size_t cycles_ = 0;           // number of cycles begun
  bool unsaved_ = false;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace salebra
