// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <sstream>

#include "../contact/quadrature.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double square(double value) { return value * value; }

double normal_amplitude(const Oscillation& motion) {
  return std::visit([](const auto& m) { return m.normal_amplitude; }, motion);
}

void require_finite(double value, const char* field) {
  require(std::isfinite(value), field, value, "must be a finite number");
}

void check(const Oscillation& motion, const DampingOptions& options) {
  const double amplitude = normal_amplitude(motion);
  require(std::isfinite(amplitude) && amplitude >= 0, "normal_amplitude", amplitude,
          "must be finite and >= 0; a negative one is a phase shift of pi");
  if (const auto* drag = std::get_if<Drag>(&motion)) {
    require_finite(drag->drag_velocity, "drag_velocity");
    require_positive(drag->angular_frequency, "angular_frequency");
  } else {
    const auto& equal = std::get<EqualFrequency>(motion);
    require_finite(equal.tangential_amplitude, "tangential_amplitude");
    require_finite(equal.phase, "phase");
    require(std::isfinite(equal.angular_frequency) && equal.angular_frequency >= 0,
            "angular_frequency", equal.angular_frequency,
            "must be finite and > 0, or 0 where it is not known");
  }
  require(options.tolerance >= 1e-13 && options.tolerance <= 1e-2, "tolerance", options.tolerance,
          "must lie between 1e-13 and 1e-2");
}

void require_covered(const ContactLaw& law, double mean_indentation, double amplitude) {
  const double low = law.lowest_indentation(), high = law.highest_indentation();
  const double slack = std::isfinite(high - low) ? 1e-12 * (high - low) : 0;
  if (mean_indentation - amplitude >= low - slack && mean_indentation + amplitude <= high + slack)
    return;
  std::ostringstream constraint;
  constraint.precision(9);
  constraint << "m about the indentation " << mean_indentation << " m leaves the curve's range ["
             << low << ", " << high << "] m; reduce the amplitude or extend the curve";
  require(false, "normal_amplitude", amplitude, constraint.str());
}

// Angle at which the contact opens while δ = δ0 + u_z cosθ falls, where it does so within the cycle: K_t has a kink or a jump there.
std::vector<double> break_angles(const ContactLaw& law, double mean_indentation, double amplitude) {
  std::vector<double> angles{0};
  double open = mean_indentation - amplitude, closed = mean_indentation + amplitude;
  if (!(law.force(open) > 0) && law.force(closed) > 0) {
    for (int halving = 0; halving < 100; ++halving) {
      const double middle = 0.5 * (open + closed);
      (law.force(middle) > 0 ? closed : open) = middle;
    }
    // Written with half angles: arccos loses half the digits at both ends.
    const double above = mean_indentation + amplitude - closed;
    const double below = closed - (mean_indentation - amplitude);
    angles.push_back(2 *
                     std::atan2(std::sqrt(std::max(above, 0.0)), std::sqrt(std::max(below, 0.0))));
  }
  angles.push_back(pi);
  return angles;
}

// One cycle of the normal motion: K_t as a function of the phase θ, even about θ = 0 where δ is largest.
struct NormalCycle {
  std::function<double(double)> stiffness;
  std::vector<double> break_angles;
  double stiffness_at_middle, stiffness_at_bottom, stiffness_at_top;
};

// W over u_x² in case (a), over v² in case (b): γ exists where the velocity is 0.
detail::Integral work_factor(const NormalCycle& cycle, const Oscillation& motion,
                             double tolerance) {
  detail::Integral integral;
  double scale = 0, weight = 0;  // weight: ∫ of the absolute weight function, for the round-off
  if (const auto* equal = std::get_if<EqualFrequency>(&motion)) {
    // ∫ sin2θ = 0: a constant may be taken off, and what is left does not cancel.
    integral = detail::integrate(
        [&](double angle) {
          return (cycle.stiffness(angle) - cycle.stiffness_at_middle) * std::sin(2 * angle);
        },
        cycle.break_angles, tolerance);
    scale = 2 * square(std::sin(equal->phase));
    weight = 2;
  } else {
    integral = detail::integrate(
        [&](double angle) { return angle * (cycle.stiffness(angle) - cycle.stiffness_at_bottom); },
        cycle.break_angles, tolerance);
    scale = 4 / square(std::get<Drag>(motion).angular_frequency);
    weight = pi * pi / 2;
  }
  // K_t is known to a few units in its last place; where that is all there is, the tolerance cannot be reached and does not count.
  const double round_off = 4 * epsilon * cycle.stiffness_at_top * weight;
  integral.converged = integral.converged || integral.error <= round_off;
  return {scale * integral.value, scale * (integral.error + round_off), integral.converged};
}

