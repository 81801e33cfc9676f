// SPDX-License-Identifier: GPL-3.0-or-later
// Options that give a contact law, or a force curve file, and the position on it.
#include "law_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <utility>

#include "first_loading.hpp"
#include "stoppable_law.hpp"

namespace salebra::cli {
namespace {

/// A way to say where a contact stands, and what a curve knows of it.
struct PositionOption {
  const char* option;
  std::vector<double> LawOptions::*values;
  double ForceSample::*column;
  Dimension dimension;
};

const std::map<std::string, PositionOption> position_options{
    {"force", {"--normal-force", &LawOptions::force, &ForceSample::force, Dimension::force}},
    {"indentation",
     {"--indentation", &LawOptions::indentation, &ForceSample::indentation, Dimension::length}},
    {"pressure",
     {"--pressure", &LawOptions::pressure, &ForceSample::pressure, Dimension::pressure}},
    {"mean_gap", {"--mean-gap", &LawOptions::mean_gap, &ForceSample::mean_gap, Dimension::length}}};

const char* option_named(const std::string& position) {
  return position_options.at(position).option;
}

/// The one position option that was given, and its values.
std::pair<std::string, std::vector<double>> position_of(const LawOptions& arguments,
                                                        const std::vector<std::string>& allowed) {
  std::pair<std::string, std::vector<double>> found;
  for (const auto& [name, position] : position_options) {
    const std::vector<double>& values = arguments.*position.values;
    if (values.empty()) continue;
    require_that(found.first.empty(), position.option,
                 fmt::format("given together with {}; give one of them",
                             found.first.empty() ? "" : option_named(found.first)));
    found = {name, values};
  }
  std::vector<std::string> options;
  for (const std::string& position : allowed) options.push_back(option_named(position));
  if (found.first.empty())
    throw InvalidInput(fmt::format("{}", fmt::join(options, ", ")), "not given; give one of them");
  require_that(std::ranges::find(allowed, found.first) != allowed.end(), option_named(found.first),
               fmt::format("given, but this contact stands at {}", fmt::join(options, " or ")));
  return found;
}

std::vector<Position> positions_of(const std::string& name, const std::vector<double>& values) {
  std::vector<Position> positions;
  for (const double value : values) {
    if (name == "indentation") {
      positions.emplace_back(AtIndentation{value});
    } else {
      require_positive(value, "--normal-force");
      positions.emplace_back(AtForce{value});
    }
  }
  return positions;
}

std::unique_ptr<ContactLaw> exponential(const LawOptions& arguments,
                                        const MaterialOptions& material) {
  const double decay_length =
      required(arguments.decay_length, "--decay-length", "--law exponential needs it");
  require_positive(decay_length, "--decay-length");
  require_that(!arguments.force.empty(), "--normal-force",
               "not given, but --law exponential needs it");
  require_positive(arguments.force.front(), "--normal-force");
  // The law has no scale of its own: F'' = F/l² whatever the reference force.
  return stoppable(std::make_unique<ExponentialLaw>(arguments.force.front(), decay_length,
                                                    material.modulus_ratio()));
}

std::unique_ptr<ContactLaw> tabulated(const ForceCurve& curve, const MaterialOptions& material) {
  return stoppable(std::make_unique<TabulatedLaw>(curve, material.modulus_ratio()));
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

/// Throws InvalidInput in the quantity that was typed, before it becomes the force or the
/// indentation that the law knows.
void require_on_curve(const std::string& name, const std::vector<double>& values,
                      const ForceCurve& curve) {
  const PositionOption& column = position_options.at(name);
  const auto [low, high] = std::ranges::minmax(curve.column(column.column));
  for (const double value : values)
    require(!(value < low || value > high), column.option, format_quantity(value, column.dimension),
            fmt::format("lies outside the curve's range, {} to {}; choose one within it or extend "
                        "the curve",
                        format_quantity(low, column.dimension),
                        format_quantity(high, column.dimension)));
}

std::vector<Position> positions_on_curve(const LawOptions& arguments, const ForceCurve& curve) {
  auto [name, values] = position_of(arguments, {"force", "indentation", "pressure", "mean_gap"});
  require_on_curve(name, values, curve);
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
  return positions_of(name, values);
}

/// Whether the moduli that were given fit the stiffnesses of the curve. K_t/K of a curve is G*/E*
/// to the last digits, or, where each K_t is a stick solve of its own, to some per cent and nowhere
/// the same.
std::vector<std::string> doubts_of_moduli(const ForceCurve& curve, double modulus_ratio) {
  std::vector<double> ratios;
  for (const ForceSample& sample : curve.samples) {
    const double ratio = sample.tangential_stiffness / sample.normal_stiffness;
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  if (ratios.empty()) return {};
  const auto [low, high] = std::ranges::minmax(ratios);
  const double tolerance = high - low > 1e-6 * high ? 0.1 : 1e-3;
  if (modulus_ratio > (1 - tolerance) * low && modulus_ratio < (1 + tolerance) * high) return {};
  return {
      fmt::format("G*/E* = {:.4g} of --poisson or --tangential-modulus, and K_t/K = {:.4g} in the "
                  "curve's file; give the material that the curve was computed with",
                  modulus_ratio, low)};
}

/// Pressures about those that are asked for, which are among them: from a sixth to six times, close
/// enough for a smooth law.
std::vector<double> pressures_about(std::vector<double> asked) {
  constexpr double factor = 1.35;
  std::ranges::sort(asked);
  std::vector<double> all = asked;
  const auto is_new = [&](double pressure) {
    return std::ranges::none_of(
        all, [&](double known) { return std::abs(std::log(pressure / known)) < 0.1; });
  };
  for (const double pressure : asked)
    for (int k = -6; k <= 6; ++k)
      if (const double one = pressure * std::pow(factor, k); is_new(one)) all.push_back(one);
  std::ranges::sort(all);
  return all;
}

ForceCurve curve_of_surface(const Surface& surface, const Material& material,
                            const std::vector<double>& pressures, Session& session) {
  SweepOptions options;
  options.stick = true;
  options.contact.on_progress = session.progress();
  ForceCurve curve = sweep_pressures(surface, material, pressures_about(pressures), options);
  if (interrupted()) throw Interrupted("interrupted; nothing was written");
  if (const auto lost = std::ranges::count(curve.samples, false, &ForceSample::converged); lost > 0)
    throw NotConverged(
        fmt::format("--surface: {} of {} contacts did not converge", lost, curve.samples.size()));
  return curve;
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
      .add_option("--curve", curve, "file of sweep, gw or a study of one surface, instead of --law")
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

std::unique_ptr<ContactLaw> LawOptions::law_alone(const MaterialOptions& material) const {
  require(!surface.given(), "--surface", surface.file,
          "has no law for a path of indentations; sweep it and give its --curve");
  require_one(!law.empty(), "--law", !curve.empty(), "--curve");
  require_own_parameters();
  if (!curve.empty()) return tabulated(read_force_curve(curve), material);
  if (law == "exponential") return exponential(*this, material);
  // The premises know an indenter by its type.
  return std::make_unique<IndenterLaw>(stoppable(profile_of(*this)),
                                       material.material_with_tangential_modulus());
}

ContactFacts LawOptions::Contact::facts_at(ContactFacts facts, double indentation) const {
  facts = at_state(facts, *law, curve ? &*curve : nullptr, indentation);
  if (first_loading && first_loading->yielded())
    facts.first_load = first_loading->pressure * curve->nominal_area;
  return facts;
}

LawOptions::Contact LawOptions::contact(const MaterialOptions& material, Session& session,
                                        const std::optional<double>& hardness,
                                        double normal_amplitude) const {
  if (surface.given()) {
    require(law.empty() && curve.empty(), "--surface", surface.file,
            "is given together with --law or --curve; give one of them");
    require_own_parameters();
    const std::vector<double> values = position_of(*this, {"pressure"}).second;
    for (const double value : values) require_positive(value, "--pressure");
    Surface body = surface.read(session);
    session.doubt(doubt_of_pressure(std::ranges::max(values), material.material().contact_modulus));
    const std::optional<FirstLoading> first_loading =
        load_first(body, hardness, material.material().contact_modulus, std::ranges::max(values),
                   {.on_progress = session.progress()}, normal_amplitude);
    ForceCurve samples =
        curve_of_surface(body, material.material_with_tangential_modulus(), values, session);
    auto table = tabulated(samples, material);
    auto positions = positions_on_curve(*this, samples);
    return {std::move(table), std::move(positions), std::move(samples), {},
            std::move(body),  first_loading};
  }
  if (!curve.empty() && law.empty()) {
    require_own_parameters();
    ForceCurve samples = read_force_curve(curve);
    std::vector<std::string> doubts = doubts_of_moduli(samples, material.modulus_ratio());
    auto table = tabulated(samples, material);
    auto positions = positions_on_curve(*this, samples);
    return {std::move(table), std::move(positions), std::move(samples), std::move(doubts)};
  }
  if (law == "exponential" && curve.empty()) {
    const auto [name, values] = position_of(*this, {"force"});
    return {law_alone(material), positions_of(name, values)};
  }
  auto force_law = law_alone(material);
  const auto [name, values] = position_of(*this, {"force", "indentation"});
  for (const double value : values)
    require_positive(value, name == "force" ? "--normal-force" : "--indentation");
  return {std::move(force_law), positions_of(name, values)};
}

}  // namespace salebra::cli
