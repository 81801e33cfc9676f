// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <optional>
#include <salebra/io/cycle_checkpoint.hpp>
#include <salebra/io/cycle_fields.hpp>
#include <string>
#include <vector>

#include "friction_run.hpp"
#include "options.hpp"
#include "oscillation_case.hpp"

namespace salebra::cli {

/// Checkpoints and fields of a long cycle.
struct RecordOptions {
  std::string checkpoint, fields;
  std::optional<double> checkpoint_every;
  bool resume = false;
  std::vector<double> field_steps;

  void add_to(Command& app);
  /// Before any work: that the files suit what is asked for.
  void check(const Session& session) const;
};

/// What is written while a cycle runs: checkpoints in time, fields at steps.
class CycleRecorder {
 public:
  /// Reads the state to resume from and writes the mesh of the fields. Throws InvalidInput where a file is in the way or of
  /// another run. `run` must outlive the recorder.
  CycleRecorder(const RecordOptions& record, const OscillationCase& run,
                const CycleOptions& options, const FrictionOptions& friction, Session& session);

  /// The state to go on from; none where the cycle begins.
  const CycleState* state() const { return state_ ? &*state_ : nullptr; }
  /// The state of the cycle with friction to go on from; none where that cycle begins, or there is none.
  const FrictionalCycleState* friction_state() const {
    return friction_state_ ? &*friction_state_ : nullptr;
  }
  /// For CycleOptions::on_state.
  void operator()(const CycleState& state);
  /// For FrictionalCycleOptions::on_state, of the cycle after.
  void operator()(const FrictionalCycleState& state);
  /// Removes the checkpoint: the result takes its place.
  void done() const;

 private:
  double time(int step) const { return static_cast<double>(step) / steps_; }
  bool wanted(int step) const;
  NormalContactState normal_at(double indentation) const;
  void save(const FrictionalCycleState* friction);

  const OscillationCase& run_;
  int steps_;
  CycleSettings settings_;
  Provenance provenance_;
  std::string checkpoint_;
  double every_;  // s
  std::vector<int> field_steps_;
  std::chrono::steady_clock::time_point last_;
  std::optional<CycleState> state_;  // to resume from; latest_ is what a checkpoint keeps
  CycleState latest_;
  std::optional<FrictionalCycleState> friction_state_;
  std::optional<CycleFields> fields_, friction_fields_;
};

}  // namespace salebra::cli
