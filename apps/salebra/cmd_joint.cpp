// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra joint`: partial slip under a tangential oscillation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/joint.hpp>
#include <salebra/questions/damping.hpp>

#include "figures.hpp"
#include "first_loading.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "result_tables.hpp"

namespace salebra::cli {
namespace {

struct JointArguments {
  LawOptions law;
  MaterialOptions material;
  std::vector<double> tangential_forces, tangential_amplitudes;
  std::optional<double> normal_amplitude, phase, nominal_area, frequency;
  int steps = 2000;
  std::optional<int> direct_steps;
  PremiseOptions premises;
};

Figure joint_figure(const std::vector<JointLoss>& losses, const SampledMotion& path,
                    const TrajectoryDamping& loop) {
  std::vector<double> force, amplitude, work;
  for (const JointLoss& one : losses) {
    force.push_back(one.tangential_force);
    amplitude.push_back(one.tangential_amplitude);
    work.push_back(one.work_per_cycle);
  }
  Figure figure;
  figure.columns = 2;
  figure.panels.push_back({.title = "Energy dissipated in a cycle",
                           .x = axis_of("tangential_force", spans_decades(force)),
                           .y = {.label = "W", .unit = "J", .logarithmic = spans_decades(work)}});
  figure.panels.back().curves = {{.name = "W", .x = force, .y = work}};
  figure.panels.push_back({.title = "Loop of the largest motion, and backbone",
                           .x = {.label = "x", .unit = "m"},
                           .y = {.label = "T", .unit = "N"},
                           .legend = PlotLegend::top_left});
  figure.panels.back().curves = {
      {.name = "loop", .x = path.displacement, .y = loop.tangential_force},
      {.name = "backbone", .x = amplitude, .y = force, .style = PlotStyle::dashed}};
  return figure;
}

// Every motion once more, cell by cell, at the same indentation.
std::vector<JointLoss> simulate(const JointArguments& arguments, const ContactAnswer& contact,
                                const std::vector<TangentialOscillation>& motions,
                                double indentation, Session& session) {
  const Material material = arguments.material.material_with_tangential_modulus();
  const PressureLevels levels =
      boundary_element_pressures(*contact.surface, material.contact_modulus);
  CycleOptions options{.friction_coefficient = *arguments.premises.friction_coefficient,
                       .steps = *arguments.direct_steps,
                       .max_periods = 20};
  options.on_progress = session.progress();
  std::vector<JointLoss> losses;
  for (const TangentialOscillation& motion : motions) {
    losses.push_back(simulated_joint_loss(levels, contact.surface->grid, material, indentation,
                                          motion, arguments.normal_amplitude.value_or(0),
                                          arguments.phase.value_or(0), options));
    if (interrupted()) throw Interrupted("joint: stopped before all motions were done");
  }
  if (const auto lost = std::ranges::count(losses, false, &JointLoss::converged); lost > 0)
    throw NotConverged(
        fmt::format("joint: {} of {} motions cell by cell did not converge to a steady loss", lost,
                    losses.size()));
  return losses;
}

void run(const JointArguments& arguments, Session& session) {
  const bool direct = arguments.direct_steps.has_value();
  require_tables(session, direct ? std::vector<std::string>{"motions", "direct"}
                                 : std::vector<std::string>{"motions"});
  require(!direct || arguments.law.surface.given(), "--direct-steps",
          arguments.direct_steps.value_or(0), "is of a surface cell by cell; give --surface");
  std::vector<std::string> missing;
  if (!arguments.premises.friction_coefficient) missing.emplace_back("--friction-coefficient");
  if (arguments.tangential_forces.empty() && arguments.tangential_amplitudes.empty())
    missing.emplace_back("--tangential-forces or --tangential-amplitudes");
  require_options(missing, "a joint");
  require_that(arguments.tangential_forces.empty() || arguments.tangential_amplitudes.empty(),
               "--tangential-amplitudes",
               "given together with --tangential-forces; give one of them");
  require(!arguments.phase || arguments.normal_amplitude, "--phase", arguments.phase.value_or(0),
          "is that of a normal oscillation; give --normal-amplitude");
  if (arguments.frequency) require_positive(*arguments.frequency, "--frequency");
  if (arguments.nominal_area) require_positive(*arguments.nominal_area, "--nominal-area");
  const double friction = *arguments.premises.friction_coefficient;
  require_positive(friction, "--friction-coefficient");
  const ContactAnswer contact =
      arguments.law.contact(arguments.material, session, arguments.premises.hardness,
                            std::abs(arguments.normal_amplitude.value_or(0)));
  require(contact.positions.size() == 1, "--normal-force",
          fmt::format("{} positions", contact.positions.size()),
          "are given; joint takes one, and several tangential forces or amplitudes");
  const Position& position = contact.positions.front();
  const ContactLaw& law = *contact.law;

  const bool oscillates = arguments.normal_amplitude && *arguments.normal_amplitude != 0;
  const double phase = arguments.phase.value_or(0);
  std::vector<TangentialOscillation> motions;
  for (const double force : arguments.tangential_forces)
    motions.emplace_back(TangentialForce{force});
  for (const double amplitude : arguments.tangential_amplitudes)
    motions.emplace_back(TangentialAmplitude{amplitude});
  std::vector<JointLoss> losses;
  const Progress progress = session.progress();
  const auto of_all = [&](ProgressReport report) {
    report.fraction = (double(losses.size()) + report.fraction) / double(motions.size());
    return progress(report);
  };
  if (contact.surface && !oscillates)
    losses =
        surface_joint_loss(*contact.surface, arguments.material.material_with_tangential_modulus(),
                           law, position, motions, friction, progress);
  else
    for (const TangentialOscillation& motion : motions)
      losses.push_back(oscillates
                           ? joint_loss(law, position, motion, friction,
                                        *arguments.normal_amplitude, phase, arguments.steps, of_all)
                           : joint_loss(law, position, motion, friction));
  if (const auto lost = std::ranges::count(losses, false, &JointLoss::converged); lost > 0)
    throw NotConverged(
        fmt::format("joint: {} of {} integrals did not reach the tolerance", lost, losses.size()));

  if (contact.surface && oscillates)
    session.note(
        "the loss is that of a law through some loads: its error is not known while the "
        "normal force oscillates");
  if (const auto lost = std::ranges::count_if(
          losses, [](const JointLoss& one) { return std::isnan(one.work_per_cycle); });
      lost > 0)
    session.note(
        fmt::format("n/a at {} of {} motions: the error of the loss is larger than the "
                    "loss, because too few cells part where the joint slips; a finer "
                    "surface helps",
                    lost, losses.size()));
  const double indentation = losses.front().indentation;
  const double area =
      arguments.nominal_area.value_or(contact.curve ? contact.curve->nominal_area : 0);
  Json answer = {{"force", law.force(indentation)},
                 {"indentation", indentation},
                 {"normal_stiffness", law.normal_stiffness(indentation)},
                 {"tangential_stiffness", law.tangential_stiffness(indentation)}};
  std::vector<ResultTable> tables{table_of("motions", losses, area)};
  if (direct)
    tables.push_back(
        table_of("direct", simulate(arguments, contact, motions, indentation, session), area));
  write_tables(session, "joint", answer, tables);
  for (const ResultColumn& column : tables.front().columns) answer[column.name] = column.values;
  if (direct)
    for (const ResultColumn& column : tables.back().columns)
      answer["direct"][column.name] = column.values;

  const JointLoss& largest =
      *std::ranges::max_element(losses, {}, &JointLoss::tangential_amplitude);
  const EqualFrequency motion{arguments.normal_amplitude.value_or(0), largest.tangential_amplitude,
                              phase, 2 * std::numbers::pi * arguments.frequency.value_or(0)};
  if (session.has_plot()) {
    const DampingCycle largest_cycle =
        cycle_of(law, motion, indentation, arguments.steps, friction, session.context());
    session.plot(joint_figure(losses, largest_cycle.path, largest_cycle.loss));
  }
  add_first_loading(answer, contact.first_loading);
  // A constant normal force is the limit of small normal amplitudes.
  EqualFrequency judged = motion;
  if (!oscillates)
    judged.normal_amplitude = 1e-6 * law.force(indentation) / law.normal_stiffness(indentation);
  const ContactFacts known = arguments.premises.facts(arguments.material);
  PremiseReport{{contact.premises_beside_slip(indentation, judged, known)}}.answer(session, answer);
}

}  // namespace

void add_joint_command(Program& program) {
  auto arguments = std::make_shared<JointArguments>();
  Command& command = program.add_command(
      "joint", "partial slip under a tangential oscillation",
      {"salebra joint --law paraboloid --radius 10mm --normal-force 10 --contact-modulus 115GPa "
       "--poisson 0.3 --friction-coefficient 0.3 --tangential-forces 0.1:2.9N:12 --plot joint.png",
       "salebra joint --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--friction-coefficient 0.3 --tangential-amplitudes 1:50nm:8 --nominal-area 1mm2 -o "
       "joint.csv"},
      [arguments](Session& session) { run(*arguments, session); },
      "loss over force, loop and backbone", OutputCheck::any_name);
  arguments->law.add_to(command);
  arguments->material.add_to(command);
  add_quantity(command, "--nominal-area", arguments->nominal_area, Dimension::length_squared,
               "for results per area too; default: that of --curve");
  command.under("Motion");
  add_values(command, "--tangential-forces", arguments->tangential_forces, Dimension::force,
             "T of an oscillation between -T and T: one, a list or a range");
  add_values(command, "--tangential-amplitudes", arguments->tangential_amplitudes,
             Dimension::length, "x of an oscillation between -x and x, instead");
  add_quantity(command, "--normal-amplitude", arguments->normal_amplitude, Dimension::length,
               "u_z; without it the normal force is constant");
  add_quantity(command, "--phase", arguments->phase, Dimension::angle,
               "of the tangential motion against the normal one; default 0");
  command
      .add_option("--steps", arguments->steps, "in a cycle with a normal oscillation; default 2000")
      ->range(16, 10000000);
  command
      .add_option("--direct-steps", arguments->direct_steps,
                  "simulates each motion cell by cell too, with so many steps in a cycle; of "
                  "--surface")
      ->range(16, 100000);
  add_quantity(command, "--frequency", arguments->frequency, Dimension::frequency,
               "in Hz, to judge inertia");
  arguments->premises.add_to(command, false);
}

}  // namespace salebra::cli
