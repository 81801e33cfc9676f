// SPDX-License-Identifier: GPL-3.0-or-later
// Averaged equation of motion of a slider: slip by GSL's Runge–Kutta steps, stick in closed form.
#include "averaged_slider.hpp"

#include <gsl/gsl_errno.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>

#include "base/numerics/quadrature.hpp"
#include "max_motion.hpp"

namespace salebra::detail {

MeanFriction::MeanFriction(const SliderContact& contact, double friction_coefficient) {
  constexpr int pieces = 128;
  const NormalOscillation normal{contact.normal_amplitude, contact.angular_frequency};
  std::vector<double> velocities{1};
  const auto sliding = [&] {
    return steady_sliding_about(contact.law, contact.indentation, normal, velocities,
                                friction_coefficient);
  };
  const SteadySliding any = sliding().front();
  critical_velocity_ = any.critical_velocity;
  values_.push_back(any.static_friction_coefficient * any.mean_force);
  slopes_.push_back(0);
  if (!(critical_velocity_ > 0)) return;
  velocities.clear();
  for (int i = 1; i <= pieces; ++i)
    velocities.push_back(critical_velocity_ * std::pow(static_cast<double>(i) / pieces, 2));
  for (const SteadySliding& one : sliding()) {
    const double root = static_cast<double>(values_.size()) / pieces;
    values_.push_back(one.mean_tangential_force);
    slopes_.push_back(one.sliding_damping * 2 * critical_velocity_ * root);
  }
}

double MeanFriction::at(double velocity) const {
  if (velocity >= critical_velocity_ || values_.size() == 1) return values_.back();
  const auto pieces = static_cast<double>(values_.size() - 1);
  const double position = pieces * std::sqrt(std::max(velocity, 0.0) / critical_velocity_);
  const auto left = std::min(static_cast<std::size_t>(position), values_.size() - 2);
  const double t = position - static_cast<double>(left), u = 1 - t;
  return u * u * (1 + 2 * t) * values_[left] + t * t * (1 + 2 * u) * values_[left + 1] +
         t * u * (u * slopes_[left] - t * slopes_[left + 1]) / pieces;
}

AveragedSlider::AveragedSlider(const SliderContact& contact, const SteadySliding& sliding,
                               double friction_coefficient, const Slider& slider)
    : slider_(slider),
      friction_(contact, friction_coefficient),
      natural_(std::sqrt(slider.spring_stiffness / slider.mass)),
      length_(slider.velocity / natural_),
      force_(sliding.mean_tangential_force),
      system_{&AveragedSlider::derivatives, nullptr, size, this},
      step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size), &gsl_odeiv2_step_free),
      control_(gsl_odeiv2_control_y_new(1e-10, 1e-10), &gsl_odeiv2_control_free),
      evolve_(gsl_odeiv2_evolve_alloc(size), &gsl_odeiv2_evolve_free) {}

// Right-hand side of the averaged equation. Time is in units of 1/natural_, force in units of
// force_.
int AveragedSlider::derivatives(double, const double* state, double* rates, void* self) {
  const auto& it = *static_cast<const AveragedSlider*>(self);
  const Slider& slider = it.slider_;
  const double relative = state[1] * slider.velocity, velocity = relative + slider.velocity;
  const double support =
      -slider.spring_stiffness * state[0] * it.length_ - slider.support_damping * relative;
  const double friction = it.direction_ * it.friction_.at(it.direction_ * velocity);
  const double momentum = slider.mass * slider.velocity * it.natural_;
  const double power = it.force_ * slider.velocity;
  rates[0] = state[1];
  rates[1] = (support + slider.falling_slope * velocity - friction) / momentum;
  rates[2] = friction / it.force_;
  rates[3] = support / it.force_;
  rates[4] = slider.support_damping * relative * relative / power;
  rates[5] = slider.falling_slope * velocity * velocity / power;
  rates[6] = friction * velocity / power;
  return GSL_SUCCESS;
}

