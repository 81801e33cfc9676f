// SPDX-License-Identifier: GPL-3.0-or-later
// Direct simulation of a cycle with Coulomb friction, uncoupled or coupled, to its steady period.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/damping/frictional_cycle.hpp>
#include <utility>

namespace salebra {
namespace {

void validate(const FrictionalCycleOptions& options, const Trajectory& trajectory) {
  require(options.steps >= 4, "steps", options.steps, "must be >= 4");
  require(options.max_periods >= 1, "max_periods", options.max_periods, "must be >= 1");
  require_positive(options.steady_tolerance, "steady_tolerance");
  require(std::isfinite(options.direction), "direction", options.direction, "must be finite");
  require(options.stick.hold_lateral || options.direction == 0, "direction", options.direction,
          "must be 0 where the lateral displacement is free; turn the surface instead");
  if (!trajectory.indentation || !trajectory.tangential)
    throw InvalidInput("trajectory: a function is missing; give indentation and tangential");
}

// The pressures of each step of a period. Going down, a cycle meets the indentations of its way up again.
class StepPressures {
 public:
  StepPressures(const PressureLevels& levels, const Grid2D& grid, const Trajectory& trajectory,
                int steps) {
    // A field for every second step, since the way down meets those of the way up.
    require_memory(grid, 0.5 * sizeof(double) * steps * static_cast<double>(grid.points()),
                   "the pressures of its steps (fewer steps need less)");
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (int k = 0; k <= steps; ++k) {
      const double indentation = trajectory.indentation(static_cast<double>(k) / steps);
      least = std::min(least, indentation);
      greatest = std::max(greatest, indentation);
    }
    const double resolution = 1e-9 * (greatest - least);
    for (int k = 0; k <= steps; ++k) {
      const double indentation = trajectory.indentation(static_cast<double>(k) / steps);
      auto next = stored_.lower_bound(indentation - resolution);
      if (next == stored_.end() || next->first > indentation + resolution) {
        next = stored_.emplace(indentation, levels(indentation)).first;
        converged_ = converged_ && next->second.converged;
      }
      steps_.push_back(&next->second);
    }
  }
  const PressureLevel& at(int step) const { return *steps_[static_cast<std::size_t>(step)]; }
  bool converged() const { return converged_; }

 private:
  std::map<double, PressureLevel> stored_;
  std::vector<const PressureLevel*> steps_;
  bool converged_ = true;
};

// The contact of given pressures as a cycle drives it.
class GivenPressures {
 public:
  GivenPressures(const PressureLevels& levels, const Grid2D& grid, const Material& material,
                 const Trajectory& trajectory, const FrictionalCycleOptions& options,
                 double motion_scale)
      : pressures_(levels, grid, trajectory, options.steps),
        contact_(grid, material,
                 {.friction_coefficient = options.friction_coefficient,
                  .motion_scale = motion_scale,
                  .stick = options.stick}) {
    ContactSet largest = ContactSet::Constant(grid.nx, grid.ny, false);
    for (int k = 0; k <= options.steps; ++k) {
      const Field& pressure = pressures_.at(k).pressure;
      require(pressure.rows() == grid.nx && pressure.cols() == grid.ny, "levels", pressure.size(),
              "pressures do not match the grid");
      largest = largest || (pressure > 0);
    }
    contact_.reserve(largest);
    if (!options.resume) contact_.advance(pressures_.at(0).pressure);
  }
  void restore(const SlidingState& state) { contact_.restore(state); }
  // Returns the normal force.
  double advance(int step, const TangentialMove& move) {
    contact_.advance(pressures_.at(step).pressure, move);
    return pressures_.at(step).force;
  }
  const SlidingContact& sliding() const { return contact_; }
  double stored_energy() const { return contact_.stored_energy(); }
  double normal_work() const { return 0; }
  double gap_work() const { return 0; }
  bool converged() const { return contact_.converged() && pressures_.converged(); }
  bool interrupted() const { return contact_.interrupted(); }

