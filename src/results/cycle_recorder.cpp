// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints and fields of cycles while they run (results/cycle_recorder.hpp).
#include "cycle_recorder.hpp"

#include <algorithm>
#include <salebra/base/error.hpp>
#include <utility>

namespace salebra {

void CycleRecordOptions::check() const {
  require(checkpoint_every >= 0, "checkpoint_every", checkpoint_every, "must be >= 0, s");
  if (!checkpoint.empty() && !resume && !writing.overwrite && std::filesystem::exists(checkpoint))
    throw InvalidInput(checkpoint.string(),
                       "exists; resume from it, or remove it to start the cycle again");
}

CycleRecorder::CycleRecorder(CycleRecordOptions options, CycleSettings settings,
                             Provenance provenance)
    : options_(std::move(options)),
      settings_(std::move(settings)),
      provenance_(std::move(provenance)) {
  options_.check();
  if (options_.resume && std::filesystem::exists(options_.checkpoint))
    states_ = read_cycle_checkpoint(options_.checkpoint, settings_);
}

CycleRecorder::CycleRecorder(CycleRecordOptions options, CycleSettings settings,
                             Provenance provenance, RecordedContact contact,
                             const std::vector<std::string>& names)
    : CycleRecorder(std::move(options), std::move(settings), std::move(provenance)) {
  if (options_.fields.empty()) return;
  normal_at_ = std::move(contact.normal_at);
  WriteOptions writing = options_.writing;
  writing.overwrite = writing.overwrite || options_.resume;
  for (const std::string& name : names) {
    std::filesystem::path prefix = options_.fields;
    prefix += name;
    fields_.emplace_back(prefix, contact.surface, provenance_, writing);
  }
}

CycleResult CycleRecorder::run(CycleOptions options,
                               const std::function<CycleResult(const CycleOptions&)>& simulate) {
  const std::size_t cycle = cycles_++;
  const int steps = options.steps;
  if (cycle < states_.size()) {
    const CycleState& state = states_[cycle];
    options.resume = &state;
    if (cycle < fields_.size())
      // Lists the steps whose files an interrupted run has written; in a later period they are
      // replaced.
      for (const int step : options_.field_steps)
        if (state.period > 0 || step <= state.step)
          fields_[cycle].keep(step, static_cast<double>(step) / steps);
  }
  if (!options_.checkpoint.empty() || !fields_.empty())
    options.on_state = [&](CycleState state) { record(cycle, steps, std::move(state)); };
  try {
    CycleResult result = simulate(options);
    if (result.termination == Termination::interrupted) write_checkpoint();
    return result;
  } catch (const IoError&) {
    throw;  // writing the checkpoint failed, for example because the disk is full
  } catch (...) {
    write_checkpoint();
    throw;
  }
}

void CycleRecorder::record(std::size_t cycle, int steps, CycleState state) {
  const double time = static_cast<double>(state.step) / steps;
  if (cycle < fields_.size() &&
      std::ranges::find(options_.field_steps, state.step) != options_.field_steps.end()) {
    const double indentation = state.samples.back().indentation;
    const bool needed = indentation > 0 && !std::holds_alternative<CoupledState>(state.body);
    fields_[cycle].write(state, time, needed ? normal_at_(indentation) : NormalContactState());
  }
  if (options_.checkpoint.empty()) return;
  states_.resize(std::max(states_.size(), cycle + 1));
  states_[cycle] = std::move(state);
  unsaved_ = true;
  if (std::chrono::duration<double>(Clock::now() - saved_).count() >= options_.checkpoint_every)
    write_checkpoint();
}

void CycleRecorder::write_checkpoint() {
  if (!unsaved_) return;
  write_cycle_checkpoint(options_.checkpoint, states_, settings_, provenance_);
  unsaved_ = false;
  saved_ = Clock::now();
}

void CycleRecorder::done() const {
  std::error_code ignored;
  if (!options_.checkpoint.empty()) std::filesystem::remove(options_.checkpoint, ignored);
}

}  // namespace salebra
