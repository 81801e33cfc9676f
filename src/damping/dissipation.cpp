// SPDX-License-Identifier: GPL-3.0-or-later
// The theorem W = ½∮s² dK_t for any contact law, at a held mean indentation or a held mean force
// (s: stretch of a spring where it separates).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <sstream>

#include "base/numerics/quadrature.hpp"
#include "base/special_values.hpp"
#include "continued_law.hpp"
#include "max_motion.hpp"
#include "sweep_breaks.hpp"
#include "table_error.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
using detail::unknown;

double square(double value) { return value * value; }

void require_finite(double value, const char* field) {
  require(std::isfinite(value), field, value, "must be a finite number");
}

void require_amplitude(double amplitude) {
  require(std::isfinite(amplitude) && amplitude >= 0, "normal_amplitude", amplitude,
          "must be finite and >= 0; a negative one is a phase shift of pi");
}

// A tangential motion under δ = δ0 + u_z cosθ, or under any other even function δ(θ) that falls
// from θ = 0 to π. Its loss is
//     W = square_velocity · scale · ∫_0^π weight(θ) [K_t(δ(θ)) − K_t(reference)] dθ.
struct Kernel {
  double normal_amplitude = 0;
  // u_x² or v²; W without this factor gives γ, also for u_x = 0 or v = 0.
  double square_velocity = 0;
  double scale = 0;
  std::function<double(double)> weight;
  double absolute_weight = 0;  // ∫|weight| dθ, to bound the round-off error
  // K_t(reference) is K_t(δ(π)); false: K_t(δ(π/2)), allowed where ∫ weight dθ = 0.
  bool reference_is_bottom = true;
  // W = (G*/E*)F'' u_z · small_amplitude · square_velocity in the limit u_z → 0.
  double small_amplitude = 0;
  double rate = unknown;  // periods per second
  // Time average of the squared tangential velocity for square_velocity = 1.
  double mean_square_velocity = 1;
  // False: the motion has no period, and W is the mean per normal cycle.
  bool periodic = true;
};

Kernel kernel_of(const EqualFrequency& motion) {
  require_amplitude(motion.normal_amplitude);
  require_finite(motion.tangential_amplitude, "tangential_amplitude");
  require_finite(motion.phase, "phase");
  require(std::isfinite(motion.angular_frequency) && motion.angular_frequency >= 0,
          "angular_frequency", motion.angular_frequency,
          "must be finite and > 0, or 0 where it is not known");
  const double sine_square = square(std::sin(motion.phase));
  Kernel kernel{.normal_amplitude = motion.normal_amplitude,
                .square_velocity = square(motion.tangential_amplitude),
                .scale = 2 * sine_square,
                .weight = [](double angle) { return std::sin(2 * angle); },
                .absolute_weight = 2,
                .reference_is_bottom = false,
                .small_amplitude = 8.0 / 3 * sine_square};
  if (motion.angular_frequency > 0) kernel.rate = motion.angular_frequency / (2 * pi);
  kernel.mean_square_velocity = square(motion.angular_frequency) / 2;
  return kernel;
}

Kernel kernel_of(const Drag& motion) {
  require_amplitude(motion.normal_amplitude);
  require_finite(motion.drag_velocity, "drag_velocity");
  require_positive(motion.angular_frequency, "angular_frequency");
  const double square_period = 1 / square(motion.angular_frequency);
  return {.normal_amplitude = motion.normal_amplitude,
          .square_velocity = square(motion.drag_velocity),
          .scale = 4 * square_period,
          .weight = [](double angle) { return angle; },
          .absolute_weight = pi * pi / 2,
          .small_amplitude = 2 * (pi * pi - 4) * square_period,
          .rate = motion.angular_frequency / (2 * pi)};
}

Kernel kernel_of(const TwoFrequencies& motion) {
  require_amplitude(motion.normal_amplitude);
  require_finite(motion.tangential_amplitude, "tangential_amplitude");
  require_finite(motion.phase, "phase");
  const CommonPeriod period = common_period(motion);
  const bool periodic = period.normal_cycles > 0;
  const double ratio = motion.tangential_angular_frequency / motion.normal_angular_frequency;
  const int cycles = periodic ? period.normal_cycles : 1;
  const double sum = periodic ? closed_form::frequency_ratio_phase_sum(cycles, motion.phase) : 0.5;
  return {.normal_amplitude = motion.normal_amplitude,
          .square_velocity = square(motion.tangential_amplitude),
          .scale = 2 * sum * ratio,
          .weight = [ratio](double angle) { return std::sin(2 * ratio * angle); },
          .absolute_weight = std::min(pi, pi * pi * ratio),
          .small_amplitude = 2 * sum * closed_form::frequency_ratio_integral(ratio),
          .rate = motion.normal_angular_frequency / (2 * pi * cycles),
          .mean_square_velocity = square(motion.tangential_angular_frequency) / 2,
          .periodic = periodic};
}

