// SPDX-License-Identifier: GPL-3.0-or-later
// Steps of the full equation of motion of a slider on an oscillating contact.
#include "slider_equation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/numerics/quadrature.hpp"
#include "sweep_breaks.hpp"

namespace salebra::detail {
namespace {

using std::numbers::pi;

TangentialContact contact_of(const SliderContact& at) {
  return {at.law,
          at.min_indentation(),
          at.indentation + at.normal_amplitude,
          {.friction_coefficient = at.friction_coefficient,
           .table_tolerance = 1e-9,
           .tangential_range = std::numeric_limits<double>::infinity()}};
}

// Natural angular frequency of the slider on its spring and the contact at its largest indentation,
// rad/s; at least the natural frequency on the spring alone.
double fastest_of(const SliderContact& contact, const Slider& slider) {
  const double highest = contact.indentation + contact.normal_amplitude;
  return std::sqrt((slider.spring_stiffness + contact.law.tangential_stiffness(highest)) /
                   slider.mass);
}

}  // namespace

double SliderEquation::period_of(const SliderContact& contact, const Slider& slider) {
  return 2 * pi /
         (contact.normal_amplitude > 0 ? contact.angular_frequency : fastest_of(contact, slider));
}

double SliderEquation::steps_of_period(const SliderContact& contact, const Slider& slider,
                                       int steps) {
  const double resonances = period_of(contact, slider) * fastest_of(contact, slider) / (2 * pi);
  // Without an oscillation `resonances` is 1 to round-off.
  return steps * std::ceil(std::max(1.0, resonances * (1 - 1e-12)));
}

SliderEquation::SliderEquation(const SliderContact& contact, const Slider& slider, int steps)
    : at_(contact),
      slider_(slider),
      contact_(contact_of(contact)),
      slope_limit_(contact.friction_coefficient /
                   contact.law.stiffness_ratio(contact.indentation)) {
  const double highest = contact.indentation + contact.normal_amplitude;
  const bool oscillates = contact.normal_amplitude > 0;
  span_ = std::max(contact.normal_amplitude,
                   contact.law.force(highest) / contact.law.normal_stiffness(highest));
  period_ = period_of(contact, slider);
  const int count = static_cast<int>(steps_of_period(contact, slider, steps));
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(period_ * i / count);
  if (oscillates) {
    const double low = contact.min_indentation();
    for (const double spring_depth : sweep_breaks(contact.law, low, highest)) {
      if (!(spring_depth > low && spring_depth < highest) || contact.law.force(spring_depth) > 0)
        continue;
      const double phase =
          2 * std::atan2(std::sqrt(spring_depth - low), std::sqrt(highest - spring_depth));
      const double time = phase / contact.angular_frequency;
      times.push_back(time);
      times.push_back(period_ - time);
    }
    std::ranges::sort(times);
  }
  for (const double time : times) nodes_.push_back(instant_at(time));
  contact_.slide(contact.min_indentation(), 0, 1);
  slid_force_ = contact_.tangential_force();
}

SliderEquation::Instant SliderEquation::instant_at(double time) const {
  if (!(at_.normal_amplitude > 0)) return {time, at_.indentation, 0};
  const double half = pi * time / period_, sine = std::sin(half);
  return {time, at_.min_indentation() + 2 * at_.normal_amplitude * sine * sine,
          2 * at_.normal_amplitude * at_.angular_frequency * sine * std::cos(half)};
}

double SliderEquation::position_at(double time_in_period) const {
  return slider_.velocity * (time() + time_in_period) + offset_;
}

void SliderEquation::begin(double offset, double relative_velocity) {
  offset_ = offset, relative_velocity_ = relative_velocity;
  periods_ = 0;
  totals_ = {};
  contact_.slide(at_.min_indentation(), offset, 1);
  furthest_ = offset - slope_limit_ * at_.min_indentation();
  force_ = contact_.tangential_force();
}

double SliderEquation::stored_energy() const {
  const double velocity = relative_velocity_ + slider_.velocity;
  return 0.5 * slider_.mass * velocity * velocity +
         0.5 * slider_.spring_stiffness * offset_ * offset_ + contact_.stored_energy();
}

double SliderEquation::acceleration(double force) const {
  return (-slider_.spring_stiffness * offset_ -
          (slider_.support_damping - slider_.falling_slope) * relative_velocity_ +
          slider_.falling_slope * slider_.velocity - force) /
         slider_.mass;
}

void SliderEquation::part(const Instant& from, const Instant& to, double acceleration_now) {
  const double length = to.time - from.time;
  const double damping = slider_.support_damping - slider_.falling_slope;
  const double before = relative_velocity_, offset_before = offset_, force_before = force_;
  offset_ += length * (before + 0.5 * length * acceleration_now);
  const double position = position_at(to.time);
  contact_.move_to(to.indentation, position);
  furthest_ = std::max(furthest_, position - slope_limit_ * to.indentation);
  force_ = contact_.tangential_force();
  // Velocity Verlet: the new velocity occurs on both sides of its equation, in the damping force,
  // and is solved for.
  relative_velocity_ = before + 0.5 * length * acceleration_now;
  const double rest =
      (-slider_.spring_stiffness * offset_ + slider_.falling_slope * slider_.velocity - force_) /
      slider_.mass;
  relative_velocity_ =
      (relative_velocity_ + 0.5 * length * rest) / (1 + 0.5 * length * damping / slider_.mass);

  const double middle = 0.5 * length;
  const auto sum = [&](double a, double b) { return middle * (a + b); };
  const double velocity = slider_.velocity, after = relative_velocity_;
  const auto support = [&](double offset, double relative) {
    return slider_.spring_stiffness * offset + slider_.support_damping * relative;
  };
  totals_.time += length;
  totals_.impulse += sum(force_before, force_);
  totals_.drive_work -= velocity * sum(support(offset_before, before), support(offset_, after));
  totals_.support_loss += slider_.support_damping * sum(before * before, after * after);
  totals_.falling_gain +=
      slider_.falling_slope * sum(std::pow(before + velocity, 2), std::pow(after + velocity, 2));
  totals_.contact_loss = contact_.dissipated();
  min_velocity_ = std::min(min_velocity_, after + velocity);
  if (!(at_.normal_amplitude > 0) && std::abs(force_) < (1 - 1e-6) * slid_force_)
    totals_.stuck += length;
}

SliderEquation::Instant SliderEquation::next_event(const Instant& from, const Instant& to,
                                                   double acceleration_now) const {
  const double length = to.time - from.time;
  const double velocity = relative_velocity_ + slider_.velocity;
  // Events closer than this to the beginning or the end of the step count as that instant.
  const double least = 1e-4 * length;
  double first = length;
  const auto locate = [&](const auto& distance, double at_start, double at_end) {
    if ((at_start > 0) == (at_end > 0)) return;
    const double at = find_root(
        [&](double time) {
          if (time == 0) return at_start;
          return time == length ? at_end : distance(time, instant_at(from.time + time));
        },
        0, length);
    if (at > least && at < length - least) first = std::min(first, at);
  };
  const double end_velocity = velocity + acceleration_now * length;
  for (const double limit : {-slope_limit_, 0.0, slope_limit_})
    locate(
        [&](double time, const Instant& there) {
          return velocity + acceleration_now * time - limit * there.speed;
        },
        velocity - limit * from.speed, end_velocity - limit * to.speed);
  const double position = position_at(from.time) - furthest_;
  const auto ahead = [&](double time, const Instant& there) {
    return position + time * (velocity + 0.5 * acceleration_now * time) -
           slope_limit_ * there.indentation;
  };
  const double behind = ahead(0, from);
  if (behind < -1e-9 * slope_limit_ * span_) locate(ahead, behind, ahead(length, to));
  return first < length ? instant_at(from.time + first) : to;
}

void SliderEquation::step(Instant from, const Instant& to) {
  while (from.time < to.time) {
    const double now = acceleration(force_);
    const Instant next = next_event(from, to, now);
    part(from, next, now);
    from = next;
  }
}

void SliderEquation::advance() {
  min_velocity_ = relative_velocity_ + slider_.velocity;
  for (std::size_t i = 1; i < nodes_.size(); ++i) step(nodes_[i - 1], nodes_[i]);
  ++periods_;
  if (at_.normal_amplitude > 0 && std::abs(force_) < (1 - 1e-6) * slid_force_)
    totals_.stuck += period_;
}

}  // namespace salebra::detail
