// SPDX-License-Identifier: GPL-3.0-or-later
// The simulated cycles with Coulomb friction: one without and one with coupling of pressures and
// tangential tractions (damping/cycle.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <salebra/contact/tangential/coupled_contact.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "base/memory.hpp"
#include "cycle_engine.hpp"

namespace salebra {
namespace {

// The contact pressures at each step of a period. Indentations that occur twice, as in the rising
// and the falling half of an oscillation, share one field.
class StepPressures {
 public:
  StepPressures(const PressureFields& contact_sets, const Grid2D& grid,
                const Trajectory& trajectory, int steps, double resolution) {
    // One field for every second step, because the falling half reuses the fields of the rising
    // half.
    require_memory(grid, 0.5 * sizeof(double) * steps * static_cast<double>(grid.points()),
                   "the pressures of its steps (fewer `steps` need less)");
    for (int k = 0; k <= steps; ++k) {
      const double indentation = trajectory.indentation(static_cast<double>(k) / steps);
      auto next = stored_.lower_bound(indentation - resolution);
      if (next == stored_.end() || next->first > indentation + resolution) {
        next = stored_.emplace(indentation, contact_sets(indentation)).first;
        if (!next->second.converged) termination_ = Termination::iteration_limit;
      }
      steps_.push_back(&next->second);
    }
  }
  const PressureAt& at(int step) const { return *steps_[static_cast<std::size_t>(step)]; }
  Termination termination() const { return termination_; }

 private:
  std::map<double, PressureAt> stored_;
  std::vector<const PressureAt*> steps_;
  Termination termination_ = Termination::converged;
};

// Common part of the simulations with friction: a contact that slips, driven along a straight line.
class SlidingBody : public detail::CycleBody {
 public:
  SlidingBody(const Trajectory& trajectory, const CycleOptions& options)
      : trajectory_(trajectory),
        steps_(options.steps),
        along_x_(std::cos(options.direction)),
        along_y_(options.stick.hold_lateral ? std::sin(options.direction) : 0.0) {}

  double advance(int step, double from) override {
    const double distance = trajectory_.tangential(time(step)) - from;
    move(step, along(distance));
    return from + distance;
  }

 protected:
  virtual void move(int step, const TangentialMove& by) = 0;
  TangentialMove along(double distance) const { return {distance * along_x_, distance * along_y_}; }
  double component(const TangentialMove& force) const {
    return along_x_ * force.x + along_y_ * force.y;
  }
  double time(int step) const { return static_cast<double>(step) / steps_; }
  double indentation(int step) const { return trajectory_.indentation(time(step)); }
  /// Tangential distance of one period.
  TangentialMove drift() const {
    return along(trajectory_.tangential(1) - trajectory_.tangential(0));
  }
  int steps() const { return steps_; }
  detail::CycleReading reading_of(const SlidingContact& contact) const {
    return {.contact = contact.contact_pressure() > 0,
            .tangential_force = component(contact.tangential_force()),
            .work = contact.work(),
            .loss = &contact.loss(),
            .slipping = contact.slipping(),
            .iterations = contact.iterations(),
            .fft_count = contact.fft_count()};
  }

 private:
  const Trajectory& trajectory_;
  int steps_;
  double along_x_, along_y_;
};

class FrictionalBody : public SlidingBody {
 public:
  FrictionalBody(const PressureFields& contact_sets, const Grid2D& grid, const Body& body,
                 const Trajectory& trajectory, const CycleOptions& options,
                 const detail::TrajectoryRange& range)
      : SlidingBody(trajectory, options),
        pressures_(contact_sets, grid, trajectory, options.steps, 1e-9 * range.sweep()),
        // motion_scale must be positive; without tangential motion its value has no effect.
        contact_(grid, body,
                 {.friction_coefficient = options.friction_coefficient,
                  .motion_scale = range.tangential() > 0 ? range.tangential() : 1.0,
                  .stick = options.stick}) {
    ContactSet largest = ContactSet::Constant(grid.nx, grid.ny, false);
    for (int k = 0; k <= options.steps; ++k) {
      const Field& pressure = pressures_.at(k).contact_pressure;
      require(pressure.rows() == grid.nx && pressure.cols() == grid.ny, "contact_sets",
              pressure.size(), "pressures do not match the grid");
      largest = largest || (pressure > 0);
    }
    contact_.reserve(largest);
    if (const SlidingState* state = detail::resumed<SlidingState>(options, grid))
      contact_.restore(*state);
    else if (std::isfinite(options.friction_coefficient) &&
             std::hypot(drift().x, drift().y) > 1e-9 * range.tangential())
      contact_.slide(pressures_.at(0).contact_pressure, drift());
    else
      contact_.advance(pressures_.at(0).contact_pressure);
  }

