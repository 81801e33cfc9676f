// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra mdr`: contact, stress map and friction map of an axisymmetric indenter.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/questions/contact.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/quantity_group.hpp>

#include "answer_file.hpp"
#include "figures.hpp"
#include "follow.hpp"
#include "indenter_options.hpp"
#include "options.hpp"
#include "plausibility.hpp"
#include "premise_options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct MdrArguments {
  IndenterOptions indenter;
  MaterialOptions material;
  MotionOptions motion;
  std::optional<double> indentation, force;
  std::vector<double> friction_numbers;
  std::string hold = "indentation", stress_map, friction_map;
  int phases = 256, radii = 400;
  FollowOptions follow;
  PremiseOptions premises;
};

void write_stress_map(const MdrArguments& arguments, const IndenterLaw& law, double indentation,
                      const Oscillation& motion, Session& session) {
  const StressMap map =
      stress_map(law, indentation, motion, arguments.phases, arguments.radii, session.progress());
  ResultFile file(arguments.stress_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("stress_map"));
  group.coordinate("angle", map.angle);
  group.coordinate("radial_position", map.radial_position);
  group.dataset("contact_radius", map.contact_radius, {"angle"});
  group.dataset("tangential_force", map.tangential_force, {"angle"});
  group.dataset("shear", map.shear, "angle", "radial_position");
  group.dataset("contact_pressure", map.contact_pressure, "angle", "radial_position");
  if (session.has_plot() && arguments.friction_map.empty())
    session.plot(stress_figure(law, indentation, motion, map));
  file.commit();
}

void write_friction_map(const MdrArguments& arguments, const IndenterLaw& law, double indentation,
                        const EqualFrequency& motion, Session& session) {
  std::vector<double> numbers = arguments.friction_numbers, phases;
  if (numbers.empty())
    for (int i = 0; i <= 24; ++i) numbers.push_back(std::pow(10.0, -1 + i / 8.0));
  for (int i = 1; i <= 18; ++i) phases.push_back(std::numbers::pi / 36 * i);
  const FrictionMap map =
      friction_map(law, indentation, motion.normal_amplitude, motion.tangential_amplitude, numbers,
                   phases, {.steps = arguments.follow.steps, .on_progress = session.progress()});
  ResultFile file(arguments.friction_map, session.provenance(), session.write_options());
  QuantityGroup group(file.group("friction_map"));
  group.coordinate("friction_number", numbers);
  group.coordinate("phase", phases);
  group.dataset("loss_ratio", map.loss_ratio, "friction_number", "phase");
  group.dataset("relaxation_ratio", map.relaxation_ratio, "friction_number", "phase");
  group.dataset("slip_ratio", map.slip_ratio, "friction_number", "phase");
  if (session.has_plot()) session.plot(friction_figure(map));
  file.commit();
}

void add_state(Json& object, const IndenterLaw& law, double indentation) {
  object["contact_radius"] = law.contact_radius(indentation);
  object["indentation"] = indentation;
  object["force"] = law.force(indentation);
  object["normal_stiffness"] = law.normal_stiffness(indentation);
  object["tangential_stiffness"] = law.tangential_stiffness(indentation);
  object["force_curvature"] = law.force_curvature(indentation);
}