double AveragedSlider::load() const {
  return -slider_.spring_stiffness * offset() + slider_.support_damping * slider_.velocity;
}

double AveragedSlider::tangential_force() const {
  const double velocity = relative_velocity() + slider_.velocity;
  return direction_ == 0 ? load() : direction_ * friction_.at(direction_ * velocity);
}

double AveragedSlider::stored_energy() const {
  const double velocity = relative_velocity() + slider_.velocity;
  return 0.5 * slider_.mass * velocity * velocity +
         0.5 * slider_.spring_stiffness * offset() * offset();
}

void AveragedSlider::begin(double offset, double relative_velocity) {
  std::ranges::fill(state_, 0);
  state_[0] = offset / length_, state_[1] = relative_velocity / slider_.velocity;
  direction_ = state_[1] > -1 ? 1 : 0;
  totals_ = {};
  next_step_ = 1e-3;
  gsl_odeiv2_evolve_reset(evolve_.get());
}

double AveragedSlider::stick(double time) {
  // Increase of the spring load in a unit of scaled time.
  const double rate = slider_.spring_stiffness * length_;
  const double left = std::max(friction_.at_rest() - load(), 0.0) / rate;
  const double taken = std::min(left, time), mean = load() + 0.5 * rate * taken;
  state_[0] -= taken;
  state_[2] += mean * taken / force_;
  state_[3] += mean * taken / force_;
  state_[4] += slider_.support_damping * slider_.velocity * taken / force_;
  totals_.stuck += taken / natural_;
  if (taken < time) direction_ = 1;
  return taken;
}

double AveragedSlider::slip(double time) {
  double before[size];
  std::ranges::copy(state_, before);
  double taken = 0;
  if (gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &system_, &taken, time,
                              &next_step_, state_) != GSL_SUCCESS)
    throw NotConverged("slider: a step of the averaged equation failed");
  if (direction_ * (state_[1] + 1) > -1e-9) return taken;
  // The velocity changes sign, so the slider stops within this step.
  double errors[size];
  const auto velocity_after = [&](double part) {
    std::ranges::copy(before, state_);
    gsl_odeiv2_step_reset(step_.get());
    gsl_odeiv2_step_apply(step_.get(), 0, part, state_, errors, nullptr, nullptr, &system_);
    return direction_ * (state_[1] + 1);
  };
  if (direction_ * (before[1] + 1) > 0) {
    taken = find_root(
        [&](double part) { return part > 0 ? velocity_after(part) : direction_ * (before[1] + 1); },
        0, taken);
    velocity_after(taken);
  } else {
    taken = 0;
    std::ranges::copy(before, state_);
  }
  state_[1] = -1;
  direction_ = std::abs(load()) <= friction_.at_rest() ? 0 : (load() > 0 ? 1 : -1);
  next_step_ = 1e-3;
  gsl_odeiv2_evolve_reset(evolve_.get());
  return taken;
}

void AveragedSlider::advance() {
  constexpr double part = 2 * std::numbers::pi / 256;
  // A stiff equation, for example one with a dashpot of many times √(km) (spring stiffness k, mass
  // m), would take endless steps.
  constexpr int max_steps = 100'000;
  double left = part;
  int taken = 0;
  while (left > 1e-12 * part) {
    left -= direction_ == 0 ? stick(left) : slip(left);
    if (++taken > max_steps)
      throw NotConverged(
          "slider: the averaged equation is too stiff, because 1/256 of a slow period takes more "
          "than 100000 steps; use less damping or a less stiff contact");
  }
  const double energy = force_ * length_;
  totals_.time += part / natural_;
  totals_.impulse = state_[2] * force_ / natural_;
  totals_.drive_work = state_[3] * energy;
  totals_.support_loss = state_[4] * energy;
  totals_.falling_gain = state_[5] * energy;
  totals_.contact_loss = state_[6] * energy;
}

}  // namespace salebra::detail
