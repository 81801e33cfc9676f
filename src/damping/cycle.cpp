// SPDX-License-Identifier: GPL-3.0-or-later
// Direct simulation of a cycle without slip: cells stick, and those that leave lose their energy.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/damping/cycle.hpp>
#include <utility>

namespace salebra {
namespace {

using std::numbers::pi;

double dot(const TangentialField& a, const TangentialField& b) {
  return (a.x * b.x + a.y * b.y).sum();
}

// A stuck contact, whose memory is the state: where each of its cells has been drawn to.
class StuckContact {
 public:
  StuckContact(const Grid2D& grid, const Material& material, const CycleOptions& options,
               double motion_scale, CycleState& state)
      : cell_area_(grid.cell_area()),
        scale_(motion_scale),
        direction_x_(std::cos(options.direction)),
        direction_y_(options.stick.hold_lateral ? std::sin(options.direction) : 0.0),
        solver_(grid, material, options.stick),
        state_(state),
        unit_motion_{Field::Constant(grid.nx, grid.ny, direction_x_),
                     Field::Constant(grid.nx, grid.ny, direction_y_)} {}

  void reserve(const ContactSet& largest) { solver_.reserve(largest); }

  double tangential_force() const { return along_motion(state_.traction); }
  double tangential_stiffness() const { return along_motion(state_.unit_traction); }
  double stored_energy() const {
    return cell_area_ / 2 * dot(state_.traction, state_.displacement);
  }
  double contact_area() const { return cell_area_ * static_cast<double>(state_.contact.count()); }
  bool interrupted() const { return interrupted_; }

  // Moves the body; returns the work of the tangential force, which is linear in the move.
  double move(double distance) {
    if (!state_.contact.any()) return 0;
    const double force_before = tangential_force();
    state_.traction.x += distance * state_.unit_traction.x;
    state_.traction.y += distance * state_.unit_traction.y;
    state_.displacement.x += state_.contact.select(Field(distance * unit_motion_.x), 0.0);
    state_.displacement.y += state_.contact.select(Field(distance * unit_motion_.y), 0.0);
    return (force_before + tangential_force()) / 2 * distance;
  }

  // Replaces the contact set at rest; returns the energy released.
  double change_to(const ContactSet& contact) {
    if ((contact == state_.contact).all()) return 0;
    const ContactSet leaving = state_.contact && !contact, staying = state_.contact && contact;
    const ContactSet entering = contact && !state_.contact;
    const double released = leaving.any() ? release(leaving, staying) : 0;
    if (entering.any()) {
      const TangentialField present = solver_.displacement(staying, state_.traction, entering);
      state_.fft_count += 2;
      state_.displacement.x = entering.select(present.x, state_.displacement.x);
      state_.displacement.y = entering.select(present.y, state_.displacement.y);
    }
    state_.contact = contact;
    // The stick traction of the last set is a good guess for this one; solve() reads it on the contact only.
    count(solver_.solve(contact, unit_motion_, 1.0, state_.unit_traction));
    return released;
  }

 private:
  double along_motion(const TangentialField& traction) const {
    return cell_area_ * (direction_x_ * traction.x.sum() + direction_y_ * traction.y.sum());
  }

  void count(const StickReport& report) {
    state_.iterations += report.iterations;
    state_.fft_count += report.fft_count;
    state_.converged = state_.converged && report.converged;
    interrupted_ = interrupted_ || report.interrupted;
  }

  double release(const ContactSet& leaving, const ContactSet& staying) {
    const TangentialField before = state_.traction;
    count(solver_.solve(staying, state_.displacement, scale_, state_.traction));
    const TangentialField relaxed = solver_.displacement(staying, state_.traction, leaving);
    state_.fft_count += 2;
    double released = 0;
    for (Index ix = 0; ix < leaving.rows(); ++ix)
      for (Index iy = 0; iy < leaving.cols(); ++iy)
        if (leaving(ix, iy)) {
          double& x = state_.displacement.x(ix, iy);
          double& y = state_.displacement.y(ix, iy);
          released += before.x(ix, iy) * (x - relaxed.x(ix, iy)) +
                      before.y(ix, iy) * (y - relaxed.y(ix, iy));
          x = y = 0;
        }
    return released * cell_area_ / 2;
  }

  double cell_area_, scale_, direction_x_, direction_y_;
  StickSolver solver_;
  CycleState& state_;
  TangentialField unit_motion_;  // the body's direction
  bool interrupted_ = false;
};

// Caches levels by rounded indentation, so that a resumed run gets identical levels.
class LevelStore {
 public:
  LevelStore(const ContactLevels& levels, double resolution)
      : levels_(levels), resolution_(resolution) {}

  const ContactLevel& at(double indentation) {
    const long long key = resolution_ > 0 ? std::llround(indentation / resolution_) : 0;
    const auto found = stored_.find(key);
    if (found != stored_.end()) return found->second;
    const double rounded = resolution_ > 0 ? static_cast<double>(key) * resolution_ : indentation;
    return stored_.emplace(key, levels_(rounded)).first->second;
  }

