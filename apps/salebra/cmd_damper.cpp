// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra damper`: damping constant as a damper, decay of an oscillator, stability border.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/damper.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/quantity_group.hpp>

#include "figures.hpp"
#include "first_loading.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct DamperArguments {
  LawOptions law;
  MaterialOptions material;
  std::string amplitude = "finite", hold = "indentation";
  std::vector<double> normal_amplitude;
  FrequencyOptions frequency;
  std::optional<double> mass, spring_stiffness, falling_slope, largest_amplitude, drag_velocity;
  PremiseOptions premises;
};

void write_map(const DamperMap& map, const std::optional<double>& falling_slope,
               const Session& session) {
  ResultFile file(session.output(), session.provenance(), session.write_options());
  QuantityGroup group(file.group("damper"));
  group.coordinate("normal_amplitude", map.normal_amplitude);
  group.coordinate("angular_frequency", map.angular_frequency);
  group.dataset("damping_constant", map.damping_constant, "normal_amplitude", "angular_frequency");
  if (falling_slope) {
    std::vector<bool> stable;
    for (Index i = 0; i < map.damping_constant.rows(); ++i)
      for (Index j = 0; j < map.damping_constant.cols(); ++j)
        stable.push_back(map.damping_constant(i, j) >= *falling_slope);
    group.plain().flags("stable", stable, {"normal_amplitude", "angular_frequency"},
                        "steady sliding is stable");
    group.scalar("falling_slope", *falling_slope);
  }
  file.commit();
}

// γ: a number, a row over the one quantity that varies, or rows over frequencies for each
// amplitude.
Json constants(const DamperMap& map) {
  Json rows = Json::array();
  for (Index i = 0; i < map.damping_constant.rows(); ++i) {
    Json row = Json::array();
    for (Index j = 0; j < map.damping_constant.cols(); ++j)
      row.push_back(map.damping_constant(i, j));
    rows.push_back(row.size() == 1 ? row[0] : row);
  }
  return rows.size() == 1 ? rows[0] : rows;
}

// For people, a map is a row for each pair of amplitude and frequency: in one table with the list
// of amplitudes and that of frequencies, each amplitude would stand beside a frequency it has
// nothing to do with.
std::string text_of(const Json& answer, const DamperMap& map) {
  Json pairs = Json::array();
  for (std::size_t i = 0; i < map.normal_amplitude.size(); ++i)
    for (std::size_t j = 0; j < map.angular_frequency.size(); ++j)
      pairs.push_back({{"normal_amplitude", map.normal_amplitude[i]},
                       {"angular_frequency", map.angular_frequency[j]},
                       {"damping_constant", map.damping_constant(Index(i), Index(j))}});
  std::string text = to_text(Json{{"map", pairs}});
  if (answer.contains("stabilising_amplitude"))
    text += "\n" + to_text(Json{{"angular_frequency", answer["angular_frequency"]},
                                {"stabilising_amplitude", answer["stabilising_amplitude"]}});
  return text;
}

// The least amplitude that stabilises, over frequency.
void add_border(Figure& figure, const std::vector<double>& omega,
                const std::vector<double>& least) {
  PlotCurve border{.y = least, .style = PlotStyle::line_and_points, .color = 1};
  for (const double value : omega) border.x.push_back(value / (2 * std::numbers::pi));
  const bool any = std::ranges::any_of(least, [](double value) { return std::isfinite(value); });
  if (!any) return;
  PlotPanel& panel = figure.panels.emplace_back();
  panel.title = "Least amplitude that stabilises";
  panel.x = {.label = "frequency ω / 2π", .unit = "Hz", .logarithmic = spans_decades(border.x)};
  panel.y = {.label = "normal amplitude u_z", .unit = "m", .logarithmic = true};
  panel.curves.push_back(border);
}

// Judges each amplitude at the highest frequency: slip does not depend on it, inertia grows with
// it.
PremiseReport premises_of_map(const DamperArguments& arguments, const ContactAnswer& contact,
                              const std::vector<double>& omega, const DampingOptions& options) {
  const ContactFacts facts = arguments.premises.facts(arguments.material);
  if (arguments.drag_velocity) require_positive(*arguments.drag_velocity, "--drag-velocity");
  PremiseReport report{.list = arguments.normal_amplitude.size() > 1};
  for (const double amplitude : arguments.normal_amplitude) {
    Drag motion{amplitude, 0, std::ranges::max(omega)};
    const double indentation =
        relaxation_damping(*contact.law, contact.positions.front(), motion, options).indentation;
    motion.drag_velocity = arguments.drag_velocity.value_or(ContactFacts::unknown);
    report.cases.push_back(
        premises_of(*contact.law, indentation, motion, contact.facts_at(facts, indentation)));
  }
  return report;
}

