// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/law.hpp>
#include <salebra/contact/mdr.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/io/force_curve_file.hpp>

#include "answer_file.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct DampingArguments {
  std::string law, curve;
  std::vector<double> force, indentation, pressure, mean_gap;
  std::optional<double> decay_length, angle, radius, exponent, coefficient;
  std::string amplitude = "finite", hold = "indentation";
  MaterialOptions material;
  MotionOptions motion;
};

struct Contact {
  std::unique_ptr<ContactLaw> law;
  std::vector<Position> positions;
};

/// The one position option that was given, and its values.
std::pair<std::string, std::vector<double>> position_of(const DampingArguments& arguments,
                                                        const std::vector<std::string>& allowed) {
  std::pair<std::string, std::vector<double>> found;
  for (const auto& [name, values] : {std::pair{"force", &arguments.force},
                                     {"indentation", &arguments.indentation},
                                     {"pressure", &arguments.pressure},
                                     {"mean_gap", &arguments.mean_gap}}) {
    if (values->empty()) continue;
    require(found.first.empty(), name, "given", "beside " + found.first + "; give one position");
    found = {name, *values};
  }
  require(std::ranges::find(allowed, found.first) != allowed.end(), "position",
          found.first.empty() ? "none" : found.first,
          fmt::format("is given, but this law stands at one of: {}", fmt::join(allowed, ", ")));
  return found;
}

std::vector<Position> positions_of(const std::string& name, const std::vector<double>& values) {
  std::vector<Position> positions;
  for (const double value : values) {
    if (name == "indentation") {
      positions.emplace_back(AtIndentation{value});
    } else {
      require_positive(value, "--force-newton");
      positions.emplace_back(AtForce{value});
    }
  }
  return positions;
}

Contact exponential(const DampingArguments& arguments) {
  const double decay_length =
      required(arguments.decay_length, "--decay-length", "--law exponential needs it");
  require_positive(decay_length, "--decay-length");
  const auto [name, values] = position_of(arguments, {"force"});
  // The law has no scale of its own: F'' = F/l² whatever the reference force.
  const auto positions = positions_of(name, values);
  return {std::make_unique<ExponentialLaw>(values.front(), decay_length,
                                           arguments.material.modulus_ratio()),
          positions};
}

std::shared_ptr<const IndenterProfile> profile_of(const DampingArguments& arguments) {
  if (arguments.law == "cone")
    return cone_profile(required(arguments.angle, "--angle", "--law cone needs it"));
  if (arguments.law == "parabola") {
    return paraboloid_profile(required(arguments.radius, "--radius", "--law parabola needs it"));
  }
  return power_profile(required(arguments.coefficient, "--coefficient", "--law power needs it"),
                       required(arguments.exponent, "--exponent", "--law power needs it"));
}

Contact of_profile(const DampingArguments& arguments) {
  const Material material = arguments.material.material_with_tangential_modulus();
  const auto [name, values] = position_of(arguments, {"force", "indentation"});
  return {std::make_unique<IndenterLaw>(profile_of(arguments), material),
          positions_of(name, values)};
}

Contact of_curve(const DampingArguments& arguments) {
  const ForceCurve curve = read_force_curve(arguments.curve);
  auto law = std::make_unique<TabulatedLaw>(curve, arguments.material.modulus_ratio());
  auto [name, values] = position_of(arguments, {"force", "indentation", "pressure", "mean_gap"});
  if (name == "pressure") {
    require_positive(curve.nominal_area, "nominal_area of " + arguments.curve);
    for (double& value : values) value *= curve.nominal_area;
    name = "force";
  } else if (name == "mean_gap") {
    const ForceSample& any = curve.samples.front();
    require(!std::isnan(any.mean_gap), "--mean-gap", arguments.curve,
            "has no mean gap; give another position");
    const double origin = std::isnan(any.indentation) ? 0 : any.indentation + any.mean_gap;
    for (double& value : values) value = origin - value;
    name = "indentation";
  }
  return {std::move(law), positions_of(name, values)};
}

