// SPDX-License-Identifier: GPL-3.0-or-later
// Options that give a contact law, or a force curve file, and the position on it.
#include "law_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <salebra/base/error.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <utility>

namespace salebra::cli {
namespace {

constexpr auto position_members =
    std::to_array<std::pair<Standing, std::vector<double> LawOptions::*>>(
        {{Standing::normal_force, &LawOptions::force},
         {Standing::indentation, &LawOptions::indentation},
         {Standing::mean_gap, &LawOptions::mean_gap},
         {Standing::pressure, &LawOptions::pressure}});

std::string option_named(Standing standing) {
  std::string option = "--" + std::string(word_of(standing));
  std::ranges::replace(option, '_', '-');
  return option;
}

/// The one position that was given, and its values.
Standings position_of(const LawOptions& arguments, const std::vector<Standing>& allowed) {
  std::optional<Standings> found;
  for (const auto& [standing, values] : position_members) {
    if ((arguments.*values).empty()) continue;
    require_that(!found, option_named(standing),
                 fmt::format("given together with {}; give one of them",
                             found ? option_named(found->quantity) : ""));
    found = {standing, arguments.*values};
  }
  std::vector<std::string> options;
  for (const Standing standing : allowed) options.push_back(option_named(standing));
  if (!found)
    throw InvalidInput(fmt::format("{}", fmt::join(options, ", ")), "not given; give one of them");
  require_that(std::ranges::find(allowed, found->quantity) != allowed.end(),
               option_named(found->quantity),
               fmt::format("given, but this contact stands at {}", fmt::join(options, " or ")));
  return *found;
}

std::shared_ptr<const IndenterProfile> profile_of(const LawOptions& arguments) {
  if (arguments.law == "cone")
    return cone_profile(required(arguments.angle, "--angle", "--law cone needs it"));
  if (arguments.law == "parabola") {
    return paraboloid_profile(required(arguments.radius, "--radius", "--law parabola needs it"));
  }
  return power_profile(required(arguments.coefficient, "--coefficient", "--law power needs it"),
                       required(arguments.exponent, "--exponent", "--law power needs it"));
}

}  // namespace

void LawOptions::require_own_parameters() const {
  const std::string chosen = surface.given() ? "--surface"
                             : curve.empty() ? "--law " + law
                                             : "--curve";
  for (const auto& [option, value, owner] :
       {std::tuple{"--decay-length", &decay_length, "exponential"},
        {"--angle", &angle, "cone"},
        {"--radius", &radius, "parabola"},
        {"--exponent", &exponent, "power"},
        {"--coefficient", &coefficient, "power"}})
    require_that(!*value || (law == owner && curve.empty() && !surface.given()), option,
                 fmt::format("given, but {} has none; leave it out", chosen));
}

void LawOptions::add_to(Command& command) {
  const std::string group = "Law";
  add_choice(command, "--law", law, {"exponential", "cone", "parabola", "power"}, "F(indentation)")
      ->group(group);
  command
      .add_option("--curve", curve, "file of contact or a study of one surface, instead of --law")
      ->file(FileUse::input)
      ->group(group);
  surface.add_to(command, false, "--surface");
  add_quantity(command, "--decay-length", decay_length, Dimension::length,
               "l of the exponential law")
      ->group(group);
  add_quantity(command, "--angle", angle, Dimension::angle, "of the cone's flank to the plane")
      ->group(group);
  add_quantity(command, "--radius", radius, Dimension::length, "of the paraboloid")->group(group);
  add_quantity(command, "--exponent", exponent, Dimension::dimensionless,
               "N of the profile f = B r^N")
      ->group(group);
  add_quantity(command, "--coefficient", coefficient, Dimension::dimensionless,
               "B of the profile f = B r^N, m^(1-N)")
      ->group(group);
  const std::string position = "Position (may be a range)";
  add_values(command, "--normal-force", force, Dimension::force, "normal force")->group(position);
  add_values(command, "--indentation", indentation, Dimension::length, "from first touch")
      ->group(position);
  add_values(command, "--pressure", pressure, Dimension::pressure,
             "nominal pressure, of a curve or a surface")
      ->group(position);
  add_values(command, "--mean-gap", mean_gap, Dimension::length, "mean gap, of a curve")
      ->group(position);
}

ContactQuestion LawOptions::read(const MaterialOptions& material, bool with_positions) const {
  using enum Standing;
  const auto standing = [&](const std::vector<Standing>& allowed) {
    return with_positions ? position_of(*this, allowed) : Standings{};
  };
  require_one(!law.empty(), "--law", !curve.empty(), "--curve");
  require_own_parameters();
  if (!curve.empty())
    return CurveContact{.curve = read_force_curve(curve),
                        .modulus_ratio = material.modulus_ratio(),
                        .at = standing({normal_force, Standing::indentation, Standing::pressure,
                                        Standing::mean_gap}),
                        .source = curve};
  if (law == "exponential") {
    standing({normal_force});
    const double length = required(decay_length, "--decay-length", "--law exponential needs it");
    require_that(!force.empty(), "--normal-force", "not given, but --law exponential needs it");
    return ExponentialContact{length, material.modulus_ratio(), force};
  }
  return IndenterContact{.profile = profile_of(*this),
                         .material = material.material_with_tangential_modulus(),
                         .at = standing({normal_force, Standing::indentation})};
}

ContactQuestion LawOptions::question(const MaterialOptions& material, Session& session,
                                     const std::optional<double>& hardness) const {
  if (!surface.given()) return read(material, true);
  require(law.empty() && curve.empty(), "--surface", surface.file,
          "is given together with --law or --curve; give one of them");
  require_own_parameters();
  std::vector<double> values = position_of(*this, {Standing::pressure}).values;
  return SurfaceContact{.surface = surface.read(session),
                        .material = material.material_with_tangential_modulus(),
                        .pressure = std::move(values),
                        .hardness = hardness};
}

ContactAnswer LawOptions::contact(const MaterialOptions& material, Session& session,
                                  const std::optional<double>& hardness,
                                  double normal_amplitude) const {
  ContactQuestion asked = question(material, session, hardness);
  if (auto* body = std::get_if<SurfaceContact>(&asked)) body->normal_amplitude = normal_amplitude;
  ContactAnswer contact = ask(std::move(asked), session.context());
  for (const std::string& line : contact.doubts) session.warn(line);
  return contact;
}

std::unique_ptr<const ContactLaw> LawOptions::law_alone(const MaterialOptions& material,
                                                        Session& session) const {
  require(!surface.given(), "--surface", surface.file,
          "has no law for a path of indentations; press it and give its --curve");
  return law_of(read(material, false), session.context());
}

}  // namespace salebra::cli