Kernel kernel_of(const Oscillation& motion) {
  return std::visit([](const auto& m) { return kernel_of(m); }, motion);
}

void check(const DampingOptions& options) {
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "must lie between 1e-13 and 1e-2");
}

// Throws if a motion up to the indentation `highest` leaves the range of a table. The message names
// the force that the table has to reach. It estimates this force with the exponential continuation
// of the table.
void require_covered(const ContactLaw& law, double highest, double amplitude) {
  const double end = law.highest_indentation();
  const double slack = std::isfinite(end) ? 1e-12 * std::abs(end) : 0;
  if (highest <= end + slack) return;
  if (!std::isfinite(law.lowest_indentation())) {
    std::ostringstream constraint;
    constraint.precision(9);
    constraint << "m presses to the indentation " << highest << " m, but the law ends at " << end
               << " m; reduce the amplitude";
    require(false, "normal_amplitude", amplitude, constraint.str());
  }
  require(
      false, "normal_amplitude", amplitude,
      fmt::format("m presses up to about {}, but the curve ends at {}; extend the curve to this "
                  "load, or reduce the amplitude",
                  format_quantity(detail::ContinuedLaw(law).force(highest), Dimension::force, 3),
                  format_quantity(law.force(end), Dimension::force, 3)));
}

// Throws if the force at the largest indentation overflows, since losses would be NaN or wrong.
void require_representable(const ContactLaw& law, double mean_indentation, double amplitude) {
  const double highest = mean_indentation + amplitude;
  const double limit = std::sqrt(std::numeric_limits<double>::max());
  require(law.force(highest) < limit && law.tangential_stiffness(highest) < limit,
          "normal_amplitude", amplitude,
          "m makes the contact force overflow; reduce the amplitude");
}

// Phases from 0 to π, both included, at which δ = δ0 + u_z cosθ passes a break point of the law.
std::vector<double> break_angles(const ContactLaw& law, double mean_indentation, double amplitude) {
  const double low = mean_indentation - amplitude, high = mean_indentation + amplitude;
  if (!(low < high)) return {0, pi};
  std::vector<double> angles;
  for (const double point : detail::sweep_breaks(law, low, high))
    // Computes half angles by arctan, because arccos loses half the digits near 0 and π.
    angles.push_back(2 * std::atan2(std::sqrt(high - point), std::sqrt(point - low)));
  std::ranges::reverse(angles);
  return angles;
}

// One cycle of the normal motion: K_t as a function of the phase θ, an even function about θ = 0,
// at which δ is largest.
struct NormalCycle {
  std::function<double(double)> stiffness;
  std::vector<double> break_angles;
  double stiffness_at_middle, stiffness_at_bottom, stiffness_at_top;
};

double mean_of_force(const ContactLaw& law, double mean_indentation, double amplitude) {
  require_covered(law, mean_indentation + amplitude, amplitude);
  auto force = [&](double angle) {
    return law.force(mean_indentation + amplitude * std::cos(angle));
  };
  return detail::integrate(force, break_angles(law, mean_indentation, amplitude), 1e-12).value / pi;
}

// Loss W of a tangential motion with square_velocity = 1.
detail::Integral work_factor(const NormalCycle& cycle, const Kernel& kernel, double tolerance) {
  // Subtracting a constant from K_t does not change W, and makes the integrand small where it would
  // cancel.
  const double reference =
      kernel.reference_is_bottom ? cycle.stiffness_at_bottom : cycle.stiffness_at_middle;
  detail::Integral integral = detail::integrate(
      [&](double angle) { return kernel.weight(angle) * (cycle.stiffness(angle) - reference); },
      cycle.break_angles, tolerance);
  // K_t itself is only accurate to a few units in its last place. An estimated integration error
  // below this accuracy counts as converged, even if it exceeds the tolerance.
  const double round_off = 4 * epsilon * cycle.stiffness_at_top * kernel.absolute_weight;
  integral.converged = integral.converged || integral.error <= round_off;
  return {kernel.scale * integral.value, kernel.scale * (integral.error + round_off),
          integral.converged};
}

