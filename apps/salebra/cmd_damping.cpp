// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra damping`: loss per cycle of a contact law under an oscillation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/results/columns.hpp>

#include "answer_file.hpp"
#include "figures.hpp"
#include "first_loading.hpp"
#include "follow.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "plausibility.hpp"
#include "premise_options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct DampingArguments {
  LawOptions law;
  std::string amplitude = "finite", hold = "indentation";
  MaterialOptions material;
  MotionOptions motion;
  std::vector<double> force_amplitude;
  FollowOptions follow;
  PremiseOptions premises;
};

struct DampingCase {
  Position position;
  Motion motion;
  std::optional<double> force_amplitude;
};

// The quantity that has several values, by its name in JSON; "" if there is none.
std::pair<std::string, std::vector<double>> varied(const DampingArguments& arguments) {
  const LawOptions& law = arguments.law;
  auto found = arguments.motion.varied();
  for (const auto& [name, values] : {std::pair{"force", &law.force},
                                     {"indentation", &law.indentation},
                                     {"pressure", &law.pressure},
                                     {"mean_gap", &law.mean_gap},
                                     {"force_amplitude", &arguments.force_amplitude}}) {
    if (values->size() < 2) continue;
    require(found.second.empty(), name, fmt::format("{} values", values->size()),
            "are a second range; only one quantity may be a range");
    found = {name, *values};
  }
  return found;
}

std::vector<Motion> motions_of(const DampingArguments& arguments) {
  if (arguments.force_amplitude.empty()) return arguments.motion.all_motions();
  require(arguments.motion.normal_amplitude.empty(), "--force-amplitude",
          arguments.force_amplitude.front(),
          "is given together with --normal-amplitude; give one of them");
  // The library takes the amplitude of the force in its place.
  MotionOptions motion = arguments.motion;
  motion.normal_amplitude = {0};
  return motion.all_motions();
}

DampingResult result_of(const ContactLaw& law, const DampingCase& one,
                        const DampingOptions& options) {
  if (!one.force_amplitude) return damping_of(law, one.position, one.motion, options);
  const auto* force = std::get_if<AtForce>(&one.position);
  require(force != nullptr, "--force-amplitude", *one.force_amplitude,
          "goes with a mean force; give --normal-force or --pressure");
  return std::visit(
      [&](const auto& motion) {
        return relaxation_damping_force_controlled(law, force->force, *one.force_amplitude, motion,
                                                   options);
      },
      one.motion);
}

// Power of case (b) at the tangential motion's mean square velocity: what a slow tangential
// oscillation tends to.
double slow_limit_power(const ContactLaw& law, const DampingCase& one,
                        const DampingOptions& options) {
  const auto& motion = std::get<TwoFrequencies>(one.motion);
  const double velocity =
      motion.tangential_amplitude * motion.tangential_angular_frequency * std::numbers::sqrt2 / 2;
  DampingCase drag = one;
  drag.motion = Drag{motion.normal_amplitude, velocity, motion.normal_angular_frequency};
  return result_of(law, drag, options).power;
}

// Small-amplitude form over the exact one. Without a common period the two are means, and the work
// is not known.
double small_over_exact(const DampingResult& result, const Motion& motion) {
  if (!std::isnan(result.work_per_cycle))
    return result.small_amplitude_work / result.work_per_cycle;
  const auto* two = std::get_if<TwoFrequencies>(&motion);
  if (two == nullptr) return std::numeric_limits<double>::quiet_NaN();
  return result.small_amplitude_work * two->normal_angular_frequency / (2 * std::numbers::pi) /
         result.power;
}

// The normal oscillation of a case whose force is given has the amplitude that its stiffness makes
// of it.
Premises premises_of_case(const ContactAnswer& contact, const DampingCase& one,
                          const DampingResult& result, const ContactFacts& facts) {
  const ContactLaw& law = *contact.law;
  Motion motion = one.motion;
  if (one.force_amplitude)
    std::visit(
        [&](auto& m) { m.normal_amplitude = *one.force_amplitude / result.normal_stiffness; },
        motion);
  const ContactFacts known = contact.facts_at(facts, result.indentation);
  return std::visit([&](const auto& m) { return premises_of(law, result.indentation, m, known); },
                    motion);
}

