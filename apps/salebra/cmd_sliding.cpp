// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra sliding`: friction under a normal oscillation, in steady sliding or of a slider on a
// spring.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <numbers>
#include <salebra/analysis/sliding.hpp>
#include <salebra/base/error.hpp>
#include <salebra/figures/figures.hpp>

#include "assumption_options.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "results/answer_json.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct SlidingArguments {
  LawOptions law;
  MaterialOptions material;
  SlidingProblem sliding;
  FrequencyOptions frequency;
  std::string hold = "auto", start = "rest", direction = "auto";
  BodyOptions body;
  std::optional<double> support_damping, tolerance;
  std::optional<int> steps, max_cycles;
  AssumptionOptions assumptions;

  bool of_slider() const {
    return body.given() || support_damping || tolerance || steps || max_cycles || start != "rest";
  }
};

// Names of the columns that depend on the amplitude only. All other columns also depend on the
// velocity.
constexpr std::string_view of_amplitude[]{"mean_force",
                                          "critical_velocity",
                                          "static_friction_coefficient",
                                          "low_speed_damping",
                                          "relaxation_damping",
                                          "mean_force_error",
                                          "critical_velocity_error",
                                          "static_friction_coefficient_error",
                                          "low_speed_damping_error",
                                          "relaxation_damping_error"};

