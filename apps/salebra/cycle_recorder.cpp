// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints and field output of a simulated cycle, as the command line requests them.
#include "cycle_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>

namespace salebra::cli {
namespace {

constexpr double default_checkpoint_every = 60;  // s

// Everything that decides the bits of a cycle.
CycleSettings settings_of(const OscillationCase& run, const CycleOptions& options,
                          const FrictionOptions& friction) {
  CycleSettings settings =
      cycle_settings(run.body.surface.grid, run.material, run.motion, run.indentation, options);
  settings.emplace_back("surface", fingerprint(run.body.surface.heights));
  settings.emplace_back("friction", friction.friction_coefficient
                                        ? fmt::format("{}", *friction.friction_coefficient)
                                        : "none");
  if (friction.friction_coefficient)
    settings.emplace_back("max_periods", fmt::format("{}", friction.max_periods));
  return settings;
}

std::vector<int> field_steps_of(const RecordOptions& record, int steps_of_cycle) {
  std::vector<int> steps;
  if (record.field_steps.empty())
    for (int k = 0; k <= 8; ++k) steps.push_back(k * steps_of_cycle / 8);
  for (const double step : record.field_steps) {
    require(step == std::floor(step) && step >= 0 && step <= steps_of_cycle, "--field-steps", step,
            "is not one of the steps; give whole numbers from 0 to --steps");
    steps.push_back(static_cast<int>(step));
  }
  return steps;
}

}  // namespace

void RecordOptions::add_to(Command& app) {
  app.add_option("--checkpoint", checkpoint,
                 "file that keeps the state of the cycle while it runs; removed at its end")
      ->type_name("FILE");
  add_quantity(app, "--checkpoint-every", checkpoint_every, Dimension::time,
               "time between checkpoints; default 60 s, 0 for every step");
  app.add_flag("--resume", resume,
               "go on from the checkpoint of an interrupted run, to the same result");
  app.add_option("--fields", fields,
                 "write PREFIX.xdmf for ParaView with its HDF5 files: contact, tractions, "
                 "displacements, pressure, gap")
      ->type_name("PREFIX");
  add_values(app, "--field-steps", field_steps, Dimension::dimensionless,
             "steps to write fields of; default nine over the cycle");
}

void RecordOptions::check(const Session& session) const {
  require(!resume || !checkpoint.empty(), "--resume", "given",
          "without --checkpoint; name the checkpoint");
  require(!checkpoint_every || *checkpoint_every >= 0, "--checkpoint-every",
          checkpoint_every.value_or(0), "must be >= 0");
  if (!fields.empty()) {
    const WriteOptions writing = resume ? WriteOptions{.overwrite = true} : session.write_options();
    require_output(fields + ".xdmf", writing);
  }
  if (checkpoint.empty()) return;
  require_output(checkpoint, {.overwrite = true});
  const bool there = std::filesystem::exists(checkpoint);
  require(there || !resume, "--resume", checkpoint,
          "is not there; leave out --resume to begin the cycle");
  require(!there || resume || session.write_options().overwrite, checkpoint, "exists;",
          "add --resume to go on from it, or --overwrite to begin anew");
}

CycleRecorder::CycleRecorder(const RecordOptions& record, const OscillationCase& run,
                             const CycleOptions& options, const FrictionOptions& friction,
                             Session& session)
    : run_(run),
      steps_(options.steps),
      settings_(settings_of(run, options, friction)),
      provenance_(session.provenance()),
      checkpoint_(record.checkpoint),
      every_(record.checkpoint_every.value_or(default_checkpoint_every)),
      field_steps_(field_steps_of(record, options.steps)),
      last_(std::chrono::steady_clock::now()) {
  if (record.resume) {
    state_ = read_cycle_checkpoint(checkpoint_, settings_);
    latest_ = *state_;
    friction_state_ = read_friction_checkpoint(checkpoint_);
  }
  if (record.fields.empty()) return;
  const WriteOptions writing =
      record.resume ? WriteOptions{.overwrite = true} : session.write_options();
  const auto keep = [&](CycleFields& fields, int last) {
    for (const int step : field_steps_)
      if (step <= last) fields.keep(step, time(step));
  };
  fields_.emplace(record.fields, run.body.surface, provenance_, writing);
  if (state_) keep(*fields_, state_->step);
  if (!friction.friction_coefficient) return;
  friction_fields_.emplace(record.fields + "-friction", run.body.surface, provenance_, writing);
  // A later period writes each step anew.
  if (friction_state_)
    keep(*friction_fields_, friction_state_->period > 0 ? steps_ : friction_state_->step);
}

bool CycleRecorder::wanted(int step) const {
  return std::ranges::find(field_steps_, step) != field_steps_.end();
}

NormalContactState CycleRecorder::normal_at(double indentation) const {
  if (!(indentation > 0)) return {};
  return press_to_indentation(run_.body.surface, run_.material.contact_modulus, indentation,
                              {.boundary = run_.body.boundary});
}

void CycleRecorder::save(const FrictionalCycleState* friction) {
  const auto now = std::chrono::steady_clock::now();
  if (std::chrono::duration<double>(now - last_).count() < every_ && !interrupted()) return;
  write_cycle_checkpoint(checkpoint_, latest_, settings_, provenance_, friction);
  last_ = now;
}

void CycleRecorder::operator()(const CycleState& state) {
  if (fields_ && wanted(state.step))
    fields_->write(state, time(state.step), normal_at(state.samples.back().indentation));
  if (checkpoint_.empty()) return;
  latest_ = state;
  save(nullptr);
}

void CycleRecorder::operator()(const FrictionalCycleState& state) {
  if (friction_fields_ && wanted(state.step))
    friction_fields_->write(state, time(state.step), normal_at(state.samples.back().indentation));
  if (!checkpoint_.empty()) save(&state);
}

void CycleRecorder::done() const {
  std::error_code ignored;
  if (!checkpoint_.empty()) std::filesystem::remove(checkpoint_, ignored);
}

}  // namespace salebra::cli
