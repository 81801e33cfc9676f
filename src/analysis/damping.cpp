// SPDX-License-Identifier: GPL-3.0-or-later
// Losses of contacts under formula motions (equal frequencies, drag, two frequencies) and under
// measured paths, and contacts as dampers, each with its assumptions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/error.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <utility>

#include "damping/max_motion.hpp"
#include "damping/phase_quadrature.hpp"
#include "damping/surface_law.hpp"

namespace salebra {
namespace {

constexpr double not_known = ContactParameters::unknown;

struct Case {
  OperatingPoint point;
  Motion motion;
  std::optional<double> force_amplitude;
};

template <class T>
const T& at(const std::vector<T>& all, std::size_t i) {
  return all[all.size() == 1 ? 0 : i];
}

std::vector<Case> cases_of(const std::vector<OperatingPoint>& points,
                           const DampingProblem& problem) {
  const auto& forces = problem.force_amplitude;
  const std::size_t count = std::max({points.size(), problem.motions.size(), forces.size()});
  for (const std::size_t size :
       {points.size(), problem.motions.size(), std::max<std::size_t>(1, forces.size())})
    require(size == 1 || size == count, "motions", problem.motions.size(),
            fmt::format("given; give one, or one for each of the {} cases", count));
  std::vector<Case> cases;
  for (std::size_t i = 0; i < count; ++i) {
    cases.push_back({at(points, i), at(problem.motions, i), {}});
    if (!forces.empty()) cases.back().force_amplitude = at(forces, i);
  }
  return cases;
}

// What the oscillation keeps in all cases: the mean force if hold_of() chooses it for one of them,
// so that the results of a range of loads or amplitudes can be compared.
Hold hold_of_all(const ContactLaw& law, const std::vector<Case>& cases, Hold wanted) {
  const bool force = std::ranges::any_of(cases, [&](const Case& one) {
    const double amplitude =
        std::visit([](const auto& motion) { return motion.normal_amplitude; }, one.motion);
    return hold_of(law, one.point, amplitude, wanted) == Hold::force;
  });
  return force ? Hold::force : Hold::indentation;
}

DampingResult result_of(const ContactLaw& law, const Case& one, const DampingOptions& options) {
  if (!one.force_amplitude)
    return std::visit(
        [&](const auto& motion) { return relaxation_damping(law, one.point, motion, options); },
        one.motion);
  require(one.point.load_given(), "force_amplitude", *one.force_amplitude,
          "needs a mean force; give `normal_force` or `pressure`");
  return std::visit(
      [&](const auto& motion) {
        return relaxation_damping_force_controlled(law, one.point.value, *one.force_amplitude,
                                                   motion, options);
      },
      one.motion);
}

std::vector<DampingResult> results_of(const ContactLaw& law, const std::vector<Case>& cases,
                                      const DampingOptions& options, const Context& context) {
  std::vector<DampingResult> results;
  for (const Case& one : cases) {
    results.push_back(result_of(law, one, options));
    const double done = double(results.size());
    if (context.on_progress &&
        !context.on_progress({"damping", done / double(cases.size()), static_cast<int>(done), 0}))
      throw Interrupted("damping: stopped before all cases were done");
  }
  return results;
}

/// Power of a drag with the root-mean-square velocity of a tangential oscillation: the power of the
/// oscillation in the limit of low tangential frequency.
double slow_limit_power(const ContactLaw& law, const Case& one, const DampingOptions& options) {
  const auto& motion = std::get<TwoFrequencies>(one.motion);
  const double velocity =
      motion.tangential_amplitude * motion.tangential_angular_frequency * std::numbers::sqrt2 / 2;
  Case drag = one;
  drag.motion = Drag{motion.normal_amplitude, velocity, motion.normal_angular_frequency};
  return result_of(law, drag, options).power;
}

/// The loss by the small-amplitude formula divided by the loss at finite amplitude. If the two
/// frequencies have no common period, the loss per cycle is unknown, and this is the ratio of the
/// mean powers.
double small_over_exact(const DampingResult& result, const Motion& motion) {
  if (!std::isnan(result.work_per_cycle))
    return result.small_amplitude_work / result.work_per_cycle;
  const auto* two = std::get_if<TwoFrequencies>(&motion);
  if (two == nullptr) return not_known;
  return result.small_amplitude_work * two->normal_angular_frequency / (2 * std::numbers::pi) /
         result.power;
}

/// Checks the assumptions of one case. If a force amplitude is given, the normal amplitude is the
/// force amplitude divided by K.
Assumptions assumptions_of_case(const ContactSolution& contact, const Case& one,
                                const DampingResult& result, const ContactParameters& parameters) {
  Motion motion = one.motion;
  if (one.force_amplitude)
    std::visit(
        [&](auto& m) { m.normal_amplitude = *one.force_amplitude / result.normal_stiffness; },
        motion);
  const double amplitude = std::visit([](const auto& m) { return m.normal_amplitude; }, motion);
  const double deepest = one.force_amplitude
                             ? contact.law->indentation_of(result.mean_force + *one.force_amplitude)
                             : result.indentation + amplitude;
  const ContactParameters known = contact.parameters_at(parameters, result.indentation, deepest);
  return std::visit(
      [&](const auto& m) { return assumptions_of(*contact.law, result.indentation, m, known); },
      motion);
}

/// Index of the load whose pressure is closest to this one, which may differ from it by round-off.
std::size_t place_of(const ForceCurve& curve, double pressure) {
  const auto nearest = std::ranges::min_element(curve.samples, {}, [&](const ForceSample& sample) {
    return std::abs(sample.pressure - pressure);
  });
  return std::size_t(nearest - curve.samples.begin());
}

/// The loads with these pressures and, for each, the next lower and higher load, from which the
/// change of K_t/K with the load follows.
ForceCurve loads_with_neighbours(const ForceCurve& all, const std::vector<double>& pressures) {
  ForceCurve loads = all;
  loads.samples.clear();
  for (std::size_t k = 0; k < all.samples.size(); ++k)
    if (std::ranges::any_of(pressures, [&](double pressure) {
          const std::size_t asked = place_of(all, pressure);
          return k + 1 >= asked && k <= asked + 1;
        }))
      loads.samples.push_back(all.samples[k]);
  return loads;
}

/// Why a loss is not stated although its contacts were solved; share: SurfaceDamping::leaving_share.
std::string leaving(double share) {
  return fmt::format(
      "{:.2g} % of the cells leave the contact while the bodies approach, more than the error of "
      "the loss, which is a sum over contacts that only grow; simulate the cycle directly",
      100 * share);
}

/// Replaces the losses that the laws of a surface give by the losses from contacts solved inside the
/// oscillation, which have a known error. The laws would interpolate between loads. contacts: the
/// surface in each direction, all cases of which are in `solution`.
void resolve_on_surface(const DampingProblem& problem, const std::vector<double>& pressures,
                        const Body& body, const std::vector<ContactSolution>& contacts,
                        const Context& context, DampingSolution& solution) {
  const Oscillation one = *oscillation_of(problem.motions.front());
  const bool known = why_loss_unknown(problem.motions.front(), problem.parameters).empty();
  std::vector<ForceCurve> loads;
  for (const ContactSolution& contact : contacts)
    loads.push_back(loads_with_neighbours(*contact.curve, pressures));
  SurfaceDampingOptions options = problem.surface;
  options.hold = problem.hold;
  options.amplitude = problem.amplitude;
  options.friction_coefficient = problem.parameters.friction_coefficient;
  options.excursion = problem.parameters.excursion;
  options.on_progress = context.on_progress;
  const std::vector<std::vector<SurfaceDamping>> found =
      surface_damping(*contacts.front().surface, body, one, loads, options);
  for (std::size_t i = 0; i < solution.results.size(); ++i) {
    const std::size_t direction = i / pressures.size();
    const double pressure = pressures[i % pressures.size()];
    const SurfaceDamping& load = found[direction][place_of(loads[direction], pressure)];
    DampingResult& result = solution.results[i];
    if (!std::isnan(load.possible_amplitude))
      detail::refuse_full_contact(detail::normal_amplitude(one), pressure, load.possible_amplitude);
    static_cast<Loss&>(result) = load;
    // The assumptions are judged by the law, so the result keeps the mean indentation of the law.
    result.mean_force = load.mean_force;
    result.max_force = load.max_force;
    result.contact_time = load.contact_time;
    result.drop_uncertain();
    result.error_estimate = load.work_per_cycle_error();
    result.converged = load.converged;
    result.power = closed_form::power(result.work_per_cycle, one);
    if (!body.half_space_material()) solution.leaving_share.push_back(load.leaving_share);
    if (!known)
      result.forget();
    else if (std::isnan(result.work_per_cycle) && load.leaving_share > 0)
      solution.warnings.push_back(fmt::format("at {} there is no loss, because {}",
                                              format_quantity(pressure, Dimension::pressure),
                                              leaving(load.leaving_share)));
    else if (std::isnan(result.work_per_cycle))
      solution.warnings.push_back(
          fmt::format("at {} there is no loss, because its error is larger than the loss; a study "
                      "of the surface with a `relative_error` halves the cells further",
                      format_quantity(pressure, Dimension::pressure)));
  }
}

bool slips(const DamperProblem& problem) {
  return !std::isnan(problem.parameters.friction_coefficient);
}

/// Returns why the damping constant of a damper with friction is unknown; empty if it is known.
std::string why_unknown(const DamperProblem& problem, double angular_frequency) {
  if (slips(problem) && std::isnan(problem.drag_velocity))
    return "with friction the damping constant depends on the `drag_velocity` and the `excursion` "
           "of the slow motion; give both";
  return why_loss_unknown(Drag{0, problem.drag_velocity, angular_frequency}, problem.parameters);
}

/// Returns the loss with slip of a law about its mean indentation, if it is known. without_slip:
/// its damping constant without slip.
Loss loss_of(const DamperProblem& problem, const ContactLaw& law, double indentation,
             const Drag& drag, double without_slip) {
  Loss loss;
  if (why_unknown(problem, drag.angular_frequency).empty())
    loss = loss_with_slip(law, indentation, drag, problem.parameters.friction_coefficient,
                          problem.parameters.excursion);
  loss.damping_constant_without_slip = without_slip;
  return loss;
}

/// A surface as a damper: its damping constant γ at each amplitude from contacts solved inside the
/// oscillation, and the results that follow from γ (decay, amplitude of stable sliding).
class SurfaceDamper {
 public:
  SurfaceDamper(const DamperProblem& problem, const Body& body, const Context& context,
                DamperSolution& solution)
      : problem_(problem), body_(body), solution_(solution), about_(*solution.contact.curve) {
    options_ = {.hold = problem.hold,
                .amplitude = problem.amplitude,
                .friction_coefficient = problem.parameters.friction_coefficient,
                .excursion = problem.parameters.excursion,
                .on_progress = context.on_progress};
    const ForceSample load = about_.samples[solution.contact.load()];
    // Slip of springs on other bodies than half-spaces needs to know how K_t/K changes.
    if (body.half_space_material())
      about_.samples = {load};
    else
      about_ = loads_with_neighbours(about_, {load.pressure});
    load_ = place_of(about_, load.pressure);
  }