 private:
  const ContactLevels& levels_;
  double resolution_;
  std::map<long long, ContactLevel> stored_;
};

// Loss estimated from every stride-th contact set.
struct LossInSteps {
  double lost = 0;
  double variance = 0;  // from the unknown entry time of each cell within a step
};

// W = ½∮s² dK_t with the contact sets of every `stride`-th step, as the simulation would find it in steps of that length: what lies
// between two sets enters and leaves at the middle time. Cells that enter at any time of a step, each by itself, have s² spread evenly
// between its values at the ends. Of the second of two periods, since the first may begin anywhere.
LossInSteps loss_in_steps(const std::vector<CycleSample>& samples, const Trajectory& trajectory,
                          double cell_area, int stride) {
  struct Band {
    double top;                  // K_t up to which it reaches
    double begin, middle, end;   // x while it entered
    double cells_per_stiffness;  // m/N
  };
  const int steps = static_cast<int>(samples.size()) - 1;
  const double advance = trajectory.tangential(1) - trajectory.tangential(0);
  const double start = trajectory.tangential(0);
  std::vector<Band> bands{{samples.front().tangential_stiffness, start, start, start, 1}};
  LossInSteps loss;
  for (const double travelled : {0.0, advance}) {
    loss = {};
    for (int k = 0, next = 0; k < steps; k = next) {
      next = std::min(k + stride, steps);
      const auto at = [&](double step) { return trajectory.tangential(step / steps) + travelled; };
      const double begin = at(k), middle = at((k + next) / 2.0), end = at(next);
      const CycleSample &from = samples[static_cast<std::size_t>(k)],
                        &to = samples[static_cast<std::size_t>(next)];
      const double stiffness = to.tangential_stiffness;
      while (!bands.empty() && bands.back().top > stiffness) {
        Band& band = bands.back();
        const double below = bands.size() > 1 ? bands[bands.size() - 2].top : 0;
        const double part = band.top - std::max(below, stiffness);
        const double spread = std::pow(end - band.begin, 2) - std::pow(begin - band.end, 2);
        loss.lost += part * std::pow(middle - band.middle, 2) / 2;
        loss.variance +=
            std::pow(part * spread / 2, 2) / (12 * std::max(1.0, part * band.cells_per_stiffness));
        if (below < stiffness) {
          band.top = stiffness;
          break;
        }
        bands.pop_back();
      }
      const double below = bands.empty() ? 0 : bands.back().top;
      if (below < stiffness) {
        const double cells = (to.contact_area - from.contact_area) / cell_area;
        bands.push_back({stiffness, begin, middle, end, cells / (stiffness - below)});
      }
    }
  }
  return loss;
}

double step_error_of(const CycleResult& result, const Trajectory& trajectory, double cell_area) {
  const LossInSteps here = loss_in_steps(result.samples, trajectory, cell_area, 1);
  const LossInSteps twice = loss_in_steps(result.samples, trajectory, cell_area, 2);
  // A third of the change is the error of second order; the whole of it leaves room for cells that enter in groups.
  const double change = std::abs(here.lost - twice.lost);
  return std::max(change, change / 3 + 2 * std::sqrt(here.variance)) +
         std::abs(here.lost - result.work_per_cycle);
}

CycleState at_rest(const Grid2D& grid) {
  const auto zero = [&] {
    return TangentialField{Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
  };
  CycleState state;
  state.contact = ContactSet::Constant(grid.nx, grid.ny, false);
  state.displacement = zero();
  state.traction = zero();
  state.unit_traction = zero();
  return state;
}

void require_state(const CycleState& state, const Grid2D& grid, const CycleOptions& options) {
  require(state.contact.rows() == grid.nx && state.contact.cols() == grid.ny, "resume",
          state.contact.size(), "cells do not match the grid; resume with the run's own settings");
  require(state.step >= 0 && state.step <= options.steps && state.period < options.max_periods,
          "resume", state.step, "is not one of the steps; resume with the run's own settings");
}

void validate(const CycleOptions& options, const Trajectory& trajectory) {
  require(options.steps >= 4, "steps", options.steps, "must be >= 4");
  require(options.max_periods >= 1, "max_periods", options.max_periods, "must be >= 1");
  require(std::isfinite(options.direction), "direction", options.direction, "must be finite");
  require(options.stick.hold_lateral || options.direction == 0, "direction", options.direction,
          "must be 0 where the lateral displacement is free; turn the surface instead");
  if (!trajectory.indentation || !trajectory.tangential)
    throw InvalidInput("trajectory: a function is missing; give indentation and tangential");
}

}  // namespace

ContactLevels boundary_element_levels(Surface surface, double contact_modulus,
                                      const NormalContactOptions& options) {
  return [surface = std::move(surface), contact_modulus, options](double indentation) {
    if (indentation <= 0)
      return ContactLevel{ContactSet::Constant(surface.grid.nx, surface.grid.ny, false)};
    const NormalContactState state =
        press_to_indentation(surface, contact_modulus, indentation, options);
    return ContactLevel{contact_set(state), state.force, state.converged};
  };
}

Trajectory trajectory_of(const Oscillation& motion, double mean_indentation) {
  // t = 0 is the phase θ = −π, where the indentation is least.
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

CycleResult simulate_cycle(const ContactLevels& levels, const Grid2D& grid,
                           const Material& material, const Trajectory& trajectory,
                           const CycleOptions& options) {
  grid.validate();
  validate(options, trajectory);
  const int steps = options.steps;
  // A contact set, of a byte a cell, for every second step, since the way down meets those of the way up.
  require_memory(grid, 0.5 * steps * static_cast<double>(grid.points()),
                 "the contact sets of its steps (fewer --steps need less)");
  const auto time = [&](double step) { return step / steps; };

  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  double left = least, right = -least;
  for (int k = 0; k <= steps; ++k) {
    least = std::min(least, trajectory.indentation(time(k)));
    greatest = std::max(greatest, trajectory.indentation(time(k)));
    left = std::min(left, trajectory.tangential(time(k)));
    right = std::max(right, trajectory.tangential(time(k)));
  }
  LevelStore store(levels, 1e-9 * (greatest - least));
  CycleResult result;
  const ContactSet widest = store.at(greatest).contact;
  require(widest.rows() == grid.nx && widest.cols() == grid.ny, "levels", widest.size(),
          "cells do not match the grid");
  const bool resumed = options.resume != nullptr;
  if (resumed) require_state(*options.resume, grid, options);
  CycleState state = resumed ? *options.resume : at_rest(grid);
  // Without tangential motion nothing is solved for, and any scale will do.
  StuckContact contact(grid, material, options, right > left ? right - left : 1.0, state);
  contact.reserve(widest);
  if (!resumed) {
    state.largest = state.smallest = widest;
    contact.change_to(store.at(trajectory.indentation(0)).contact);
    state.converged = state.converged && store.at(greatest).converged;
  }

  const auto move_to = [&](double t) {
    const double next = trajectory.tangential(t);
    state.work += contact.move(next - state.tangential);
    state.tangential = next;
  };
  const auto take_step = [&](int k) {
    const ContactLevel& level = store.at(trajectory.indentation(time(k)));
    state.converged = state.converged && level.converged;
    state.released_energy += contact.change_to(level.contact);
    state.smallest = state.smallest && level.contact;
    state.largest = state.largest || level.contact;
    if (k > 0) move_to(time(k));
    state.step = k;
    state.samples.push_back({.t = time(k),
                             .indentation = trajectory.indentation(time(k)),
                             .tangential = state.tangential - state.period_start,
                             .tangential_force = contact.tangential_force(),
                             .normal_force = level.force,
                             .work = state.work,
                             .released_energy = state.released_energy,
                             .contact_area = contact.contact_area(),
                             .tangential_stiffness = contact.tangential_stiffness()});
  };
  const auto begin_period = [&] {
    state.samples.clear();
    state.work = state.released_energy = 0;
    state.energy_at_period_start = contact.stored_energy();
    state.tangential = state.period_start = trajectory.tangential(0);
  };

  if (!resumed) begin_period();
  for (int k = resumed ? state.step : 0;; ++k) {
    if (!resumed || k != options.resume->step || state.period != options.resume->period) {
      take_step(k);
      if (contact.interrupted()) {
        result.interrupted = true;
        break;
      }
      if (options.on_state) options.on_state(state);
    }
    if (options.on_progress &&
        !options.on_progress({"cycle", static_cast<double>(k) / steps, k, 0})) {
      result.interrupted = true;
      break;
    }
    if (k < steps) {
      move_to(time(k + 0.5));
      continue;
    }
    const double lost = state.work - (contact.stored_energy() - state.energy_at_period_start);
    // Started at the least indentation, every other cell has been released and has entered again: the period repeats.
    const bool from_least = trajectory.indentation(0) <= least + 1e-9 * (greatest - least);
    result.steady = from_least ||
                    (state.period > 0 && std::abs(lost - state.last_work) <= 1e-6 * std::abs(lost));
    if (result.steady || state.period + 1 == options.max_periods) break;
    state.last_work = lost;
    ++state.period;
    begin_period();
    k = -1;
  }

  result.periods = state.period + 1;
  result.stored_energy_change = contact.stored_energy() - state.energy_at_period_start;
  result.work_per_cycle = state.work - result.stored_energy_change;
  result.released_energy = state.released_energy;
  result.smallest = state.smallest;
  result.largest = state.largest;
  result.samples = state.samples;
  result.contact_area_min = result.contact_area_max = contact.contact_area();
  for (const CycleSample& sample : result.samples) {
    result.contact_area_min = std::min(result.contact_area_min, sample.contact_area);
    result.contact_area_max = std::max(result.contact_area_max, sample.contact_area);
  }
  if (!result.interrupted) result.step_error = step_error_of(result, trajectory, grid.cell_area());
  result.iterations = state.iterations;
  result.fft_count = state.fft_count;
  result.converged = state.converged && !result.interrupted;
  return result;
}

}  // namespace salebra