void run(const DampingArguments& arguments, Session& session) {
  require(arguments.law.empty() != arguments.curve.empty(), "--law",
          arguments.law.empty() ? "missing;" : "given beside --curve;",
          "give exactly one of --law and --curve");
  const std::vector<Oscillation> motions = arguments.motion.motions();
  const Contact contact = !arguments.curve.empty()         ? of_curve(arguments)
                          : arguments.law == "exponential" ? exponential(arguments)
                                                           : of_profile(arguments);
  const auto& positions = contact.positions;
  require(positions.size() == 1 || motions.size() == 1, "--force-newton",
          fmt::format("{} values", positions.size()),
          "are a second range; only one quantity may be a range");

  DampingOptions options;
  options.hold = arguments.hold == "force" ? Hold::force : Hold::indentation;
  options.amplitude = arguments.amplitude == "small" ? Amplitude::small : Amplitude::finite;
  options.on_progress = session.progress();
  std::vector<DampingCase> cases;
  for (std::size_t i = 0; i < std::max(positions.size(), motions.size()); ++i) {
    cases.push_back(
        {positions[positions.size() == 1 ? 0 : i], motions[motions.size() == 1 ? 0 : i]});
  }
  const auto results = relaxation_damping(*contact.law, cases, options);
  const auto lost = std::ranges::count(results, false, &DampingResult::converged);

  const auto column = [&](double DampingResult::*quantity) -> Json {
    if (cases.size() == 1) return results.front().*quantity;
    Json values = Json::array();
    for (const DampingResult& result : results) values.push_back(result.*quantity);
    return values;
  };
  Json object;
  if (const auto& [name, values] = arguments.motion.varied(); !values.empty())
    object[name] = values;
  object["work_per_cycle"] = column(&DampingResult::work_per_cycle);
  object["power"] = column(&DampingResult::power);
  object["damping_constant"] = column(&DampingResult::damping_constant);
  object["curvature"] = column(&DampingResult::curvature);
  object["force"] = column(&DampingResult::force);
  if (lost == 0) write_answer(session, "damping", object);
  session.answer(object);
  if (lost > 0) {
    throw NotConverged(fmt::format("damping: {} of {} integrals did not reach the tolerance", lost,
                                   results.size()));
  }
}

}  // namespace

void add_damping_command(Program& program) {
  auto arguments = std::make_shared<DampingArguments>();
  CLI::App& command = program.add_command(
      "damping", "relaxation damping of a contact under an oscillation",
      {"salebra damping --law exponential --force-newton 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 5nm --drag-velocity 1mm/s --frequency 20kHz --amplitude small",
       "salebra damping --curve curve.h5 --pressure 10MPa --poisson 0.3 --normal-amplitude "
       "1:20nm:8 --drag-velocity 1mm/s --frequency 20kHz"},
      [arguments](Session& session) { run(*arguments, session); });
  const std::string group = "Law";
  add_choice(command, "--law", arguments->law, {"exponential", "cone", "parabola", "power"},
             "F(indentation)")
      ->group(group);
  command.add_option("--curve", arguments->curve, "file of sweep or gw, instead of --law")
      ->type_name("FILE")
      ->group(group);
  add_quantity(command, "--decay-length", arguments->decay_length, Dimension::length,
               "l of the exponential law")
      ->group(group);
  add_quantity(command, "--angle", arguments->angle, Dimension::angle,
               "of the cone's flank to the plane")
      ->group(group);
  add_quantity(command, "--radius", arguments->radius, Dimension::length, "of the paraboloid")
      ->group(group);
  add_quantity(command, "--exponent", arguments->exponent, Dimension::dimensionless,
               "N of the profile f = B r^N")
      ->group(group);
  add_quantity(command, "--coefficient", arguments->coefficient, Dimension::dimensionless,
               "B of the profile f = B r^N, m^(1-N)")
      ->group(group);
  const std::string position = "Position (may be a range)";
  add_values(command, "--force-newton", arguments->force, Dimension::force, "normal force")
      ->group(position);
  add_values(command, "--indentation", arguments->indentation, Dimension::length,
             "from first touch")
      ->group(position);
  add_values(command, "--pressure", arguments->pressure, Dimension::pressure,
             "nominal pressure, of a curve")
      ->group(position);
  add_values(command, "--mean-gap", arguments->mean_gap, Dimension::length, "mean gap, of a curve")
      ->group(position);
  arguments->motion.add_to(command);
  add_choice(command, "--amplitude", arguments->amplitude, {"small", "finite"},
             "of the normal oscillation; default finite");
  add_choice(command, "--hold", arguments->hold, {"indentation", "force"},
             "what stays in the mean; default indentation");
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
