// SPDX-License-Identifier: GPL-3.0-or-later
// Steady sliding over velocities and amplitudes, and the motion of a slider on a spring.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/analysis/sliding.hpp>
#include <salebra/base/error.hpp>
#include <span>
#include <tuple>

#include "damping/max_motion.hpp"

namespace salebra {
namespace {

std::vector<SlidingPoint> points_at(const SlidingProblem& problem, double amplitude,
                                    const ContactLaw& law, const OperatingPoint& point) {
  DampingOptions options;
  options.hold = problem.hold;
  const NormalOscillation normal{amplitude, problem.angular_frequency};
  const auto states = [&](const std::vector<double>& velocities) {
    return steady_sliding(law, point, normal, velocities, problem.friction_coefficient, options);
  };
  std::vector<double> velocities = problem.velocities;
  if (!problem.velocity_ratios.empty()) {
    require_positive(amplitude, "normal_amplitude");
    const double critical =
        states({amplitude * problem.angular_frequency}).front().critical_velocity;
    for (const double ratio : problem.velocity_ratios) velocities.push_back(ratio * critical);
  }
  std::vector<SlidingPoint> points;
  for (const SteadySliding& state : states(velocities)) {
    const std::size_t i = points.size();
    points.push_back({.normal_amplitude = amplitude, .velocity = velocities[i], .state = state});
    if (!problem.velocity_ratios.empty()) points.back().velocity_ratio = problem.velocity_ratios[i];
  }
  return points;
}

// The largest normal amplitude about an indentation for which the motion stays in the range of the
// law.
double covered_amplitude(const ContactLaw& law, double indentation) {
  return std::min(law.highest_indentation() - indentation,
                  detail::possible_amplitude(law, indentation));
}

SliderThreshold in_hertz(SliderThreshold threshold) {
  for (double* value :
       {&threshold.value, &threshold.linear_estimate, &threshold.linear_estimate_error})
    *value /= 2 * std::numbers::pi;
  return threshold;
}

SliderThresholds thresholds_of(const SliderProblem& problem, const ContactLaw& law,
                               const OperatingPoint& point, double indentation) {
  const Slider& slider = problem.slider;
  const auto [amplitude, omega] = problem.normal;
  if (!(slider.falling_slope > slider.support_damping) || !(omega > 0)) return {};
  const double friction = problem.friction_coefficient;
  const double start = slider.velocity / omega * law.tangential_stiffness(indentation) /
                       (friction * law.normal_stiffness(indentation));
  const double largest = problem.max_amplitude.value_or(
      std::min(10 * std::max(amplitude, start), covered_amplitude(law, indentation)));
  SliderThresholds found{.amplitude = threshold_amplitude(law, point, {largest, omega}, slider,
                                                          friction, problem.options)};
  if (amplitude > 0)
    found.frequency = in_hertz(threshold_angular_frequency(law, point, {amplitude, 10 * omega},
                                                           slider, friction, problem.options));
  return found;
}

}  // namespace

SlidingSolution solve(const SlidingProblem& asked, const ContactLaw& law,
                      const OperatingPoint& point) {
  SlidingProblem problem = asked;
  // All amplitudes keep the same mean value, so that they can be compared.
  if (!problem.normal_amplitude.empty())
    problem.hold = hold_of(law, point, std::ranges::max(problem.normal_amplitude), problem.hold);
  SlidingSolution solution;
  std::vector<SlidingPoint>& points = solution.points;
  std::vector<DampingResult> means;
  for (const double amplitude : problem.normal_amplitude) {
    const std::vector<SlidingPoint> found = points_at(problem, amplitude, law, point);
    points.insert(points.end(), found.begin(), found.end());
    const SteadySliding& state = found.front().state;
    DampingResult& mean = means.emplace_back();
    mean.force = law.force(state.indentation);
    mean.mean_force = state.mean_force;
    mean.hold = problem.hold;
    if (const auto lost = std::ranges::count_if(
            found, [](const SlidingPoint& point) { return !point.state.converged; });
        lost > 0)
      throw NotConverged(fmt::format("sliding: {} of {} integrals did not reach the tolerance",
                                     lost, found.size()));
  }
  if (const auto warning = detail::warning_of_held_indentation(means))
    solution.warnings.push_back(*warning);
  if (problem.excursions.empty()) return solution;
  std::vector<double> velocities;
  for (const SlidingPoint& point : points) velocities.push_back(point.velocity);
  solution.regimes = regime_map(law, points.front().state.indentation,
                                {problem.normal_amplitude.front(), problem.angular_frequency},
                                velocities, problem.excursions, problem.friction_coefficient);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].no_slip_excursion = solution.regimes->no_slip_excursion[i];
  return solution;
}

SlidingSolution solve(const SlidingProblem& asked, const ContactSolution& contact, const Body& body,
                      const Context& context) {
  SlidingProblem problem = asked;
  if (contact.surface) problem.hold = contact.hold;
  SlidingSolution solution = solve(problem, *contact.law, contact.points.front());
  for (SlidingPoint& point : solution.points) point.direction = contact.direction();
  if (!contact.surface) return solution;
  const std::size_t velocities = solution.points.size() / problem.normal_amplitude.size();
  for (std::size_t first = 0; first < solution.points.size(); first += velocities) {
    const auto points = std::span(solution.points).subspan(first, velocities);
    SurfaceSlidingMotion motion{
        .normal = {points.front().normal_amplitude, problem.angular_frequency},
        .velocities = {},
        .friction_coefficient = problem.friction_coefficient,
        .hold = problem.hold};
    for (const SlidingPoint& point : points) motion.velocities.push_back(point.velocity);
    const auto found = surface_sliding(*contact.surface, body, *contact.curve, contact.load(),
                                       motion, context.on_progress);
    for (std::size_t i = 0; i < velocities; ++i) {
      // The assumptions are judged by the law, so the point keeps the mean indentation of the law.
      const double indentation = points[i].state.indentation;
      std::tie(points[i].state, points[i].errors) = found[i];
      points[i].state.indentation = indentation;
    }
  }
  return solution;
}

SliderSolution solve(const SliderProblem& problem, const ContactLaw& law,
                     const OperatingPoint& point) {
  const auto& [slider, normal, friction, max_amplitude, options] = problem;
  SliderSolution solution;
  solution.stability = slider_stability(law, point, normal, slider, friction, options);
  const bool oscillates = normal.normal_amplitude > 0;
  DampingOptions averages;
  averages.hold = options.hold;
  solution.judged = {
      normal.normal_amplitude, slider.velocity,
      oscillates ? normal.angular_frequency : std::sqrt(slider.spring_stiffness / slider.mass)};
  solution.sliding = steady_sliding(law, point, solution.judged, friction, averages);
  const double indentation = solution.sliding.indentation;
  // Without a normal oscillation the assumptions are judged for a very small one.
  if (!oscillates)
    solution.judged.normal_amplitude =
        1e-6 * law.force(indentation) / law.normal_stiffness(indentation);
  solution.motion = slider_motion(law, point, normal, slider, friction, options);
  solution.averaged = averaged_slider_motion(law, point, normal, slider, friction, options);
  if (!solution.motion.converged || !solution.averaged.converged)
    throw NotConverged(
        fmt::format("slider: the {} does not repeat to the `tolerance` within `max_cycles`; raise "
                    "both, because near the threshold disturbances grow or decay slowly",
                    solution.motion.converged ? "averaged motion" : "motion"));
  solution.thresholds = thresholds_of(problem, law, point, indentation);
  return solution;
}

}  // namespace salebra