  /// Loss at an amplitude and an angular frequency ω. Without slip the product γω depends only on
  /// the amplitude, so contacts are solved once for each amplitude.
  Loss at(double amplitude, double angular_frequency) {
    const bool known = why_unknown(problem_, angular_frequency).empty();
    if (slips(problem_) && known)
      return stated(solved({amplitude, problem_.drag_velocity, angular_frequency}, options_),
                    amplitude);
    if (!(solved_amplitude_ == amplitude)) solved_ = without_slip(amplitude);
    solved_amplitude_ = amplitude;
    Loss loss = solved_;
    for (double* number :
         {&loss.damping_constant, &loss.damping_constant_without_slip, &loss.damping_per_work})
      *number /= angular_frequency;
    if (!known) loss.forget();
    return loss;
  }

  void decay(double contact_stiffness) {
    const double omega = problem_.angular_frequency.front();
    const auto by = [&](double constant) {
      return oscillator_decay(constant, contact_stiffness, omega, *problem_.oscillator);
    };
    const double constant = solution_.map.damping_constant(0, 0),
                 error = solution_.damping_constant_error(0, 0);
    const OscillatorDecay found = by(constant), more = by(constant + error);
    OscillatorDecay& off = solution_.decay_error.emplace();
    off.damping_constant = error;
    off.contact_stiffness = off.natural_frequency = off.frequency_ratio = not_known;
    for (double OscillatorDecay::*const number :
         {&OscillatorDecay::damping_ratio, &OscillatorDecay::quality_factor,
          &OscillatorDecay::decay_time, &OscillatorDecay::logarithmic_decrement})
      off.*number = std::abs(more.*number - found.*number);
  }