  detail::CycleReading reading() const override {
    detail::CycleReading now = reading_of(contact_);
    now.normal_force = normal_force_;
    return now;
  }
  double stored_energy() const override { return contact_.stored_energy(); }
  Termination termination() const override {
    return std::max(contact_.termination(), pressures_.termination());
  }
  decltype(CycleState::body) state() const override { return contact_.state(); }

 protected:
  const PressureAt& pressure_at(int step) const { return pressures_.at(step); }
  SlidingContact& contact() { return contact_; }
  void at_step(int step) { normal_force_ = pressure_at(step).force; }

 private:
  void move(int step, const TangentialMove& by) override {
    contact_.advance(pressure_at(step).contact_pressure, by);
    at_step(step);
  }

  StepPressures pressures_;
  SlidingContact contact_;
  double normal_force_ = 0;
};

// A body whose tangential force is given at each step; its displacement is computed.
class ForcedBody final : public FrictionalBody {
 public:
  ForcedBody(const PressureFields& contact_sets, const Grid2D& grid, const Body& body,
             const Trajectory& at_rest, const std::function<double(double t)>& force,
             const CycleOptions& options, const detail::TrajectoryRange& range)
      : FrictionalBody(contact_sets, grid, body, at_rest, options, range) {
    double greatest = 0;
    for (int k = 0; k <= options.steps; ++k) {
      forces_.push_back(force(time(k)));
      const double limit =
          options.friction_coefficient * grid.cell_area() * pressure_at(k).contact_pressure.sum();
      std::ostringstream constraint;
      constraint << "N must be below " << limit << " N, at which the contact slides";
      require(std::abs(forces_.back()) < limit, "tangential_force", forces_.back(),
              constraint.str());
      greatest = std::max(greatest, std::abs(forces_.back()));
    }
    require_positive(greatest, "tangential_force");
    const StickStiffness stiffness = stick_stiffness(pressure_at(0).contact_pressure > 0, grid,
                                                     body, options.stick, /*along_x_only=*/true);
    termination_ = stiffness.termination;
    stiffness_ = stiffness.xx;
    tolerance_ = 1e-7 * greatest;
    contact().set_motion_scale(greatest / stiffness_);
  }

  // Finds the displacement at which the tangential force has the given value, by secant steps
  // within a bracket; the force grows with the displacement. The first step uses the stiffness in
  // full stick.
  double advance(int step, double from) override {
    const Field& pressure = pressure_at(step).contact_pressure;
    double low = -std::numeric_limits<double>::infinity(), high = -low;
    double distance = 0, slope = stiffness_, last_distance = 0, last_excess = 0;
    std::optional<SlidingContact::Increment> increment;
    for (int search = 0;; ++search) {
      increment =
          contact().attempt(pressure, along(distance), nullptr, increment ? &*increment : nullptr);
      const double excess =
          component(contact().tangential_force(*increment)) - forces_[std::size_t(step)];
      const bool met = std::abs(excess) <= tolerance_;
      if (met || search == 60 || increment->report.termination == Termination::interrupted) {
        if (!met) termination_ = std::max(termination_, Termination::iteration_limit);
        break;
      }
      (excess < 0 ? low : high) = distance;
      if (search > 0) {
        const double secant = (excess - last_excess) / (distance - last_distance);
        if (secant > 0) slope = secant;
      }
      last_distance = distance, last_excess = excess;
      distance -= excess / slope;
      if (!(low < distance && distance < high)) distance = (low + high) / 2;
    }
    contact().accept(std::move(*increment));
    at_step(step);
    return from + distance;
  }

  Termination termination() const override {
    return std::max(FrictionalBody::termination(), termination_);
  }

