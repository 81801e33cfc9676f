// SPDX-License-Identifier: GPL-3.0-or-later
// Mean friction of a contact that slides steadily under a normal oscillation.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/steady_sliding.hpp>
#include <vector>

#include "contact/quadrature.hpp"
#include "sweep_breaks.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

// What a period looks like from the level of the spring foundation: r = v/v_c, φ counted from the least indentation.
class Period {
 public:
  explicit Period(double ratio) : ratio_(ratio), sticks_from_(std::asin(std::min(ratio, 1.0))) {}

  // Levels that touch between these phases stick from the start.
  double sticks_from() const { return sticks_from_; }
  double sticks_to() const { return pi - sticks_from_; }

  // The phase at which a level that sticks from `start` on begins to slip: −cosφ − rφ is there what it was.
  double slips_at(double start) const {
    const auto lead = [&](double phase) {
      return 2 * std::sin(0.5 * (phase + start)) * std::sin(0.5 * (phase - start)) -
             ratio_ * (phase - start);
    };
    double low = sticks_to(), high = 2 * pi - start;
    if (!(lead(low) > 0)) return low;
    // Newton's method from a point on the falling branch, held between bounds.
    double phase = high - (high - start) * std::min(ratio_, 0.5);
    for (int iteration = 0; iteration < 100; ++iteration) {
      if (!(phase > low && phase < high)) phase = 0.5 * (low + high);
      const double value = lead(phase);
      (value > 0 ? low : high) = phase;
      const double step = value / (std::sin(phase) - ratio_);
      phase -= step;
      if (!(std::abs(step) > 1e-15 * phase) || !(high - low > 1e-15 * high)) break;
    }
    return std::clamp(phase, low, high);
  }

  // Mean over the period of (m − δ_min)/u_z, where levels that never open have the stretch (μK/K_t)(m − ζ).
  double mean_rise() const {
    if (ratio_ >= 1) return 1;
    const double end = slips_at(sticks_from_), stuck = end - sticks_from_;
    const double slides = 2 * pi - stuck - (std::sin(sticks_from_) - std::sin(end));
    const double sticks =
        2 * std::pow(std::sin(0.5 * sticks_from_), 2) * stuck + 0.5 * ratio_ * stuck * stuck;
    return (slides + sticks) / (2 * pi);
  }

 private:
  double ratio_, sticks_from_;
};

}  // namespace

SteadySliding steady_sliding(const ContactLaw& law, const Position& position, const Drag& motion,
                             double friction_coefficient, const DampingOptions& options) {
  require(std::isfinite(friction_coefficient) && friction_coefficient >= 0, "friction_coefficient",
          friction_coefficient, "must be finite and >= 0");
  require_positive(motion.drag_velocity, "drag_velocity");
  DampingOptions exact = options;
  exact.amplitude = Amplitude::finite;
  const DampingResult stuck = relaxation_damping(law, position, motion, exact);

  const double amplitude = motion.normal_amplitude, omega = motion.angular_frequency;
  const double velocity = motion.drag_velocity;
  const double low = stuck.indentation - amplitude, high = stuck.indentation + amplitude;
  // A cycle may have its middle where nothing touches.
  const double stiffness_ratio =
      stuck.normal_stiffness > 0
          ? law.tangential_stiffness(stuck.indentation) / stuck.normal_stiffness
          : law.modulus_ratio();

  SteadySliding result;
  result.indentation = stuck.indentation;
  result.mean_force = stuck.mean_force;
  result.relaxation_damping = stuck.damping_constant;
  result.critical_velocity = friction_coefficient / stiffness_ratio * amplitude * omega;
  const double least_friction = friction_coefficient * law.force(low);
  result.static_friction_coefficient = least_friction / result.mean_force;
  if (amplitude > 0)
    result.low_speed_damping =
        result.relaxation_damping + pi * law.tangential_stiffness(low) / omega;

  if (velocity >= result.critical_velocity) {
    result.mean_tangential_force = friction_coefficient * result.mean_force;
    result.error_estimate = 1e-12 * result.mean_tangential_force;
    result.converged = true;
  } else {
    const Period period(velocity / result.critical_velocity);
    std::vector<double> breaks{period.sticks_from(), period.sticks_to()};
    // By half angles: arccos loses half the digits at both ends.
    for (const double point : detail::sweep_breaks(law, low, high))
      breaks.push_back(2 * std::atan2(std::sqrt(std::max(point - low, 0.0)),
                                      std::sqrt(std::max(high - point, 0.0))));
    std::ranges::sort(breaks);
    const auto share = [&](double phase) {
      const double level = low + 2 * amplitude * std::pow(std::sin(0.5 * phase), 2);
      const bool sticks = phase > period.sticks_from() && phase < period.sticks_to();
      const double limit =
          friction_coefficient * amplitude * law.normal_stiffness(level) * std::sin(phase);
      if (!sticks) return limit * 2 * (pi - phase);
      const double end = period.slips_at(phase);
      return limit * (2 * pi - phase - end) +
             velocity / omega * law.tangential_stiffness(level) * (end - phase);
    };
    const detail::Integral integral = detail::integrate(share, breaks, options.tolerance);
    result.mean_tangential_force = least_friction + integral.value / (2 * pi);
    result.error_estimate = integral.error / (2 * pi);
    result.converged = integral.converged && stuck.converged;
  }
  const double travel = 2 * pi * velocity / omega;
  const double rise =
      amplitude > 0 ? amplitude * Period(velocity / result.critical_velocity).mean_rise() : 0;
  result.slip_work =
      travel * (least_friction + friction_coefficient * law.normal_stiffness(low) * rise);
  result.relaxation_work = travel * result.mean_tangential_force - result.slip_work;
  result.friction_coefficient = result.mean_tangential_force / result.mean_force;
  return result;
}

}  // namespace salebra