  /// Corrects the amplitude of stable sliding that the law gave, in one step: by γ of the surface
  /// at this amplitude, and by the exponent with which γ of the law grows with the amplitude.
  void stabilise(double angular_frequency) {
    double& amplitude = solution_.stabilising_amplitude.back();
    const double by_law = amplitude;
    const auto lost = [&] {
      amplitude = not_known;
      solution_.stabilising_amplitude_error.push_back(not_known);
    };
    if (!std::isfinite(by_law)) return lost();
    const Loss there = at(by_law, 1);
    const double constant = there.damping_constant, error = there.damping_constant_error();
    const Field about = damper_map(*solution_.contact.law, solution_.contact.points.front(),
                                   {by_law, 1.05 * by_law}, {angular_frequency},
                                   {.hold = problem_.hold, .amplitude = problem_.amplitude})
                            .damping_constant;
    const double exponent = std::log(about(1, 0) / about(0, 0)) / std::log(1.05);
    amplitude *= std::pow(*problem_.falling_slope * angular_frequency / constant, 1 / exponent);
    const double off =
        std::hypot(amplitude * error / (constant * exponent), (amplitude - by_law) / 2);
    if (!(exponent > 0) || !(off < amplitude) || amplitude > problem_.max_amplitude) return lost();
    solution_.stabilising_amplitude_error.push_back(off);
  }