void set_work(DampingResult& result, const detail::Integral& factor, const Kernel& kernel) {
  const double work = factor.value * kernel.square_velocity;
  require(std::isfinite(work), "normal_amplitude", kernel.normal_amplitude,
          "m makes the loss overflow with this tangential motion; reduce both");
  result.work_per_cycle = kernel.periodic ? work : unknown;
  result.work_per_cycle_without_slip = result.work_per_cycle;
  result.error_estimate = factor.error * kernel.square_velocity;
  result.power = work * kernel.rate;
  result.damping_constant = factor.value * kernel.rate / kernel.mean_square_velocity;
  result.damping_constant_without_slip = result.damping_constant;
  result.damping_per_work = kernel.rate / (kernel.mean_square_velocity * kernel.square_velocity);
  require(!std::isinf(result.power) && !std::isinf(result.damping_constant), "angular_frequency",
          2 * pi * kernel.rate, "rad/s makes the damping overflow");
  result.converged = factor.converged;
}

void set_state(DampingResult& result, const ContactLaw& law, double indentation) {
  result.indentation = indentation;
  result.force = law.force(indentation);
  result.normal_stiffness = law.normal_stiffness(indentation);
  result.tangential_stiffness = law.tangential_stiffness(indentation);
  result.force_curvature = law.force_curvature(indentation);
  result.tangential_curvature = law.tangential_curvature(indentation);
}

double small_amplitude_factor(const ContactLaw& law, double curvature, const Kernel& kernel) {
  return law.modulus_ratio() * curvature * kernel.normal_amplitude * kernel.small_amplitude;
}

/// Whether only the loss in the limit of a small amplitude is asked for. Throws InvalidInput if the
/// law has no ratio of moduli, with which that limit is computed.
bool by_small_amplitude(const ContactLaw& law, Amplitude amplitude) {
  if (amplitude != Amplitude::small) return false;
  require(!std::isnan(law.modulus_ratio()), "amplitude", name_of(amplitude),
          "needs G*/E*, which only half-spaces have; use the finite amplitude");
  return true;
}

double settled_indentation(const ContactLaw& law, const OperatingPoint& point) {
  if (point.control == ControlQuantity::indentation)
    require_finite(point.value, "indentation");
  else if (point.control == ControlQuantity::normal_force)
    require_positive(point.value, "force");
  return indentation_of(law, point);
}

// Sets the loss for a finite amplitude about a mean indentation. middle: mean indentation, m.
void set_finite(DampingResult& result, const ContactLaw& law, double middle, const Kernel& kernel,
                double tolerance) {
  const double amplitude = kernel.normal_amplitude;
  require_covered(law, middle + amplitude, amplitude);
  require_representable(law, middle, amplitude);
  set_state(result, law, middle);
  result.mean_force = mean_of_force(law, middle, amplitude);
  result.max_force = law.force(middle + amplitude);
  result.contact_time = contact_time(law, middle, amplitude);
  const NormalCycle cycle{
      [&](double angle) { return law.tangential_stiffness(middle + amplitude * std::cos(angle)); },
      break_angles(law, middle, amplitude), law.tangential_stiffness(middle),
      law.tangential_stiffness(middle - amplitude), law.tangential_stiffness(middle + amplitude)};
  set_work(result, work_factor(cycle, kernel, tolerance), kernel);
}

// The loss in a measure that is known for every motion: γ also if the tangential motion is 0, W if
// ω is unknown.
double measure_of(const DampingResult& result) {
  return std::isnan(result.damping_constant_without_slip) ? result.work_per_cycle_without_slip
                                                          : result.damping_constant_without_slip;
}