void run(const DamperArguments& arguments, Session& session) {
  const auto& amplitudes = arguments.normal_amplitude;
  const ContactAnswer contact =
      arguments.law.contact(arguments.material, session, arguments.premises.hardness,
                            amplitudes.empty() ? 0 : std::ranges::max(amplitudes));
  require(contact.positions.size() == 1, "--normal-force",
          fmt::format("{} positions", contact.positions.size()),
          "are given; damper takes one, salebra damping takes ranges");
  const Position& position = contact.positions.front();
  if (!arguments.frequency.given()) require_options({"--frequency"}, "a damper");
  const std::vector<double> omega = arguments.frequency.angular();
  DampingOptions options;
  options.hold = *value_of<Hold>(arguments.hold);
  options.amplitude = *value_of<Amplitude>(arguments.amplitude);
  options.on_progress = session.progress();
  const bool one = arguments.normal_amplitude.size() == 1 && omega.size() == 1;

  Json object;
  Figure figure;
  DamperMap map;
  const PremiseReport premises = premises_of_map(arguments, contact, omega, options);
  if (arguments.normal_amplitude.size() > 1)
    object["normal_amplitude"] = arguments.normal_amplitude;
  if (omega.size() > 1) object["angular_frequency"] = omega;
  if (!arguments.normal_amplitude.empty()) {
    map = damper_map(*contact.law, position, arguments.normal_amplitude, omega, options);
    object["damping_constant"] = constants(map);
    if (session.has_output()) write_map(map, arguments.falling_slope, session);
    if (!one) figure = damper_figure(map, arguments.falling_slope);
  } else {
    require_that(arguments.falling_slope.has_value(), "--normal-amplitude",
                 "missing; give it, or --falling-slope to have it computed");
    require(!session.has_output(), "--output", session.output().string(),
            "is for a map over --normal-amplitude and --frequency");
  }
  if (arguments.mass) {
    require(one, "--mass", *arguments.mass, "kg needs one --normal-amplitude and one --frequency");
    const OscillatorDecay decay = oscillator_decay(
        *contact.law, position, {arguments.normal_amplitude.front(), omega.front()},
        {*arguments.mass, arguments.spring_stiffness.value_or(0)}, options);
    object["decay"] = json_of(decay);
    figure.panels.push_back(decay_panel(decay));
  } else {
    require_that(!arguments.spring_stiffness, "--spring-stiffness",
                 "given, but there is no --mass to oscillate");
  }
  if (arguments.falling_slope) {
    require_positive(*arguments.falling_slope, "--falling-slope");
    const double largest = arguments.largest_amplitude.value_or(
        arguments.normal_amplitude.empty() ? 1e-6 : std::ranges::max(arguments.normal_amplitude));
    std::vector<double> least;
    for (const double frequency : omega)
      least.push_back(stabilising_amplitude(*contact.law, position, frequency,
                                            *arguments.falling_slope, largest, options));
    object["stabilising_amplitude"] = least.size() == 1 ? Json(least[0]) : Json(least);
    if (omega.size() > 1) add_border(figure, omega, least);
  }
  if (session.has_plot()) {
    require_that(!figure.panels.empty(), "--plot",
                 "one number is no picture; give a range, --mass, or --falling-slope with several "
                 "frequencies");
    session.plot(figure);
  }
  add_first_loading(object, contact.first_loading);
  const bool pairs = map.normal_amplitude.size() > 1 && map.angular_frequency.size() > 1;
  const std::string text = pairs ? text_of(object, map) : to_text(object);
  if (premises.cases.empty()) return session.answer(object, text);
  premises.answer(session, object, text);
}

}  // namespace

void add_damper_command(Program& program) {
  auto arguments = std::make_shared<DamperArguments>();
  Command& command = program.add_command(
      "damper", "a contact under fast normal oscillation as a tunable damper",
      {"salebra damper --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 20nm --frequency 20kHz --mass 10g --spring-stiffness 1kN/m",
       "salebra damper --curve curve.h5 --pressure 10MPa --poisson 0.3 --normal-amplitude "
       "1:50nm:20 --frequency 1:100kHz:20 --falling-slope 5 --output map.h5 --plot map.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "γ over what varies, with the border of stability; the decay of the oscillator");
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  const std::string motion = "Normal oscillation (both may be ranges)";
  add_values(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length, "u_z")
      ->group(motion);
  arguments->frequency.add_to(command, motion);
  add_choice<Amplitude>(command, "--amplitude", arguments->amplitude,
                        "of the normal oscillation; default finite")
      ->group(motion);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "what stays in the mean; default indentation")
      ->group(motion);
  const std::string use = "Use";
  add_quantity(command, "--mass", arguments->mass, Dimension::mass,
               "of a tangential oscillator on the contact")
      ->group(use);
  add_quantity(command, "--spring-stiffness", arguments->spring_stiffness, Dimension::stiffness,
               "of its spring, without the contact")
      ->group(use);
  add_quantity(command, "--falling-slope", arguments->falling_slope, Dimension::damping,
               "b of a friction force that falls by b per velocity")
      ->group(use);
  add_quantity(command, "--largest-amplitude", arguments->largest_amplitude, Dimension::length,
               "to look for stability in; default the largest --normal-amplitude, or 1um")
      ->group(use);
  arguments->premises.add_to(command);
  add_quantity(command, "--drag-velocity", arguments->drag_velocity, Dimension::velocity,
               "of the slow motion that is damped, to judge slip")
      ->group("Premises");
}

}  // namespace salebra::cli
