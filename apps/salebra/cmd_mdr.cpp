// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/io/number_table.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/result_file.hpp>

#include "indenter_options.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct MdrArguments {
  IndenterOptions indenter;
  MaterialOptions material;
  MotionOptions motion;
  std::optional<double> indentation, force, friction;
  std::vector<double> friction_numbers;
  std::string hold = "indentation", stress_map, friction_map, trajectory;
  int steps = 2000;
};

void write_stress_map(const MdrArguments& arguments, const IndenterLaw& law, double indentation,
                      const Oscillation& motion, Session& session) {
  const StressMap map = stress_map(law, indentation, motion, 256, 400, session.progress());
  ResultFile file(arguments.stress_map, session.provenance(), session.write_options());
  ResultGroup group = file.group("stress_map");
  group.coordinate("angle", map.angle, "rad", "phase of the normal motion, 0 at its top");
  group.coordinate("radius", map.radius, "m", "distance from the axis");
  group.dataset("contact_radius", map.contact_radius, {"angle"}, "m", "contact radius");
  group.dataset("tangential_force", map.tangential_force, {"angle"}, "N", "tangential force");
  group.dataset("shear", map.shear, "angle", "radius", "Pa", "tangential stress, Eq. (17)");
  group.dataset("pressure", map.pressure, "angle", "radius", "Pa", "normal stress");
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
                   phases, {.steps = arguments.steps, .on_progress = session.progress()});
  ResultFile file(arguments.friction_map, session.provenance(), session.write_options());
  ResultGroup group = file.group("friction_map");
  group.coordinate("friction_number", numbers, "1", "M = mu E* u_z/(G* u_x)");
  group.coordinate("phase", phases, "rad", "phase between the oscillations");
  group.dataset("loss", map.loss, "friction_number", "phase", "1", "W(mu)/W(infinity)");
  group.dataset("relaxation", map.relaxation, "friction_number", "phase", "1",
                "part of it from springs that open and close");
  group.dataset("slip", map.slip, "friction_number", "phase", "1",
                "part of it from slip in permanent contact");
  file.commit();
}

void add_state(Json& object, const IndenterLaw& law, double indentation) {
  object["contact_radius"] = law.contact_radius(indentation);
  object["indentation"] = indentation;
  object["force"] = law.force(indentation);
  object["normal_stiffness"] = law.normal_stiffness(indentation);
  object["tangential_stiffness"] = law.tangential_stiffness(indentation);
  object["curvature"] = law.curvature(indentation);
}

void add_losses(Json& object, const TrajectoryDamping& loss) {
  object["work_per_cycle"] = loss.work_per_cycle;
  object["relaxation_work"] = loss.relaxation_work;
  object["slip_work"] = loss.slip_work;
  object["power"] = loss.power;
  object["damping_constant"] = loss.damping_constant;
  object["storage_stiffness"] = loss.storage_stiffness;
  object["loss_factor"] = loss.loss_factor;
}

void follow_file(const MdrArguments& arguments, const IndenterLaw& law, Session& session) {
  const auto columns = read_number_table(arguments.trajectory, 3);
  const SampledMotion path{columns[0], columns[1], columns[2]};
  const TrajectoryDamping loss = trajectory_damping(
      law, path,
      {.friction = arguments.friction.value_or(std::numeric_limits<double>::infinity())});
  Json object;
  add_losses(object, loss);
  object["converged"] = loss.converged;
  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    ResultGroup group = file.group("trajectory");
    group.coordinate("time", path.time, "s", "time");
    group.dataset("indentation", path.indentation, {"time"}, "m", "indentation");
    group.dataset("displacement", path.displacement, {"time"}, "m", "tangential displacement");
    group.dataset("tangential_force", loss.tangential_force, {"time"}, "N", "tangential force");
    group.dataset("dissipated", loss.dissipated, {"time"}, "J", "energy lost since the first time");
    file.commit();
  }
  session.answer(object);
  if (!loss.converged)
    throw NotConverged("mdr: the losses of the last two periods still differ; give more friction");
}