 private:
  /// Loss without slip at ω = 1 rad/s, whose γ is γω of any frequency. The drag velocity is
  /// arbitrary, since the loss is proportional to its square.
  Loss without_slip(double amplitude) {
    SurfaceDampingOptions options = options_;
    options.friction_coefficient = options.excursion = not_known;
    return stated(solved({amplitude, 1e-6, 1}, options), amplitude);
  }

  SurfaceDamping solved(const Drag& drag, const SurfaceDampingOptions& options) const {
    return surface_damping(*solution_.contact.surface, body_, drag, about_, options)[load_];
  }

  /// Returns the loss if it exceeds its error. Otherwise adds a warning and returns an unknown
  /// loss.
  Loss stated(SurfaceDamping loss, double amplitude) {
    loss.drop_uncertain();
    if (!std::isnan(loss.damping_constant)) return loss;
    solution_.warnings.push_back(fmt::format(
        "at the amplitude {} there is no damping constant, because {}",
        format_quantity(amplitude, Dimension::length),
        loss.leaving_share > 0 ? leaving(loss.leaving_share)
                               : "its error is larger than the constant; use a finer surface"));
    loss.forget();
    return loss;
  }

  const DamperProblem& problem_;
  const Body& body_;
  DamperSolution& solution_;
  ForceCurve about_;      // the curve with the load of the operating point
  std::size_t load_ = 0;  // its index
  SurfaceDampingOptions options_;
  double solved_amplitude_ = not_known;
  Loss solved_;  // loss without slip at ω = 1 rad/s and the amplitude solved_amplitude_
};

void require_motion_of_surface(const DampingProblem& problem) {
  require_that(problem.motions.size() == 1 && problem.force_amplitude.empty() &&
                   !std::holds_alternative<TwoFrequencies>(problem.motions.front()),
               "surface",
               "takes one motion, drag or equal frequencies; give several values of `pressure`, or "
               "a `curve`");
}

}  // namespace

DampingSolution solve(DampingProblem problem, const Context& context) {
  require_that(!problem.motions.empty(), "motions", "not given; give one");
  auto* surface = std::get_if<SurfaceContact>(&problem.contact);
  std::vector<double> pressures;
  std::optional<Body> body;
  if (surface) {
    require_motion_of_surface(problem);
    surface->normal_amplitude =
        problem.amplitude == Amplitude::small
            ? 0
            : std::visit([](const auto& m) { return m.normal_amplitude; }, problem.motions.front());
    surface->hold = problem.hold;
    pressures = surface->pressure;
    body = surface->body;
  }
  std::vector<ContactSolution> contacts = solve_directions(std::move(problem.contact), context);
  const std::vector<Case> cases = cases_of(contacts.front().points, problem);
  problem.hold =
      hold_of_all(*contacts.front().law, cases, surface ? contacts.front().hold : problem.hold);
  const DampingOptions options{.hold = problem.hold, .amplitude = problem.amplitude};
  DampingSolution solution;
  for (const ContactSolution& contact : contacts) {
    std::ranges::move(results_of(*contact.law, cases, options, context),
                      std::back_inserter(solution.results));
    for (std::size_t k = solution.results.size() - cases.size(); k < solution.results.size(); ++k)
      solution.results[k].direction = contact.direction();
  }
  if (const auto warning = detail::warning_of_held_indentation(solution.results))
    solution.warnings.push_back(*warning);
  // Why a loss is unknown, or was dropped; the first reason found serves all cases.
  std::string unknown, dropped;
  if (surface) resolve_on_surface(problem, pressures, *body, contacts, context, solution);
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < solution.results.size(); ++i) {
    const ContactSolution& contact = contacts[i / cases.size()];
    const ContactLaw& law = *contact.law;
    const Case& one = cases[i % cases.size()];
    DampingResult& result = solution.results[i];
    solution.motions.push_back(one.motion);
    const std::string why =
        why_loss_unknown(one.motion, problem.parameters, one.force_amplitude.has_value());
    if (unknown.empty()) unknown = why;
    if (!why.empty())
      result.forget();
    else if (!surface)
      add_slip(result, law, one.motion, problem.parameters, problem.steps, context);
    if (!surface)
      if (const std::string why_dropped = drop_uncertain(result); dropped.empty())
        dropped = why_dropped;
    solution.ratio.push_back(1 / small_over_exact(result, one.motion));
    solution.assumptions.push_back(assumptions_of_case(contact, one, result, problem.parameters));
    if (const auto* two = std::get_if<TwoFrequencies>(&one.motion)) {
      solution.periods.push_back(common_period(*two));
      solution.slow_limit_power.push_back(slow_limit_power(law, one, options));
    }
    const auto* drag = std::get_if<Drag>(&one.motion);
    if (drag == nullptr) continue;
    if (const double distance = drag->distance_per_cycle();
        problem.parameters.excursion >= distance)
      solution.work_there_and_back.push_back(result.work_per_cycle * 2 *
                                             problem.parameters.excursion / distance);
    if (!warnings.empty()) continue;
    const ForceCurve* curve = contact.curve ? &*contact.curve : nullptr;
    warnings = warnings_of_path(drag->drag_velocity, drag->angular_frequency,
                                spot_radius(problem.parameters, law, curve, result.indentation));
  }
  solution.contact = std::move(contacts.front());
  for (const std::string& why : {dropped, unknown})
    if (!why.empty()) warnings.insert(warnings.begin(), why);
  solution.warnings.insert(solution.warnings.end(), warnings.begin(), warnings.end());
  return solution;
}

