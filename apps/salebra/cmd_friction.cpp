// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra friction`: steady sliding under a normal oscillation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/steady_sliding.hpp>

#include "figures.hpp"
#include "first_loading.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct FrictionArguments {
  LawOptions law;
  MaterialOptions material;
  std::string hold = "indentation";
  std::vector<double> normal_amplitude, velocities, velocity_ratios, excursions;
  FrequencyOptions frequency;
  PremiseOptions premises;
};

// Steady sliding at one amplitude.
struct Sliding {
  double normal_amplitude = 0;
  std::vector<double> velocities;
  std::vector<SteadySliding> states;
};

std::vector<Sliding> sliding_at(const FrictionArguments& arguments, const ContactLaw& law,
                                const Position& position, double omega, double friction) {
  DampingOptions options;
  options.hold = *value_of<Hold>(arguments.hold);
  std::vector<Sliding> all;
  for (const double amplitude : arguments.normal_amplitude) {
    const NormalOscillation normal{amplitude, omega};
    Sliding& one = all.emplace_back(Sliding{amplitude, arguments.velocities, {}});
    if (!arguments.velocity_ratios.empty()) {
      require_positive(amplitude, "--normal-amplitude");
      const double any[] = {amplitude * omega};
      const double critical =
          steady_sliding(law, position, normal, any, friction, options).front().critical_velocity;
      for (const double ratio : arguments.velocity_ratios)
        one.velocities.push_back(ratio * critical);
    }
    one.states = steady_sliding(law, position, normal, one.velocities, friction, options);
    if (const auto lost = std::ranges::count(one.states, false, &SteadySliding::converged);
        lost > 0)
      throw NotConverged(fmt::format("friction: {} of {} integrals did not reach the tolerance",
                                     lost, one.states.size()));
  }
  return all;
}

// Columns of the amplitude alone; the others depend on the velocity too.
constexpr std::string_view of_amplitude[]{"mean_force", "critical_velocity",
                                          "static_friction_coefficient", "low_speed_damping",
                                          "relaxation_damping"};

// A row for each amplitude and velocity.
ResultTable sliding_table(const std::vector<Sliding>& all, const FrictionArguments& arguments) {
  std::vector<double> amplitudes, velocities, ratios;
  std::vector<SteadySliding> states;
  for (const Sliding& one : all) {
    amplitudes.insert(amplitudes.end(), one.states.size(), one.normal_amplitude);
    velocities.insert(velocities.end(), one.velocities.begin(), one.velocities.end());
    ratios.insert(ratios.end(), arguments.velocity_ratios.begin(), arguments.velocity_ratios.end());
    states.insert(states.end(), one.states.begin(), one.states.end());
  }
  ResultTable table{.name = "sliding", .columns = {}};
  if (all.size() > 1) table.columns.push_back({"normal_amplitude", amplitudes});
  table.columns.push_back({"velocity", velocities});
  if (!ratios.empty()) table.columns.push_back({"velocity_ratio", ratios});
  for (ResultColumn& column : table_of("sliding", states).columns)
    if (all.size() > 1 || std::ranges::find(of_amplitude, column.name) == std::end(of_amplitude))
      table.columns.push_back(std::move(column));
  return table;
}

// A row for each velocity and excursion.
ResultTable regime_table(const RegimeMap& map) {
  ResultTable table{.name = "regime_map", .columns = {}};
  for (const char* name : {"velocity", "excursion", "loss_ratio", "slip_ratio", "regime"})
    table.columns.push_back({name, {}});
  for (std::size_t i = 0; i < map.velocity.size(); ++i)
    for (std::size_t j = 0; j < map.excursion.size(); ++j) {
      const double row[] = {map.velocity[i], map.excursion[j], map.loss_ratio(Index(i), Index(j)),
                            map.slip_ratio(Index(i), Index(j)), double(map.regime[i][j])};
      for (std::size_t k = 0; k < std::size(row); ++k) table.columns[k].values.push_back(row[k]);
    }
  return table;
}

Figure sliding_figure(const Sliding& sliding, double friction) {
  const std::vector<double>& velocities = sliding.velocities;
  PlotCurve mean{.name = "computed", .x = velocities},
      slow{.name = "static friction and Γv", .x = velocities};
  slow.style = PlotStyle::dashed;
  PlotCurve total{.name = "whole", .x = velocities}, opening{.name = "levels that open"};
  opening.x = velocities;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const SteadySliding& one = sliding.states[i];
    mean.y.push_back(one.friction_coefficient);
    const double linear =
        one.static_friction_coefficient + one.low_speed_damping * velocities[i] / one.mean_force;
    slow.y.push_back(std::min(linear, friction));
    total.y.push_back(one.relaxation_work + one.slip_work);
    opening.y.push_back(one.relaxation_work);
  }
  const PlotAxis x = axis_of("velocity", spans_decades(velocities));
  Figure figure;
  figure.columns = 2;
  figure.panels.push_back({.title = "Friction coefficient of steady sliding",
                           .x = x,
                           .y = {.label = "mean tangential over mean normal force"},
                           .legend = PlotLegend::top_left});
  figure.panels.back().curves = {mean, slow};
  figure.panels.push_back({.title = "Energy dissipated in a normal cycle",
                           .x = x,
                           .y = {.label = "W", .unit = "J", .logarithmic = spans_decades(total.y)},
                           .legend = PlotLegend::top_left});
  figure.panels.back().curves = {total, opening};
  return figure;
}

