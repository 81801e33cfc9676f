// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra friction`: steady sliding under a normal oscillation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/damping/steady_sliding.hpp>

#include "answer_file.hpp"
#include "figures.hpp"
#include "first_loading.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct FrictionArguments {
  LawOptions law;
  MaterialOptions material;
  std::string hold = "indentation";
  std::vector<double> velocities;
  std::optional<double> normal_amplitude;
  FrequencyOptions frequency;
  PremiseOptions premises;
};

Figure sliding_figure(const std::vector<SteadySliding>& sliding,
                      const std::vector<double>& velocities, double friction) {
  PlotCurve mean{.name = "computed", .x = velocities},
      slow{.name = "static friction and Γv", .x = velocities};
  slow.style = PlotStyle::dashed;
  PlotCurve total{.name = "whole", .x = velocities}, opening{.name = "levels that open"};
  opening.x = velocities;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    const SteadySliding& one = sliding[i];
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

void run(const FrictionArguments& arguments, Session& session) {
  std::vector<std::string> missing;
  if (!arguments.premises.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (!arguments.normal_amplitude) missing.emplace_back("--normal-amplitude");
  if (!arguments.frequency.given()) missing.emplace_back("--frequency");
  if (arguments.velocities.empty()) missing.emplace_back("--velocities");
  require_options(missing, "sliding under an oscillation");
  for (const double velocity : arguments.velocities) require_positive(velocity, "--velocities");
  const double friction = *arguments.premises.friction_coefficient;
  require_positive(friction, "--friction-coefficient");
  const LawOptions::Contact contact =
      arguments.law.contact(arguments.material, session, arguments.premises.hardness,
                            std::abs(*arguments.normal_amplitude));
  require(contact.positions.size() == 1, "--normal-force",
          fmt::format("{} positions", contact.positions.size()),
          "are given; friction takes one, and several --velocities");
  const Position& position = contact.positions.front();
  DampingOptions options;
  options.hold = *value_of<Hold>(arguments.hold);

  const Drag motion{*arguments.normal_amplitude, arguments.velocities.back(),
                    arguments.frequency.angular().front()};
  const std::vector<SteadySliding> sliding = steady_sliding(
      *contact.law, position, NormalOscillation{motion.normal_amplitude, motion.angular_frequency},
      arguments.velocities, friction, options);
  if (const auto lost = std::ranges::count(sliding, false, &SteadySliding::converged); lost > 0)
    throw NotConverged(fmt::format("friction: {} of {} integrals did not reach the tolerance", lost,
                                   sliding.size()));

  const SteadySliding& any = sliding.front();
  Json object = {{"mean_force", any.mean_force},
                 {"critical_velocity", any.critical_velocity},
                 {"static_friction_coefficient", any.static_friction_coefficient},
                 {"low_speed_damping", any.low_speed_damping},
                 {"relaxation_damping", any.relaxation_damping},
                 {"velocity", arguments.velocities}};
  const auto column = [&](const char* name, double SteadySliding::*member) {
    Json& all = object[name] = Json::array();
    for (const SteadySliding& one : sliding) all.push_back(one.*member);
  };
  column("mean_tangential_force", &SteadySliding::mean_tangential_force);
  column("friction_coefficient", &SteadySliding::friction_coefficient);
  column("sliding_damping", &SteadySliding::sliding_damping);
  column("relaxation_work", &SteadySliding::relaxation_work);
  column("slip_work", &SteadySliding::slip_work);
  for (const std::string& line : contact.doubts) session.warn(line);
  add_first_loading(object, contact.first_loading);
  write_answer(session, "friction", object);
  if (session.has_plot()) session.plot(sliding_figure(sliding, arguments.velocities, friction));
  const ContactFacts facts =
      contact.facts_at(arguments.premises.facts(arguments.material), any.indentation);
  premises_beside_slip(*contact.law, any.indentation, motion, facts).answer(session, object);
}

}  // namespace

void add_friction_command(Program& program) {
  auto arguments = std::make_shared<FrictionArguments>();
  Command& command = program.add_command(
      "friction", "steady sliding under a normal oscillation",
      {"salebra friction --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --normal-amplitude 30nm --frequency 20kHz --velocities "
       "10um/s,100um/s,1mm/s",
       "salebra friction --law parabola --radius 10mm --indentation 1um --contact-modulus 1GPa "
       "--poisson 0.3 --friction-coefficient 0.4 --normal-amplitude 300nm --frequency 20kHz "
       "--velocities 0.1:30mm/s:30 --plot friction.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "friction coefficient and loss over velocity");
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  const std::string motion = "Motion";
  add_values(command, "--velocities", arguments->velocities, Dimension::velocity,
             "of sliding, > 0: one, a list or a range")
      ->group(motion);
  add_quantity(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length, "u_z")
      ->group(motion);
  arguments->frequency.add_to(command, motion, true);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "what stays in the mean; default indentation")
      ->group(motion);
  arguments->premises.add_to(command);
}

}  // namespace salebra::cli