void run(const MdrArguments& arguments, Session& session) {
  const Material material = arguments.material.material_with_tangential_modulus();
  const auto profile = arguments.indenter.indenter();
  const auto any_law = law_of(IndenterContact{profile, material, {}}, session.context());
  const auto& law = static_cast<const IndenterLaw&>(*any_law);
  const ContactFacts facts =
      arguments.premises.facts(arguments.material, arguments.follow.friction_coefficient);
  if (!arguments.follow.trajectory.empty()) {
    require(
        !arguments.indentation && !arguments.force && !arguments.motion.given(), "--trajectory",
        arguments.follow.trajectory,
        "is the whole motion; leave out --indentation, --normal-force and the options of Motion");
    follow_file(arguments.follow, law, facts, session);
    return;
  }
  require_one(arguments.indentation.has_value(), "--indentation", arguments.force.has_value(),
              "--normal-force");
  if (arguments.indentation) require_positive(*arguments.indentation, "--indentation");
  for (const std::string* path : {&arguments.stress_map, &arguments.friction_map})
    if (!path->empty()) require_output(*path, session.write_options());

  const double settled =
      arguments.indentation ? *arguments.indentation : law.indentation_of(*arguments.force);
  for (const std::string& line : doubts_of_profile(*profile, law.contact_radius(settled)))
    session.warn(line);
  Json object;
  if (arguments.motion.normal_amplitude.empty()) {
    require_that(!arguments.motion.given() && arguments.stress_map.empty() &&
                     arguments.friction_map.empty() && !arguments.follow.friction_coefficient,
                 "--normal-amplitude", "missing; a motion, maps and friction need it");
    add_state(object, law, settled);
    write_answer(session, "mdr", object);
    if (session.has_plot()) session.plot(contact_figure(law, settled));
    session.answer(object);
    return;
  }
  const std::vector<Motion> motions = arguments.motion.all_motions();
  const auto [quantity, values] = arguments.motion.varied();
  require(motions.size() == 1, quantity, fmt::format("{} values", values.size()),
          "are given, but mdr takes one motion; " + arguments.indenter.advice_for_ranges());
  const Motion& motion = motions.front();
  const auto* equal = std::get_if<EqualFrequency>(&motion);
  const auto* drag = std::get_if<Drag>(&motion);
  require(arguments.stress_map.empty() || equal || drag, "--stress-map", arguments.stress_map,
          "is of a single cycle; use --mode equal-frequency or drag");
  require(arguments.friction_map.empty() || equal, "--friction-map", arguments.friction_map,
          "is over the phase; use --mode equal-frequency");
  const DampingResult result =
      damping_of(law, AtIndentation{settled}, motion, {.hold = *value_of<Hold>(arguments.hold)});
  if (!result.converged) throw NotConverged("mdr: the integral did not reach the tolerance");
  add_state(object, law, result.indentation);
  const bool followed = arguments.follow.friction_coefficient.has_value();
  TrajectoryDamping loss;
  SampledMotion path;
  const bool mapped = !arguments.stress_map.empty() || !arguments.friction_map.empty();
  if (followed || (session.has_plot() && !mapped)) {
    path = sampled(motion, result.indentation, arguments.follow.steps);
    loss = follow(law, motion, path, arguments.follow.coefficient(), session.progress());
  }
  if (followed) {
    object.add(json_of(loss));
    object["full_stick_work"] = result.work_per_cycle;
  } else {
    object["work_per_cycle"] = result.work_per_cycle;
    object["power"] = result.power;
    object["damping_constant"] = result.damping_constant;
  }
  object["small_amplitude_work"] = result.small_amplitude_work;
  object["ratio"] =
      (followed ? loss.work_per_cycle : result.work_per_cycle) / result.small_amplitude_work;
  const ContactFacts known = at_state(facts, law, nullptr, result.indentation);
  const PremiseReport premises{{std::visit(
      [&](const auto& m) { return premises_of(law, result.indentation, m, known); }, motion)}};
  if (drag)
    for (const std::string& line : doubts_of_path(drag->drag_velocity, drag->angular_frequency,
                                                  law.contact_radius(result.indentation)))
      session.warn(line);
  write_answer(session, "mdr", object);
  if (session.has_plot() && !mapped) session.plot(cycle_figure(path, loss));
  if (!arguments.stress_map.empty())
    write_stress_map(arguments, law, result.indentation,
                     equal ? Oscillation(*equal) : Oscillation(*drag), session);
  if (!arguments.friction_map.empty())
    write_friction_map(arguments, law, result.indentation, *equal, session);
  premises.answer(session, object);
}

}  // namespace

void add_mdr_command(Program& program) {
  auto arguments = std::make_shared<MdrArguments>();
  Command& command = program.add_command(
      "mdr", "axisymmetric contact and its damping by the method of dimensionality reduction",
      {"salebra mdr --profile parabola --radius 10mm --indentation 1um --contact-modulus 1GPa "
       "--poisson 0.3 --mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm "
       "--phase 90deg --stress-map fig4.h5 --plot fig4.png",
       "salebra mdr --profile cone --angle 10deg --normal-force 1 --contact-modulus 1GPa --poisson "
       "0.3 "
       "--normal-amplitude 100nm --drag-velocity 1mm/s --frequency 20kHz --friction "
       "0.3"},
      [arguments](Session& session) { run(*arguments, session); },
      "the map that is asked for; else one period of the motion; else the contact at rest");
  arguments->indenter.add_to(command);
  const std::string position = "Position";
  add_quantity(command, "--indentation", arguments->indentation, Dimension::length,
               "from first touch")
      ->group(position);
  add_quantity(command, "--normal-force", arguments->force, Dimension::force, "normal force")
      ->group(position);
  add_choice<Hold>(command, "--hold", arguments->hold, "what stays fixed at finite amplitude")
      ->group(position);
  arguments->material.add_to(command);
  arguments->motion.add_to(command, true);
  arguments->follow.add_to(command);
  arguments->premises.add_to(command);
  const std::string more = "Maps";
  command
      .add_option("--stress-map", arguments->stress_map, "HDF5 file for stresses over r and phase")
      ->file(FileUse::output)
      ->group(more);
  command
      .add_option("--friction-map", arguments->friction_map,
                  "HDF5 file for W(mu)/W(infinity) over M and phase")
      ->file(FileUse::output)
      ->group(more);
  command.add_option("--map-phases", arguments->phases, "of the stress map; default 256")
      ->range(8, 100000)
      ->group(more);
  command.add_option("--map-radii", arguments->radii, "of the stress map; default 400")
      ->range(8, 100000)
      ->group(more);
  add_values(command, "--friction-numbers", arguments->friction_numbers, Dimension::dimensionless,
             "M of the map; default 0.1:100:25")
      ->group(more);
}

}  // namespace salebra::cli