StressMap stress_map_of(const DampingSolution& solution, int phases, int radii,
                        const Context& context) {
  return stress_map(dynamic_cast<const IndenterLaw&>(*solution.contact.law),
                    solution.results.front().indentation, *oscillation_of(solution.motions.front()),
                    phases, radii, context.on_progress);
}

FrictionMap friction_map_of(const DampingSolution& solution, std::vector<double> friction_numbers,
                            int steps, const Context& context) {
  if (friction_numbers.empty())
    for (int i = 0; i <= 24; ++i) friction_numbers.push_back(std::pow(10.0, -1 + i / 8.0));
  std::vector<double> phases;
  for (int i = 1; i <= 18; ++i) phases.push_back(std::numbers::pi / 36 * i);
  const auto& motion = std::get<EqualFrequency>(solution.motions.front());
  return friction_map(*solution.contact.law, solution.results.front().indentation,
                      motion.normal_amplitude, motion.tangential_amplitude, friction_numbers,
                      phases, {.steps = steps, .on_progress = context.on_progress});
}

PathSolution solve(const PathProblem& problem, const Context& context) {
  const auto law = law_of(problem.contact, context);
  const double friction = problem.parameters.friction_coefficient;
  const bool planar = !problem.transverse.empty();
  require(!planar || std::isnan(friction), "friction_coefficient", friction,
          "cannot be combined with a trajectory in two directions, for which slip is not computed; "
          "leave it out, or the fourth column");
  const auto [low, high] = std::ranges::minmax(problem.path.indentation);
  // An exponential law measures the indentation from the operating point, where it is 0.
  if (const auto* body = std::get_if<ExponentialContact>(&problem.contact))
    require(high <= detail::possible_amplitude(body->decay_length), "trajectory", high,
            fmt::format("m is reached, where the force is more than {:g} times the force at rest; "
                        "an exponential law allows at most {}",
                        detail::max_force_ratio,
                        format_quantity(detail::possible_amplitude(body->decay_length),
                                        Dimension::length, 3)));
  TrajectoryDampingOptions options{.on_progress = context.on_progress};
  if (!std::isnan(friction)) options.friction_coefficient = friction;
  PathSolution solution;
  solution.loss = planar ? trajectory_damping(*law, problem.path, problem.transverse)
                         : trajectory_damping(*law, problem.path, options);
  solution.assumptions = assumptions_of(
      *law, problem.path, at_state(problem.parameters, *law, nullptr, 0.5 * (low + high), high));
  if (!planar) return solution;
  // Slip is only judged for a motion along x. Here the motion has two directions, so the verdicts
  // on slip are removed.
  Assumptions& judged = solution.assumptions;
  judged.slip_of_opening_springs = judged.slip_of_closed_springs = {};
  judged.largest.clear();
  judged.regime = Regime::unknown;
  return solution;
}