Figure amplitude_figure(const std::vector<Sliding>& all, const FrictionArguments& arguments) {
  const bool relative = !arguments.velocity_ratios.empty();
  const std::vector<double>& along = relative ? arguments.velocity_ratios : arguments.velocities;
  Figure figure;
  figure.columns = 2;
  const auto panel = [&](const char* title, PlotAxis scale, double SteadySliding::*member) {
    PlotImage image{.x = along, .y = arguments.normal_amplitude, .scale = std::move(scale)};
    image.values = Field(Index(along.size()), Index(all.size()));
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j) {
        const double value = all[j].states[i].*member;
        image.values(Index(i), Index(j)) =
            image.scale.logarithmic && !(value > 0) ? ContactFacts::unknown : value;
      }
    figure.panels.push_back(
        {.title = title,
         .x = axis_of(relative ? "velocity_ratio" : "velocity", spans_decades(along)),
         .y = axis_of("normal_amplitude", spans_decades(arguments.normal_amplitude)),
         .image = std::move(image)});
  };
  panel("Friction coefficient of steady sliding", {.label = "mean T / mean F"},
        &SteadySliding::friction_coefficient);
  panel("Growth of friction with velocity",
        {.label = "dT/dv", .unit = "N s/m", .logarithmic = true}, &SteadySliding::sliding_damping);
  return figure;
}

Figure regime_figure(const RegimeMap& map, double omega) {
  Figure figure;
  PlotPanel& panel = figure.panels.emplace_back();
  panel.title = "Loss of a slow oscillation over that without slip";
  const auto axis = [](const char* label, const char* unit, const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return PlotAxis{label, unit, spans_decades(values), low, high};
  };
  panel.x = axis("velocity v", "m/s", map.velocity);
  panel.y = axis("excursion X", "m", map.excursion);
  panel.image =
      PlotImage{.x = map.velocity,
                .y = map.excursion,
                .values = map.loss_ratio,
                .scale = {.label = "W / W(no slip)", .logarithmic = true, .low = 1, .high = 1e3}};
  PlotCurve no_slip{.name = "no slip below", .x = map.velocity, .color = 6};
  PlotCurve sliding{.name = "sliding above", .x = map.velocity, .color = 1};
  PlotCurve cycle{.name = "one normal cycle", .x = map.velocity, .color = 7};
  cycle.style = PlotStyle::dashed;
  for (std::size_t i = 0; i < map.velocity.size(); ++i) {
    cycle.y.push_back(2 * std::numbers::pi * map.velocity[i] / omega);
    no_slip.y.push_back(map.no_slip_excursion[i] > cycle.y.back() ? map.no_slip_excursion[i]
                                                                  : ContactFacts::unknown);
    sliding.y.push_back(std::max(map.sliding_excursion, cycle.y.back()));
  }
  PlotCurve critical{.name = "v_c", .style = PlotStyle::dotted, .color = 6};
  if (map.critical_velocity > *panel.x.low && map.critical_velocity < *panel.x.high) {
    critical.x.assign(2, map.critical_velocity);
    critical.y = {*panel.y.low, *panel.y.high};
  }
  for (PlotCurve* curve : {&no_slip, &sliding, &cycle, &critical})
    if (std::ranges::any_of(curve->y, [](double y) { return std::isfinite(y); }))
      panel.curves.push_back(*curve);
  panel.legend = PlotLegend::bottom_right;
  return figure;
}

