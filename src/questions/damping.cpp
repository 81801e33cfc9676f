// SPDX-License-Identifier: GPL-3.0-or-later
// Losses of contacts in motions with a name, in measured ones, and as dampers, with their premises.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/questions/damping.hpp>
#include <utility>

#include "damping/largest_motion.hpp"

namespace salebra {
namespace {

constexpr double not_known = ContactFacts::unknown;

/// One of the cases.
struct Case {
  Position position;
  Motion motion;
  std::optional<double> force_amplitude;
};

template <class T>
const T& at(const std::vector<T>& all, std::size_t i) {
  return all[all.size() == 1 ? 0 : i];
}

std::vector<Case> cases_of(const std::vector<Position>& positions,
                           const DampingQuestion& question) {
  const auto& forces = question.force_amplitude;
  const std::size_t count = std::max({positions.size(), question.motions.size(), forces.size()});
  for (const std::size_t size :
       {positions.size(), question.motions.size(), std::max<std::size_t>(1, forces.size())})
    require(size == 1 || size == count, "motions", question.motions.size(),
            fmt::format("must be one, or one for each of {} cases", count));
  std::vector<Case> cases;
  for (std::size_t i = 0; i < count; ++i) {
    cases.push_back({at(positions, i), at(question.motions, i), {}});
    if (!forces.empty()) cases.back().force_amplitude = at(forces, i);
  }
  return cases;
}

DampingResult result_of(const ContactLaw& law, const Case& one, const DampingOptions& options) {
  if (!one.force_amplitude)
    return std::visit(
        [&](const auto& motion) { return relaxation_damping(law, one.position, motion, options); },
        one.motion);
  const auto* force = std::get_if<AtForce>(&one.position);
  require(force != nullptr, "force_amplitude", *one.force_amplitude,
          "goes with a mean force; give `normal_force` or `pressure`");
  return std::visit(
      [&](const auto& motion) {
        return relaxation_damping_force_controlled(law, force->force, *one.force_amplitude, motion,
                                                   options);
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

/// Power of case (b) at the tangential motion's mean square velocity: what a slow tangential
/// oscillation tends to.
double slow_limit_power(const ContactLaw& law, const Case& one, const DampingOptions& options) {
  const auto& motion = std::get<TwoFrequencies>(one.motion);
  const double velocity =
      motion.tangential_amplitude * motion.tangential_angular_frequency * std::numbers::sqrt2 / 2;
  Case drag = one;
  drag.motion = Drag{motion.normal_amplitude, velocity, motion.normal_angular_frequency};
  return result_of(law, drag, options).power;
}

/// Small-amplitude form over the exact one. Without a common period the two are means, and the work
/// is not known.
double small_over_exact(const DampingResult& result, const Motion& motion) {
  if (!std::isnan(result.work_per_cycle))
    return result.small_amplitude_work / result.work_per_cycle;
  const auto* two = std::get_if<TwoFrequencies>(&motion);
  if (two == nullptr) return not_known;
  return result.small_amplitude_work * two->normal_angular_frequency / (2 * std::numbers::pi) /
         result.power;
}

/// The normal oscillation of a case whose force is given has the amplitude that its stiffness makes
/// of it.
Premises premises_of_case(const ContactAnswer& contact, const Case& one,
                          const DampingResult& result, const ContactFacts& facts) {
  Motion motion = one.motion;
  if (one.force_amplitude)
    std::visit(
        [&](auto& m) { m.normal_amplitude = *one.force_amplitude / result.normal_stiffness; },
        motion);
  const double amplitude = std::visit([](const auto& m) { return m.normal_amplitude; }, motion);
  const double deepest = one.force_amplitude
                             ? contact.law->indentation_of(result.mean_force + *one.force_amplitude)
                             : result.indentation + amplitude;
  const ContactFacts known = contact.facts_at(facts, result.indentation, deepest);
  return std::visit(
      [&](const auto& m) { return premises_of(*contact.law, result.indentation, m, known); },
      motion);
}

/// Why the loss of a case with friction is not known; empty: it is.
std::string why_unknown(const Case& one, const ContactFacts& facts) {
  if (one.force_amplitude)
    return "slip is not followed where `force_amplitude` is given; give the `normal_amplitude`";
  const auto* two = std::get_if<TwoFrequencies>(&one.motion);
  if (two && common_period(*two).normal_cycles == 0)
    return "slip is not followed in a motion that never repeats; give frequencies with a common "
           "period";
  const auto* drag = std::get_if<Drag>(&one.motion);
  if (drag && std::isnan(facts.excursion))
    return "with friction the loss of a slow motion depends on its `excursion`; give it";
  if (drag && facts.excursion < drag->way_per_cycle())
    return "the motion turns back within one normal cycle: it is not slow; give a longer "
           "`excursion`, or a motion of equal frequencies";
  return {};
}

TrajectoryDamping unknown_loss() {
  TrajectoryDamping loss;
  loss.work_per_cycle = loss.slip_work = loss.power = loss.damping_constant =
      loss.storage_stiffness = loss.loss_factor = not_known;
  return loss;
}

/// Of a loss that is known by its works alone, J.
TrajectoryDamping loss_of_works(double total, double slip, const Oscillation& motion) {
  TrajectoryDamping loss = unknown_loss();
  loss.work_per_cycle = total;
  loss.slip_work = slip;
  const double omega = std::visit([](const auto& m) { return m.angular_frequency; }, motion);
  if (omega > 0) loss.power = total * omega / (2 * std::numbers::pi);
  loss.damping_constant = closed_form::damping_constant(total, motion);
  return loss;
}

/// Of a law: a slow motion by its turning points, the others followed step by step.
TrajectoryDamping loss_with_slip_of(const ContactLaw& law, const Motion& motion, double indentation,
                                    const DampingQuestion& question, const Context& context) {
  const double friction = question.facts.friction_coefficient;
  const auto* drag = std::get_if<Drag>(&motion);
  if (drag == nullptr)
    return cycle_of(law, motion, indentation, question.steps, friction, context).loss;
  const LossWithSlip loss =
      loss_with_slip(law, indentation, *drag, friction, question.facts.excursion);
  return loss_of_works(loss.work_per_cycle, loss.slip_work, *drag);
}

/// Puts the loss with slip of case i in the place of that without.
void follow_slip(DampingAnswer& answer, std::size_t i, const TrajectoryDamping& loss) {
  DampingResult& result = answer.results[i];
  answer.work_per_cycle_without_slip.push_back(result.work_per_cycle);
  answer.damping_constant_without_slip.push_back(result.damping_constant);
  result.work_per_cycle = loss.work_per_cycle;
  result.power = loss.power;
  result.damping_constant = loss.damping_constant;
  result.error_estimate = not_known;
  answer.slip_share.push_back(loss.slip_work / loss.work_per_cycle);
  answer.relaxation_share.push_back(1 - answer.slip_share.back());
  answer.storage_stiffness.push_back(loss.storage_stiffness);
  answer.loss_factor.push_back(loss.loss_factor);
}

/// The place of a load, whose pressure came back with round-off.
std::size_t place_of(const ForceCurve& curve, double pressure) {
  const auto nearest = std::ranges::min_element(curve.samples, {}, [&](const ForceSample& sample) {
    return std::abs(sample.pressure - pressure);
  });
  return std::size_t(nearest - curve.samples.begin());
}

/// Each load with its neighbours, from which K_t/K has its slope.
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

/// A surface is not interpolated between loads: contacts inside the oscillation give W and its
/// error.
void resolve_on_surface(const DampingQuestion& question, const std::vector<double>& pressures,
                        const Material& material, bool followed, const Context& context,
                        DampingAnswer& answer) {
  const Oscillation one = *oscillation_of(question.motions.front());
  const double omega = std::visit([](const auto& m) { return m.angular_frequency; }, one);
  const bool slips = !std::isnan(question.facts.friction_coefficient);
  const ForceCurve loads = loads_with_neighbours(*answer.contact.curve, pressures);
  const std::vector<SurfaceDamping> found =
      surface_damping(*answer.contact.surface, material, one, loads,
                      {.hold = question.hold,
                       .amplitude = question.amplitude,
                       .friction_coefficient = question.facts.friction_coefficient,
                       .excursion = question.facts.excursion,
                       .on_progress = context.on_progress});
  for (std::size_t i = 0; i < answer.results.size(); ++i) {
    const SurfaceDamping& load = found[place_of(loads, pressures[i])];
    DampingResult& result = answer.results[i];
    result.work_per_cycle = load.work_per_cycle;
    result.damping_constant = load.damping_constant;
    result.error_estimate = load.error;
    result.converged = load.converged;
    if (slips) {
      answer.damping_constant_without_slip_error.push_back(
          closed_form::damping_constant(load.error, one));
      follow_slip(answer, i,
                  followed
                      ? loss_of_works(load.relaxation_work + load.slip_work, load.slip_work, one)
                      : unknown_loss());
      if (followed) result.error_estimate = load.work_with_slip_error;
    }
    if (followed && !(result.error_estimate < std::abs(result.work_per_cycle))) {
      answer.doubts.push_back(
          fmt::format("the error of the loss at {} exceeds the loss, which is not given; "
                      "a study of the surface with a `relative_error` halves the cells further",
                      format_quantity(pressures[i], Dimension::pressure)));
      result.work_per_cycle = result.damping_constant = not_known;
    }
    answer.damping_constant_error.push_back(
        closed_form::damping_constant(result.error_estimate, one));
    answer.error_estimate.push_back(result.error_estimate);
    if (omega > 0) result.power = result.work_per_cycle * omega / (2 * std::numbers::pi);
  }
}

/// Of a damper: γ, its error, of it what slip dissipates, and γ without slip; NaN where not known.
struct DamperConstant {
  double value = not_known, error = not_known, slip_share = not_known, without_slip = not_known;
};

/// Why γ of a damper with friction is not known; empty: it is.
std::string why_unknown(const DamperQuestion& question, double angular_frequency) {
  if (std::isnan(question.drag_velocity))
    return "with friction the damping constant depends on the `drag_velocity` and the `excursion` "
           "of the slow motion; give both";
  const Drag drag{0, question.drag_velocity, angular_frequency};
  return why_unknown(Case{AtForce{}, drag, {}}, question.facts);
}

bool slips(const DamperQuestion& question) {
  return !std::isnan(question.facts.friction_coefficient);
}

/// Of a law, about its mean indentation; `without` is γ without slip.
DamperConstant constant_with_slip(const DamperQuestion& question, const ContactLaw& law,
                                  double indentation, const Drag& drag, double without) {
  DamperConstant found{.without_slip = without};
  if (!why_unknown(question, drag.angular_frequency).empty()) return found;
  const LossWithSlip loss = loss_with_slip(
      law, indentation, drag, question.facts.friction_coefficient, question.facts.excursion);
  found.value = closed_form::damping_constant(loss.work_per_cycle, drag);
  found.slip_share = loss.slip_work / loss.work_per_cycle;
  return found;
}

/// What a damper of a surface does: γ of each amplitude from contacts inside the oscillation, and
/// what follows from it.
class SurfaceDamper {
 public:
  SurfaceDamper(const DamperQuestion& question, const Material& material, const Context& context,
                DamperAnswer& answer)
      : question_(question), material_(material), answer_(answer), about_(*answer.contact.curve) {
    options_ = {.hold = question.hold,
                .amplitude = question.amplitude,
                .friction_coefficient = question.facts.friction_coefficient,
                .excursion = question.facts.excursion,
                .on_progress = context.on_progress};
    const ForceSample load = about_.samples[answer.contact.load()];
    about_.samples = {load};
  }

  /// Without slip γω is a number of the amplitude alone, and is solved once.
  DamperConstant at(double amplitude, double angular_frequency) {
    if (slips(question_) && why_unknown(question_, angular_frequency).empty())
      return with_slip({amplitude, question_.drag_velocity, angular_frequency});
    if (!(solved_amplitude_ == amplitude)) solved_ = without_slip(amplitude);
    solved_amplitude_ = amplitude;
    const double constant = solved_.value / angular_frequency;
    if (slips(question_)) return {.without_slip = constant};
    return {.value = constant, .error = solved_.error / angular_frequency};
  }

  void decay(double contact_stiffness) {
    const double omega = question_.angular_frequency.front();
    const auto by = [&](double constant) {
      return oscillator_decay(constant, contact_stiffness, omega, *question_.oscillator);
    };
    const double constant = answer_.map.damping_constant(0, 0),
                 error = answer_.damping_constant_error(0, 0);
    const OscillatorDecay found = by(constant), more = by(constant + error);
    OscillatorDecay& off = answer_.decay_error.emplace();
    off.damping_constant = error;
    off.contact_stiffness = off.natural_frequency = off.frequency_ratio = not_known;
    for (double OscillatorDecay::* const number :
         {&OscillatorDecay::damping_ratio, &OscillatorDecay::quality_factor,
          &OscillatorDecay::decay_time, &OscillatorDecay::logarithmic_decrement})
      off.*number = std::abs(more.*number - found.*number);
  }

  /// The amplitude of the law, corrected once by what γ is there, along the slope of the law.
  void stabilise(double angular_frequency) {
    double& amplitude = answer_.stabilising_amplitude.back();
    const double by_law = amplitude;
    const auto lost = [&] {
      amplitude = not_known;
      answer_.stabilising_amplitude_error.push_back(not_known);
    };
    if (!std::isfinite(by_law)) return lost();
    const DamperConstant there = at(by_law, 1);
    const double constant = there.value, error = there.error;
    const Field about =
        damper_map(*answer_.contact.law, answer_.contact.positions.front(), {by_law, 1.05 * by_law},
                   {angular_frequency}, {.hold = question_.hold, .amplitude = question_.amplitude})
            .damping_constant;
    const double exponent = std::log(about(1, 0) / about(0, 0)) / std::log(1.05);
    amplitude *= std::pow(*question_.falling_slope * angular_frequency / constant, 1 / exponent);
    const double off =
        std::hypot(amplitude * error / (constant * exponent), (amplitude - by_law) / 2);
    if (!(exponent > 0) || !(off < amplitude) || amplitude > question_.largest_amplitude)
      return lost();
    answer_.stabilising_amplitude_error.push_back(off);
  }

 private:
  DamperConstant with_slip(const Drag& drag) {
    const SurfaceDamping load = solved(drag, options_);
    const auto constant_of = [&](double work) { return closed_form::damping_constant(work, drag); };
    const double work = load.relaxation_work + load.slip_work;
    return stated({constant_of(work), constant_of(load.work_with_slip_error), load.slip_work / work,
                   load.damping_constant},
                  drag.normal_amplitude);
  }

  /// γω: W is in proportion to v², and any velocity serves.
  DamperConstant without_slip(double amplitude) {
    SurfaceDampingOptions options = options_;
    options.friction_coefficient = options.excursion = not_known;
    const SurfaceDamping load = solved({amplitude, 1e-6, 1}, options);
    return stated({.value = load.damping_constant, .error = load.damping_constant_error()},
                  amplitude);
  }

  SurfaceDamping solved(const Drag& drag, const SurfaceDampingOptions& options) const {
    return surface_damping(*answer_.contact.surface, material_, drag, about_, options)[0];
  }

  /// With its error where this is smaller.
  DamperConstant stated(const DamperConstant& found, double amplitude) {
    if (found.error < std::abs(found.value)) return found;
    answer_.doubts.push_back(fmt::format(
        "the error of the damping constant under {} exceeds it, and neither is given; a finer "
        "surface helps",
        format_quantity(amplitude, Dimension::length)));
    return {.without_slip = found.without_slip};
  }

  const DamperQuestion& question_;
  const Material& material_;
  DamperAnswer& answer_;
  ForceCurve about_;  // the load
  SurfaceDampingOptions options_;
  double solved_amplitude_ = not_known;
  DamperConstant solved_;  // γω there, without slip
};

void require_motion_of_surface(const DampingQuestion& question) {
  require_that(question.motions.size() == 1 && question.force_amplitude.empty() &&
                   !std::holds_alternative<TwoFrequencies>(question.motions.front()),
               "surface",
               "takes one motion of equal frequencies or drag; give several `pressure`, or a "
               "`curve`");
}

}  // namespace

DampingAnswer ask(DampingQuestion question, const Context& context) {
  require_that(!question.motions.empty(), "motions", "not given; give one");
  auto* surface = std::get_if<SurfaceContact>(&question.contact);
  std::vector<double> pressures;
  Material material;
  if (surface) {
    require_motion_of_surface(question);
    surface->normal_amplitude =
        std::visit([](const auto& m) { return m.normal_amplitude; }, question.motions.front());
    pressures = surface->pressure;
    material = surface->material;
  }
  DampingAnswer answer{ask(std::move(question.contact), context)};
  const ContactLaw& law = *answer.contact.law;
  const DampingOptions options{.hold = question.hold, .amplitude = question.amplitude};
  const std::vector<Case> cases = cases_of(answer.contact.positions, question);
  answer.results = results_of(law, cases, options, context);
  if (const auto doubt = detail::doubt_of_held_indentation(question.hold, answer.results))
    answer.doubts.push_back(*doubt);
  const bool slips = !std::isnan(question.facts.friction_coefficient);
  std::string unknown;  // why, one line for all cases
  if (surface) {
    if (slips) unknown = why_unknown(cases.front(), question.facts);
    resolve_on_surface(question, pressures, material, unknown.empty(), context, answer);
  }
  std::vector<std::string> doubts;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& one = cases[i];
    const DampingResult& result = answer.results[i];
    answer.motions.push_back(one.motion);
    if (!surface && slips) {
      const std::string why = why_unknown(one, question.facts);
      if (unknown.empty()) unknown = why;
      follow_slip(answer, i,
                  why.empty()
                      ? loss_with_slip_of(law, one.motion, result.indentation, question, context)
                      : unknown_loss());
    }
    answer.ratio.push_back(1 / small_over_exact(result, one.motion));
    answer.premises.push_back(premises_of_case(answer.contact, one, result, question.facts));
    if (const auto* two = std::get_if<TwoFrequencies>(&one.motion)) {
      answer.periods.push_back(common_period(*two));
      answer.slow_limit_power.push_back(slow_limit_power(law, one, options));
    }
    const auto* drag = std::get_if<Drag>(&one.motion);
    if (drag == nullptr) continue;
    if (const double way = drag->way_per_cycle(); question.facts.excursion >= way)
      answer.work_there_and_back.push_back(result.work_per_cycle * 2 * question.facts.excursion /
                                           way);
    if (!doubts.empty()) continue;
    const ForceCurve* curve = answer.contact.curve ? &*answer.contact.curve : nullptr;
    doubts = doubts_of_path(drag->drag_velocity, drag->angular_frequency,
                            spot_radius(question.facts, law, curve, result.indentation));
  }
  if (!unknown.empty()) doubts.insert(doubts.begin(), unknown);
  answer.doubts.insert(answer.doubts.end(), doubts.begin(), doubts.end());
  return answer;
}

DampingCycle cycle_of(const ContactLaw& law, const Motion& motion, double indentation, int steps,
                      double friction_coefficient, const Context& context) {
  DampingCycle cycle;
  cycle.path = std::visit([&](const auto& m) { return sample(m, indentation, steps); }, motion);
  TrajectoryDampingOptions options{.on_progress = context.on_progress};
  if (!std::isnan(friction_coefficient)) options.friction_coefficient = friction_coefficient;
  cycle.loss = trajectory_damping(law, cycle.path, options);
  const auto* equal = std::get_if<EqualFrequency>(&motion);
  // Its frequency is not known.
  if (equal && !(equal->angular_frequency > 0))
    cycle.loss.power = cycle.loss.damping_constant = not_known;
  return cycle;
}

StressMap stress_map_of(const DampingAnswer& answer, int phases, int radii,
                        const Context& context) {
  return stress_map(dynamic_cast<const IndenterLaw&>(*answer.contact.law),
                    answer.results.front().indentation, *oscillation_of(answer.motions.front()),
                    phases, radii, context.on_progress);
}

FrictionMap friction_map_of(const DampingAnswer& answer, std::vector<double> friction_numbers,
                            int steps, const Context& context) {
  if (friction_numbers.empty())
    for (int i = 0; i <= 24; ++i) friction_numbers.push_back(std::pow(10.0, -1 + i / 8.0));
  std::vector<double> phases;
  for (int i = 1; i <= 18; ++i) phases.push_back(std::numbers::pi / 36 * i);
  const auto& motion = std::get<EqualFrequency>(answer.motions.front());
  return friction_map(*answer.contact.law, answer.results.front().indentation,
                      motion.normal_amplitude, motion.tangential_amplitude, friction_numbers,
                      phases, {.steps = steps, .on_progress = context.on_progress});
}

PathAnswer ask(const PathQuestion& question, const Context& context) {
  const auto law = law_of(question.contact, context);
  const double friction = question.facts.friction_coefficient;
  const bool planar = !question.transverse.empty();
  require(!planar || std::isnan(friction), "friction_coefficient", friction,
          "cannot be combined with a trajectory in two directions, whose slip is not followed; "
          "leave it out, or the fourth column");
  const auto [low, high] = std::ranges::minmax(question.path.indentation);
  // The exponential law counts indentations from its rest.
  if (const auto* body = std::get_if<ExponentialContact>(&question.contact))
    require(high <= detail::possible_amplitude(body->decay_length), "trajectory", high,
            fmt::format("m is an indentation at which the force is more than {:g} times that at "
                        "rest, up to which an exponential law holds; at most {}",
                        detail::most_force_ratio,
                        format_quantity(detail::possible_amplitude(body->decay_length),
                                        Dimension::length, 3)));
  TrajectoryDampingOptions options{.on_progress = context.on_progress};
  if (!std::isnan(friction)) options.friction_coefficient = friction;
  PathAnswer answer;
  answer.loss = planar ? trajectory_damping(*law, question.path, question.transverse)
                       : trajectory_damping(*law, question.path, options);
  answer.premises = premises_of(*law, question.path,
                                at_state(question.facts, *law, nullptr, 0.5 * (low + high), high));
  if (!planar) return answer;
  // Slip is judged along x alone, where it is one of the vector.
  Premises& judged = answer.premises;
  judged.slip_of_opening_levels = judged.slip_of_closed_levels = {};
  judged.largest.clear();
  judged.regime = Regime::unknown;
  return answer;
}

namespace {

/// Puts γ of the surface, with friction that with slip, in the place of the law's without.
void fill_map(const DamperQuestion& question, const std::vector<double>& indentations,
              std::optional<SurfaceDamper>& of_surface, DamperAnswer& answer) {
  DamperMap& map = answer.map;
  if (map.damping_constant.size() == 0 || !(of_surface || slips(question))) return;
  if (of_surface) answer.damping_constant_error = map.damping_constant;
  if (slips(question)) {
    answer.damping_constant_without_slip = answer.slip_share = map.damping_constant;
    const std::string unknown = why_unknown(question, std::ranges::min(map.angular_frequency));
    if (!unknown.empty()) answer.doubts.push_back(unknown);
  }
  for (std::size_t i = 0; i < map.normal_amplitude.size(); ++i)
    for (std::size_t j = 0; j < map.angular_frequency.size(); ++j) {
      const auto row = Index(i), column = Index(j);
      const Drag drag{map.normal_amplitude[i], question.drag_velocity, map.angular_frequency[j]};
      double& constant = map.damping_constant(row, column);
      const DamperConstant found =
          of_surface
              ? of_surface->at(drag.normal_amplitude, drag.angular_frequency)
              : constant_with_slip(question, *answer.contact.law, indentations[i], drag, constant);
      constant = found.value;
      if (of_surface) answer.damping_constant_error(row, column) = found.error;
      if (!slips(question)) continue;
      answer.damping_constant_without_slip(row, column) = found.without_slip;
      answer.slip_share(row, column) = found.slip_share;
    }
}

}  // namespace

DamperAnswer ask(DamperQuestion question, const Context& context) {
  const std::vector<double>&amplitudes = question.normal_amplitude,
        &omega = question.angular_frequency;
  require_that(!omega.empty(), "frequency", "not given, but a damper needs it; give it");
  require(!question.falling_slope || !slips(question), "falling_slope",
          question.falling_slope.value_or(0),
          "N s/m is held against the damping without slip; leave out `friction_coefficient`, or "
          "ask for steady sliding, where stability follows the slip");
  Material material;
  if (auto* surface = std::get_if<SurfaceContact>(&question.contact)) {
    surface->normal_amplitude = amplitudes.empty() ? 0 : std::ranges::max(amplitudes);
    material = surface->material;
  }
  DamperAnswer answer{ask(std::move(question.contact), context)};
  const ContactLaw& law = *answer.contact.law;
  require(answer.contact.positions.size() == 1, "normal_force",
          fmt::format("{} positions", answer.contact.positions.size()),
          "are given; a damper takes one");
  const Position& position = answer.contact.positions.front();
  const DampingOptions options{
      .hold = question.hold, .amplitude = question.amplitude, .on_progress = context.on_progress};
  const bool one = amplitudes.size() == 1 && omega.size() == 1;
  std::vector<double> indentations;
  std::vector<DampingResult> rested;
  for (const double amplitude : amplitudes) {
    Drag motion{amplitude, 0, std::ranges::max(omega)};
    rested.push_back(relaxation_damping(law, position, motion, options));
    indentations.push_back(rested.back().indentation);
    motion.drag_velocity = question.drag_velocity;
    answer.premises.push_back(
        premises_of(law, indentations.back(), motion,
                    answer.contact.facts_at(question.facts, indentations.back(),
                                            indentations.back() + amplitude)));
  }
  if (const auto doubt = detail::doubt_of_held_indentation(question.hold, rested))
    answer.doubts.push_back(*doubt);
  std::optional<SurfaceDamper> of_surface;
  if (answer.contact.surface) of_surface.emplace(question, material, context, answer);
  if (!amplitudes.empty())
    answer.map = damper_map(law, position, amplitudes, omega, options);
  else
    require_that(question.falling_slope.has_value(), "normal_amplitude",
                 "missing; give it, or `falling_slope` to have it computed");
  fill_map(question, indentations, of_surface, answer);
  if (question.oscillator) {
    require(one, "mass", question.oscillator->mass,
            "kg needs one `normal_amplitude` and one `frequency`");
    answer.decay =
        oscillator_decay(answer.map.damping_constant(0, 0),
                         law.tangential_stiffness(indentations.front() - amplitudes.front()),
                         omega.front(), *question.oscillator);
    if (of_surface) of_surface->decay(answer.decay->contact_stiffness);
  }
  if (!question.falling_slope) return answer;
  require_positive(*question.falling_slope, "falling_slope");
  for (const double frequency : omega) {
    answer.stabilising_amplitude.push_back(stabilising_amplitude(
        law, position, frequency, *question.falling_slope, question.largest_amplitude, options));
    if (of_surface) of_surface->stabilise(frequency);
  }
  return answer;
}

std::vector<std::string> doubts_of_path(double drag_velocity, double angular_frequency,
                                        double spot_radius) {
  const double path = 2 * std::numbers::pi * drag_velocity / angular_frequency;
  if (!(path > 2 * spot_radius)) return {};
  return {fmt::format(
      "the slow motion moves on by 2 pi v/w = {} in one normal cycle, beyond a contact spot of {} "
      "across; take a lower `drag_velocity` or a higher `frequency`",
      format_quantity(path, Dimension::length),
      format_quantity(2 * spot_radius, Dimension::length))};
}

}  // namespace salebra
