// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra oscillate`: direct simulation of an oscillating contact, next to the theorem.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/results/columns.hpp>

#include "first_loading.hpp"
#include "friction_run.hpp"
#include "options.hpp"
#include "oscillation_case.hpp"
#include "premise_options.hpp"
#include "program.hpp"
#include "record_options.hpp"

namespace salebra::cli {
namespace {

struct OscillateArguments {
  std::string shape, method = "both", boundary, lateral = "held";
  SurfaceOptions surface;
  PositionOptions position;
  MaterialOptions material;
  MotionOptions motion;
  std::optional<int> points;
  int steps = 64, levels = 0;
  std::optional<double> direction, relative_error, decay_length;
  RecordOptions record;
  FrictionOptions friction;
  PremiseOptions premises;
};

constexpr double default_size = 1e-3;  // m

Body shape_of(const OscillateArguments& arguments) {
  // An automatic choice begins with few cells.
  const int points = arguments.points.value_or(arguments.relative_error ? 64 : 128);
  require(points >= 16, "--points", points, "must be >= 16");
  const double size = arguments.surface.size_x.value_or(default_size);
  const double width = arguments.surface.size_y.value_or(size);
  const Grid2D grid{points,
                    std::max<Index>(1, static_cast<Index>(std::lround(points * width / size))),
                    size, width};
  grid.validate();
  return shape_body(arguments.shape, grid);
}

Body file_of(const OscillateArguments& arguments, Session& session) {
  Body body;
  body.surface = arguments.surface.read(session);
  body.boundary = body.surface.periodic ? Boundary::periodic : Boundary::free;
  require_that(arguments.position.count() == 1, "--indentation",
               "needed with --surface; give one position");
  return body;
}

/// By the position that was given, or at the indentation.
NormalContactState contact_at(const PositionOptions& position, const Body& body,
                              double contact_modulus, double indentation,
                              const NormalContactOptions& options) {
  NormalContactState state;
  if (position.mean_gap)
    state = press_to_mean_gap(body.surface, contact_modulus, *position.mean_gap, options);
  else if (const auto pressure = position.nominal_pressure(body.surface.grid))
    state = press_to_pressure(body.surface, contact_modulus, *pressure, options);
  else
    state = press_to_indentation(body.surface, contact_modulus, indentation, options);
  if (!state.converged)
    throw NotConverged("oscillate: the contact at the mean position did not converge");
  return state;
}

double indentation_of(const OscillateArguments& arguments, const Body& body,
                      const Material& material, const NormalContactOptions& options) {
  const PositionOptions& position = arguments.position;
  require_that(position.count() <= 1, "--indentation",
               "given together with another position; give one");
  if (position.count() == 0) return body.indentation;
  if (position.indentation) return *position.indentation;
  return contact_at(position, body, material.contact_modulus, body.indentation, options)
      .indentation;
}

/// First loading to the mean position with --hardness. Where it flows, the contact stands on the
/// residual surface, at the same load.
void load_plastically(const OscillateArguments& arguments, OscillationCase& contact,
                      Session& session) {
  const std::optional<double>& hardness = arguments.premises.hardness;
  if (!hardness) return;
  const double modulus = contact.material.contact_modulus;
  const NormalContactOptions elastic{.boundary = contact.body.boundary,
                                     .on_progress = session.progress()};
  std::optional<double> pressure = arguments.position.nominal_pressure(contact.body.surface.grid);
  if (!pressure) {
    NormalContactOptions plastic = elastic;
    plastic.hardness = *hardness;
    pressure = contact_at(arguments.position, contact.body, modulus, contact.indentation, plastic)
                   .mean_pressure;
  }
  Body residual = contact.body;
  contact.first_loading = load_first(
      residual.surface, hardness, modulus, *pressure, elastic,
      std::visit([](const auto& motion) { return motion.normal_amplitude; }, contact.motion));
  if (!contact.first_loading->yielded()) return;
  require(arguments.shape.empty() || !arguments.relative_error, "--hardness",
          format_quantity(*hardness, Dimension::pressure),
          "is reached, and a shape that flowed has no finer cells; leave out --relative-error");
  contact.body = std::move(residual);
  PositionOptions same_load;
  same_load.pressure = *pressure;
  contact.indentation = contact_at(same_load, contact.body, modulus, 0, elastic).indentation;
}

Oscillation motion_of(MotionOptions motion, const Body& body, double indentation) {
  const auto fill = [](std::vector<double>& values, double value) {
    if (values.empty()) values = {value};
  };
  // A shape by its name alone is the paper's experiment: everything moves, at 90 degrees.
  if (body.normal_amplitude > 0) {
    fill(motion.normal_amplitude, body.normal_amplitude / body.indentation * indentation);
    if (motion.mode == "equal-frequency") {
      fill(motion.tangential_amplitude, motion.normal_amplitude.front());
      fill(motion.phase, std::numbers::pi / 2);
    }
  }
  require_that(motion.varied().second.empty(), motion.varied().first,
               "is a range of a single simulation; give one value");
  return motion.motions().front();
}

void check(const OscillateArguments& arguments, Session& session) {
  require_one(!arguments.shape.empty(), "--shape", arguments.surface.given(), "--surface");
  const bool simulate = arguments.method != "levels";
  arguments.record.check(arguments.steps, arguments.friction.cycles(), session);
  require(simulate || (arguments.record.checkpoint.empty() && arguments.record.fields.empty()),
          "--method", arguments.method,
          "steps through no cycle: leave out --checkpoint and --fields");
  require(simulate || !session.has_plot(), "--method", arguments.method,
          "steps through no cycle: leave out --plot");
  const FrictionOptions& friction = arguments.friction;
  friction.check();
  require(simulate || !friction.given(), "--method", arguments.method,
          "steps through no cycle: leave out " + friction.name());
  require(!arguments.relative_error || arguments.levels == 0, "--levels", arguments.levels,
          "cannot be combined with --relative-error, which chooses them; give one");
}

// Eq. (16), or Eq. (12) with F'' = F/l², and the exponential law at this amplitude, beside what the
// contact itself does.
void add_exponential_law(Json& object, const OscillationOutcome& outcome, double decay_length) {
  require_positive(decay_length, "--decay-length");
  const double modulus_ratio = outcome.run.material.modulus_ratio(), force = outcome.levels.force;
  const double small = std::visit(
      [&](const auto& motion) {
        return closed_form::work_per_cycle(modulus_ratio, force / (decay_length * decay_length),
                                           motion);
      },
      outcome.run.motion);
  const ExponentialLaw law(force, decay_length, modulus_ratio);
  const double finite = relaxation_damping(law, AtForce{force}, outcome.run.motion).work_per_cycle;
  object.add(json_of(ExponentialLoss{.decay_length = decay_length,
                                     .predicted_exponential = small,
                                     .ratio_exponential = outcome.over(small),
                                     .predicted_exponential_finite = finite,
                                     .ratio_exponential_finite = outcome.over(finite)}));
}

void finish(const OscillationOutcome& outcome, const CycleOptions& cycle,
            const OscillateArguments& arguments, Session& session) {
  PremiseReport premises{
      {premises_of(outcome, arguments.premises.facts(arguments.material,
                                                     arguments.friction.friction_coefficient))}};
  // The coupling that was computed, not one of other contacts.
  if (outcome.coupled && outcome.frictional && !std::holds_alternative<Drag>(outcome.run.motion)) {
    Premise& coupling = premises.cases.front().coupling;
    coupling.value =
        std::abs(outcome.coupled->work_per_cycle / outcome.frictional->work_per_cycle - 1);
    coupling.verdict = std::isnan(coupling.value)                   ? Verdict::unknown
                       : coupling.value > coupling.limit_20_percent ? Verdict::broken
                       : coupling.value > coupling.limit_5_percent  ? Verdict::doubtful
                                                                    : Verdict::holds;
  }
  const bool friction = outcome.frictional.has_value();
  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    write_outcome(file, "", outcome);
    if (friction) write_friction(file, cycle, outcome);
    file.commit();
  }
  if (session.has_plot()) {
    Figure figure{.panels = {contact_panel(outcome, "contact"), work_panel(outcome, "work")}};
    if (friction) figure.panels.push_back(loop_panel(arguments.friction, outcome));
    session.plot(figure);
  }
  Json object = to_json(outcome);
  if (arguments.decay_length) add_exponential_law(object, outcome, *arguments.decay_length);
  if (friction) add_friction(object, arguments.friction, cycle, outcome);
  premises.answer(session, object);
  if (!outcome.converged())
    throw NotConverged("oscillate: a contact or a tangential solve did not reach its tolerance");
  if (friction) warn_of_friction(cycle, outcome, session);
  if (outcome.choice && !outcome.choice->reached)
    session.warn(
        fmt::format("the relative error asked for was not reached: {:.2g} is left at {} x {} cells "
                    "and {} levels",
                    outcome.choice->error_estimate / std::abs(outcome.levels.work_per_cycle),
                    outcome.choice->grid.nx, outcome.choice->grid.ny, outcome.choice->levels));
}

void run(const OscillateArguments& arguments, Session& session) {
  check(arguments, session);
  // Bad input is refused before the work.
  arguments.premises.facts(arguments.material, arguments.friction.friction_coefficient);
  OscillationCase contact;
  contact.material = arguments.material.material_with_tangential_modulus();
  contact.body = arguments.shape.empty() ? file_of(arguments, session) : shape_of(arguments);
  Body& body = contact.body;
  body.boundary = value_of<Boundary>(arguments.boundary).value_or(body.boundary);
  if (const auto pressure = arguments.position.nominal_pressure(body.surface.grid))
    session.doubt(doubt_of_pressure(*pressure, contact.material.contact_modulus));
  contact.indentation =
      indentation_of(arguments, body, contact.material, {.boundary = body.boundary});
  contact.motion = motion_of(arguments.motion, body, contact.indentation);
  arguments.friction.check(contact.motion, contact.indentation);
  load_plastically(arguments, contact, session);

  OscillationRoutes routes;
  routes.levels.levels = arguments.levels;
  routes.levels.direction = arguments.direction.value_or(0);
  routes.levels.stick.boundary = body.boundary;
  routes.levels.stick.hold_lateral = arguments.lateral == "held";
  routes.levels.on_progress = session.progress();
  routes.relative_error = arguments.relative_error;
  routes.shape = arguments.shape;
  routes.cycle.steps = arguments.steps;
  routes.cycle.direction = routes.levels.direction;
  routes.cycle.stick.boundary = body.boundary;
  routes.cycle.stick.hold_lateral = routes.levels.stick.hold_lateral;
  routes.cycle.on_progress = session.progress();
  routes.simulate = false;
  OscillationOutcome outcome = run_routes(std::move(contact), routes);
  if (arguments.method == "levels") {
    finish(outcome, routes.cycle, arguments, session);
    return;
  }

  const OscillationCase& chosen = outcome.run;
  const Surface& surface = chosen.body.surface;
  const double modulus = chosen.material.contact_modulus;
  arguments.friction.apply(routes.cycle, arguments.material, chosen.material);
  CycleSettings settings = cycle_settings(surface.grid, chosen.material, chosen.motion,
                                          chosen.indentation, routes.cycle);
  settings.emplace_back("surface", fingerprint(surface.heights));
  const NormalContactOptions normal{.boundary = chosen.body.boundary};
  CycleRecorder recorder(arguments.record.options(arguments.steps, session), std::move(settings),
                         session.provenance(),
                         {surface,
                          [&](double indentation) {
                            return press_to_indentation(surface, modulus, indentation, normal);
                          }},
                         arguments.friction.cycles());
  outcome.cycle = recorder.run(
      routes.cycle, [&](const CycleOptions& options) { return simulate(chosen, options); });
  if (arguments.friction.given() && !outcome.cycle->interrupted)
    run_with_friction(arguments.friction, routes.cycle, recorder, outcome);
  const auto stopped = [](const std::optional<CycleResult>& cycle) {
    return cycle && cycle->interrupted;
  };
  if (stopped(outcome.cycle) || stopped(outcome.frictional) || stopped(outcome.coupled))
    throw Interrupted(arguments.record.checkpoint.empty()
                          ? "oscillate: interrupted; nothing was written"
                          : "oscillate: interrupted; the same command with --resume continues");
  finish(outcome, routes.cycle, arguments, session);
  recorder.done();
}

}  // namespace

