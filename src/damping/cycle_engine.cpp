// SPDX-License-Identifier: GPL-3.0-or-later
// The engine of all simulated cycles: steps, periods, balances, states to resume from
// (damping/cycle.hpp).
#include "cycle_engine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <utility>

namespace salebra {

Trajectory trajectory_of(const Oscillation& motion, double mean_indentation) {
  using std::numbers::pi;
  // t = 0 is the phase θ = −π, where the indentation is at its minimum.
  const auto phase = [](double t) { return 2 * pi * t - pi; };
  if (const auto* equal = std::get_if<EqualFrequency>(&motion)) {
    const EqualFrequency m = *equal;
    return {[=](double t) { return mean_indentation + m.normal_amplitude * std::cos(phase(t)); },
            [=](double t) { return m.tangential_amplitude * std::cos(phase(t) + m.phase); }};
  }
  const Drag m = std::get<Drag>(motion);
  require_positive(m.angular_frequency, "angular_frequency");
  return {[=](double t) { return mean_indentation + m.normal_amplitude * std::cos(phase(t)); },
          [=](double t) { return m.drag_velocity / m.angular_frequency * phase(t); }};
}

namespace detail {

TrajectoryRange checked_range(const Trajectory& trajectory, const CycleOptions& options) {
  require(options.steps >= 4, "steps", options.steps, "must be >= 4");
  require(options.max_periods >= 1, "max_periods", options.max_periods, "must be >= 1");
  require_positive(options.steady_tolerance, "steady_tolerance");
  require(std::isfinite(options.direction), "direction", options.direction, "must be finite");
  require(options.stick.hold_lateral || options.direction == 0, "direction", options.direction,
          "must be 0 where the lateral displacement is free; turn the surface instead");
  if (!trajectory.indentation || !trajectory.tangential)
    throw InvalidInput("trajectory", "a function is missing; give indentation and tangential");
  if (trajectory.tangential_force)
    throw InvalidInput(
        "tangential_force",
        "is given together with tangential, or for a cycle without friction; leave it out");
  TrajectoryRange range;
  for (int k = 0; k <= options.steps; ++k) {
    const double t = static_cast<double>(k) / options.steps;
    range.indentation_min = std::min(range.indentation_min, trajectory.indentation(t));
    range.indentation_max = std::max(range.indentation_max, trajectory.indentation(t));
    range.tangential_min = std::min(range.tangential_min, trajectory.tangential(t));
    range.tangential_max = std::max(range.tangential_max, trajectory.tangential(t));
  }
  return range;
}

template <class State>
const State* resumed(const CycleOptions& options, const Grid2D& grid) {
  if (!options.resume) return nullptr;
  const CycleState& state = *options.resume;
  const auto* body = std::get_if<State>(&state.body);
  if (body == nullptr)
    throw InvalidInput("resume",
                       "is the state of another kind of cycle; name the file of this cycle");
  require(state.smallest.rows() == grid.nx && state.smallest.cols() == grid.ny, "resume",
          state.smallest.size(),
          "cells do not match the grid; resume with the settings of the first run");
  require(state.step >= 0 && state.step <= options.steps && state.period < options.max_periods,
          "resume", state.step,
          "is not one of the steps; resume with the settings of the first run");
  return body;
}
template const StuckState* resumed<StuckState>(const CycleOptions& options, const Grid2D& grid);
template const SlidingState* resumed<SlidingState>(const CycleOptions& options, const Grid2D& grid);
template const CoupledState* resumed<CoupledState>(const CycleOptions& options, const Grid2D& grid);

namespace {

/// Simulates periods of a cycle until the loss repeats. Holds the state from which a later run can
/// resume, and the result so far.
class CycleRun {
 public:
  CycleRun(CycleBody& body, const Grid2D& grid, const Trajectory& trajectory,
           const CycleOptions& options)
      : body_(body),
        grid_(grid),
        trajectory_(trajectory),
        options_(options),
        start_(trajectory.tangential(0)) {
    if (options.resume) {
      state_ = *options.resume;
      state_.body = {};  // Saves memory: the body has its own copy of this state.
    } else {
      start_period();
    }
  }

