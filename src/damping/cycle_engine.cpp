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
        "is given together with tangential, or to a cycle without friction; leave it out");
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
    throw InvalidInput("resume", "is the state of another kind of cycle; name that of this one");
  require(state.smallest.rows() == grid.nx && state.smallest.cols() == grid.ny, "resume",
          state.smallest.size(), "cells do not match the grid; resume with the run's own settings");
  require(state.step >= 0 && state.step <= options.steps && state.period < options.max_periods,
          "resume", state.step, "is not one of the steps; resume with the run's own settings");
  return body;
}
template const StuckState* resumed<StuckState>(const CycleOptions& options, const Grid2D& grid);
template const SlidingState* resumed<SlidingState>(const CycleOptions& options, const Grid2D& grid);
template const CoupledState* resumed<CoupledState>(const CycleOptions& options, const Grid2D& grid);

CycleResult run_cycle(CycleBody& body, const Grid2D& grid, const Trajectory& trajectory,
                      const CycleOptions& options, bool first_is_steady) {
  const int steps = options.steps;
  const double start = trajectory.tangential(0);
  CycleState state;
  if (options.resume) {
    state = *options.resume;
    state.body = {};  // the body has its own
  }
  CycleResult result;

  const auto start_period = [&] {
    body.start_period();
    const CycleReading now = body.reading();
    state.samples.clear();
    state.smallest = state.largest = now.contact;
    state.tangential = start;
    state.energy_at_period_start = body.stored_energy();
    state.work_at_period_start = now.work;
    state.normal_work_at_period_start = now.normal_work;
    state.gap_work_at_period_start = now.gap_work;
    if (now.loss) state.loss_at_period_start = *now.loss;
  };
  const auto lost = [&](const CycleReading& now) { return *now.loss - state.loss_at_period_start; };
  const auto take_step = [&](int k) {
    state.tangential = body.advance(k, state.tangential);
    state.step = k;
    const CycleReading now = body.reading();
    state.smallest = state.smallest && now.contact;
    state.largest = state.largest || now.contact;
    const double t = static_cast<double>(k) / steps;
    state.samples.push_back(
        {.t = t,
         .indentation = trajectory.indentation(t),
         .tangential = state.tangential - start,
         .tangential_force = now.tangential_force,
         .normal_force = now.normal_force,
         .work = now.work - state.work_at_period_start,
         .dissipated = now.loss ? lost(now).sum() : now.released,
         .contact_area = grid.cell_area() * static_cast<double>(now.contact.count()),
         .slip_area = grid.cell_area() * static_cast<double>(now.slipping),
         .tangential_stiffness = now.tangential_stiffness});
  };
  const auto finish_period = [&] {
    const CycleReading now = body.reading();
    if (now.loss) {
      const Field loss = lost(now);
      result.loss = loss / grid.cell_area();
      result.dissipated = loss.sum();
      result.slip_work = state.smallest.select(loss, 0.0).sum();
      result.relaxation_work = state.smallest.select(0.0, loss).sum();
    } else {
      result.dissipated = result.relaxation_work = now.released;
    }
    result.stored_energy_change = body.stored_energy() - state.energy_at_period_start;
    result.normal_work = now.normal_work - state.normal_work_at_period_start;
    result.gap_work = now.gap_work - state.gap_work_at_period_start;
    result.work_per_cycle =
        now.work - state.work_at_period_start + result.normal_work - result.stored_energy_change;
  };

  if (!options.resume) start_period();
  bool sampled = options.resume != nullptr;  // whether the step k has its sample already
  for (int k = state.step;; sampled = false) {
    if (!sampled) {
      take_step(k);
      if (options.on_state && !body.interrupted()) {
        CycleState copy = state;
        copy.body = body.state();
        options.on_state(std::move(copy));
      }
    }
    if (body.interrupted() ||
        (options.on_progress &&
         !options.on_progress({"cycle", static_cast<double>(k) / steps, k, 0}))) {
      result.interrupted = true;
      finish_period();
      break;
    }
    if (++k <= steps) continue;
    finish_period();
    const double change = std::abs(result.work_per_cycle - state.last_work);
    result.steady =
        first_is_steady ||
        (state.period > 0 && change <= options.steady_tolerance * std::abs(result.work_per_cycle));
    if (result.steady || state.period + 1 == options.max_periods) break;
    state.last_work = result.work_per_cycle;
    ++state.period;
    start_period();
    k = 0;
  }

  result.periods = state.period + 1;
  result.contact_area_min = std::numeric_limits<double>::infinity();
  for (const CycleSample& sample : state.samples) {
    result.contact_area_min = std::min(result.contact_area_min, sample.contact_area);
    result.contact_area_max = std::max(result.contact_area_max, sample.contact_area);
  }
  result.smallest = std::move(state.smallest);
  result.largest = std::move(state.largest);
  result.samples = std::move(state.samples);
  const CycleReading end = body.reading();
  result.iterations = end.iterations;
  result.fft_count = end.fft_count;
  result.converged = end.converged && !result.interrupted;
  return result;
}

}  // namespace detail
}  // namespace salebra
