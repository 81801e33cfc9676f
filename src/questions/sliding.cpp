// SPDX-License-Identifier: GPL-3.0-or-later
// Answers about sliding: over velocities and amplitudes, and of a slider on a spring.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/questions/sliding.hpp>
#include <span>
#include <tuple>

#include "damping/largest_motion.hpp"

namespace salebra {
namespace {

std::vector<SlidingPoint> points_at(const SlidingQuestion& question, double amplitude,
                                    const ContactLaw& law, const Position& position) {
  DampingOptions options;
  options.hold = question.hold;
  const NormalOscillation normal{amplitude, question.angular_frequency};
  const auto states = [&](const std::vector<double>& velocities) {
    return steady_sliding(law, position, normal, velocities, question.friction_coefficient,
                          options);
  };
  std::vector<double> velocities = question.velocities;
  if (!question.velocity_ratios.empty()) {
    require_positive(amplitude, "normal_amplitude");
    const double critical =
        states({amplitude * question.angular_frequency}).front().critical_velocity;
    for (const double ratio : question.velocity_ratios) velocities.push_back(ratio * critical);
  }
  std::vector<SlidingPoint> points;
  for (const SteadySliding& state : states(velocities)) {
    const std::size_t i = points.size();
    points.push_back({.normal_amplitude = amplitude, .velocity = velocities[i], .state = state});
    if (!question.velocity_ratios.empty())
      points.back().velocity_ratio = question.velocity_ratios[i];
  }
  return points;
}

// The largest oscillation about an indentation that the law covers.
double covered_amplitude(const ContactLaw& law, double indentation) {
  return std::min({indentation - law.lowest_indentation(), law.highest_indentation() - indentation,
                   detail::possible_amplitude(law, indentation)});
}

SliderThreshold in_hertz(SliderThreshold threshold) {
  for (double* value :
       {&threshold.value, &threshold.linear_estimate, &threshold.linear_estimate_error})
    *value /= 2 * std::numbers::pi;
  return threshold;
}

SliderThresholds thresholds_of(const SliderQuestion& question, const ContactLaw& law,
                               const Position& position, double indentation) {
  const Slider& slider = question.slider;
  const auto [amplitude, omega] = question.normal;
  if (!(slider.falling_slope > slider.support_damping) || !(omega > 0)) return {};
  const double friction = question.friction_coefficient;
  const double start = slider.velocity / omega * law.tangential_stiffness(indentation) /
                       (friction * law.normal_stiffness(indentation));
  const double largest = question.largest_amplitude.value_or(
      std::min(10 * std::max(amplitude, start), covered_amplitude(law, indentation)));
  SliderThresholds found{.amplitude = threshold_amplitude(law, position, {largest, omega}, slider,
                                                          friction, question.options)};
  if (amplitude > 0)
    found.frequency = in_hertz(threshold_angular_frequency(law, position, {amplitude, 10 * omega},
                                                           slider, friction, question.options));
  return found;
}

}  // namespace

SlidingAnswer ask(const SlidingQuestion& question, const ContactLaw& law,
                  const Position& position) {
  SlidingAnswer answer;
  std::vector<SlidingPoint>& points = answer.points;
  std::vector<DampingResult> means;
  for (const double amplitude : question.normal_amplitude) {
    const std::vector<SlidingPoint> found = points_at(question, amplitude, law, position);
    points.insert(points.end(), found.begin(), found.end());
    const SteadySliding& state = found.front().state;
    means.push_back({.force = law.force(state.indentation), .mean_force = state.mean_force});
    if (const auto lost = std::ranges::count_if(
            found, [](const SlidingPoint& point) { return !point.state.converged; });
        lost > 0)
      throw NotConverged(fmt::format("sliding: {} of {} integrals did not reach the tolerance",
                                     lost, found.size()));
  }
  if (const auto doubt = detail::doubt_of_held_indentation(question.hold, means))
    answer.doubts.push_back(*doubt);
  if (question.excursions.empty()) return answer;
  std::vector<double> velocities;
  for (const SlidingPoint& point : points) velocities.push_back(point.velocity);
  answer.regimes = regime_map(law, points.front().state.indentation,
                              {question.normal_amplitude.front(), question.angular_frequency},
                              velocities, question.excursions, question.friction_coefficient);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].no_slip_excursion = answer.regimes->no_slip_excursion[i];
  return answer;
}

SlidingAnswer ask(const SlidingQuestion& question, const ContactAnswer& contact,
                  const Material& material, const Context& context) {
  SlidingAnswer answer = ask(question, *contact.law, contact.positions.front());
  if (!contact.surface) return answer;
  const std::size_t velocities = answer.points.size() / question.normal_amplitude.size();
  for (std::size_t first = 0; first < answer.points.size(); first += velocities) {
    const auto points = std::span(answer.points).subspan(first, velocities);
    SurfaceSlidingMotion motion{
        .normal = {points.front().normal_amplitude, question.angular_frequency},
        .velocities = {},
        .friction_coefficient = question.friction_coefficient,
        .hold = question.hold};
    for (const SlidingPoint& point : points) motion.velocities.push_back(point.velocity);
    const auto found = surface_sliding(*contact.surface, material, *contact.curve, contact.load(),
                                       motion, context.on_progress);
    for (std::size_t i = 0; i < velocities; ++i) {
      // The indentations of the law, by which the premises are judged, are those of its cells.
      const double indentation = points[i].state.indentation;
      std::tie(points[i].state, points[i].errors) = found[i];
      points[i].state.indentation = indentation;
    }
  }
  return answer;
}

SliderAnswer ask(const SliderQuestion& question, const ContactLaw& law, const Position& position) {
  const auto& [slider, normal, friction, largest_amplitude, options] = question;
  SliderAnswer answer;
  answer.stability = slider_stability(law, position, normal, slider, friction, options);
  const bool oscillates = normal.normal_amplitude > 0;
  DampingOptions averages;
  averages.hold = options.hold;
  answer.judged = {
      normal.normal_amplitude, slider.velocity,
      oscillates ? normal.angular_frequency : std::sqrt(slider.spring_stiffness / slider.mass)};
  answer.sliding = steady_sliding(law, position, answer.judged, friction, averages);
  const double indentation = answer.sliding.indentation;
  // No oscillation is the limit of small ones.
  if (!oscillates)
    answer.judged.normal_amplitude =
        1e-6 * law.force(indentation) / law.normal_stiffness(indentation);
  answer.motion = slider_motion(law, position, normal, slider, friction, options);
  answer.averaged = averaged_slider_motion(law, position, normal, slider, friction, options);
  if (!answer.motion.converged || !answer.averaged.converged)
    throw NotConverged(
        fmt::format("slider: the {} does not repeat to the `tolerance` within `most_cycles`; near "
                    "the threshold "
                    "disturbances grow or decay slowly, and then both must be raised",
                    answer.motion.converged ? "averaged motion" : "motion"));
  answer.thresholds = thresholds_of(question, law, position, indentation);
  return answer;
}

}  // namespace salebra