// A surface is not interpolated between loads: contacts inside the oscillation give W and its
// error. Returns the errors of γ.
std::vector<double> resolve_on_surface(const DampingArguments& arguments,
                                       const ContactAnswer& contact, const Motion& motion,
                                       const DampingOptions& options, Session& session,
                                       std::vector<DampingResult>& results) {
  const Oscillation one = std::holds_alternative<Drag>(motion)
                              ? Oscillation(std::get<Drag>(motion))
                              : Oscillation(std::get<EqualFrequency>(motion));
  const double omega = std::visit([](const auto& m) { return m.angular_frequency; }, one);
  // The place of a load, whose pressure came back with round-off.
  const auto place_of = [](const ForceCurve& curve, double pressure) {
    const auto nearest = std::ranges::min_element(
        curve.samples, {},
        [&](const ForceSample& sample) { return std::abs(sample.pressure - pressure); });
    return std::size_t(nearest - curve.samples.begin());
  };
  // Each load with its neighbours, from which K_t/K has its slope.
  const ForceCurve& all = *contact.curve;
  ForceCurve loads = all;
  loads.samples.clear();
  for (std::size_t k = 0; k < all.samples.size(); ++k)
    if (std::ranges::any_of(arguments.law.pressure, [&](double pressure) {
          const std::size_t asked = place_of(all, pressure);
          return k + 1 >= asked && k <= asked + 1;
        }))
      loads.samples.push_back(all.samples[k]);
  const std::vector<SurfaceDamping> found = surface_damping(
      *contact.surface, arguments.material.material_with_tangential_modulus(), one, loads,
      {.hold = options.hold, .amplitude = options.amplitude, .on_progress = session.progress()});
  std::vector<double> errors;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const double pressure = arguments.law.pressure[i];
    const SurfaceDamping& load = found[place_of(loads, pressure)];
    DampingResult& result = results[i];
    errors.push_back(load.damping_constant_error());
    result.work_per_cycle = load.work_per_cycle;
    result.damping_constant = load.damping_constant;
    result.error_estimate = load.error;
    result.converged = load.converged;
    if (!(load.error < std::abs(load.work_per_cycle))) {
      session.warn(
          fmt::format("the error of the loss at {} exceeds the loss, which is not given; "
                      "salebra study --surface with --relative-error halves the cells further",
                      format_quantity(pressure, Dimension::pressure)));
      result.work_per_cycle = result.damping_constant = DampingResult::unknown;
    }
    if (omega > 0) result.power = result.work_per_cycle * omega / (2 * std::numbers::pi);
  }
  return errors;
}

void follow_motion(const DampingArguments& arguments, const ContactAnswer& contact,
                   const DampingCase& one, const DampingOptions& options, Session& session) {
  const ContactLaw& law = *contact.law;
  require(!one.force_amplitude, "--friction", arguments.follow.coefficient(),
          "does not go with --force-amplitude; give --normal-amplitude");
  const DampingResult full_stick = damping_of(law, one.position, one.motion, options);
  const SampledMotion path = sampled(one.motion, full_stick.indentation, arguments.follow.steps);
  const TrajectoryDamping loss =
      follow(law, one.motion, path, arguments.follow.coefficient(), session.progress());
  Json object = json_of(loss);
  object["full_stick_work"] = full_stick.work_per_cycle;
  object["force_curvature"] = full_stick.force_curvature;
  object["force"] = full_stick.force;
  object["indentation"] = full_stick.indentation;
  add_first_loading(object, contact.first_loading);
  const PremiseReport premises{{premises_of_case(
      contact, one, full_stick,
      arguments.premises.facts(arguments.material, arguments.follow.friction_coefficient))}};
  session.plot(cycle_figure(path, loss));
  write_answer(session, "damping", object);
  premises.answer(session, object);
}

// One period of a single case that a picture can show; nothing for a motion that never repeats.
void plot_case(const ContactLaw& law, const DampingCase& one, const DampingResult& result,
               Session& session) {
  if (!session.has_plot()) return;
  require_that(!one.force_amplitude, "--plot",
               "one case of --force-amplitude has no picture; give it as a range");
  const SampledMotion path = sampled(one.motion, result.indentation, 1000);
  session.plot(cycle_figure(path, trajectory_damping(law, path)));
}

