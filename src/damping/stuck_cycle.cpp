// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated cycle of a stuck contact, with the estimated error of its steps
// (damping/cycle.hpp).
#include <algorithm>
#include <cmath>
#include <map>
#include <salebra/base/error.hpp>
#include <utility>

#include "base/memory.hpp"
#include "cycle_engine.hpp"

namespace salebra {
namespace {

double inner_product(const TangentialField& a, const TangentialField& b) {
  return (a.x * b.x + a.y * b.y).sum();
}

// Stores solved contact sets by rounded indentation. A resumed run finds the same sets as the run
// that it continues.
class ContactSetStore {
 public:
  ContactSetStore(const ContactSets& contact_sets, double resolution)
      : contact_sets_(contact_sets), resolution_(resolution) {}

  const ContactSetAt& at(double indentation) {
    const long long key = resolution_ > 0 ? std::llround(indentation / resolution_) : 0;
    const auto found = stored_.find(key);
    if (found != stored_.end()) return found->second;
    const double rounded = resolution_ > 0 ? static_cast<double>(key) * resolution_ : indentation;
    return stored_.emplace(key, contact_sets_(rounded)).first->second;
  }

 private:
  const ContactSets& contact_sets_;
  double resolution_;
  std::map<long long, ContactSetAt> stored_;
};

class StuckBody final : public detail::CycleBody {
 public:
  StuckBody(const ContactSets& contact_sets, const Grid2D& grid, const Body& elastic,
            const Trajectory& trajectory, const CycleOptions& options,
            const detail::TrajectoryRange& range)
      : trajectory_(trajectory),
        steps_(options.steps),
        cell_area_(grid.cell_area()),
        // motion_scale must be positive; without tangential motion its value has no effect.
        scale_(range.tangential() > 0 ? range.tangential() : 1.0),
        direction_x_(std::cos(options.direction)),
        direction_y_(options.stick.hold_lateral ? std::sin(options.direction) : 0.0),
        contact_sets_(contact_sets, 1e-9 * range.sweep()),
        solver_(grid, elastic, options.stick),
        unit_motion_{Field::Constant(grid.nx, grid.ny, direction_x_),
                     Field::Constant(grid.nx, grid.ny, direction_y_)} {
    const ContactSetAt& widest = contact_sets_.at(range.indentation_max);
    require(widest.contact.rows() == grid.nx && widest.contact.cols() == grid.ny, "contact_sets",
            widest.contact.size(), "cells do not match the grid");
    solver_.reserve(widest.contact);
    if (const StuckState* state = detail::resumed<StuckState>(options, grid)) {
      state_ = *state;
      return;
    }
    const auto zero = [&] {
      return TangentialField{Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
    };
    state_.contact = ContactSet::Constant(grid.nx, grid.ny, false);
    state_.displacement = zero();
    state_.traction = zero();
    state_.unit_traction = zero();
    change_to(contact_sets_.at(trajectory.indentation(0)));
    note(widest);
  }

  void start_period() override { state_.work = state_.released = 0; }

  double advance(int step, double from) override {
    if (step > 0) from = move(from, (step - 0.5) / steps_);
    const double t = static_cast<double>(step) / steps_;
    change_to(contact_sets_.at(trajectory_.indentation(t)));
    return step > 0 ? move(from, t) : from;
  }

  detail::CycleReading reading() const override {
    return {.contact = state_.contact,
            .tangential_force = along_motion(state_.traction),
            .normal_force = normal_force_,
            .work = state_.work,
            .released = state_.released,
            .tangential_stiffness = along_motion(state_.unit_traction),
            .iterations = state_.iterations,
            .fft_count = state_.fft_count};
  }
  double stored_energy() const override {
    return cell_area_ / 2 * inner_product(state_.traction, state_.displacement);
  }
  Termination termination() const override { return state_.termination; }
  decltype(CycleState::body) state() const override { return state_; }

 private:
  double along_motion(const TangentialField& traction) const {
    return cell_area_ * (direction_x_ * traction.x.sum() + direction_y_ * traction.y.sum());
  }

  // Moves the tractions with the body from the position `from` to that at the time t, and returns
  // the new position. The tangential force is linear in the distance.
  double move(double from, double t) {
    const double to = trajectory_.tangential(t), distance = to - from;
    if (!state_.contact.any()) return to;
    const double force_before = along_motion(state_.traction);
    state_.traction.x += distance * state_.unit_traction.x;
    state_.traction.y += distance * state_.unit_traction.y;
    state_.displacement.x += state_.contact.select(Field(distance * unit_motion_.x), 0.0);
    state_.displacement.y += state_.contact.select(Field(distance * unit_motion_.y), 0.0);
    state_.work += (force_before + along_motion(state_.traction)) / 2 * distance;
    return to;
  }

  // Replaces the contact set while the body does not move tangentially.
  void change_to(const ContactSetAt& reached) {
    note(reached);
    normal_force_ = reached.force;
    const ContactSet& contact = reached.contact;
    if ((contact == state_.contact).all()) return;
    const ContactSet leaving = state_.contact && !contact, staying = state_.contact && contact;
    const ContactSet entering = contact && !state_.contact;
    if (leaving.any()) state_.released += release(leaving, staying);
    if (entering.any()) {
      const TangentialField present = solver_.displacement(staying, state_.traction, entering);
      state_.fft_count += 2;
      state_.displacement.x = entering.select(present.x, state_.displacement.x);
      state_.displacement.y = entering.select(present.y, state_.displacement.y);
    }
    state_.contact = contact;
    // The stick traction of the previous contact set is a good initial guess. solve() reads it only
    // in cells that are in contact.
    count(solver_.solve(contact, unit_motion_, 1.0, state_.unit_traction));
  }

  void note(const ContactSetAt& reached) {
    if (!reached.converged)
      state_.termination = std::max(state_.termination, Termination::iteration_limit);
  }

  void count(const StickReport& report) {
    state_.iterations += report.iterations;
    state_.fft_count += report.fft_count;
    state_.termination = std::max(state_.termination, report.termination);
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

  const Trajectory& trajectory_;
  int steps_;
  double cell_area_, scale_, direction_x_, direction_y_;
  ContactSetStore contact_sets_;
  StickSolver solver_;
  TangentialField unit_motion_;  // unit displacement in the direction of the tangential motion
  StuckState state_;
  double normal_force_ = 0;
};

// Loss estimated from every stride-th contact set.
struct LossInSteps {
  double lost = 0;
  // Variance of `lost`, because the time within a step at which a cell enters is unknown.
  double variance = 0;
};

// Estimates W = ½∮s² dK_t (s: stretch of a spring where it separates) from the contact sets of
// every `stride`-th step, as a simulation with steps of that length would find it: cells by which
// two successive sets differ enter or leave at the time in the middle. The variance assumes that
// each cell enters at an independent time within a step, with s² distributed evenly between its
// values at the beginning and the end of the step. Follows two periods and counts the second, since
// the first may begin with any contact set.
LossInSteps loss_in_steps(const std::vector<CycleSample>& samples, const Trajectory& trajectory,
                          double cell_area, int stride) {
  struct Band {
    double top;  // K_t at the top of this band of springs
    // Tangential position x at the beginning, middle and end of the step in which the band entered.
    double begin, middle, end;
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
  // The error of the steps. If it is of second order, it is a third of the change under doubled
  // steps; the whole change allows for cells that enter in groups.
  const double change = std::abs(here.lost - twice.lost);
  return std::max(change, change / 3 + 2 * std::sqrt(here.variance)) +
         std::abs(here.lost - result.work_per_cycle);
}

}  // namespace

ContactSets boundary_element_contact_sets(Surface surface, const Body& body,
                                          const NormalContactOptions& options) {
  surface.require_whole("an oscillating contact");
  return [surface = std::move(surface), body, options](double indentation) {
    if (indentation <= 0)
      return ContactSetAt{ContactSet::Constant(surface.grid.nx, surface.grid.ny, false)};
    const NormalContactState state = press(surface, body, at_indentation(indentation), options);
    return ContactSetAt{contact_set(state), state.force, state.converged()};
  };
}

ContactSets boundary_element_contact_sets(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options) {
  return boundary_element_contact_sets(std::move(surface),
                                       Material::of_contact_modulus(contact_modulus), options);
}

CycleResult simulate_cycle(const ContactSets& contact_sets, const Grid2D& grid, const Body& body,
                           const Trajectory& trajectory, const CycleOptions& options) {
  grid.validate();
  const detail::TrajectoryRange range = detail::checked_range(trajectory, options);
  // Memory of the contact sets, of one byte per cell, for every second step: the falling half of a
  // period uses the same sets as the rising half.
  require_memory(grid, 0.5 * options.steps * static_cast<double>(grid.points()),
                 "the contact sets of its steps (fewer `steps` need less)");
  StuckBody stuck(contact_sets, grid, body, trajectory, options, range);
  // If the cycle starts at the minimum indentation, every cell that is not in contact there has
  // been released and has entered again after one period, so the first period already repeats.
  const bool from_minimum =
      trajectory.indentation(0) <= range.indentation_min + 1e-9 * range.sweep();
  CycleResult result = detail::run_cycle(stuck, grid, trajectory, options, from_minimum);
  result.step_error = result.termination == Termination::interrupted
                          ? 0
                          : step_error_of(result, trajectory, grid.cell_area());
  return result;
}

}  // namespace salebra
