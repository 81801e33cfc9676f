// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/io/cycle_checkpoint.hpp>
#include <utility>

namespace salebra::python {

/// The arguments checkpoint, checkpoint_every and resume of a simulation.
struct CheckpointArguments {
  std::optional<std::filesystem::path> file;
  double every = 60;  ///< s
  bool resume = false;
};

inline void write_state(const std::filesystem::path& file, const CycleState& state,
                        const CycleSettings& settings) {
  write_cycle_checkpoint(file, state, settings, {});
}
inline void write_state(const std::filesystem::path& file, const FrictionalCycleState& state,
                        const CycleSettings& settings) {
  write_friction_checkpoint(file, state, settings, {});
}
inline void read_state(const std::filesystem::path& file, const CycleSettings& settings,
                       std::optional<CycleState>& state) {
  state = read_cycle_checkpoint(file, settings);
}
inline void read_state(const std::filesystem::path& file, const CycleSettings& settings,
                       std::optional<FrictionalCycleState>& state) {
  state = read_friction_checkpoint(file, settings);
}

/// Keeps the state of a simulation in a file while it runs; without a file it does nothing.
template <class State>
class Checkpoint {
 public:
  /// Reads the state to go on from, where there is one. Throws InvalidInput for a file that is in the way or of another run.
  Checkpoint(CheckpointArguments arguments, CycleSettings settings)
      : arguments_(std::move(arguments)), settings_(std::move(settings)) {
    const auto& file = arguments_.file;
    require(file || !arguments_.resume, "resume", "True",
            "without a checkpoint; name the file of the run to go on with");
    require(arguments_.every >= 0, "checkpoint_every", arguments_.every, "must be >= 0, s");
    if (!file || !std::filesystem::exists(*file)) return;
    if (!arguments_.resume)
      throw InvalidInput(file->string() +
                         ": exists; give resume=True to go on from it, or remove it to begin anew");
    read_state(*file, settings_, resumed_);
  }

  const State* resumed() const { return resumed_ ? &*resumed_ : nullptr; }

  void operator()(const State& state) {
    if (!arguments_.file) return;
    latest_ = state;
    if (Clock::now() - written_ >= std::chrono::duration<double>(arguments_.every)) write();
  }
  /// The simulation was stopped: its last state is kept.
  void keep() {
    if (latest_) write();
  }
  /// The result takes its place.
  void remove() const {
    std::error_code ignored;
    if (arguments_.file) std::filesystem::remove(*arguments_.file, ignored);
  }

 private:
  using Clock = std::chrono::steady_clock;

  void write() {
    write_state(*arguments_.file, *latest_, settings_);
    latest_.reset();
    written_ = Clock::now();
  }

  CheckpointArguments arguments_;
  CycleSettings settings_;
  Clock::time_point written_ = Clock::now();
  std::optional<State> resumed_, latest_;  ///< latest_: not yet written
};

/// simulate(options) with its states kept, from the one to resume from. Whatever ends it before its end leaves the checkpoint.
template <class State, class Options, class Simulate>
auto with_checkpoint(const CheckpointArguments& arguments, CycleSettings settings, Options options,
                     const Simulate& simulate) {
  Checkpoint<State> checkpoint(arguments, std::move(settings));
  options.resume = checkpoint.resumed();
  if (arguments.file) options.on_state = [&](const State& state) { checkpoint(state); };
  try {
    auto result = simulate(options);
    if (result.interrupted)
      checkpoint.keep();
    else
      checkpoint.remove();
    return result;
  } catch (const IoError&) {
    throw;  // the checkpoint itself, as of a full disk
  } catch (...) {
    checkpoint.keep();
    throw;
  }
}

}  // namespace salebra::python
