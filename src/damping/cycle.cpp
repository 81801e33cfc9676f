// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/cycle.hpp>
#include <utility>

namespace salebra {
namespace {

using std::numbers::pi;

double dot(const TangentialField& a, const TangentialField& b) {
  return (a.x * b.x + a.y * b.y).sum();
}

// A stuck contact and what it remembers: where each of its cells has been drawn to.
class StuckContact {
 public:
  StuckContact(const Grid2D& grid, const Material& material, const CycleOptions& options,
               double motion_scale)
      : cell_area_(grid.cell_area()),
        scale_(motion_scale),
        direction_x_(std::cos(options.direction)),
        direction_y_(options.stick.hold_lateral ? std::sin(options.direction) : 0.0),
        solver_(grid, material, options.stick),
        contact_(ContactSet::Constant(grid.nx, grid.ny, false)),
        displacement_(zero(grid)),
        traction_(zero(grid)),
        unit_motion_(zero(grid)),
        unit_traction_(zero(grid)) {
    unit_motion_.x = direction_x_;
    unit_motion_.y = direction_y_;
  }

  void reserve(const ContactSet& largest) { solver_.reserve(largest); }

  double tangential_force() const {
    return cell_area_ * (direction_x_ * traction_.x.sum() + direction_y_ * traction_.y.sum());
  }
  double stored_energy() const { return cell_area_ / 2 * dot(traction_, displacement_); }
  const ContactSet& contact() const { return contact_; }
  double contact_area() const { return cell_area_ * static_cast<double>(contact_.count()); }
  bool converged() const { return converged_; }
  bool interrupted() const { return interrupted_; }
  long iterations() const { return iterations_; }
  long fft_count() const { return fft_count_; }

  // Moves the body; returns the work of the tangential force, which is linear in the move.
  double move(double distance) {
    if (!contact_.any()) return 0;
    const double force_before = tangential_force();
    traction_.x += distance * unit_traction_.x;
    traction_.y += distance * unit_traction_.y;
    displacement_.x += contact_.select(Field(distance * unit_motion_.x), 0.0);
    displacement_.y += contact_.select(Field(distance * unit_motion_.y), 0.0);
    return (force_before + tangential_force()) / 2 * distance;
  }

  // Replaces the contact set at rest; returns the energy released.
  double change_to(const ContactSet& contact) {
    if ((contact == contact_).all()) return 0;
    const ContactSet leaving = contact_ && !contact, staying = contact_ && contact;
    const ContactSet entering = contact && !contact_;
    const double released = leaving.any() ? release(leaving, staying) : 0;
    if (entering.any()) {
      const TangentialField present = solver_.displacement(staying, traction_, entering);
      fft_count_ += 2;
      displacement_.x = entering.select(present.x, displacement_.x);
      displacement_.y = entering.select(present.y, displacement_.y);
    }
    contact_ = contact;
    // The stick traction of the last set is a good guess for this one; solve() reads it on the contact only.
    count(solver_.solve(contact_, unit_motion_, 1.0, unit_traction_));
    return released;
  }

 private:
  static TangentialField zero(const Grid2D& grid) {
    return {Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
  }
  void count(const StickReport& report) {
    iterations_ += report.iterations;
    fft_count_ += report.fft_count;
    converged_ = converged_ && report.converged;
    interrupted_ = interrupted_ || report.interrupted;
  }

  double release(const ContactSet& leaving, const ContactSet& staying) {
    const TangentialField before = traction_;
    count(solver_.solve(staying, displacement_, scale_, traction_));
    const TangentialField relaxed = solver_.displacement(staying, traction_, leaving);
    fft_count_ += 2;
    double released = 0;
    for (Index ix = 0; ix < leaving.rows(); ++ix)
      for (Index iy = 0; iy < leaving.cols(); ++iy)
        if (leaving(ix, iy)) {
          released += before.x(ix, iy) * (displacement_.x(ix, iy) - relaxed.x(ix, iy)) +
                      before.y(ix, iy) * (displacement_.y(ix, iy) - relaxed.y(ix, iy));
          displacement_.x(ix, iy) = displacement_.y(ix, iy) = 0;
        }
    return released * cell_area_ / 2;
  }

  double cell_area_, scale_, direction_x_, direction_y_;
  StickSolver solver_;
  ContactSet contact_;
  TangentialField displacement_;  // of the cells in contact, 0 elsewhere
  TangentialField traction_;
  TangentialField unit_motion_,
      unit_traction_;  // the body's direction, and the stick traction of a unit move
  bool converged_ = true, interrupted_ = false;
  long iterations_ = 0, fft_count_ = 0;
};

// Asks for each indentation once: going down, a cycle meets the levels of its way up again.
class LevelStore {
 public:
  LevelStore(const ContactLevels& levels, double resolution)
      : levels_(levels), resolution_(resolution) {}

