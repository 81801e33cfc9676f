// SPDX-License-Identifier: GPL-3.0-or-later
// Equations (6) to (16) of the paper and the closed forms beyond them, stable at any argument.
#include <fmt/format.h>
#include <gsl/gsl_sf_bessel.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/closed_form.hpp>

#include "base/numerics/quadrature.hpp"
#include "base/quiet_gsl.hpp"
#include "max_motion.hpp"
#include "phase_quadrature.hpp"

namespace salebra::closed_form {
namespace {

using std::numbers::pi;

double square(double value) { return value * value; }

// Power series of the integral J(k) in the loss of an exponential contact under a slow drag, with k
// = u_z/l and the decay length l: J(k) = Σ c_m k^m/m!, c_m = ∫_0^π θ² sinθ cos^mθ dθ = ((−1)^m π² +
// 2T_{m+1})/(m+1), T_n = ∫_0^π θ cosⁿθ dθ.
double drag_integral_series(double k) {
  double even = pi * pi / 2, odd = -2;  // T_0, T_1
  double sum = 0, power = 1;
  for (int m = 0; m < 30; ++m) {
    const double moment = m % 2 == 0 ? odd : even;
    sum += power * ((m % 2 == 0 ? 1 : -1) * pi * pi + 2 * moment) / (m + 1);
    power *= k / (m + 1);
    const int n = m + 2;
    if (n % 2 == 0)
      even *= (n - 1.0) / n;
    else
      odd = (n - 1.0) / n * odd - 2.0 / square(n);
  }
  return sum;
}

double drag_integral_bessel_scaled(double k) {
  constexpr int highest_order = 61;  // I_61(20)/I_0(20) < 1e-17
  std::array<double, highest_order + 1> bessel{};
  // Turns off GSL's error handler, because Bessel functions of high order underflow.
  detail::quiet_gsl();
  gsl_sf_bessel_In_scaled_array(0, highest_order, k, bessel.data());
  double sum = 0;
  for (int n = highest_order; n > 0; n -= 2) sum += bessel[static_cast<std::size_t>(n)] / square(n);
  return pi * pi / k * (bessel[0] - std::exp(-2 * k)) - 8 / k * sum;
}

// Asymptotic series of the same integral J(k) for large k. With t = 1 − cosθ, θ² = 2 Σ (2t)ⁿ/(n²
// C(2n, n)) (binomial coefficient C) is integrated against e^{−kt} over all t > 0. The terms shrink
// until n ≈ 2k, so the truncation error is of order e^{−2k}. The error of integrating beyond t = 2
// (θ = π) is of the same order.
double drag_integral_asymptotic_scaled(double k) {
  double term = 2 / square(k), sum = 0;
  for (int n = 1; n < 40; ++n) {
    sum += term;
    // The term is 2ⁿ⁺¹ n!/(n² C(2n, n) kⁿ⁺¹); this is the factor from n to n + 1.
    term *= square(n) / ((2 * n + 1.0) * k);
    if (term < 1e-17 * sum) break;
  }
  return sum;
}

double exponential_ratio_scaled(const Oscillation& motion, double k) {
  return std::holds_alternative<EqualFrequency>(motion) ? equal_frequency_ratio_scaled(k)
                                                        : drag_integral_scaled(k) / (pi * pi - 4);
}

double work_at(double modulus_ratio, double force_curvature, const Oscillation& motion) {
  return std::visit(
      [&](const auto& m) { return work_per_cycle(modulus_ratio, force_curvature, m); }, motion);
}

}  // namespace

double edge_slope(double contact_modulus, double force_curvature) {
  return 2 * contact_modulus / force_curvature;
}

bool intermittent_contact(double spring_depth, double amplitude) {
  return std::abs(spring_depth) < std::abs(amplitude);
}

double released_distance(double spring_depth, const EqualFrequency& motion) {
  if (!intermittent_contact(spring_depth, motion.normal_amplitude)) return 0;
  return 2 * motion.tangential_amplitude *
         std::sqrt(1 - square(spring_depth / motion.normal_amplitude)) * std::sin(motion.phase);
}

double released_distance(double spring_depth, const Drag& motion) {
  if (!intermittent_contact(spring_depth, motion.normal_amplitude)) return 0;
  return 2 * motion.drag_velocity / motion.angular_frequency *
         std::acos(spring_depth / std::abs(motion.normal_amplitude));
}

double spring_energy(double tangential_modulus, double distance, double spring_width) {
  return 0.5 * tangential_modulus * square(distance) * spring_width;
}

double work_per_cycle(double tangential_modulus, double slope, double amplitude,
                      const std::function<double(double)>& distance) {
  const double half_width = std::abs(amplitude);
  const std::array<double, 2> interval{-half_width, half_width};
  return tangential_modulus / slope *
         detail::integrate([&](double spring_depth) { return square(distance(spring_depth)); },
                           interval, 1e-13)
             .value;
}

double work_per_cycle_by_slope(double tangential_modulus, double slope,
                               const EqualFrequency& motion) {
  return 16.0 / 3 * tangential_modulus / slope * square(motion.tangential_amplitude) *
         std::abs(motion.normal_amplitude) * square(std::sin(motion.phase));
}

double work_per_cycle_by_slope(double tangential_modulus, double slope, const Drag& motion) {
  return 4 * (pi * pi - 4) * tangential_modulus / slope * std::abs(motion.normal_amplitude) *
         square(motion.drag_velocity / motion.angular_frequency);
}

double work_per_cycle(double modulus_ratio, double force_curvature, const EqualFrequency& motion) {
  return 8.0 / 3 * modulus_ratio * force_curvature * square(motion.tangential_amplitude) *
         std::abs(motion.normal_amplitude) * square(std::sin(motion.phase));
}

double work_per_cycle(double modulus_ratio, double force_curvature, const Drag& motion) {
  return 2 * (pi * pi - 4) * modulus_ratio * force_curvature * std::abs(motion.normal_amplitude) *
         square(motion.drag_velocity / motion.angular_frequency);
}

double work_per_cycle_rough(double modulus_ratio, double force, double decay_length,
                            const Drag& motion) {
  return work_per_cycle(modulus_ratio, force / square(decay_length), motion);
}

double power(double work, const Oscillation& motion) {
  const double frequency = std::visit([](const auto& m) { return m.angular_frequency; }, motion);
  return frequency > 0 ? work * frequency / (2 * pi) : std::numeric_limits<double>::quiet_NaN();
}

double damping_constant(double work, const Oscillation& motion) {
  double mean_square_velocity = 0;
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    mean_square_velocity = square(drag->drag_velocity);
  } else {
    const auto& equal = std::get<EqualFrequency>(motion);
    mean_square_velocity = square(equal.tangential_amplitude * equal.angular_frequency) / 2;
  }
  return mean_square_velocity > 0 ? power(work, motion) / mean_square_velocity
                                  : std::numeric_limits<double>::quiet_NaN();
}