void set_work(DampingResult& result, const detail::Integral& factor, const Oscillation& motion) {
  double square_velocity = 0;  // W = factor · u_x² or v²
  if (const auto* equal = std::get_if<EqualFrequency>(&motion)) {
    square_velocity = square(equal->tangential_amplitude);
    if (equal->angular_frequency > 0)
      result.damping_constant = factor.value / (pi * equal->angular_frequency);
  } else {
    const auto& drag = std::get<Drag>(motion);
    square_velocity = square(drag.drag_velocity);
    result.damping_constant = factor.value * drag.angular_frequency / (2 * pi);
  }
  result.work_per_cycle = factor.value * square_velocity;
  result.error_estimate = factor.error * square_velocity;
  result.converged = factor.converged;
  result.power = closed_form::power(result.work_per_cycle, motion);
}

Oscillation with_normal_amplitude(Oscillation motion, double amplitude) {
  std::visit([&](auto& m) { m.normal_amplitude = amplitude; }, motion);
  return motion;
}

// The motion with u_x or v of 1, so that its work is the factor of set_work().
Oscillation with_unit_velocity(Oscillation motion) {
  if (auto* equal = std::get_if<EqualFrequency>(&motion))
    equal->tangential_amplitude = 1;
  else
    std::get<Drag>(motion).drag_velocity = 1;
  return motion;
}

double small_amplitude_work(const ContactLaw& law, double curvature, const Oscillation& motion) {
  return std::visit(
      [&](const auto& m) { return closed_form::work_per_cycle(law.modulus_ratio(), curvature, m); },
      motion);
}

void set_state(DampingResult& result, const ContactLaw& law, double indentation) {
  result.indentation = indentation;
  result.force = law.force(indentation);
  result.normal_stiffness = law.normal_stiffness(indentation);
  result.curvature = law.curvature(indentation);
  result.tangential_curvature = law.tangential_curvature(indentation);
}

void set_small_amplitude_work(DampingResult& result, const ContactLaw& law, double curvature,
                              const Oscillation& motion) {
  const double factor = small_amplitude_work(law, curvature, with_unit_velocity(motion));
  set_work(result, {factor, 0, true}, motion);
}

}  // namespace

double mean_force_of_cycle(const ContactLaw& law, double mean_indentation, double amplitude) {
  require_finite(mean_indentation, "indentation");
  require_covered(law, mean_indentation, amplitude);
  const std::vector<double> angles = break_angles(law, mean_indentation, amplitude);
  return detail::integrate(
             [&](double angle) {
               return law.force(mean_indentation + amplitude * std::cos(angle));
             },
             angles, 1e-12)
             .value /
         pi;
}

double indentation_at_mean_force(const ContactLaw& law, double mean_force, double amplitude) {
  require_positive(mean_force, "force");
  const double settled = law.indentation_of(mean_force);
  if (amplitude == 0) return settled;
  // F grows with δ, so F(δ0 − u_z) <= mean <= F(δ0 + u_z): δ0 is within u_z of where the force would rest without oscillation.
  const double low = std::max(settled - amplitude, law.lowest_indentation() + amplitude);
  const double high = std::min(settled + amplitude, law.highest_indentation() - amplitude);
  if (!(low <= high)) require_covered(law, settled, amplitude);
  auto excess = [&](double indentation) {
    return mean_force_of_cycle(law, indentation, amplitude) - mean_force;
  };
  if (!(excess(low) <= 0)) require_covered(law, low - amplitude, amplitude);
  if (!(excess(high) >= 0)) require_covered(law, high + amplitude, amplitude);
  return detail::find_root(excess, low, high);
}

