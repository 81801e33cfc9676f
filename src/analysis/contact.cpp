// SPDX-License-Identifier: GPL-3.0-or-later
// The law of a contact and its operating points, from a formula, an indenter, a force curve or a
// surface.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <utility>

#include "damping/max_motion.hpp"
#include "damping/phase_quadrature.hpp"
#include "damping/surface_law.hpp"
#include "damping/wide_oscillation.hpp"
#include "stoppable_law.hpp"

namespace salebra {
namespace {

Dimension dimension_of(ControlQuantity control) {
  switch (control) {
    case ControlQuantity::normal_force:
      return Dimension::force;
    case ControlQuantity::pressure:
      return Dimension::pressure;
    default:
      return Dimension::length;
  }
}

double ForceSample::*column_of(ControlQuantity control) {
  switch (control) {
    case ControlQuantity::normal_force:
      return &ForceSample::force;
    case ControlQuantity::indentation:
      return &ForceSample::indentation;
    case ControlQuantity::pressure:
      return &ForceSample::pressure;
    default:
      return &ForceSample::mean_gap;
  }
}

std::vector<OperatingPoint> at_forces(const std::vector<double>& values) {
  std::vector<OperatingPoint> points;
  for (const double value : values) {
    require_positive(value, name_of(ControlQuantity::normal_force));
    points.push_back(at_force(value));
  }
  return points;
}

std::vector<OperatingPoint> at_indentations(const std::vector<double>& values) {
  std::vector<OperatingPoint> points;
  for (const double value : values) points.push_back(at_indentation(value));
  return points;
}

/// The load of a sample differs by this from the load that was asked of it.
constexpr double round_off = 1e-12;

/// Throws InvalidInput for a value outside the range of the curve. The message names the control
/// quantity that the user gave (such as a pressure), since the value is later converted to a force
/// or an indentation.
void require_on_curve(const OperatingPoints& at, const ForceCurve& curve) {
  const Dimension dimension = dimension_of(at.control);
  const auto [low, high] = std::ranges::minmax(curve.column(column_of(at.control)));
  for (const double value : at.values)
    // A body that lifts off has a mean indentation below the curve.
    require(!((value < low && at.control != ControlQuantity::indentation) ||
              value > high * (1 + round_off)),
            name_of(at.control), format_quantity(value, dimension),
            fmt::format("lies outside the curve's range, {} to {}; choose one within it or extend "
                        "the curve",
                        format_quantity(low, dimension), format_quantity(high, dimension)));
}

std::vector<OperatingPoint> points_on(const ForceCurve& curve, const OperatingPoints& at,
                                      const std::string& source) {
  require_on_curve(at, curve);
  std::vector<double> values = at.values;
  switch (at.control) {
    case ControlQuantity::normal_force:
      return at_forces(values);
    case ControlQuantity::indentation:
      return at_indentations(values);
    case ControlQuantity::pressure:
      require_positive(curve.nominal_area, "nominal_area of " + source);
      for (double& value : values)
        value = std::min(value * curve.nominal_area,
                         std::ranges::max(curve.column(&ForceSample::force)));
      return at_forces(values);
    case ControlQuantity::mean_gap:
      break;
  }
  const ForceSample& any = curve.samples.front();
  require(!std::isnan(any.mean_gap), name_of(at.control), source,
          "has no mean gap; give a pressure, a force or an indentation");
  const double origin = std::isnan(any.indentation) ? 0 : any.indentation + any.mean_gap;
  for (double& value : values) value = origin - value;
  return at_indentations(values);
}

/// Warns if the ratio G*/E* of the given moduli does not fit the ratio K_t/K of the curve. If the
/// curve took K_t as (G*/E*)K, its K_t/K is its G*/E* to the last digits. If each K_t comes from a
/// stick solve, K_t/K agrees with G*/E* to some per cent and differs from load to load.
std::vector<std::string> warnings_of_moduli(const ForceCurve& curve, double modulus_ratio) {
  std::vector<double> ratios;
  for (const ForceSample& sample : curve.samples) {
    const double ratio = sample.tangential_stiffness / sample.normal_stiffness;
    if (std::isfinite(ratio)) ratios.push_back(ratio);
  }
  if (ratios.empty()) return {};
  const auto [low, high] = std::ranges::minmax(ratios);
  const double tolerance = high - low > 1e-6 * high ? 0.1 : 1e-3;
  if (std::isnan(modulus_ratio)) return {};
  if (modulus_ratio > (1 - tolerance) * low && modulus_ratio < (1 + tolerance) * high) return {};
  return {
      fmt::format("`poisson` or `tangential_modulus` gives G*/E* = {:.4g}, but the file of the "
                  "curve has K_t/K = {:.4g}; give the material with which the curve was computed",
                  modulus_ratio, low)};
}

/// The requested pressures and further ones around each, from a sixth to six times it. They are
/// close enough for a smooth law through the contacts.
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

SweepOptions sweep_options(const Context& context) {
  SweepOptions options;
  options.stick = true;
  options.contact.on_progress = context.on_progress;
  return options;
}

void require_converged(const ForceCurve& curve, const Context& context) {
  if (context.stopped && context.stopped()) throw Interrupted("interrupted; nothing was written");
  if (const auto lost = std::ranges::count(curve.samples, false, &ForceSample::converged); lost > 0)
    throw NotConverged(
        fmt::format("`surface`: {} of {} contacts did not converge", lost, curve.samples.size()));
}

std::vector<ForceCurve> curves_of_surface(const SurfaceContact& body,
                                          const std::vector<double>& pressures,
                                          const std::vector<double>& directions,
                                          const Context& context) {
  std::vector<ForceCurve> curves =
      sweep_directions(body.surface, body.body, pressures, directions, sweep_options(context));
  require_converged(curves.front(), context);
  // In full contact nothing can close further: the force grows without indentation.
  const auto full = [&](const ForceSample& sample) {
    return body.body.stops_at_full_contact() && !(sample.contact_area_fraction < 1);
  };
  for (const ForceSample& sample : curves.front().samples)
    if (full(sample))
      for (const double pressure : body.pressure)
        require(
            !(pressure > sample.pressure * (1 - 1e-6)), "pressure",
            format_quantity(pressure, Dimension::pressure),
            "presses the surface into full contact, which has no stiffness; choose a smaller one");
  for (ForceCurve& curve : curves) std::erase_if(curve.samples, full);
  return curves;
}

/// What the oscillation of a surface about its pressures keeps; `curve` has these pressures.
Hold hold_of(const SurfaceContact& body, const ForceCurve& curve) {
  ForceCurve asked = curve;
  const double lowest = std::ranges::min(body.pressure);
  std::erase_if(asked.samples, [&](const ForceSample& sample) {
    return !(std::abs(sample.pressure / lowest - 1) < 1e-6);
  });
  return detail::hold_of(asked, body.normal_amplitude, body.hold);
}

/// Adds loads to the curves of a surface in all directions until they cover the oscillation about
/// each pressure, down to a hundredth of the pressure and up to the largest load. The steps in ln F
/// are those of pressures_about(), and twice as large below.
void cover_motion(std::vector<ForceCurve>& curves, const std::vector<double>& directions,
                  const SurfaceContact& body, Hold hold, const Context& context) {
  const ForceCurve& curve = curves.front();
  constexpr double step = 1.35, lowest_share = 0.01;
  const double amplitude = body.normal_amplitude, ratio = body.body.modulus_ratio();
  const SweepOptions options = sweep_options(context);
  const double full = body.body.stops_at_full_contact() ? detail::full_contact(body.surface)
                                                        : std::numeric_limits<double>::infinity();
  std::vector<double> below;
  for (const double pressure : body.pressure) {
    const double force = pressure * curve.nominal_area;
    for (;;) {
      const TabulatedLaw law(curve, ratio);
      const double needed = detail::mean_indentation(law, force, amplitude, hold) + amplitude;
      const double top = law.highest_indentation();
      if (needed <= top) break;
      const auto next = detail::further_indentation(law, needed, full, hold);
      if (!next)
        detail::refuse_full_contact(amplitude, pressure,
                                    detail::possible_amplitude(law, force, amplitude, hold,
                                                               hold == Hold::force ? top : full));
      const double length = law.force(top) / law.normal_stiffness(top);
      NormalContactState state =
          press(body.surface, body.body,
                at_indentation(std::min(*next, top + std::log(step) * length)), options.contact);
      const auto samples = force_samples(state, body.surface, body.body, options, directions);
      for (std::size_t k = 0; k < curves.size(); ++k) curves[k].samples.push_back(samples[k]);
      require_converged(curve, context);
    }
    const TabulatedLaw law(curve, ratio);
    const double mean = detail::mean_indentation(law, force, amplitude, hold);
    if (mean - amplitude < law.lowest_indentation())
      for (double one = curve.samples.front().pressure / (step * step);
           one > lowest_share * pressure / step; one /= step * step)
        if (below.empty() || one < below.back()) below.push_back(one);
  }
  if (below.empty()) return;
  std::ranges::reverse(below);
  const std::vector<ForceCurve> lower = curves_of_surface(body, below, directions, context);
  for (std::size_t k = 0; k < curves.size(); ++k)
    curves[k].samples.insert(curves[k].samples.begin(), lower[k].samples.begin(),
                             lower[k].samples.end());
}

std::unique_ptr<const ContactLaw> law(const ExponentialContact& body, const Context& context) {
  require_positive(body.decay_length, "decay_length");
  require_that(!body.normal_force.empty(), "normal_force",
               "not given, but the exponential law needs it");
  require_positive(body.normal_force.front(), "normal_force");
  return stoppable(std::make_unique<ExponentialLaw>(body.normal_force.front(), body.decay_length,
                                                    body.modulus_ratio),
                   context);
}

/// The assumptions recognise an indenter by the class of its law, so the law is not wrapped. Its
/// profile checks whether the user asked to stop.
std::unique_ptr<const ContactLaw> law(const IndenterContact& body, const Context& context) {
  return std::make_unique<IndenterLaw>(stoppable(body.profile, context), body.material);
}

std::unique_ptr<const ContactLaw> law(const CurveContact& body, const Context& context) {
  return stoppable(std::make_unique<TabulatedLaw>(body.curve, body.modulus_ratio), context);
}

std::unique_ptr<const ContactLaw> law(const SurfaceContact&, const Context&) {
  throw InvalidInput(
      "surface",
      "has no law for a path of indentations; compute its force curve and give it as `curve`");
}

using Solutions = std::vector<ContactSolution>;

Solutions one_solution(ContactSolution solution) {
  Solutions solutions;
  solutions.push_back(std::move(solution));
  return solutions;
}

Solutions solutions(ExponentialContact body, const Context& context) {
  return one_solution({law(body, context), at_forces(body.normal_force)});
}

Solutions solutions(IndenterContact body, const Context& context) {
  auto force_law = law(body, context);
  const auto& [control, values] = body.at;
  require_that(control == ControlQuantity::normal_force || control == ControlQuantity::indentation,
               name_of(control), "given, but an indenter takes `normal_force` or `indentation`");
  for (const double value : values) require_positive(value, name_of(control));
  const bool by_force = control == ControlQuantity::normal_force;
  ContactSolution solution{std::move(force_law),
                           by_force ? at_forces(values) : at_indentations(values)};
  const auto& indenter = static_cast<const IndenterLaw&>(*solution.law);
  for (const OperatingPoint& point : solution.points) {
    const double radius = indenter.contact_radius(indentation_of(indenter, point));
    solution.warnings = warnings_of_profile(*body.profile, radius);
    if (!solution.warnings.empty()) break;
  }
  return one_solution(std::move(solution));
}

/// The curves of a contact in the directions that it asks for.
std::vector<ForceCurve> chosen_curves(const CurveContact& body) {
  std::vector<ForceCurve> curves = by_direction(body.curve);
  if (body.direction == DirectionChoice(LayDirection::automatic)) return curves;
  std::vector<std::string> known;
  for (const ForceCurve& curve : curves)
    if (!std::isnan(curve.direction()))
      known.push_back(fmt::format("{:.6g}deg", curve.direction() * 180 / std::numbers::pi));
  const std::string there =
      known.empty() ? "has a tangential stiffness without a direction; leave this out"
                    : fmt::format(
                          "is not in the curve, which has {}; leave this out or give one "
                          "of its directions",
                          fmt::join(known, " and "));
  const double* angle = std::get_if<double>(&body.direction);
  if (angle == nullptr)
    throw InvalidInput("direction", std::string(name_of(std::get<LayDirection>(body.direction))),
                       known.empty() ? "needs a surface; the curve " + there
                                     : fmt::format("needs a surface; the curve has {}; give one of "
                                                   "these angles, or none for all of them",
                                                   fmt::join(known, " and ")));
  const double asked = directions_of(body.direction, SurfaceLay{}).front();
  // Directions are written with six digits of the angle.
  std::erase_if(curves, [&](const ForceCurve& curve) {
    const double difference = std::abs(curve.direction() - asked);
    return !(std::min(difference, std::numbers::pi - difference) < 1e-5);
  });
  require(!curves.empty(), "direction", fmt::format("{:.6g}deg", *angle * 180 / std::numbers::pi),
          there);
  return curves;
}

Solutions solutions(CurveContact body, const Context& context) {
  Solutions all;
  for (ForceCurve& curve : chosen_curves(body)) {
    std::vector<std::string> warnings = warnings_of_moduli(curve, body.modulus_ratio);
    CurveContact one{std::move(curve), body.modulus_ratio, body.at, body.source};
    auto table = law(one, context);
    auto points = points_on(one.curve, one.at, one.source);
    all.push_back(
        {std::move(table), std::move(points), std::move(one.curve), {}, {}, std::move(warnings)});
  }
  return all;
}

Solutions solutions(SurfaceContact body, const Context& context) {
  for (const double value : body.pressure) require_positive(value, "pressure");
  const double largest = std::ranges::max(body.pressure);
  std::vector<std::string> warnings;
  const std::optional<Material>& material = body.body.half_space_material();
  if (material)
    if (const auto warning = warning_of_pressure(largest, material->contact_modulus))
      warnings.push_back(*warning);
  const SurfaceLay lay = surface_lay(body.surface);
  const std::vector<double> directions = directions_of(body.direction, lay);
  if (std::holds_alternative<double>(body.direction))
    std::ranges::move(
        warnings_of_lay(lay, 0,
                        "the tangential stiffness and the damping constant are those of motion " +
                            direction_in_words(directions.front()) +
                            "; along and across the lay they differ",
                        {}),
        std::back_inserter(warnings));
  require(material || !body.hardness, "hardness",
          format_quantity(body.hardness.value_or(0), Dimension::pressure),
          "is for homogeneous half-spaces; leave it out, or give their elastic constants");
  if (body.hardness && body.normal_amplitude > 0)
    body.hold = detail::hold_of(body.surface, body.body, std::ranges::min(body.pressure),
                                body.normal_amplitude, body.hold, context.on_progress);
  const std::optional<FirstLoading> first_loading =
      load_first(body.surface, body.hardness, material ? material->contact_modulus : 0, largest,
                 {.on_progress = context.on_progress}, body.normal_amplitude, body.hold);
  std::vector<ForceCurve> curves =
      curves_of_surface(body, pressures_about(body.pressure), directions, context);
  const Hold hold = body.normal_amplitude > 0 ? hold_of(body, curves.front()) : body.hold;
  if (body.normal_amplitude > 0) cover_motion(curves, directions, body, hold, context);
  Solutions all;
  for (ForceCurve& curve : curves) {
    CurveContact swept{.curve = std::move(curve),
                       .modulus_ratio = body.body.modulus_ratio(),
                       .at = {ControlQuantity::pressure, body.pressure}};
    auto table = law(swept, context);
    auto points = points_on(swept.curve, swept.at, "surface");
    all.push_back({std::move(table), std::move(points), std::move(swept.curve), body.surface,
                   first_loading, warnings, hold});
  }
  return all;
}

}  // namespace

std::size_t ContactSolution::load() const {
  const double force = law->force(indentation_of(*law, points.front()));
  const auto nearest = std::ranges::min_element(
      curve->samples, {}, [&](const ForceSample& one) { return std::abs(one.force - force); });
  return std::size_t(nearest - curve->samples.begin());
}

ContactParameters ContactSolution::parameters_at(ContactParameters parameters, double indentation,
                                                 double deepest) const {
  parameters = at_state(parameters, *law, curve ? &*curve : nullptr, indentation, deepest);
  if (first_loading && first_loading->yielded())
    parameters.first_load = first_loading->pressure * curve->nominal_area;
  return parameters;
}

Assumptions ContactSolution::assumptions_beside_slip(double indentation, const Oscillation& motion,
                                                     const ContactParameters& known) const {
  const double deepest = indentation + detail::normal_amplitude(motion);
  Assumptions assumptions =
      assumptions_of(*law, indentation, motion, parameters_at(known, indentation, deepest));
  // Sets four assumptions to `holds`, because they do not apply where slip is computed: both
  // assumptions on slip, the one on slow motion (there are no turning points), and the one on small
  // amplitudes (the loss is that at finite amplitude).
  for (const auto assumption :
       {&Assumptions::slip_of_opening_springs, &Assumptions::slip_of_closed_springs,
        &Assumptions::slow_motion, &Assumptions::amplitude})
    assumptions.*assumption = {.verdict = Verdict::holds};
  assumptions.largest.clear();
  return assumptions;
}

ContactSolution solve(ContactProblem problem, const Context& context) {
  // The number of directions is known before the contacts are solved.
  std::size_t count = 1;
  if (const auto* body = std::get_if<SurfaceContact>(&problem))
    count = directions_of(body->direction, body->surface).size();
  else if (const auto* curve = std::get_if<CurveContact>(&problem))
    count = chosen_curves(*curve).size();
  require(count == 1, "direction", count,
          "directions are possible, across and along the lay; "
          "give one");
  return std::move(solve_directions(std::move(problem), context).front());
}

std::vector<ContactSolution> solve_directions(ContactProblem problem, const Context& context) {
  return std::visit([&](auto&& body) { return solutions(std::move(body), context); },
                    std::move(problem));
}

std::unique_ptr<const ContactLaw> law_of(const ContactProblem& problem, const Context& context) {
  return std::visit([&](const auto& body) { return law(body, context); }, problem);
}

MeanSummit mean_summit(const Surface& surface, const Adhesion& adhesion, double contact_modulus) {
  const SpectralMoments moments = surface_moments(surface);
  if (!(moments.nayak() >= 1) || !(adhesion.work > 0)) return {};
  const SummitEnsemble summits =
      summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  return {tabor_parameter(summits.radius, contact_modulus, adhesion.work, adhesion.range)};
}

LawState state_of(const ContactLaw& law, double indentation) {
  return {law.force(indentation), indentation, law.normal_stiffness(indentation),
          law.tangential_stiffness(indentation)};
}

IndenterState state_of(const IndenterLaw& law, double indentation) {
  return {state_of(static_cast<const ContactLaw&>(law), indentation),
          law.contact_radius(indentation), law.force_curvature(indentation)};
}

std::optional<FirstLoading> load_first(Surface& surface, const std::optional<double>& hardness,
                                       double contact_modulus, double nominal_pressure,
                                       NormalContactOptions contact, double normal_amplitude,
                                       Hold hold) {
  if (!hardness) return {};
  require_positive(*hardness, "hardness");
  contact.hardness = *hardness;
  ResidualSurface residual = detail::loaded_by_motion(
      std::move(surface), contact_modulus, nominal_pressure, contact, normal_amplitude, hold);
  if (residual.termination == Termination::interrupted)
    throw Interrupted("interrupted; nothing was written");
  if (!residual.converged()) throw NotConverged("`hardness`: the first loading did not converge");
  surface = std::move(residual.surface);
  return residual.first_loading;
}

std::vector<std::string> warnings_of_profile(const IndenterProfile& profile,
                                             double contact_radius) {
  constexpr double max_change = 0.05, max_radius = 1;
  const auto* table = dynamic_cast<const TabulatedProfile*>(&profile);
  if (table == nullptr) return {};
  std::vector<std::string> warnings;
  if (table->max_radius() > max_radius)
    warnings.push_back(fmt::format("the table has radii up to {}; check the unit: a table is in m",
                                   format_quantity(table->max_radius(), Dimension::length)));
  const double change = table->image_error(contact_radius);
  if (change > max_change)
    warnings.push_back(
        fmt::format("the table is coarse: without every other point the indentation at the contact "
                    "radius {} changes by {:.2g} %; give more points",
                    format_quantity(contact_radius, Dimension::length), 100 * change));
  return warnings;
}

}  // namespace salebra