void run(const DampingArguments& arguments, Session& session) {
  if (!arguments.follow.trajectory.empty()) {
    require(!arguments.motion.given() && arguments.force_amplitude.empty(), "--trajectory",
            arguments.follow.trajectory, "is the motion; leave out the options of Motion");
    follow_file(arguments.follow, *arguments.law.law_alone(arguments.material, session),
                arguments.premises.facts(arguments.material, arguments.follow.friction_coefficient),
                session);
    return;
  }
  const auto [quantity, values] = varied(arguments);
  const std::vector<Motion> motions = motions_of(arguments);
  double largest = 0;
  for (const Motion& motion : motions)
    largest =
        std::max(largest, std::visit([](const auto& m) { return m.normal_amplitude; }, motion));
  const ContactAnswer contact =
      arguments.law.contact(arguments.material, session, arguments.premises.hardness, largest);
  const ContactLaw& law = *contact.law;
  const auto& positions = contact.positions;
  DampingOptions options;
  options.hold = *value_of<Hold>(arguments.hold);
  options.amplitude = *value_of<Amplitude>(arguments.amplitude);

  const auto at = [](const auto& all, std::size_t i) { return all[all.size() == 1 ? 0 : i]; };
  const std::size_t count = std::max<std::size_t>(1, values.size());
  std::vector<DampingCase> cases;
  for (std::size_t i = 0; i < count; ++i) {
    cases.push_back({at(positions, i), at(motions, i), {}});
    if (!arguments.force_amplitude.empty())
      cases.back().force_amplitude = at(arguments.force_amplitude, i);
  }
  const bool one = count == 1;
  if (arguments.follow.friction_coefficient) {
    require(one, "--friction", *arguments.follow.friction_coefficient,
            "takes one motion, not a range");
    follow_motion(arguments, contact, cases.front(), options, session);
    return;
  }

  if (contact.surface)
    require(motions.size() == 1 && arguments.force_amplitude.empty() &&
                arguments.motion.mode != "two-frequencies",
            "--surface", arguments.law.surface.file,
            "takes one motion of equal frequencies or drag; give several --pressure, or a --curve");
  std::vector<DampingResult> results;
  const Progress progress = session.progress();
  for (std::size_t i = 0; i < count; ++i) {
    results.push_back(result_of(law, cases[i], options));
    if (!progress({"damping", static_cast<double>(i + 1) / static_cast<double>(count),
                   static_cast<int>(i + 1), 0}))
      throw Interrupted("damping: stopped before all cases were done");
  }
  std::vector<double> errors;
  if (contact.surface)
    errors = resolve_on_surface(arguments, contact, motions.front(), options, session, results);
  const ContactFacts facts = arguments.premises.facts(arguments.material);
  PremiseReport premises{.list = !one};
  for (std::size_t i = 0; i < count; ++i)
    premises.cases.push_back(premises_of_case(contact, cases[i], results[i], facts));
  for (std::size_t i = 0; i < count; ++i) {
    const auto* drag = std::get_if<Drag>(&cases[i].motion);
    const auto doubts =
        drag ? doubts_of_path(drag->drag_velocity, drag->angular_frequency,
                              spot_radius(facts, law, contact.curve ? &*contact.curve : nullptr,
                                          results[i].indentation))
             : std::vector<std::string>{};
    for (const std::string& line : doubts) session.warn(line);
    if (!doubts.empty()) break;  // one line for a range
  }
  const auto lost = std::ranges::count(results, false, &DampingResult::converged);

  const auto column = [&](const auto& value_of) -> Json {
    if (one) return value_of(0);
    Json all = Json::array();
    for (std::size_t i = 0; i < count; ++i) all.push_back(value_of(i));
    return all;
  };
  const double area = contact.curve ? contact.curve->nominal_area : 0;
  Json object = Json::object();
  if (!one) object[quantity] = values;
  object.add(one ? json_of(results.front(), area) : json_of(results, area));
  if (contact.surface) {
    object["damping_constant_error"] = column([&](std::size_t i) { return errors[i]; });
    object["error_estimate"] = column([&](std::size_t i) { return results[i].error_estimate; });
  }
  const auto ratio = [&](std::size_t i) {
    return 1 / small_over_exact(results[i], cases[i].motion);
  };
  object["ratio"] = column(ratio);
  add_first_loading(object, contact.first_loading);
  if (arguments.motion.mode == "two-frequencies") {
    std::vector<CommonPeriod> periods;
    for (const DampingCase& each : cases)
      periods.push_back(common_period(std::get<TwoFrequencies>(each.motion)));
    object.add(one ? json_of(periods.front()) : json_of(periods));
    object["slow_limit_power"] =
        column([&](std::size_t i) { return slow_limit_power(law, cases[i], options); });
    if (one && periods.front().normal_cycles == 0)
      session.note("the frequencies have no common period: power is the mean over a long time");
  }
  if (lost == 0) {
    write_answer(session, "damping", object);
    if (one)
      plot_case(law, cases.front(), results.front(), session);
    else if (session.has_plot())
      session.plot(damping_figure(quantity, values, results));
  }
  premises.answer(session, object);
  if (lost > 0) {
    throw NotConverged(fmt::format("damping: {} of {} integrals did not reach the tolerance", lost,
                                   results.size()));
  }
}

}  // namespace

void add_damping_command(Program& program) {
  auto arguments = std::make_shared<DampingArguments>();
  Command& command = program.add_command(
      "damping", "relaxation damping of a contact under an oscillation",
      {"salebra damping --law exponential --normal-force 1 --decay-length 100nm --poisson 0.3 "
       "--normal-amplitude 5nm --drag-velocity 1um/s --frequency 20kHz --amplitude small",
       "salebra damping --curve curve.h5 --pressure 10MPa --poisson 0.3 --normal-amplitude "
       "1:20nm:8 --drag-velocity 100nm/s --frequency 20kHz --plot damping.png"},
      [arguments](Session& session) { run(*arguments, session); },
      "the loss over the quantity that is a range, or one period of a single motion");
  arguments->law.add_to(command);
  arguments->motion.add_to(command, true);
  const std::string normal = "Normal motion";
  add_values(command, "--force-amplitude", arguments->force_amplitude, Dimension::force,
             "F_a of a force-controlled motion F + F_a cos wt, instead of --normal-amplitude")
      ->group(normal);
  add_choice<Amplitude>(command, "--amplitude", arguments->amplitude,
                        "of the normal oscillation; default finite")
      ->group(normal);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "what stays in the mean; default indentation")
      ->group(normal);
  arguments->follow.add_to(command);
  arguments->premises.add_to(command);
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