DampingResult damping_of(const ContactLaw& law, const OperatingPoint& point, const Kernel& kernel,
                         const DampingOptions& options) {
  check(options);
  const double amplitude = kernel.normal_amplitude;
  const double settled = settled_indentation(law, point);
  const double small_factor = small_amplitude_factor(law, law.force_curvature(settled), kernel);
  DampingResult result;
  if (by_small_amplitude(law, options.amplitude)) {
    detail::require_possible(law, settled, 0);
    set_state(result, law, settled);
    result.mean_force = result.max_force = result.force;
    result.contact_time = 1;
    set_work(result, {small_factor, 0, true}, kernel);
  } else {
    result.hold = hold_of(law, point, amplitude, options.hold);
    const bool mean_force = result.hold == Hold::force;
    const auto middle_at = [&](double one) {
      if (!mean_force) return settled;
      return indentation_at_mean_force(law, point.load_given() ? point.value : law.force(settled),
                                       one);
    };
    detail::require_possible(law, settled, amplitude, middle_at, result.hold);
    set_finite(result, law, middle_at(amplitude), kernel, options.tolerance);
    result.error = result.error_without_slip = detail::error_of_table(
        law, {result.indentation - amplitude, result.indentation + amplitude},
        result.indentation - amplitude, result.work_per_cycle, measure_of(result),
        [&](const ContactLaw& other) {
          DampingResult by_other;
          const double middle =
              mean_force ? indentation_at_mean_force(other, result.mean_force, amplitude) : settled;
          set_finite(by_other, other, middle, kernel, 1e-7);
          return measure_of(by_other);
        });
  }
  result.small_amplitude_work = small_factor * kernel.square_velocity;
  return result;
}

DampingResult force_controlled(const ContactLaw& law, double mean_force, double force_amplitude,
                               Kernel kernel, const DampingOptions& options) {
  check(options);
  require_positive(mean_force, "force");
  require(force_amplitude >= 0 && force_amplitude <= mean_force, "force_amplitude", force_amplitude,
          "must lie between 0 and the mean force");
  // indentation_of() needs F > 0. At 1e-280 times the mean force, K_t of every law equals its limit
  // for F = 0.
  const double least = std::max(1e-280 * mean_force, std::numeric_limits<double>::min());
  auto stiffness_at = [&](double force) {
    return law.tangential_stiffness(law.indentation_of(std::max(force, least)));
  };
  DampingResult result;
  set_state(result, law, indentation_of(law, at_force(mean_force)));
  detail::require_possible(law, result.indentation,
                           law.indentation_of(mean_force + force_amplitude) - result.indentation);
  result.mean_force = mean_force;
  result.max_force = mean_force + force_amplitude;
  result.contact_time = 1;
  result.hold = Hold::force;
  kernel.normal_amplitude = force_amplitude / result.normal_stiffness;
  const double small_factor = small_amplitude_factor(law, result.force_curvature, kernel);
  if (by_small_amplitude(law, options.amplitude)) {
    set_work(result, {small_factor, 0, true}, kernel);
  } else {
    const NormalCycle cycle{
        [&](double angle) {
          // F0 + F_a cosθ with the mean force F0 and the amplitude F_a, written as (F0 − F_a) +
          // F_a(1 + cosθ), so that F is accurate where it falls to 0.
          return stiffness_at((mean_force - force_amplitude) +
                              2 * force_amplitude * square(std::cos(angle / 2)));
        },
        {0, pi},
        stiffness_at(mean_force),
        stiffness_at(mean_force - force_amplitude),
        stiffness_at(mean_force + force_amplitude)};
    set_work(result, work_factor(cycle, kernel, options.tolerance), kernel);
  }
  result.small_amplitude_work = small_factor * kernel.square_velocity;
  return result;
}

}  // namespace

void DampingResult::forget() {
  Loss::forget();
  power = error_estimate = storage_stiffness = loss_factor = unknown;
}

DampingResult detail::damping_about(const ContactLaw& law, double mean_indentation,
                                    const Motion& motion, double tolerance) {
  const Kernel kernel = std::visit([](const auto& one) { return kernel_of(one); }, motion);
  DampingResult result;
  set_finite(result, law, mean_indentation, kernel, tolerance);
  result.small_amplitude_work =
      small_amplitude_factor(law, result.force_curvature, kernel) * kernel.square_velocity;
  return result;
}

double indentation_of(const ContactLaw& law, const OperatingPoint& point) {
  if (point.control == ControlQuantity::indentation) return point.value;
  require(point.control == ControlQuantity::normal_force, name_of(point.control), point.value,
          "means nothing to a contact law; give a force or an indentation");
  if (const double lowest = law.lowest_indentation(); std::isfinite(lowest)) {
    const double low = law.force(lowest), high = law.force(law.highest_indentation());
    // The force of a sample may differ from that of the law by round-off.
    constexpr double slack = 1e-9;
    require(
        !(point.value < (1 - slack) * low), "force", point.value,
        fmt::format("lies outside the curve's range [{:.12g}, {:.12g}] N; choose a force within "
                    "it, or give a curve that covers it",
                    low, high));
  }
  return law.indentation_of(point.value);
}