  const ContactLevel& at(double indentation) {
    auto next = stored_.lower_bound(indentation - resolution_);
    if (next != stored_.end() && next->first <= indentation + resolution_) return next->second;
    const ContactLevel& level = stored_.emplace(indentation, levels_(indentation)).first->second;
    converged_ = converged_ && level.converged;
    return level;
  }
  bool converged() const { return converged_; }

 private:
  const ContactLevels& levels_;
  double resolution_;
  std::map<double, ContactLevel> stored_;
  bool converged_ = true;
};

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
  result.largest = store.at(greatest).contact;
  require(result.largest.rows() == grid.nx && result.largest.cols() == grid.ny, "levels",
          result.largest.size(), "cells do not match the grid");
  // Without tangential motion nothing is solved for, and any scale will do.
  StuckContact contact(grid, material, options, right > left ? right - left : 1.0);
  contact.reserve(result.largest);
  contact.change_to(store.at(trajectory.indentation(0)).contact);
  result.smallest = result.largest;

  double last_work = 0;
  for (int period = 0; period < options.max_periods; ++period) {
    result.samples.clear();
    const double energy_at_start = contact.stored_energy();
    double work = 0, released = 0, x = trajectory.tangential(0);
    const double start = x;
    for (int k = 0; k <= steps; ++k) {
      const ContactLevel& level = store.at(trajectory.indentation(time(k)));
      released += contact.change_to(level.contact);
      result.smallest = result.smallest && level.contact;
      result.largest = result.largest || level.contact;
      const auto add_sample = [&] {
        result.samples.push_back({.t = time(k),
                                  .indentation = trajectory.indentation(time(k)),
                                  .tangential = x - start,
                                  .tangential_force = contact.tangential_force(),
                                  .normal_force = level.force,
                                  .work = work,
                                  .released_energy = released,
                                  .contact_area = contact.contact_area()});
      };
      const auto move_to = [&](double t) {
        const double next = trajectory.tangential(t);
        work += contact.move(next - x);
        x = next;
      };
      if (k > 0) move_to(time(k));
      add_sample();
      if (k < steps) move_to(time(k + 0.5));
      if (contact.interrupted() ||
          (options.on_progress &&
           !options.on_progress({"cycle", static_cast<double>(k) / steps, k, 0}))) {
        result.interrupted = true;
        break;
      }
    }
    ++result.periods;
    result.stored_energy_change = contact.stored_energy() - energy_at_start;
    result.work_per_cycle = work - result.stored_energy_change;
    result.released_energy = released;
    if (result.interrupted) break;
    // Started at the least indentation, every other cell has been released and has entered again: the period repeats.
    const bool from_least = trajectory.indentation(0) <= least + 1e-9 * (greatest - least);
    const double change = std::abs(result.work_per_cycle - last_work);
    result.steady = from_least || (period > 0 && change <= 1e-6 * std::abs(result.work_per_cycle));
    if (result.steady) break;
    last_work = result.work_per_cycle;
  }
  result.contact_area_min = result.contact_area_max = contact.contact_area();
  for (const CycleSample& sample : result.samples) {
    result.contact_area_min = std::min(result.contact_area_min, sample.contact_area);
    result.contact_area_max = std::max(result.contact_area_max, sample.contact_area);
  }
  result.iterations = contact.iterations();
  result.fft_count = contact.fft_count();
  result.converged = contact.converged() && store.converged() && !result.interrupted;
  return result;
}

}  // namespace salebra