void check(const FrictionArguments& arguments) {
  std::vector<std::string> missing;
  if (!arguments.premises.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (arguments.normal_amplitude.empty()) missing.emplace_back("--normal-amplitude");
  if (!arguments.frequency.given()) missing.emplace_back("--frequency");
  if (arguments.velocities.empty() && arguments.velocity_ratios.empty())
    missing.emplace_back("--velocities (or --velocity-ratios)");
  require_options(missing, "sliding under an oscillation");
  require_that(arguments.velocities.empty() || arguments.velocity_ratios.empty(),
               "--velocity-ratios", "given together with --velocities; give one of them");
  for (const double velocity : arguments.velocities) require_positive(velocity, "--velocities");
  for (const double ratio : arguments.velocity_ratios) require_positive(ratio, "--velocity-ratios");
  for (const double excursion : arguments.excursions) require_positive(excursion, "--excursions");
  require(arguments.excursions.empty() || arguments.normal_amplitude.size() == 1, "--excursions",
          arguments.excursions.size(),
          "are a second axis in addition to the velocities; give one --normal-amplitude");
  require_positive(*arguments.premises.friction_coefficient, "--friction-coefficient");
}

void run(const FrictionArguments& arguments, Session& session) {
  check(arguments);
  require_tables(session, {"sliding", "regime_map"});
  const std::size_t velocities = arguments.velocities.size() + arguments.velocity_ratios.size();
  require(!session.has_plot() || arguments.excursions.empty() ||
              (velocities > 1 && arguments.excursions.size() > 1),
          "--plot", fmt::format("{} by {} values", velocities, arguments.excursions.size()),
          "are no map; give several velocities and several --excursions");
  const double friction = *arguments.premises.friction_coefficient;
  const double omega = arguments.frequency.angular().front();
  const ContactAnswer contact =
      arguments.law.contact(arguments.material, session, arguments.premises.hardness,
                            std::ranges::max(arguments.normal_amplitude, {},
                                             [](double amplitude) { return std::abs(amplitude); }));
  require(contact.positions.size() == 1, "--normal-force",
          fmt::format("{} positions", contact.positions.size()),
          "are given; friction takes one, and several --velocities");
  const Position& position = contact.positions.front();
  const std::vector<Sliding> sliding =
      sliding_at(arguments, *contact.law, position, omega, friction);

  const Sliding& first = sliding.front();
  const SteadySliding& any = first.states.front();
  Json answer = Json::object();
  if (sliding.size() == 1) {
    const Json whole = json_of(any);
    for (const std::string_view name : of_amplitude) answer[name] = whole[name];
  }
  std::vector<ResultTable> tables{sliding_table(sliding, arguments)};
  RegimeMap map;
  if (!arguments.excursions.empty()) {
    map = regime_map(*contact.law, any.indentation, {first.normal_amplitude, omega},
                     first.velocities, arguments.excursions, friction);
    answer.add(json_of(map));
    tables.front().columns.push_back({"no_slip_excursion", map.no_slip_excursion});
    tables.push_back(regime_table(map));
  }
  write_tables(session, "friction", answer, tables);
  for (const ResultColumn& column : tables.front().columns) answer[column.name] = column.values;
  add_first_loading(answer, contact.first_loading);
  const std::string text = to_text(answer);
  if (tables.size() > 1) {
    answer = with_tables(answer, {tables.back()});
    Json& regimes = answer["regime_map"]["regime"] = Json::array();
    for (const std::vector<Regime>& row : map.regime)
      for (const Regime regime : row) regimes.push_back(std::string(word_of(regime)));
  }
  if (session.has_plot())
    session.plot(!arguments.excursions.empty() ? regime_figure(map, omega)
                 : sliding.size() > 1          ? amplitude_figure(sliding, arguments)
                                               : sliding_figure(first, friction));
  PremiseReport premises{.list = sliding.size() > 1};
  const ContactFacts known = arguments.premises.facts(arguments.material);
  for (const Sliding& one : sliding) {
    const double indentation = one.states.front().indentation;
    const Drag motion{one.normal_amplitude, one.velocities.back(), omega};
    premises.cases.push_back(premises_beside_slip(*contact.law, indentation, motion,
                                                  contact.facts_at(known, indentation))
                                 .cases.front());
  }
  premises.answer(session, answer, text);
}

}  // namespace

void add_friction_command(Program& program) {
  auto arguments = std::make_shared<FrictionArguments>();
  Command& command = program.add_command(
      "friction", "steady sliding under a normal oscillation",
      {"salebra friction --law parabola --radius 10mm --indentation 1um --contact-modulus 1GPa "
       "--poisson 0.3 --friction-coefficient 0.4 --normal-amplitude 10:500nm:40 --frequency 20kHz "
       "--velocity-ratios 0.01:2:40 --plot friction.png",
       "salebra friction --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz --velocities "
       "1nm/s:10mm/s:60 --excursions 1pm:1um:60 -o regimes.csv --plot regimes.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "regimes with --excursions; friction over velocity, or over velocity and amplitude",
      OutputCheck::any_name);
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  const std::string motion = "Motion";
  add_values(command, "--velocities", arguments->velocities, Dimension::velocity,
             "of sliding, > 0: one, a list or a range")
      ->group(motion);
  add_values(command, "--velocity-ratios", arguments->velocity_ratios, Dimension::dimensionless,
             "v/v_c, instead of --velocities")
      ->group(motion);
  add_values(command, "--excursions", arguments->excursions, Dimension::length,
             "X of slow oscillations between turning points, to map no slip, partial slip and "
             "sliding over the velocities")
      ->group(motion);
  add_values(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length,
             "u_z; a map over amplitudes where it is a list or a range")
      ->group(motion);
  arguments->frequency.add_to(command, motion, true);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "what stays in the mean; default indentation")
      ->group(motion);
  arguments->premises.add_to(command, false);
}

}  // namespace salebra::cli