Hold hold_of(const ContactLaw& law, const OperatingPoint& point, double normal_amplitude,
             Hold wanted) {
  if (wanted != Hold::automatic) return wanted;
  const bool lifts_off =
      point.load_given() && indentation_of(law, point) - normal_amplitude < law.first_touch();
  return lifts_off ? Hold::force : Hold::indentation;
}

double contact_time(const ContactLaw& law, double mean_indentation, double normal_amplitude) {
  const double touch = law.first_touch();
  if (!(normal_amplitude > 0)) return mean_indentation > touch ? 1 : 0;
  return std::acos(std::clamp((touch - mean_indentation) / normal_amplitude, -1.0, 1.0)) / pi;
}

double detail::fastest_opening(const ContactLaw& law, double mean_indentation,
                               double normal_amplitude) {
  const double share = std::min(0.5, contact_time(law, mean_indentation, normal_amplitude));
  return normal_amplitude * std::sin(pi * share);
}

double mean_force_of_cycle(const ContactLaw& law, double mean_indentation, double amplitude) {
  require_finite(mean_indentation, "indentation");
  require_amplitude(amplitude);
  detail::require_possible(law, mean_indentation, amplitude);
  return mean_of_force(law, mean_indentation, amplitude);
}

double indentation_at_mean_force(const ContactLaw& law, double mean_force, double amplitude) {
  require_positive(mean_force, "force");
  const double settled = indentation_of(law, at_force(mean_force));
  if (amplitude == 0) return settled;
  // F grows with δ, so F(δ0 − u_z) <= mean force <= F(δ0 + u_z). The mean indentation δ0 therefore
  // differs by at most u_z from the indentation without oscillation.
  const double low = settled - amplitude;
  const double high = std::min(settled + amplitude, law.highest_indentation() - amplitude);
  auto excess = [&](double indentation) {
    return mean_of_force(law, indentation, amplitude) - mean_force;
  };
  if (!(low <= high) || !(excess(high) >= 0)) {
    // The table ends below the motion. Its continuation says which load is needed.
    const detail::ContinuedLaw further(law);
    require_covered(law, indentation_at_mean_force(further, mean_force, amplitude) + amplitude,
                    amplitude);
  }
  const double indentation = detail::find_root(excess, low, high);
  detail::require_possible(
      law, settled, amplitude, [&](double) { return indentation; }, Hold::force);
  return indentation;
}

DampingResult relaxation_damping(const ContactLaw& law, const OperatingPoint& point,
                                 const Oscillation& motion, const DampingOptions& options) {
  return damping_of(law, point, kernel_of(motion), options);
}

DampingResult relaxation_damping(const ContactLaw& law, const OperatingPoint& point,
                                 const TwoFrequencies& motion, const DampingOptions& options) {
  return damping_of(law, point, kernel_of(motion), options);
}

std::vector<DampingResult> relaxation_damping(const ContactLaw& law,
                                              std::span<const DampingCase> cases,
                                              const DampingOptions& options) {
  std::vector<DampingResult> results(cases.size());
  // Computes the cases in blocks, so that progress can be reported from the calling thread in
  // between.
  constexpr std::size_t block = 64;
  for (std::size_t first = 0; first < cases.size(); first += block) {
    const std::size_t count = std::min(block, cases.size() - first);
    parallel::for_slabs(static_cast<Index>(count), [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const std::size_t at = first + static_cast<std::size_t>(i);
        results[at] = relaxation_damping(law, cases[at].point, cases[at].motion, options);
      }
    });
    const double done = static_cast<double>(first + count);
    if (options.on_progress &&
        !options.on_progress({"damping", done / static_cast<double>(cases.size()),
                              static_cast<int>(first + count), 0}))
      throw Interrupted("damping: stopped before all cases were done");
  }
  return results;
}

DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude, const Oscillation& motion,
                                                  const DampingOptions& options) {
  return force_controlled(law, mean_force, force_amplitude, kernel_of(motion), options);
}

DampingResult relaxation_damping_force_controlled(const ContactLaw& law, double mean_force,
                                                  double force_amplitude,
                                                  const TwoFrequencies& motion,
                                                  const DampingOptions& options) {
  return force_controlled(law, mean_force, force_amplitude, kernel_of(motion), options);
}

}  // namespace salebra