namespace {

/// Replaces γ in the map, which the law gave without slip: by γ of the surface if there is one, and
/// by γ with slip if the coefficient of friction is known.
void fill_map(const DamperProblem& problem, const std::vector<double>& indentations,
              std::optional<SurfaceDamper>& of_surface, DamperSolution& solution) {
  DamperMap& map = solution.map;
  if (map.damping_constant.size() == 0 || !(of_surface || slips(problem))) return;
  if (of_surface) solution.damping_constant_error = map.damping_constant;
  if (slips(problem)) {
    solution.damping_constant_without_slip = solution.slip_share = map.damping_constant;
    const std::string unknown = why_unknown(problem, std::ranges::min(map.angular_frequency));
    if (!unknown.empty()) solution.warnings.push_back(unknown);
  }
  for (std::size_t i = 0; i < map.normal_amplitude.size(); ++i)
    for (std::size_t j = 0; j < map.angular_frequency.size(); ++j) {
      const auto row = Index(i), column = Index(j);
      const Drag drag{map.normal_amplitude[i], problem.drag_velocity, map.angular_frequency[j]};
      double& constant = map.damping_constant(row, column);
      const Loss found =
          of_surface ? of_surface->at(drag.normal_amplitude, drag.angular_frequency)
                     : loss_of(problem, *solution.contact.law, indentations[i], drag, constant);
      constant = found.damping_constant;
      if (of_surface) solution.damping_constant_error(row, column) = found.damping_constant_error();
      if (!slips(problem)) continue;
      solution.damping_constant_without_slip(row, column) = found.damping_constant_without_slip;
      solution.slip_share(row, column) = found.slip_share();
    }
}

/// Checks a damper, and passes its largest amplitude to its surface. Returns the body under
/// the surface.
std::optional<Body> prepare(DamperProblem& problem) {
  const std::vector<double>&amplitudes = problem.normal_amplitude,
        &omega = problem.angular_frequency;
  require_that(!omega.empty(), "frequency", "not given, but a damper needs it; give it");
  require(!problem.falling_slope || !slips(problem), "falling_slope",
          problem.falling_slope.value_or(0),
          "N s/m is compared with the damping without slip; leave out `friction_coefficient`, or "
          "use steady sliding, whose stability includes slip");
  std::optional<Body> body;
  if (auto* surface = std::get_if<SurfaceContact>(&problem.contact)) {
    surface->normal_amplitude = amplitudes.empty() ? 0 : std::ranges::max(amplitudes);
    surface->hold = problem.hold;
    body = surface->body;
  }
  return body;
}

/// Computes the damper of a contact in one direction.
DamperSolution damper_of(DamperProblem problem, ContactSolution contact,
                         const std::optional<Body>& body, const Context& context) {
  const std::vector<double>&amplitudes = problem.normal_amplitude,
        &omega = problem.angular_frequency;
  DamperSolution solution{std::move(contact)};
  if (solution.contact.surface) problem.hold = solution.contact.hold;
  const ContactLaw& law = *solution.contact.law;
  require(solution.contact.points.size() == 1, "normal_force",
          fmt::format("{} operating points", solution.contact.points.size()),
          "given; a damper takes one");
  const OperatingPoint& point = solution.contact.points.front();
  const DampingOptions options{
      .hold = problem.hold, .amplitude = problem.amplitude, .on_progress = context.on_progress};
  const bool one = amplitudes.size() == 1 && omega.size() == 1;
  std::vector<double> indentations;
  std::vector<DampingResult> rested;
  for (const double amplitude : amplitudes) {
    Drag motion{amplitude, 0, std::ranges::max(omega)};
    rested.push_back(relaxation_damping(law, point, motion, options));
    indentations.push_back(rested.back().indentation);
    motion.drag_velocity = problem.drag_velocity;
    solution.assumptions.push_back(
        assumptions_of(law, indentations.back(), motion,
                       solution.contact.parameters_at(problem.parameters, indentations.back(),
                                                      indentations.back() + amplitude)));
  }
  if (const auto warning = detail::warning_of_held_indentation(rested))
    solution.warnings.push_back(*warning);
  std::optional<SurfaceDamper> of_surface;
  if (solution.contact.surface) of_surface.emplace(problem, *body, context, solution);
  if (!amplitudes.empty())
    solution.map = damper_map(law, point, amplitudes, omega, options);
  else
    require_that(problem.falling_slope.has_value(), "normal_amplitude",
                 "not given; give it, or give `falling_slope` to compute it");
  fill_map(problem, indentations, of_surface, solution);
  if (problem.oscillator) {
    require(one, "mass", problem.oscillator->mass,
            "kg needs one `normal_amplitude` and one `frequency`");
    solution.decay =
        oscillator_decay(solution.map.damping_constant(0, 0),
                         law.tangential_stiffness(indentations.front() - amplitudes.front()),
                         omega.front(), *problem.oscillator);
    if (of_surface) of_surface->decay(solution.decay->contact_stiffness);
  }
  if (!problem.falling_slope) return solution;
  require_positive(*problem.falling_slope, "falling_slope");
  require(!std::isnan(law.modulus_ratio()), "falling_slope", *problem.falling_slope,
          "N s/m is answered on half-spaces only, as its search needs G*/E*; compute the damping "
          "constant for several amplitudes");
  for (const double frequency : omega) {
    solution.stabilising_amplitude.push_back(stabilising_amplitude(
        law, point, frequency, *problem.falling_slope, problem.max_amplitude, options));
    if (of_surface) of_surface->stabilise(frequency);
  }
  return solution;
}

}  // namespace

