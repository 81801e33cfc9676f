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

/// What is kept of a long cycle while it runs.
struct CycleRecordOptions {
  std::filesystem::path checkpoint = {};  ///< empty: none
  double checkpoint_every = 60;           ///< s, >= 0; 0: every step
  bool resume = false;                    ///< continue from the checkpoint, where it is there
  std::filesystem::path fields = {};      ///< prefix of CycleFields; empty: none
  std::vector<int> field_steps = {};      ///< steps of which fields are written
  WriteOptions writing =
      {};  ///< of the fields; overwrite also discards a checkpoint that is in the way

  /// Throws InvalidInput for a bad interval and for a checkpoint in the way.
  void check() const;
};

/// The surface of recorded cycles and its normal contact, for fields.
struct RecordedContact {
  const Surface& surface;  ///< must outlive the recorder
  std::function<NormalContactState(double indentation)> normal_at;
};

/// Runs cycles one after the other, with checkpoints in time and fields at steps. A checkpoint
/// holds the last states of the cycles that are finished, and that of the current one; whatever
/// stops a cycle leaves it.
class CycleRecorder {
 public:
  /// Reads the checkpoint to resume from.
  /// throws  InvalidInput for a file that is in the way or of other settings
  CycleRecorder(CycleRecordOptions options, CycleSettings settings, Provenance provenance);
  /// Writes, with fields, the mesh of each cycle, in the order of their runs, as PREFIXNAME.xdmf.
  CycleRecorder(CycleRecordOptions options, CycleSettings settings, Provenance provenance,
                RecordedContact contact, const std::vector<std::string>& names);

  /// simulate(options) with `resume` and `on_state` filled in.
  CycleResult run(CycleOptions options,
                  const std::function<CycleResult(const CycleOptions&)>& simulate);
  /// Removes the checkpoint: the results take its place.
  void done() const;

 private:
  using Clock = std::chrono::steady_clock;
  void record(std::size_t cycle, int steps, CycleState state);
  void write_checkpoint();

  CycleRecordOptions options_;
  CycleSettings settings_;
  Provenance provenance_;
  std::function<NormalContactState(double)> normal_at_;
  std::vector<CycleFields> fields_;  // of each cycle
  std::vector<CycleState> states_;   // of each cycle as far as it got
  std::size_t cycles_ = 0;           // begun
  bool unsaved_ = false;
  Clock::time_point saved_ = Clock::now();
};

}  // namespace salebra
