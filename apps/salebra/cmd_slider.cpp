// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra slider`: stick–slip of a mass on a spring over a contact that oscillates in the normal
// direction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/steady_sliding.hpp>

#include "figures.hpp"
#include "first_loading.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "result_tables.hpp"

namespace salebra::cli {
namespace {

struct SliderArguments {
  LawOptions law;
  MaterialOptions material;
  std::string hold = "indentation", start = "rest";
  std::optional<double> mass, spring_stiffness, velocity, support_damping, falling_slope,
      normal_amplitude, largest_amplitude, tolerance;
  FrequencyOptions frequency;
  SliderOptions options;
  PremiseOptions premises;
};

// unit: of the values in SI.
Json threshold_json(const SliderThreshold& threshold, double unit) {
  return {{"value", threshold.value / unit},
          {"linear_estimate", threshold.linear_estimate / unit},
          {"linear_estimate_error", threshold.linear_estimate_error / unit}};
}

Figure slider_figure(const SliderMotion& full, const SliderMotion& averaged, double stiffness) {
  const auto curve = [](const SliderMotion& motion, const char* name) {
    PlotCurve over_time{.name = name};
    for (const double time : motion.time) over_time.x.push_back(time - motion.time.front());
    return over_time;
  };
  PlotCurve velocity = curve(full, "full equation"), force = velocity;
  PlotCurve averaged_velocity = curve(averaged, "averaged equation");
  averaged_velocity.style = PlotStyle::dashed;
  PlotCurve averaged_force = averaged_velocity;
  velocity.y = full.slider_velocity, averaged_velocity.y = averaged.slider_velocity;
  for (const double offset : full.slider_offset) force.y.push_back(-stiffness * offset);
  for (const double offset : averaged.slider_offset)
    averaged_force.y.push_back(-stiffness * offset);
  Figure figure;
  figure.columns = 2;
  figure.panels.push_back({.title = "Velocity of the slider",
                           .x = axis_of("time"),
                           .y = {.label = "velocity", .unit = "m/s"},
                           .legend = PlotLegend::top_left});
  figure.panels.back().curves = {velocity, averaged_velocity};
  figure.panels.push_back({.title = "Force of the spring",
                           .x = axis_of("time"),
                           .y = {.label = "k(Vt − x)", .unit = "N"},
                           .legend = PlotLegend::top_left});
  figure.panels.back().curves = {force, averaged_force};
  return figure;
}

// The largest oscillation about an indentation that the law covers.
double covered_amplitude(const ContactLaw& law, double indentation) {
  return std::min(indentation - law.lowest_indentation(), law.highest_indentation() - indentation);
}

void run(const SliderArguments& arguments, Session& session) {
  require_tables(session, {"motion", "averaged_motion"});
  std::vector<std::string> missing;
  if (!arguments.premises.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (!arguments.mass) missing.emplace_back("--mass");
  if (!arguments.spring_stiffness) missing.emplace_back("--spring-stiffness");
  if (!arguments.velocity) missing.emplace_back("--velocity");
  if (arguments.normal_amplitude.value_or(0) != 0 && !arguments.frequency.given())
    missing.emplace_back("--frequency");
  require_options(missing, "a slider");
  const double friction = *arguments.premises.friction_coefficient;
  require_positive(friction, "--friction-coefficient");
  const Slider slider{.mass = *arguments.mass,
                      .spring_stiffness = *arguments.spring_stiffness,
                      .velocity = *arguments.velocity,
                      .support_damping = arguments.support_damping.value_or(0),
                      .falling_slope = arguments.falling_slope.value_or(0)};
  const NormalOscillation normal{
      arguments.normal_amplitude.value_or(0),
      arguments.frequency.given() ? arguments.frequency.angular().front() : 0};
  SliderOptions options = arguments.options;
  if (arguments.tolerance) options.tolerance = *arguments.tolerance;
  options.hold = *value_of<Hold>(arguments.hold);
  options.start = *value_of<SliderStart>(arguments.start);
  options.on_progress = session.progress();
  const ContactAnswer contact = arguments.law.contact(
      arguments.material, session, arguments.premises.hardness, std::abs(normal.normal_amplitude));
  require(contact.positions.size() == 1, "--normal-force",
          fmt::format("{} positions", contact.positions.size()), "are given; slider takes one");
  const Position& position = contact.positions.front();
  const ContactLaw& law = *contact.law;

  const SliderStability stability =
      slider_stability(law, position, normal, slider, friction, options);
  const bool oscillates = normal.normal_amplitude > 0;
  DampingOptions averages;
  averages.hold = options.hold;
  const Drag drag{
      normal.normal_amplitude, slider.velocity,
      oscillates ? normal.angular_frequency : std::sqrt(slider.spring_stiffness / slider.mass)};
  const SteadySliding sliding = steady_sliding(law, position, drag, friction, averages);
  const SliderMotion full = slider_motion(law, position, normal, slider, friction, options);
  const SliderMotion averaged =
      averaged_slider_motion(law, position, normal, slider, friction, options);
  if (!full.converged || !averaged.converged)
    throw NotConverged(
        fmt::format("slider: the {} does not repeat to the --tolerance within --most-cycles; near "
                    "the threshold disturbances grow or decay slowly, and then both must be raised",
                    full.converged ? "averaged motion" : "motion"));

  Json answer = json_of(full);
  answer["averaged"] = json_of(averaged);
  answer["mean_force"] = sliding.mean_force;
  if (oscillates) {
    answer["critical_velocity"] = sliding.critical_velocity;
    answer.add(json_of(stability));
  }
  answer["stable"] = stability.converged ? Json(stability.growth_rate < 0) : Json();
  if (slider.falling_slope > slider.support_damping && arguments.frequency.given()) {
    const double start = slider.velocity / normal.angular_frequency *
                         law.tangential_stiffness(sliding.indentation) /
                         (friction * law.normal_stiffness(sliding.indentation));
    const double largest =
        arguments.largest_amplitude.value_or(std::min(10 * std::max(normal.normal_amplitude, start),
                                                      covered_amplitude(law, sliding.indentation)));
    answer["threshold_amplitude"] =
        threshold_json(threshold_amplitude(law, position, normal.angular_frequency, slider,
                                           friction, largest, options),
                       1);
    if (oscillates)
      answer["threshold_frequency"] = threshold_json(
          threshold_angular_frequency(law, position, normal.normal_amplitude, slider, friction,
                                      10 * normal.angular_frequency, options),
          2 * std::numbers::pi);
  }
  add_first_loading(answer, contact.first_loading);
  write_tables(
      session, "slider", answer,
      {table_of("motion", lists_of(full)), table_of("averaged_motion", lists_of(averaged))});
  if (session.has_plot()) session.plot(slider_figure(full, averaged, slider.spring_stiffness));

  // No oscillation is the limit of small ones.
  Drag judged = drag;
  if (!oscillates)
    judged.normal_amplitude =
        1e-6 * law.force(sliding.indentation) / law.normal_stiffness(sliding.indentation);
  const ContactFacts facts =
      contact.facts_at(arguments.premises.facts(arguments.material), sliding.indentation);
  premises_beside_slip(law, sliding.indentation, judged, facts).answer(session, answer);
}

}  // namespace

void add_slider_command(Program& program) {
  auto arguments = std::make_shared<SliderArguments>();
  Command& command = program.add_command(
      "slider", "stick–slip of a slider under a normal oscillation",
      {"salebra slider --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 "
       "--friction-coefficient 0.3 --mass 10g --spring-stiffness 1kN/m --velocity 50um/s "
       "--falling-slope 1",
       "salebra slider --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 "
       "--friction-coefficient 0.3 --mass 10g --spring-stiffness 1kN/m --velocity 50um/s "
       "--falling-slope 1 --normal-amplitude 2nm --frequency 20kHz --plot slider.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "velocity and spring force over time", OutputCheck::any_name);
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  const std::string body = "Slider";
  add_quantity(command, "--mass", arguments->mass, Dimension::mass, "m")->group(body);
  add_quantity(command, "--spring-stiffness", arguments->spring_stiffness, Dimension::stiffness,
               "k of the spring that drags it")
      ->group(body);
  add_quantity(command, "--velocity", arguments->velocity, Dimension::velocity,
               "V of the drive, > 0")
      ->group(body);
  add_quantity(command, "--support-damping", arguments->support_damping, Dimension::damping,
               "c of a dashpot in parallel with the spring; default 0")
      ->group(body);
  add_quantity(command, "--falling-slope", arguments->falling_slope, Dimension::damping,
               "b of a friction force that falls by b per velocity; default 0")
      ->group(body);
  const std::string motion = "Motion";
  add_quantity(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length,
               "u_z; default 0, no oscillation")
      ->group(motion);
  arguments->frequency.add_to(command, motion, true);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "what stays in the mean; default indentation")
      ->group(motion);
  add_choice<SliderStart>(command, "--start", arguments->start,
                          "where the motion begins: at rest, on the point of slipping, or sliding "
                          "with a small disturbance; default rest")
      ->group(motion);
  add_quantity(command, "--largest-amplitude", arguments->largest_amplitude, Dimension::length,
               "to look for the threshold in; default 10 times that of the smallest effect")
      ->group(motion);
  command
      .add_option("--steps", arguments->options.steps,
                  "in a period of the oscillation, doubled until the tolerance is met; default 32")
      ->range(16, 100000)
      ->group(motion);
  command
      .add_option("--most-cycles", arguments->options.most_cycles,
                  "slow cycles after which the motion is given up; default 200")
      ->range(1, 1000000)
      ->group(motion);
  add_quantity(command, "--tolerance", arguments->tolerance, Dimension::dimensionless,
               "of the amplitude of a slow cycle; default 0.01")
      ->group(motion);
  arguments->premises.add_to(command);
}

}  // namespace salebra::cli