double work_per_cycle_exponential(double modulus_ratio, double reference_force, double decay_length,
                                  const Oscillation& motion) {
  const double amplitude = std::abs(detail::normal_amplitude(motion)), k = amplitude / decay_length;
  require(
      !(amplitude > detail::possible_amplitude(decay_length)), "normal_amplitude", amplitude,
      fmt::format("m raises the force above {:g} times the force at rest; an exponential law "
                  "allows at most {}; reduce the amplitude or hold the mean force",
                  detail::max_force_ratio,
                  format_quantity(detail::possible_amplitude(decay_length), Dimension::length, 3)));
  const double peak_curvature = reference_force * std::exp(k) / square(decay_length);
  return work_at(modulus_ratio, peak_curvature, motion) * exponential_ratio_scaled(motion, k);
}

double work_per_cycle_exponential_held_force(double modulus_ratio, double mean_force,
                                             double decay_length, const Oscillation& motion) {
  const double k = std::abs(detail::normal_amplitude(motion)) / decay_length;
  const double ratio = exponential_ratio_scaled(motion, k) / mean_force_ratio_scaled(k);
  return work_at(modulus_ratio, mean_force / square(decay_length), motion) * ratio;
}

double indentation_shift_at_held_force(double amplitude, double decay_length) {
  const double k = std::abs(amplitude) / decay_length;
  if (k >= 1) return -decay_length * (k + std::log(mean_force_ratio_scaled(k)));
  // Computes I_0(k) − 1 (modified Bessel function) by its series: the difference would lose the
  // digits of k² against 1.
  double term = 1, excess = 0;
  for (int n = 1; n < 14; ++n) excess += term *= square(k / 2 / n);
  return -decay_length * std::log1p(excess);
}

double work_per_cycle_force_controlled(double modulus_ratio, double force_amplitude,
                                       double decay_length, const Oscillation& motion) {
  Oscillation unit = motion;
  std::visit([](auto& m) { m.normal_amplitude = 1; }, unit);
  return work_at(modulus_ratio, force_amplitude / decay_length, unit);
}

double equal_frequency_ratio_scaled(double k) {
  if (k >= 1) return 1.5 * ((k - 1) + (k + 1) * std::exp(-2 * k)) / (k * k * k);
  // Uses the series 3 Σ 2n k^{2n−2}/(2n+1)! for small k, since the terms of the closed form cancel
  // to third order in k.
  double factor = 1.0 / 6, sum = 0;  // k^{2n−2}/(2n+1)!
  for (int n = 1; n < 12; ++n) {
    sum += 2 * n * factor;
    factor *= k * k / ((2 * n + 2.0) * (2 * n + 3.0));
  }
  return 3 * sum * std::exp(-k);
}

double drag_integral_scaled(double k) {
  if (k < 1) return drag_integral_series(k) * std::exp(-k);
  return k < 20 ? drag_integral_bessel_scaled(k) : drag_integral_asymptotic_scaled(k);
}

double mean_force_ratio_scaled(double k) {
  detail::quiet_gsl();
  return gsl_sf_bessel_I0_scaled(k);
}

double frequency_ratio_integral(double ratio) {
  // I = (sin²πr − 4r²)/(1 − 4r²) with the frequency ratio r. Near r = 1/2 both numerator and
  // denominator vanish, so a form without this cancellation is used.
  if (ratio < 0.25)
    return (square(std::sin(pi * ratio)) - square(2 * ratio)) / (1 - square(2 * ratio));
  const double offset = ratio - 0.5;
  const double sinc = std::abs(offset) < 1e-8 ? pi : std::sin(pi * offset) / offset;
  return 1 + sinc * sinc * offset / (4 * (1 + offset));
}

double frequency_ratio_phase_sum(int normal_cycles, double phase) {
  return normal_cycles <= 2 ? normal_cycles * square(std::sin(phase)) : 0.5 * normal_cycles;
}

}  // namespace salebra::closed_form