void check(const SlidingArguments& arguments) {
  const SlidingProblem& sliding = arguments.sliding;
  const bool slider = arguments.of_slider();
  std::vector<std::string> missing;
  if (!arguments.assumptions.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (slider && !arguments.body.mass) missing.emplace_back("--mass");
  if (slider && !arguments.body.spring_stiffness) missing.emplace_back("--spring-stiffness");
  if (!slider && sliding.normal_amplitude.empty()) missing.emplace_back("--normal-amplitude");
  const bool oscillates =
      std::ranges::any_of(sliding.normal_amplitude, [](double u) { return u != 0; });
  if ((oscillates || !slider) && !arguments.frequency.given()) missing.emplace_back("--frequency");
  if (sliding.velocities.empty() && (slider || sliding.velocity_ratios.empty()))
    missing.emplace_back(slider ? "--velocities" : "--velocities (or --velocity-ratios)");
  require_options(missing, slider ? "a slider" : "sliding under an oscillation");
  require_that(sliding.velocities.empty() || sliding.velocity_ratios.empty(), "--velocity-ratios",
               "given together with --velocities; give one of them");
  require_positive(*arguments.assumptions.friction_coefficient, "--friction-coefficient");
  arguments.law.at.require_one("sliding takes one");
  for (const auto& [option, values] : {std::pair{"--velocities", &sliding.velocities},
                                       {"--velocity-ratios", &sliding.velocity_ratios},
                                       {"--excursions", &sliding.excursions}})
    for (const double value : *values) require_positive(value, option);
  for (const auto& [option, values] : {std::pair{"--velocities", &sliding.velocities},
                                       {"--normal-amplitude", &sliding.normal_amplitude}})
    require(!slider || values->size() <= 1, option, values->size(),
            "values given; a slider takes one");
  require_that(!slider || sliding.excursions.empty(), "--excursions",
               "given, but it maps steady sliding; leave out the options of the slider");
  require_that(sliding.excursions.empty() || sliding.normal_amplitude.size() == 1, "--excursions",
               "given, but it maps a single amplitude; give one --normal-amplitude");
}

std::vector<ContactSolution> contacts_of(const SlidingArguments& arguments, Session& session) {
  double largest = 0;
  for (const double amplitude : arguments.sliding.normal_amplitude)
    largest = std::max(largest, std::abs(amplitude));
  std::vector<ContactSolution> contacts =
      arguments.law.contacts(arguments.material, session, arguments.assumptions.hardness, largest,
                             *parse_enum<Hold>(arguments.hold), arguments.direction);
  const ContactSolution& contact = contacts.front();
  const bool one =
      arguments.of_slider() || !arguments.sliding.excursions.empty() || session.has_plot();
  require(
      !one || contacts.size() == 1, "--direction", arguments.direction,
      "gives the directions across and along the lay; a slider, a regime map and a picture take "
      "one of them");
  if (contact.surface && arguments.of_slider())
    session.inform(
        "The error of the motion is not known: it is computed on a law through some loads of the "
        "surface, and within the error of that law another kind of motion is possible");
  if (contact.surface && !arguments.sliding.excursions.empty())
    session.inform(
        "The errors of the regimes and of no_slip_excursion are not known: they are computed on a "
        "law through some loads of the surface");
  return contacts;
}

// Rows of a table, one for each velocity and excursion of the map.
std::vector<RegimePoint> rows_of(const RegimeMap& map) {
  std::vector<RegimePoint> rows;
  for (std::size_t i = 0; i < map.velocity.size(); ++i)
    for (std::size_t j = 0; j < map.excursion.size(); ++j)
      rows.push_back({map.velocity[i], map.excursion[j], map.loss_ratio(Index(i), Index(j)),
                      map.slip_ratio(Index(i), Index(j)), static_cast<int>(map.regime[i][j])});
  return rows;
}

void add_assumptions(const SlidingSolution& found, const SlidingProblem& problem,
                     const ContactSolution& contact, const ContactParameters& known,
                     AssumptionReport& assumptions) {
  const std::size_t count = problem.normal_amplitude.size(),
                    velocities = found.points.size() / count;
  for (std::size_t k = 0; k < count; ++k) {
    const SlidingPoint& last = found.points[(k + 1) * velocities - 1];
    const Drag motion{last.normal_amplitude, last.velocity, problem.angular_frequency};
    assumptions.cases.push_back(
        contact.assumptions_beside_slip(last.state.indentation, motion, known));
  }
}

void slide(const SlidingArguments& arguments, Session& session) {
  require_tables(session, {"sliding", "regime_map"});
  SlidingProblem problem = arguments.sliding;
  const bool single = problem.normal_amplitude.size() == 1, maps = !problem.excursions.empty();
  const std::size_t velocities = problem.velocities.size() + problem.velocity_ratios.size();
  require(!session.has_plot() || !maps || (velocities > 1 && problem.excursions.size() > 1),
          "--plot", fmt::format("{} by {} values", velocities, problem.excursions.size()),
          "make no map; give several velocities and several --excursions");
  problem.friction_coefficient = *arguments.assumptions.friction_coefficient;
  problem.angular_frequency = arguments.frequency.angular().front();
  problem.hold = *parse_enum<Hold>(arguments.hold);
  const std::vector<ContactSolution> contacts = contacts_of(arguments, session);
  const ContactSolution& contact = contacts.front();
  SlidingSolution found;
  AssumptionReport assumptions;
  for (const ContactSolution& one : contacts) {
    SlidingSolution solution =
        solve(problem, one, one.surface ? arguments.material.body() : Body(Material{}),
              session.context());
    add_assumptions(solution, problem, one, arguments.assumptions.parameters(arguments.material),
                    assumptions);
    if (found.points.empty())
      found = std::move(solution);
    else
      std::ranges::move(solution.points, std::back_inserter(found.points));
  }
  assumptions.list = assumptions.cases.size() > 1;
  session.warn(found.warnings);

  Json answer = Json::object(), columns = Json::object(), all = json_of(found.points);
  arguments.material.add_datum_to(answer);
  // The direction is the first column of the rows that it distinguishes.
  if (contacts.size() > 1) columns["direction"] = all["direction"];
  columns.add(all);
  if (contacts.size() == 1 && columns.contains("direction")) {
    answer["direction"] = columns["direction"][0];
    columns.erase("direction");
  }
  if (single) columns.erase("normal_amplitude");
  if (single && contacts.size() == 1) {
    for (const std::string_view name : of_amplitude) {
      if (contact.surface || !name.ends_with("_error")) answer[name] = columns[name][0];
      columns.erase(std::string(name));
    }
  }
  std::vector<ResultTable> tables{table_of("sliding", columns)};
  if (maps) {
    answer.add(json_of(*found.regimes));
    tables.push_back(table_of("regime_map", rows_of(*found.regimes)));
  }
  write_tables(session, "friction", answer, tables);
  for (const ResultColumn& column : tables.front().columns) answer[column.name] = column.values;
  add_first_loading(answer, contact.first_loading);
  const std::string text = to_text(answer);
  if (maps) {
    answer = with_tables(answer, {tables.back()});
    Json& regimes = answer["regime_map"]["regime"] = Json::array();
    for (const std::vector<Regime>& row : found.regimes->regime)
      for (const Regime regime : row) regimes.push_back(std::string(name_of(regime)));
  }
  if (session.has_plot()) {
    figures::Figure figure = maps ? figures::figure_of(*found.regimes, problem.angular_frequency)
                             : !single
                                 ? figures::figure_of(found.points, problem)
                                 : figures::figure_of(found.points, problem.friction_coefficient);
    figure.caption += fmt::format(" µ = {:.3g}", problem.friction_coefficient);
    if (problem.normal_amplitude.size() == 1)
      figure.caption +=
          ", u_z = " + format_quantity(problem.normal_amplitude.front(), Dimension::length, 4);
    figure.caption +=
        fmt::format(", ω/2π = {}, mean force F = {}.",
                    format_quantity(problem.angular_frequency / (2 * std::numbers::pi),
                                    Dimension::frequency, 4),
                    format_quantity(found.points.front().state.mean_force, Dimension::force, 4));
    assumptions.state_in(figure);
    session.plot(figure);
  }
  assumptions.answer(session, answer, text);
}

SliderProblem slider_of(const SlidingArguments& arguments, Session& session) {
  const SlidingProblem& sliding = arguments.sliding;
  SliderProblem problem{
      .slider = {.mass = *arguments.body.mass,
                 .spring_stiffness = *arguments.body.spring_stiffness,
                 .velocity = sliding.velocities.front(),
                 .support_damping = arguments.support_damping.value_or(0),
                 .falling_slope = arguments.body.falling_slope.value_or(0)},
      .normal = {sliding.normal_amplitude.empty() ? 0 : sliding.normal_amplitude.front(),
                 arguments.frequency.given() ? arguments.frequency.angular().front() : 0},
      .friction_coefficient = *arguments.assumptions.friction_coefficient,
      .max_amplitude = arguments.body.max_amplitude};
  SliderOptions& options = problem.options;
  options.hold = *parse_enum<Hold>(arguments.hold);
  options.start = *parse_enum<SliderStart>(arguments.start);
  options.steps = arguments.steps.value_or(options.steps);
  options.tolerance = arguments.tolerance.value_or(options.tolerance);
  options.max_cycles = arguments.max_cycles.value_or(options.max_cycles);
  options.on_progress = session.progress();
  return problem;
}

void drag_slider(const SlidingArguments& arguments, Session& session) {
  require_tables(session, {"motion", "averaged_motion"});
  const SliderProblem problem = slider_of(arguments, session);
  const std::vector<ContactSolution> contacts = contacts_of(arguments, session);
  const ContactSolution& contact = contacts.front();
  const SliderSolution found = solve(problem, *contact.law, contact.points.front());

  Json answer = json_of(found.motion);
  if (!std::isnan(contact.direction())) answer["direction"] = contact.direction();
  arguments.material.add_datum_to(answer);
  answer["averaged"] = json_of(found.averaged);
  answer["mean_force"] = found.sliding.mean_force;
  const Json stability = json_of(found.stability);
  if (problem.normal.normal_amplitude > 0) {
    answer["critical_velocity"] = found.sliding.critical_velocity;
    answer.add(stability);
  } else {
    answer["stable"] = stability["stable"];
  }
  answer.add(answer_json(found.thresholds));
  add_first_loading(answer, contact.first_loading);
  write_tables(session, "slider", answer,
               {table_of("motion", lists_of(found.motion)),
                table_of("averaged_motion", lists_of(found.averaged))});
  const ContactParameters known = arguments.assumptions.parameters(arguments.material);
  const AssumptionReport assumptions{
      {contact.assumptions_beside_slip(found.sliding.indentation, found.judged, known)}};
  if (session.has_plot()) {
    figures::Figure figure =
        figures::figure_of(found.motion, found.averaged, problem.slider.spring_stiffness);
    figure.caption +=
        fmt::format(" µ = {:.3g}, V = {}, u_z = {}.", problem.friction_coefficient,
                    format_quantity(problem.slider.velocity, Dimension::velocity, 4),
                    format_quantity(problem.normal.normal_amplitude, Dimension::length, 4));
    assumptions.state_in(figure);
    session.plot(figure);
  }
  assumptions.answer(session, answer);
}

void run(const SlidingArguments& arguments, Session& session) {
  check(arguments);
  if (arguments.of_slider())
    drag_slider(arguments, session);
  else
    slide(arguments, session);
}

void add_slider(Command& command, SlidingArguments& arguments) {
  const Heading under(command, "Slider on a spring, instead of steady sliding");
  arguments.body.add_to(command,
                        "10 times the larger of --normal-amplitude and the amplitude at which the "
                        "oscillation begins to matter");
  add_quantity(command, "--support-damping", arguments.support_damping, Dimension::damping,
               "damping c of a dashpot in parallel with the spring; default 0");
  add_choice<SliderStart>(command, "--start", arguments.start,
                          "where the motion begins: at rest, on the point of slipping, or sliding "
                          "with a small disturbance; default rest");
  add_steps(command, arguments.steps,
            "steps per period of the oscillation, doubled until the tolerance is met; default 32")
      ->range(16, 100000);
  command
      .add_option("--max-cycles", arguments.max_cycles,
                  "maximum number of slow cycles until the motion repeats; default 200")
      ->range(1, 1000000);
  add_quantity(command, "--tolerance", arguments.tolerance, Dimension::dimensionless,
               "tolerance of the amplitude of a slow cycle; default 0.01");
}

}  // namespace