DampingResult relaxation_damping(const ContactLaw& law, const Position& position,
                                 const Oscillation& motion, const DampingOptions& options) {
  check(motion, options);
  const double amplitude = normal_amplitude(motion);
  double settled = 0;
  if (const auto* at = std::get_if<AtIndentation>(&position)) {
    settled = at->indentation;
    require_finite(settled, "indentation");
  } else {
    const double force = std::get<AtForce>(position).force;
    require_positive(force, "force");
    settled = law.indentation_of(force);
  }

  DampingResult result;
  const double settled_curvature = law.curvature(settled);
  if (options.amplitude == Amplitude::small) {
    set_state(result, law, settled);
    result.mean_force = result.force;
    set_small_amplitude_work(result, law, settled_curvature, motion);
  } else {
    double middle = settled;
    if (options.hold == Hold::force) {
      const auto* at = std::get_if<AtForce>(&position);
      middle = indentation_at_mean_force(law, at ? at->force : law.force(settled), amplitude);
    }
    require_covered(law, middle, amplitude);
    set_state(result, law, middle);
    result.mean_force = mean_force_of_cycle(law, middle, amplitude);
    const NormalCycle cycle{[&](double angle) {
                              return law.tangential_stiffness(middle + amplitude * std::cos(angle));
                            },
                            break_angles(law, middle, amplitude), law.tangential_stiffness(middle),
                            law.tangential_stiffness(middle - amplitude),
                            law.tangential_stiffness(middle + amplitude)};
    set_work(result, work_factor(cycle, motion, options.tolerance), motion);
  }
  result.small_amplitude_work = small_amplitude_work(law, settled_curvature, motion);
  return result;
}

std::vector<DampingResult> relaxation_damping(const ContactLaw& law,
                                              std::span<const DampingCase> cases,
                                              const DampingOptions& options) {
  std::vector<DampingResult> results(cases.size());
  // Blocks, so that the progress comes from the calling thread.
  constexpr std::size_t block = 64;
  for (std::size_t first = 0; first < cases.size(); first += block) {
    const std::size_t count = std::min(block, cases.size() - first);
    parallel::for_slabs(static_cast<Index>(count), [&](Index begin, Index end) {
      for (Index i = begin; i < end; ++i) {
        const std::size_t at = first + static_cast<std::size_t>(i);
        results[at] = relaxation_damping(law, cases[at].position, cases[at].motion, options);
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
  check(with_normal_amplitude(motion, 0), options);
  require_positive(mean_force, "force");
  require(force_amplitude >= 0 && force_amplitude <= mean_force, "force_amplitude", force_amplitude,
          "must lie between 0 and the mean force");
  // indentation_of() needs F > 0; 280 decades below the mean every K_t has reached its limit at F = 0.
  const double least = std::max(1e-280 * mean_force, std::numeric_limits<double>::min());
  auto stiffness_at = [&](double force) {
    return law.tangential_stiffness(law.indentation_of(std::max(force, least)));
  };
  DampingResult result;
  set_state(result, law, law.indentation_of(mean_force));
  result.mean_force = mean_force;
  const Oscillation equivalent =
      with_normal_amplitude(motion, force_amplitude / result.normal_stiffness);
  if (options.amplitude == Amplitude::small) {
    set_small_amplitude_work(result, law, result.curvature, equivalent);
  } else {
    const NormalCycle cycle{
        [&](double angle) {
          // F0 − F_a + F_a(1 + cosθ), so that F is accurate near a bottom at 0.
          return stiffness_at((mean_force - force_amplitude) +
                              2 * force_amplitude * square(std::cos(angle / 2)));
        },
        {0, pi},
        stiffness_at(mean_force),
        stiffness_at(mean_force - force_amplitude),
        stiffness_at(mean_force + force_amplitude)};
    set_work(result, work_factor(cycle, motion, options.tolerance), motion);
  }
  result.small_amplitude_work = small_amplitude_work(law, result.curvature, equivalent);
  return result;
}

}  // namespace salebra