 private:
  StepPressures pressures_;
  SlidingContact contact_;
};

// The same with pressures that the tractions change.
class CoupledPressures {
 public:
  CoupledPressures(const Surface& surface, const Material& material, const Trajectory& trajectory,
                   const FrictionalCycleOptions& options, const NormalContactOptions& contact,
                   double coupling, double motion_scale)
      : trajectory_(trajectory),
        steps_(options.steps),
        contact_(surface, material,
                 {.sliding = {.friction_coefficient = options.friction_coefficient,
                              .motion_scale = motion_scale,
                              .stick = options.stick},
                  .contact = contact,
                  .coupling = coupling}) {
    // What sticks while the contact is made depends on how: from first touch, in rings of about one width.
    const int approach = std::max(steps_ / 4, 4);
    for (int k = 1; k <= approach; ++k) {
      const double part = static_cast<double>(k) / approach;
      contact_.advance(part * part * trajectory.indentation(0));
    }
  }
  double advance(int step, const TangentialMove& move) {
    contact_.advance(trajectory_.indentation(static_cast<double>(step) / steps_), move);
    return contact_.normal_force();
  }
  const SlidingContact& sliding() const { return contact_.sliding(); }
  double stored_energy() const { return contact_.stored_energy(); }
  double normal_work() const { return contact_.normal_work(); }
  double gap_work() const { return contact_.gap_work(); }
  bool converged() const { return contact_.converged(); }
  bool interrupted() const { return contact_.interrupted(); }