void add_sliding_command(Program& program) {
  auto arguments = std::make_shared<SlidingArguments>();
  Command& command = program.add_command(
      "sliding", "friction under vibration, and stick–slip of a slider",
      {"salebra sliding --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 10nm --frequency 20kHz --velocities "
       "1nm/s:10mm/s:60 --excursions 1pm:1um:60 -o regimes.csv --plot regimes.png",
       "salebra sliding --law exponential --normal-force 20mN --decay-length 30nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 2nm --frequency 20kHz --velocities 50um/s "
       "--mass 10g --spring-stiffness 1kN/m --falling-slope 1 --plot slider.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "friction over velocity, or over velocity and amplitude; regimes with --excursions; velocity "
      "and spring force over time with --mass",
      OutputCheck::any_name);
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  arguments->material.add_body_to(command, "with --surface, or a --curve of such a body");
  command.under("Motion");
  SlidingProblem& sliding = arguments->sliding;
  add_values(
      command, "--velocities", sliding.velocities, Dimension::velocity,
      "sliding velocities > 0: one, a list or a range; for a slider, the velocity of the drive");
  add_values(command, "--velocity-ratios", sliding.velocity_ratios, Dimension::dimensionless,
             "sliding velocities over the critical velocity v_c, instead of --velocities");
  add_values(command, "--excursions", sliding.excursions, Dimension::length,
             "distances X between the turning points of a slow oscillation, to map no slip, "
             "partial slip and sliding over the velocities");
  add_values(command, "--normal-amplitude", sliding.normal_amplitude, Dimension::length,
             "amplitude u_z of the normal motion; a list or a range gives a map over amplitudes; "
             "default 0 for a slider");
  add_direction(command, arguments->direction,
                "with --surface or --curve: direction of the sliding");
  arguments->frequency.add_to(command, "Motion", true);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "which mean value the oscillation keeps; default auto: the indentation, or the "
                   "force once the contact lifts off under a given load");
  add_slider(command, *arguments);
  arguments->assumptions.add_to(command, false);
}

}  // namespace salebra::cli