 private:
  std::vector<double> forces_;
  double stiffness_ = 0, tolerance_ = 0;
  Termination termination_ = Termination::converged;
};

class CoupledBody final : public SlidingBody {
 public:
  CoupledBody(const Surface& surface, const Material& material, const Trajectory& trajectory,
              const CycleOptions& options, const NormalContactOptions& contact, double coupling,
              double motion_scale)
      : SlidingBody(trajectory, options),
        contact_(surface, material,
                 {.sliding = {.friction_coefficient = options.friction_coefficient,
                              .motion_scale = motion_scale,
                              .stick = options.stick},
                  .contact = contact,
                  .coupling_constant = coupling}) {
    if (const CoupledState* state = detail::resumed<CoupledState>(options, surface.grid)) {
      contact_.restore(*state);
      return;
    }
    // Which cells stick depends on how the contact is loaded. It is loaded from first touch in
    // increments that grow with the step, so that rings of about equal width enter.
    const int approach = std::max(steps() / 4, 4);
    for (int k = 1; k <= approach; ++k) {
      const double part = static_cast<double>(k) / approach;
      contact_.advance(part * part * indentation(0));
    }
  }

  detail::CycleReading reading() const override {
    detail::CycleReading now = reading_of(contact_.sliding());
    now.normal_force = contact_.normal_force();
    now.normal_work = contact_.normal_work();
    now.gap_work = contact_.gap_work();
    return now;
  }
  double stored_energy() const override { return contact_.stored_energy(); }
  Termination termination() const override { return contact_.termination(); }
  decltype(CycleState::body) state() const override { return contact_.state(); }

 private:
  void move(int step, const TangentialMove& by) override {
    contact_.advance(indentation(step), by);
  }

  CoupledContact contact_;
};

}  // namespace

PressureFields boundary_element_pressures(Surface surface, const Body& body,
                                          const NormalContactOptions& options) {
  surface.require_whole("an oscillating contact");
  return [surface = std::move(surface), body, options](double indentation) {
    if (indentation <= 0)
      return PressureAt{.contact_pressure = Field::Zero(surface.grid.nx, surface.grid.ny)};
    NormalContactState state = press(surface, body, at_indentation(indentation), options);
    return PressureAt{std::move(state.contact_pressure), state.force, state.converged()};
  };
}

PressureFields boundary_element_pressures(Surface surface, double contact_modulus,
                                          const NormalContactOptions& options) {
  return boundary_element_pressures(std::move(surface),
                                    Material::of_contact_modulus(contact_modulus), options);
}

CycleResult simulate_frictional_cycle(const PressureFields& contact_sets, const Grid2D& grid,
                                      const Body& body, const Trajectory& trajectory,
                                      const CycleOptions& options) {
  grid.validate();
  if (trajectory.tangential_force && !trajectory.tangential) {
    require_positive(options.friction_coefficient, "friction_coefficient");
    const Trajectory at_rest{trajectory.indentation, [](double) { return 0.0; }};
    const detail::TrajectoryRange range = detail::checked_range(at_rest, options);
    ForcedBody cycle(contact_sets, grid, body, at_rest, trajectory.tangential_force, options,
                     range);
    return detail::run_cycle(cycle, grid, at_rest, options);
  }
  const detail::TrajectoryRange range = detail::checked_range(trajectory, options);
  FrictionalBody cycle(contact_sets, grid, body, trajectory, options, range);
  return detail::run_cycle(cycle, grid, trajectory, options);
}

CycleResult simulate_coupled_cycle(const Surface& surface, const Material& material,
                                   const Trajectory& trajectory, const CycleOptions& options,
                                   const NormalContactOptions& contact) {
  surface.require_whole("an oscillating contact");
  const detail::TrajectoryRange range = detail::checked_range(trajectory, options);
  require(range.indentation_min >= 0, "indentation", range.indentation_min,
          "must be >= 0 throughout a coupled cycle");
  const double coupling =
      options.coupling_constant ? *options.coupling_constant : coupling_constant(material);
  // The pressures displace the surface tangentially by about Dundurs' β times the sweep of the
  // indentation, even without tangential motion.
  const double scale =
      std::max(range.tangential(),
               std::abs(dundurs_constant(material.contact_modulus, coupling)) * range.sweep());
  CoupledBody body(surface, material, trajectory, options, contact, coupling,
                   scale > 0 ? scale : 1.0);
  return detail::run_cycle(body, surface.grid, trajectory, options);
}

}  // namespace salebra