 private:
  Trajectory trajectory_;
  int steps_;
  CoupledContact contact_;
};

double motion_scale_of(const Trajectory& trajectory, int steps) {
  double left = std::numeric_limits<double>::infinity(), right = -left;
  for (int k = 0; k <= steps; ++k) {
    const double x = trajectory.tangential(static_cast<double>(k) / steps);
    left = std::min(left, x);
    right = std::max(right, x);
  }
  return right - left;
}

void require_state(const FrictionalCycleState& state, const Grid2D& grid,
                   const FrictionalCycleOptions& options) {
  require(state.smallest.rows() == grid.nx && state.smallest.cols() == grid.ny, "resume",
          state.smallest.size(), "cells do not match the grid; resume with the run's own settings");
  require(state.step >= 0 && state.step <= options.steps && state.period < options.max_periods,
          "resume", state.step, "is not one of the steps; resume with the run's own settings");
}

// From period to period until one loses what the last one lost. `state` is where the body is: fresh, or restored.
template <class Body>
FrictionalCycleResult follow(Body& body, const Grid2D& grid, const Trajectory& trajectory,
                             const FrictionalCycleOptions& options, FrictionalCycleState state) {
  const int steps = options.steps;
  const double along_x = std::cos(options.direction);
  const double along_y = options.stick.hold_lateral ? std::sin(options.direction) : 0.0;
  const SlidingContact& contact = body.sliding();
  const double start = trajectory.tangential(0);
  FrictionalCycleResult result;

  const auto begin_period = [&] {
    state.samples.clear();
    state.smallest = state.largest = contact.pressure() > 0;
    state.energy_at_period_start = body.stored_energy();
    state.work_at_period_start = contact.work();
    state.normal_work_at_period_start = body.normal_work();
    state.gap_work_at_period_start = body.gap_work();
    state.loss_at_period_start = contact.loss();
    state.tangential = start;
  };
  const auto take_step = [&](int k) {
    const double t = static_cast<double>(k) / steps;
    const double move = trajectory.tangential(t) - state.tangential;
    state.tangential += move;
    const double normal_force = body.advance(k, {move * along_x, move * along_y});
    const ContactSet in_contact = contact.pressure() > 0;
    state.smallest = state.smallest && in_contact;
    state.largest = state.largest || in_contact;
    state.step = k;
    const TangentialMove force = contact.tangential_force();
    state.samples.push_back(
        {.t = t,
         .indentation = trajectory.indentation(t),
         .tangential = state.tangential - start,
         .tangential_force = along_x * force.x + along_y * force.y,
         .normal_force = normal_force,
         .work = contact.work() - state.work_at_period_start,
         .dissipated = (contact.loss() - state.loss_at_period_start).sum(),
         .contact_area = grid.cell_area() * static_cast<double>(in_contact.count()),
         .slip_area = grid.cell_area() * static_cast<double>(contact.slipping())});
  };
  const auto finish_period = [&] {
    const Field loss = contact.loss() - state.loss_at_period_start;
    result.loss = loss / grid.cell_area();
    result.dissipated = loss.sum();
    result.slip_work = state.smallest.select(loss, 0.0).sum();
    result.relaxation_work = state.smallest.select(0.0, loss).sum();
    result.stored_energy_change = body.stored_energy() - state.energy_at_period_start;
    result.normal_work = body.normal_work() - state.normal_work_at_period_start;
    result.gap_work = body.gap_work() - state.gap_work_at_period_start;
    result.work_per_cycle = contact.work() - state.work_at_period_start + result.normal_work -
                            result.stored_energy_change;
  };

  const bool resumed = options.resume != nullptr;
  if (!resumed) begin_period();
  for (int k = resumed ? state.step : 0;;) {
    if (!resumed || k != options.resume->step || state.period != options.resume->period) {
      take_step(k);
      if (options.on_state && !body.interrupted()) {
        state.contact = contact.state();
        options.on_state(state);
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
        state.period > 0 && change <= options.steady_tolerance * std::abs(result.work_per_cycle);
    if (result.steady || state.period + 1 == options.max_periods) break;
    state.last_work = result.work_per_cycle;
    ++state.period;
    begin_period();
    k = 0;
  }
  result.periods = state.period + 1;
  result.smallest = state.smallest;
  result.largest = state.largest;
  result.samples = state.samples;
  result.contact_area_min = std::numeric_limits<double>::infinity();
  for (const FrictionalSample& sample : result.samples) {
    result.contact_area_min = std::min(result.contact_area_min, sample.contact_area);
    result.contact_area_max = std::max(result.contact_area_max, sample.contact_area);
  }
  result.iterations = contact.iterations();
  result.fft_count = contact.fft_count();
  result.converged = body.converged() && !result.interrupted;
  return result;
}

}  // namespace

PressureLevels boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options) {
  return [surface = std::move(surface), contact_modulus, options](double indentation) {
    if (indentation <= 0)
      return PressureLevel{.pressure = Field::Zero(surface.grid.nx, surface.grid.ny)};
    NormalContactState state = press_to_indentation(surface, contact_modulus, indentation, options);
    return PressureLevel{std::move(state.pressure), state.force, state.converged};
  };
}

FrictionalCycleResult simulate_frictional_cycle(const PressureLevels& levels, const Grid2D& grid,
                                                const Material& material,
                                                const Trajectory& trajectory,
                                                const FrictionalCycleOptions& options) {
  grid.validate();
  validate(options, trajectory);
  const double range = motion_scale_of(trajectory, options.steps);
  // Without tangential motion nothing is solved for, and any scale will do.
  if (options.resume) require_state(*options.resume, grid, options);
  GivenPressures body(levels, grid, material, trajectory, options, range > 0 ? range : 1.0);
  FrictionalCycleState state;
  if (options.resume) {
    state = *options.resume;
    body.restore(state.contact);
  }
  return follow(body, grid, trajectory, options, std::move(state));
}

FrictionalCycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                             const Trajectory& trajectory,
                                             const FrictionalCycleOptions& options,
                                             const NormalContactOptions& contact) {
  validate(options, trajectory);
  if (options.resume)
    throw InvalidInput("resume: given; a coupled cycle cannot be resumed, leave it out");
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (int k = 0; k <= options.steps; ++k) {
    const double indentation = trajectory.indentation(static_cast<double>(k) / options.steps);
    least = std::min(least, indentation);
    greatest = std::max(greatest, indentation);
  }
  require(least >= 0, "indentation", least, "must be >= 0 throughout a coupled cycle");
  const double coupling = options.coupling ? *options.coupling : coupling_constant(material);
  // The coupling itself moves the surface by about β of the sweep.
  const double scale =
      std::max(motion_scale_of(trajectory, options.steps),
               std::abs(dundurs_constant(material.contact_modulus, coupling)) * (greatest - least));
  CoupledPressures body(surface, material, trajectory, options, contact, coupling,
                        scale > 0 ? scale : 1.0);
  return follow(body, surface.grid, trajectory, options, {});
}

}  // namespace salebra