  CycleResult run(bool first_is_steady) {
    const int steps = options_.steps;
    result_.termination = Termination::converged;
    // Whether step k already has its sample; true for the first step of a resumed run.
    bool sampled = options_.resume != nullptr;
    for (int k = state_.step;; sampled = false) {
      if (!sampled) take_step(k);
      if (body_.termination() == Termination::interrupted ||
          (options_.on_progress &&
           !options_.on_progress({"cycle", static_cast<double>(k) / steps, k, 0}))) {
        result_.termination = Termination::interrupted;
        finish_period();
        break;
      }
      if (++k <= steps) continue;
      finish_period();
      const double change = std::abs(result_.work_per_cycle - state_.last_work);
      result_.steady = first_is_steady ||
                       (state_.period > 0 &&
                        change <= options_.steady_tolerance * std::abs(result_.work_per_cycle));
      if (result_.steady || state_.period + 1 == options_.max_periods) break;
      state_.last_work = result_.work_per_cycle;
      ++state_.period;
      start_period();
      k = 0;
    }
    return finished();
  }

 private:
  void start_period() {
    body_.start_period();
    const CycleReading now = body_.reading();
    state_.samples.clear();
    state_.smallest = state_.largest = now.contact;
    state_.tangential = start_;
    state_.energy_at_period_start = body_.stored_energy();
    state_.work_at_period_start = now.work;
    state_.normal_work_at_period_start = now.normal_work;
    state_.gap_work_at_period_start = now.gap_work;
    if (now.loss) state_.loss_at_period_start = *now.loss;
  }

  Field lost(const CycleReading& now) const { return *now.loss - state_.loss_at_period_start; }

  void take_step(int k) {
    state_.tangential = body_.advance(k, state_.tangential);
    state_.step = k;
    const CycleReading now = body_.reading();
    state_.smallest = state_.smallest && now.contact;
    state_.largest = state_.largest || now.contact;
    const double t = static_cast<double>(k) / options_.steps;
    state_.samples.push_back(
        {.t = t,
         .indentation = trajectory_.indentation(t),
         .tangential = state_.tangential - start_,
         .tangential_force = now.tangential_force,
         .normal_force = now.normal_force,
         .work = now.work - state_.work_at_period_start,
         .dissipated = now.loss ? lost(now).sum() : now.released,
         .contact_area = grid_.cell_area() * static_cast<double>(now.contact.count()),
         .slip_area = grid_.cell_area() * static_cast<double>(now.slipping),
         .tangential_stiffness = now.tangential_stiffness});
    if (options_.on_state && body_.termination() != Termination::interrupted) {
      CycleState copy = state_;
      copy.body = body_.state();
      options_.on_state(std::move(copy));
    }
  }

  void finish_period() {
    const CycleReading now = body_.reading();
    if (now.loss) {
      const Field loss = lost(now);
      result_.loss = loss / grid_.cell_area();
      result_.dissipated = loss.sum();
      result_.slip_work = state_.smallest.select(loss, 0.0).sum();
      result_.relaxation_work = state_.smallest.select(0.0, loss).sum();
    } else {
      result_.dissipated = result_.relaxation_work = now.released;
    }
    result_.stored_energy_change = body_.stored_energy() - state_.energy_at_period_start;
    result_.normal_work = now.normal_work - state_.normal_work_at_period_start;
    result_.gap_work = now.gap_work - state_.gap_work_at_period_start;
    result_.work_per_cycle =
        now.work - state_.work_at_period_start + result_.normal_work - result_.stored_energy_change;
  }

  CycleResult finished() {
    result_.periods = state_.period + 1;
    result_.contact_area_min = std::numeric_limits<double>::infinity();
    for (const CycleSample& sample : state_.samples) {
      result_.contact_area_min = std::min(result_.contact_area_min, sample.contact_area);
      result_.contact_area_max = std::max(result_.contact_area_max, sample.contact_area);
    }
    result_.smallest = std::move(state_.smallest);
    result_.largest = std::move(state_.largest);
    result_.samples = std::move(state_.samples);
    const CycleReading end = body_.reading();
    result_.iterations = end.iterations;
    result_.fft_count = end.fft_count;
    result_.termination = std::max(result_.termination, body_.termination());
    return std::move(result_);
  }

  CycleBody& body_;
  const Grid2D& grid_;
  const Trajectory& trajectory_;
  const CycleOptions& options_;
  const double start_;
  CycleState state_;
  CycleResult result_;
};

}  // namespace

CycleResult run_cycle(CycleBody& body, const Grid2D& grid, const Trajectory& trajectory,
                      const CycleOptions& options, bool first_is_steady) {
  return CycleRun(body, grid, trajectory, options).run(first_is_steady);
}

}  // namespace detail
}  // namespace salebra