void add_oscillate_command(Program& program) {
  auto arguments = std::make_shared<OscillateArguments>();
  arguments->motion.mode = "equal-frequency";
  Command& command = program.add_command(
      "oscillate", "three-dimensional simulation of an oscillating contact",
      {"salebra oscillate --shape pyramids --contact-modulus 1GPa --poisson 0.3 --phase 45deg "
       "--json",
       "salebra oscillate --surface rough.h5 --pressure 10MPa --contact-modulus 115GPa --poisson "
       "0.3 "
       "--mode drag --normal-amplitude 5nm --drag-velocity 1um/s --frequency 20kHz -o cycle.h5"},
      [arguments](Session& session) { run(*arguments, session); },
      "contact regions and the work over a cycle; with friction the loop too");
  add_choice(command, "--shape", arguments->shape, shape_names(),
             "the rigid body; with defaults for everything but the material");
  arguments->surface.add_to(command, false, "--surface");
  command.add_option("--points", arguments->points,
                     "cells along x of a shape; default 128, or 64 to begin --relative-error with");
  arguments->position.add_to(command);
  arguments->motion.add_to(command);
  add_quantity(command, "--direction", arguments->direction, Dimension::angle,
               "of the tangential motion against x; default 0");
  add_choice(command, "--lateral", arguments->lateral, {"held", "free"},
             "displacement across the motion: held at 0, or free of traction; default held");
  add_choice<Boundary>(command, "--boundary", arguments->boundary, "default: as the surface is");
  add_choice(command, "--method", arguments->method, {"levels", "both"},
             "levels: contact sets at a few indentations; both: also step through the cycle; "
             "default both");
  command.add_option("--steps", arguments->steps, "changes of the contact in a cycle; default 64");
  command.add_option("--levels", arguments->levels, "contact levels; default 16, 32 for drag");
  add_quantity(command, "--relative-error", arguments->relative_error, Dimension::dimensionless,
               "of the levels' loss, such as 1%: chooses levels and, for a shape, cells");
  add_quantity(command, "--decay-length", arguments->decay_length, Dimension::length,
               "l of F = F0 exp(-gap/l), as `fit` finds it: compares with Eq. (16) too");
  arguments->record.add_to(command);
  arguments->friction.add_to(command);
  arguments->premises.add_to(command);
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
