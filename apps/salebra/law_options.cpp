// SPDX-License-Identifier: GPL-3.0-or-later
// Options for a contact law or a force curve file, and for the operating point on it.
#include "law_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <salebra/base/error.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <utility>

namespace salebra::cli {
namespace {

std::string option_named(ControlQuantity control) { return "--" + option_word(control); }

/// The control quantity that the options give, with its values. allowed: control quantities that
/// suit the law.
OperatingPoints operating_point_of(const LawOptions& arguments,
                                   const std::vector<ControlQuantity>& allowed) {
  const std::vector<OperatingPoints> given = arguments.at.given();
  std::vector<std::string> options;
  for (const ControlQuantity control : allowed) options.push_back(option_named(control));
  if (given.empty())
    throw InvalidInput(fmt::format("{}", fmt::join(options, ", ")),
                       options.size() == 1 ? "not given; give it" : "not given; give one of them");
  const OperatingPoints& found = given.front();
  if (given.size() > 1)
    throw InvalidInput(
        option_named(given[1].control),
        fmt::format("given together with {}; give one of them", option_named(found.control)));
  require_that(std::ranges::find(allowed, found.control) != allowed.end(),
               option_named(found.control),
               fmt::format("given, but this contact takes {}", fmt::join(options, " or ")));
  return found;
}

}  // namespace

void LawOptions::require_own_parameters() const {
  const std::string& law = indenter.law;
  const bool by_law = curve.empty() && !surface.given();
  const std::string chosen = surface.given()  ? "--surface"
                             : of_roughness() ? "--rms-height"
                             : by_law         ? "--law " + law
                                              : "--curve";
  if (!by_law || law == "exponential" || of_roughness()) indenter.require_only({}, chosen);
  require_that(!decay_length || (by_law && law == "exponential"), "--decay-length",
               fmt::format("given, but {} has none; leave it out", chosen));
}

void LawOptions::add_to(Command& command) {
  const std::string group = "Law";
  indenter.add_to(command, {"exponential"});
  add_quantity(command, "--decay-length", decay_length, Dimension::length,
               "exponential: decay length l of F ~ exp(indentation/l)")
      ->group(group);
  command
      .add_option("--curve", curve,
                  "force curve instead of --law: result of contact or of a study of one surface, "
                  "or a text table")
      ->file(FileUse::input)
      ->group(group);
  surface.add_to(command, false, "--surface");
  at.add_to(command, "Operating point (may be a range)");
}

void LawOptions::add_roughness_to(Command& command) {
  const std::string before = command.under("Roughness of the sides, if there is no map");
  add_values(command, "--rms-height", rms_height, Dimension::length,
             "RQ1[,RQ2], rms height of each side; gives the decay length with its limits, from an "
             "ensemble of pairs of ground, honed and isotropic surfaces");
  add_values(command, "--rms-slope", rms_slope, Dimension::dimensionless,
             "rms slope of each side (Sdq, or sqrt(2) times Rdq), for narrower limits");
  add_values(command, "--skewness", skewness, Dimension::dimensionless,
             "skewness of each side (Rsk or Ssk), for narrower limits");
  command.under(before);
}

double LawOptions::force_of_part() const {
  const OperatingPoints point =
      operating_point_of(*this, {ControlQuantity::pressure, ControlQuantity::normal_force});
  at.require_one("a part of known roughness takes one");
  if (point.control == ControlQuantity::normal_force) return point.values.front();
  return point.values.front() *
         required(nominal_area, "--nominal-area", "--pressure with --rms-height needs it");
}

RoughnessLaw LawOptions::law_of_sides(const MaterialOptions& material) const {
  std::vector<SideRoughness> sides;
  for (const auto& [option, values] :
       {std::pair{"--rms-slope", &rms_slope}, {"--skewness", &skewness}})
    require(values->empty() || values->size() == rms_height.size(), option, values->size(),
            fmt::format("values are given for {} sides; give one for each", rms_height.size()));
  for (std::size_t k = 0; k < rms_height.size(); ++k) {
    sides.push_back({.rms_height = rms_height[k]});
    if (!rms_slope.empty()) sides.back().rms_slope = rms_slope[k];
    if (!skewness.empty()) sides.back().skewness = skewness[k];
  }
  if (rms_slope.empty()) return law_of_roughness(sides);
  const double area = required(nominal_area, "--nominal-area", "--rms-slope needs it");
  require_options(material.missing(false), "--rms-slope");
  return law_of_roughness(sides, force_of_part() / area / material.material().contact_modulus);
}

std::vector<ContactProblem> LawOptions::problems(const MaterialOptions& material, Session& session,
                                                 const std::optional<double>& hardness,
                                                 const std::string& direction) const {
  std::vector<ContactProblem> all;
  if (!curve.empty() && indenter.law.empty() && !surface.given() && !of_roughness()) {
    require_own_parameters();
    const OperatingPoints points =
        operating_point_of(*this, {ControlQuantity::normal_force, ControlQuantity::indentation,
                                   ControlQuantity::pressure, ControlQuantity::mean_gap});
    for (ForceCurve& one : read_force_curves(curve)) {
      const double ratio = material.modulus_ratio_of(one, curve);
      all.emplace_back(CurveContact{.curve = std::move(one),
                                    .modulus_ratio = ratio,
                                    .at = points,
                                    .source = curve,
                                    .direction = direction_choice(direction, "--direction")});
    }
    return all;
  }
  all.push_back(problem(material, session, hardness, direction));
  return all;
}

ContactProblem LawOptions::read(const MaterialOptions& material, bool with_points) const {
  using enum ControlQuantity;
  if (of_roughness()) {
    require(indenter.law.empty() && curve.empty() && !surface.given(), "--rms-height",
            rms_height.size(),
            "values are given together with --law, --curve or --surface; give one of them");
    require_own_parameters();
    return ExponentialContact{
        law_of_sides(material).decay_length, material.modulus_ratio(), {force_of_part()}};
  }
  const auto control = [&](const std::vector<ControlQuantity>& allowed) {
    return with_points ? operating_point_of(*this, allowed) : OperatingPoints{};
  };
  require_one(!indenter.law.empty(), "--law", !curve.empty(), "--curve");
  require_own_parameters();
  if (!curve.empty()) {
    ForceCurve one = read_force_curve(curve);
    const double ratio = material.modulus_ratio_of(one, curve);
    return CurveContact{.curve = std::move(one),
                        .modulus_ratio = ratio,
                        .at = control({normal_force, ControlQuantity::indentation,
                                       ControlQuantity::pressure, ControlQuantity::mean_gap}),
                        .source = curve};
  }
  if (indenter.law == "exponential") {
    control({normal_force});
    const double length = required(decay_length, "--decay-length", "--law exponential needs it");
    require_that(!at.force.empty(), "--normal-force", "not given, but --law exponential needs it");
    return ExponentialContact{length, material.modulus_ratio(), at.force};
  }
  return IndenterContact{.profile = indenter.indenter(),
                         .material = material.material_with_tangential_modulus(),
                         .at = control({normal_force, ControlQuantity::indentation})};
}

ContactProblem LawOptions::problem(const MaterialOptions& material, Session& session,
                                   const std::optional<double>& hardness,
                                   const std::string& direction) const {
  const DirectionChoice choice =
      direction.empty() ? 0.0 : direction_choice(direction, "--direction");
  if (!surface.given()) {
    ContactProblem problem = read(material, true);
    auto* body = std::get_if<CurveContact>(&problem);
    require(body || direction.empty() || direction == "auto", "--direction", direction,
            "given, but this law is the same in all directions; leave it out");
    if (body && !direction.empty()) body->direction = choice;
    return problem;
  }
  require(indenter.law.empty() && curve.empty() && !of_roughness(), "--surface", surface.file,
          "is given together with --law, --curve or --rms-height; give one of them");
  require_own_parameters();
  std::vector<double> values = operating_point_of(*this, {ControlQuantity::pressure}).values;
  return SurfaceContact{.surface = surface.read(session),
                        .body = material.body(),
                        .pressure = std::move(values),
                        .hardness = hardness,
                        .direction = choice};
}

std::vector<ContactSolution> LawOptions::contacts(const MaterialOptions& material, Session& session,
                                                  const std::optional<double>& hardness,
                                                  double normal_amplitude, Hold hold,
                                                  const std::string& direction) const {
  ContactProblem asked = problem(material, session, hardness, direction);
  if (auto* body = std::get_if<SurfaceContact>(&asked)) {
    body->normal_amplitude = normal_amplitude;
    body->hold = hold;
  }
  std::vector<ContactSolution> contacts = solve_directions(std::move(asked), session.context());
  session.warn(contacts.front().warnings);
  return contacts;
}

ContactProblem LawOptions::problem_of_law(const MaterialOptions& material) const {
  require(!surface.given(), "--surface", surface.file,
          "has no law for a measured path of indentations; compute its force curve and give it as "
          "--curve");
  return read(material, false);
}

}  // namespace salebra::cli