DamperSolution solve(DamperProblem problem, const Context& context) {
  const std::optional<Body> body = prepare(problem);
  ContactSolution contact = solve(std::move(problem.contact), context);
  return damper_of(std::move(problem), std::move(contact), body, context);
}

std::vector<DamperSolution> solve_directions(DamperProblem problem, const Context& context) {
  const std::optional<Body> body = prepare(problem);
  std::vector<DamperSolution> solutions;
  for (ContactSolution& contact : solve_directions(std::move(problem.contact), context)) {
    DamperProblem one = problem;
    solutions.push_back(damper_of(std::move(one), std::move(contact), body, context));
  }
  return solutions;
}

std::vector<std::string> warnings_of_path(double drag_velocity, double angular_frequency,
                                          double spot_radius) {
  const double path = 2 * std::numbers::pi * drag_velocity / angular_frequency;
  // Where the bodies are apart at the mean indentation, the size of a patch is not known.
  if (!(spot_radius > 0) || !(path > 2 * spot_radius)) return {};
  return {fmt::format(
      "the slow motion moves by 2 pi v/w = {} in one normal cycle, more than the contact patch "
      "size of {}; choose a lower `drag_velocity` or a higher `frequency`",
      format_quantity(path, Dimension::length),
      format_quantity(2 * spot_radius, Dimension::length))};
}

}  // namespace salebra