void run(const MdrArguments& arguments, Session& session) {
  const Material material = arguments.material.material_with_tangential_modulus();
  const IndenterLaw law(arguments.indenter.indenter(), material);
  if (!arguments.trajectory.empty()) {
    require(!arguments.indentation && !arguments.force, "--trajectory", arguments.trajectory,
            "holds the indentation; leave out --indentation and --force-newton");
    follow_file(arguments, law, session);
    return;
  }
  require(arguments.indentation.has_value() != arguments.force.has_value(), "--indentation",
          arguments.indentation ? "given beside" : "and --force-newton are both missing;",
          arguments.indentation ? "--force-newton; give one of them" : "give one of them");
  if (arguments.indentation) require_positive(*arguments.indentation, "--indentation");
  for (const std::string* path : {&arguments.stress_map, &arguments.friction_map})
    if (!path->empty()) require_output(*path, session.write_options());

  const double settled =
      arguments.indentation ? *arguments.indentation : law.indentation_of(*arguments.force);
  Json object;
  if (arguments.motion.normal_amplitude.empty()) {
    require(arguments.stress_map.empty() && arguments.friction_map.empty() && !arguments.friction,
            "--normal-amplitude", "missing;", "maps and friction need a motion");
    add_state(object, law, settled);
    session.answer(object);
    return;
  }
  const std::vector<Oscillation> motions = arguments.motion.motions();
  require(motions.size() == 1, "--mode", fmt::format("{} motions", motions.size()),
          "are given; mdr takes one, salebra damping takes ranges");
  const Oscillation& motion = motions.front();
  const Hold hold = arguments.hold == "force" ? Hold::force : Hold::indentation;
  const DampingResult result =
      relaxation_damping(law, AtIndentation{settled}, motion, {.hold = hold});
  if (!result.converged) throw NotConverged("mdr: the integral did not reach the tolerance");
  add_state(object, law, result.indentation);
  const double closed_form = result.small_amplitude_work;
  if (arguments.friction) {
    const TrajectoryDamping loss =
        trajectory_damping(law, sample(motion, result.indentation, arguments.steps),
                           {.friction = *arguments.friction});
    add_losses(object, loss);
    object["full_stick_work"] = result.work_per_cycle;
    object["closed_form"] = closed_form;
    object["ratio"] = loss.work_per_cycle / closed_form;
    if (!loss.converged)
      throw NotConverged("mdr: the losses of the last two periods still differ; raise --friction");
  } else {
    object["work_per_cycle"] = result.work_per_cycle;
    object["power"] = result.power;
    object["damping_constant"] = result.damping_constant;
    object["closed_form"] = closed_form;
    object["ratio"] = result.work_per_cycle / closed_form;
  }
  if (!arguments.stress_map.empty())
    write_stress_map(arguments, law, result.indentation, motion, session);
  if (!arguments.friction_map.empty()) {
    const auto* equal = std::get_if<EqualFrequency>(&motion);
    require(equal != nullptr, "--friction-map", arguments.friction_map,
            "is over the phase; use --mode equal-frequency");
    write_friction_map(arguments, law, result.indentation, *equal, session);
  }
  session.answer(object);
}

}  // namespace

void add_mdr_command(Program& program) {
  auto arguments = std::make_shared<MdrArguments>();
  CLI::App& command = program.add_command(
      "mdr", "axisymmetric contact and its damping by the method of dimensionality reduction",
      {"salebra mdr --profile parabola --radius 10mm --indentation 1um --contact-modulus 1GPa "
       "--poisson 0.3 --mode equal-frequency --normal-amplitude 300nm --tangential-amplitude 200nm "
       "--phase 90deg --stress-map fig4.h5",
       "salebra mdr --profile cone --angle 10deg --force-newton 1 --contact-modulus 1GPa --poisson "
       "0.3 "
       "--normal-amplitude 100nm --drag-velocity 1mm/s --frequency 20kHz --friction 0.3"},
      [arguments](Session& session) { run(*arguments, session); });
  arguments->indenter.add_to(command);
  const std::string position = "Position";
  add_quantity(command, "--indentation", arguments->indentation, Dimension::length,
               "from first touch")
      ->group(position);
  add_quantity(command, "--force-newton", arguments->force, Dimension::force, "normal force")
      ->group(position);
  add_choice(command, "--hold", arguments->hold, {"indentation", "force"},
             "what stays fixed at finite amplitude")
      ->group(position);
  arguments->material.add_to(command);
  arguments->motion.add_to(command);
  const std::string more = "Friction and maps";
  add_quantity(command, "--friction", arguments->friction, Dimension::dimensionless,
               "coefficient; without it full stick")
      ->group(more);
  command
      .add_option("--steps", arguments->steps, "straight steps a cycle where friction is followed")
      ->check(CLI::Range(8, 10000000))
      ->group(more);
  command
      .add_option("--trajectory", arguments->trajectory,
                  "follow one period from a file of time, indentation, displacement (SI)")
      ->type_name("FILE")
      ->group(more);
  command
      .add_option("--stress-map", arguments->stress_map, "HDF5 file for stresses over r and phase")
      ->type_name("FILE")
      ->group(more);
  command
      .add_option("--friction-map", arguments->friction_map,
                  "HDF5 file for W(mu)/W(infinity) over M and phase")
      ->type_name("FILE")
      ->group(more);
  add_values(command, "--friction-numbers", arguments->friction_numbers, Dimension::dimensionless,
             "M of the map; default 0.1:100:25")
      ->group(more);
}

}  // namespace salebra::cli
