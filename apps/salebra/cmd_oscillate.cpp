// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra oscillate`: direct simulation of an oscillating contact, compared with the theorem.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/figures/figures.hpp>

#include "assumption_options.hpp"
#include "base/memory.hpp"
#include "base/stop_check.hpp"
#include "friction_options.hpp"
#include "options.hpp"
#include "oscillation_answer.hpp"
#include "program.hpp"
#include "record_options.hpp"
#include "results/columns.hpp"
#include "results/cycle_recorder.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

struct OscillateArguments {
  std::vector<std::string> shapes;
  std::string method = "both", boundary, lateral = "held", hold = "auto";
  SurfaceOptions surface;
  OperatingPointOptions point;
  MaterialOptions material;
  MotionOptions motion;
  std::optional<int> points;
  int steps = 64, intervals = 0;
  std::string direction = "auto";
  std::optional<double> relative_error, decay_length;
  RecordOptions record;
  FrictionOptions friction;
  AssumptionOptions assumptions;
};

constexpr double default_size = 1e-3;  // m

OscillatingBody shape_of(const OscillateArguments& arguments, const std::string& shape) {
  // With --relative-error the first grid has few cells, because it will be refined.
  const int points = arguments.points.value_or(arguments.relative_error ? 64 : 128);
  require(points >= 16, "--points", points, "must be >= 16");
  const double size = arguments.surface.size_x.value_or(default_size);
  const double width = arguments.surface.size_y.value_or(size);
  const double lines = points * width / size;
  constexpr double max_lines = std::numeric_limits<int>::max();
  require(lines < max_lines, "--size-y", format_quantity(width, Dimension::length),
          fmt::format(
              "needs {:.3g} rows of cells of the size given by --size-x; choose a smaller width",
              lines));
  const Grid2D grid{points, std::max<Index>(1, std::lround(lines)), size, width};
  grid.validate();
  require_memory(grid, sizeof(double) * static_cast<double>(grid.points()), "a surface");
  return oscillating_shape(shape, grid);
}

OscillatingBody file_of(const OscillateArguments& arguments, Session& session) {
  OscillatingBody body;
  body.surface = arguments.surface.read(session);
  body.boundary = body.surface.periodic ? Boundary::periodic : Boundary::free;
  if (arguments.point.count() == 0)
    require_options({"--pressure (or --normal-force, --mean-gap, --indentation)"}, "--surface");
  return body;
}

OperatingPoint point_of(const OperatingPointOptions& options, const OscillatingBody& body) {
  require_that(options.count() <= 1, "--pressure, --normal-force, --mean-gap, --indentation",
               "several are given; give one of them");
  if (options.mean_gap) return at_mean_gap(*options.mean_gap);
  if (const auto pressure = options.nominal_pressure(body.surface.grid))
    return at_pressure(*pressure);
  return at_indentation(options.indentation.value_or(body.indentation));
}

Oscillation motion_of(MotionOptions motion, const OscillatingBody& body, double indentation) {
  const auto fill = [](std::vector<double>& values, double value) {
    if (values.empty()) values = {value};
  };
  // A shape without motion options repeats the experiment of the paper: equal tangential and normal
  // amplitudes with a phase of 90 degrees, or a drag by u_z per radian of the normal oscillation.
  if (body.normal_amplitude > 0) {
    const bool drags = motion.mode == "drag" && motion.normal_amplitude.empty() &&
                       motion.drag_velocity.empty() && !motion.frequency.given();
    fill(motion.normal_amplitude, body.normal_amplitude / body.indentation * indentation);
    if (motion.mode == "equal-frequency") {
      fill(motion.tangential_amplitude, motion.normal_amplitude.front());
      fill(motion.phase, std::numbers::pi / 2);
    } else if (drags) {
      motion.drag_velocity = motion.normal_amplitude;
      motion.frequency.angular_frequency = {1};
    }
  }
  require_that(motion.varied().second.empty(), motion.varied().first,
               "has several values; a simulation takes one");
  return motion.motions().front();
}

void check(const OscillateArguments& arguments, Session& session) {
  require_one(!arguments.shapes.empty(), "--shape", arguments.surface.given(), "--surface");
  const bool simulate = arguments.method != "intervals";
  arguments.record.check(arguments.steps, arguments.friction.cycles(), session);
  require(simulate || (arguments.record.checkpoint.empty() && arguments.record.fields.empty()),
          "--method", arguments.method,
          "does not step through a cycle: leave out --checkpoint and --fields");
  require(simulate || !session.has_plot(), "--method", arguments.method,
          "does not step through a cycle: leave out --plot");
  const FrictionOptions& friction = arguments.friction;
  friction.check();
  require(simulate || !friction.given(), "--method", arguments.method,
          "does not step through a cycle: leave out " + friction.name());
  for (auto shape = arguments.shapes.begin(); shape != arguments.shapes.end(); ++shape)
    require(std::find(arguments.shapes.begin(), shape, *shape) == shape, "--shape", *shape,
            "is given twice");
  for (const auto& [option, file] : {std::pair{"--checkpoint", &arguments.record.checkpoint},
                                     {"--fields", &arguments.record.fields}})
    require(file->empty() || arguments.shapes.size() < 2, option, *file,
            "takes one simulation; give one --shape");
  require(
      !arguments.relative_error || arguments.intervals == 0, "--intervals", arguments.intervals,
      "cannot be combined with --relative-error, which chooses the intervals; give one of them");
}

// shape: name of the shape to simulate; empty for --surface.
OscillationCase case_of(const OscillateArguments& arguments, const std::string& shape,
                        Session& session) {
  OscillationCase contact;
  contact.material = arguments.material.body();
  contact.body = shape.empty() ? file_of(arguments, session) : shape_of(arguments, shape);
  OscillatingBody& body = contact.body;
  body.boundary = parse_enum<Boundary>(arguments.boundary).value_or(body.boundary);
  if (shape.empty() && arguments.boundary.empty() && body.boundary == Boundary::free)
    session.inform(
        "The surface does not repeat itself, so it is alone on a half-space; --boundary periodic "
        "continues it, as contact and damping do.");
  const std::optional<Material>& constants = contact.material.half_space_material();
  require(constants || body.boundary == Boundary::periodic, "--body", arguments.material.body_file,
          "needs a periodic contact; add --boundary periodic");
  const OperatingPoint point = point_of(arguments.point, body);
  if (constants && point.control == ControlQuantity::pressure)
    session.warn_if(warning_of_pressure(point.value, constants->contact_modulus));
  contact.indentation = mean_indentation(body, contact.material, point);
  contact.motion = motion_of(arguments.motion, body, contact.indentation);
  const auto settle = [&] {
    contact.indentation = mean_indentation(contact.body, contact.material, point, contact.motion,
                                           *parse_enum<Hold>(arguments.hold), session.progress());
  };
  settle();
  arguments.friction.check(contact.motion, contact.indentation);
  const std::optional<double>& hardness = arguments.assumptions.hardness;
  if (!hardness) return contact;
  load_plastically(contact, point, *hardness, session.progress());
  if (contact.first_loading->yielded() && point.load_given()) settle();
  require(shape.empty() || !arguments.relative_error || !contact.first_loading->yielded(),
          "--hardness", format_quantity(*hardness, Dimension::pressure),
          "is reached, and a shape that has yielded cannot be refined; leave out --relative-error");
  return contact;
}

OscillationRoutes routes_of(const OscillateArguments& arguments, const OscillationCase& contact,
                            const std::string& shape, double direction, const Progress& progress) {
  OscillationRoutes routes;
  routes.intervals.intervals = arguments.intervals;
  routes.intervals.direction = direction;
  routes.intervals.stick.boundary = contact.body.boundary;
  routes.intervals.stick.hold_lateral = arguments.lateral == "held";
  routes.intervals.on_progress = progress;
  routes.relative_error = arguments.relative_error;
  routes.shape = shape;
  routes.cycle.steps = arguments.steps;
  routes.cycle.direction = routes.intervals.direction;
  routes.cycle.stick.boundary = contact.body.boundary;
  routes.cycle.stick.hold_lateral = routes.intervals.stick.hold_lateral;
  routes.cycle.on_progress = progress;
  arguments.friction.apply(routes.cycle, arguments.material, contact.material);
  routes.frictional = arguments.friction.given();
  routes.coupled = arguments.friction.coupled;
  return routes;
}

CycleRecorder recorder_of(const OscillateArguments& arguments, const OscillationCase& contact,
                          const CycleOptions& cycle, Session& session) {
  const Surface& surface = contact.body.surface;
  CycleSettings settings =
      cycle_settings(surface.grid, contact.material, contact.motion, contact.indentation, cycle);
  settings.emplace_back("surface", fingerprint(surface.heights));
  return {arguments.record.options(arguments.steps, session),
          std::move(settings),
          session.provenance(),
          {surface,
           [&surface, material = contact.material,
            normal = NormalContactOptions{.boundary = contact.body.boundary}](double indentation) {
             return press(surface, material, at_indentation(indentation), normal);
           }},
          arguments.friction.cycles()};
}

// Reports the progress of simulation `done` of `count` as part of the whole. The quadrature and the
// steps of a simulation take about the same time.
Progress part_of(const Progress& bar, std::size_t done, std::size_t count) {
  if (count == 1) return bar;
  return [=](const ProgressReport& report) {
    ProgressReport whole = report;
    const double half = report.stage == "cycle" ? 0.5 : 0;
    whole.fraction =
        (static_cast<double>(done) + half + report.fraction / 2) / static_cast<double>(count);
    return !bar || bar(whole);
  };
}

// Table with a line for each shape, or for each direction of a surface.
std::string table_of(const std::vector<OscillationOutcome>& outcomes, const std::string& heading,
                     const std::vector<std::string>& shapes) {
  // With friction, the loss of the motion as described is that with slip.
  const bool slips = outcomes.front().slips();
  std::vector<std::vector<std::string>> rows{{heading, slips ? "W without slip" : "W",
                                              "W over Eq. (12) or (15)", "W over finite amplitude",
                                              "W over elastic energy"}};
  if (slips) rows.front().insert(rows.front().begin() + 1, "W with slip");
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    const OscillationOutcome& outcome = outcomes[k];
    const auto text = [&](double reference) {
      const std::optional<double> ratio = outcome.over(reference);
      return ratio ? fmt::format("{:.4f}", *ratio) : std::string("no loss");
    };
    const auto loss = [&](double work) {
      return std::abs(work) > outcome.uncertain_loss() ? format_quantity(work, Dimension::energy)
                                                       : std::string("no loss");
    };
    rows.push_back({shapes[k], loss(outcome.work_per_cycle()),
                    text(outcome.intervals.small_amplitude_work),
                    text(outcome.intervals.work_by_force),
                    fmt::format("{:.1e}", outcome.work_per_cycle() / outcome.elastic_energy())});
    if (slips)
      rows.back().insert(rows.back().begin() + 1, loss(outcome.frictional->work_per_cycle));
  }
  return to_table(rows, 2, true);
}

/// The directions of the tangential motion, rad.
std::vector<double> directions_of_case(const OscillateArguments& arguments,
                                       const Surface& surface) {
  const DirectionChoice choice = direction_choice(arguments.direction, "--direction");
  // A shape has no lay, and motion with free lateral displacement is along x.
  const bool along_x = !arguments.shapes.empty() || arguments.lateral == "free";
  if (along_x && choice == DirectionChoice(LayDirection::automatic)) return {0};
  const std::vector<double> directions = directions_of(choice, surface);
  for (const auto& [option, file] : {std::pair{"--checkpoint", &arguments.record.checkpoint},
                                     {"--fields", &arguments.record.fields}})
    require(file->empty() || directions.size() == 1, option, *file,
            "takes one simulation, and the surface has a lay; give --direction across or along");
  return directions;
}

// Prints and writes the results. shapes: name of each outcome, of its shape or its direction.
void finish(const std::vector<OscillationOutcome>& outcomes, const OscillateArguments& arguments,
            const std::vector<std::string>& shapes, Session& session) {
  const bool single = outcomes.size() == 1;
  if (session.has_output()) {
    ResultFile file(session.output(), session.provenance(), session.write_options());
    for (std::size_t k = 0; k < outcomes.size(); ++k)
      write_outcome(file, single ? "" : shapes[k] + "/", outcomes[k]);
    file.commit();
  }
  const ContactParameters parameters =
      arguments.assumptions.parameters(arguments.material, arguments.friction.friction_coefficient);
  std::vector<Assumptions> checked;
  for (const OscillationOutcome& outcome : outcomes)
    checked.push_back(assumptions_of(outcome, parameters));
  if (session.has_plot()) session.plot(figures::figure_of(outcomes, shapes, checked));
  Json all;
  for (std::size_t k = 0; k < outcomes.size(); ++k) {
    const OscillationOutcome& outcome = outcomes[k];
    Json object = to_json(outcome);
    if (arguments.decay_length)
      object.add(json_of(exponential_loss(outcome, *arguments.decay_length)));
    const AssumptionReport assumptions{.cases = {checked[k]}, .slip_followed = outcome.slips()};
    if (single) {
      assumptions.answer(session, object);
    } else {
      assumptions.add_to(object);
      all[shapes[k]] = std::move(object);
    }
  }
  if (!single)
    session.answer(all,
                   table_of(outcomes, arguments.shapes.empty() ? "direction" : "shape", shapes));
  if (!std::ranges::all_of(outcomes, &OscillationOutcome::converged))
    throw NotConverged("oscillate: a normal or tangential solve did not reach its tolerance");
  for (const OscillationOutcome& outcome : outcomes) warn_of(outcome, session);
}

void run(const OscillateArguments& arguments, Session& session) {
  check(arguments, session);
  // Checks these options, so that bad input is refused before the work.
  arguments.assumptions.parameters(arguments.material, arguments.friction.friction_coefficient);
  const std::vector<std::string> shapes =
      arguments.shapes.empty() ? std::vector<std::string>{""} : arguments.shapes;
  std::vector<OscillationOutcome> outcomes;
  // The elements must not move, because a recorder refers to the surface of one.
  outcomes.reserve(2 * shapes.size());
  std::vector<std::string> names;
  std::optional<CycleRecorder> recorder;
  for (const std::string& shape : shapes) {
    // Interrupting the quadrature discards its results. An interrupted cycle keeps a checkpoint.
    std::optional<detail::StopCheck> stops{interrupted};
    const OscillationCase contact = case_of(arguments, shape, session);
    const std::vector<double> directions = directions_of_case(arguments, contact.body.surface);
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (!stops) stops.emplace(interrupted);
      names.push_back(!shape.empty()           ? shape
                      : directions.size() == 1 ? "motion " + direction_in_words(directions[k])
                      : k == 0                 ? "across"
                                               : "along");
      const OscillationRoutes routes = routes_of(
          arguments, contact, shape, directions[k],
          part_of(session.progress(), outcomes.size(), shapes.size() * directions.size()));
      OscillationOutcome& outcome =
          outcomes.emplace_back(oscillation_by_intervals(contact, routes));
      if (arguments.method == "intervals") continue;
      stops.reset();
      recorder.emplace(recorder_of(arguments, outcome.run, routes.cycle, session));
      simulate_cycles(outcome, routes, [&](const CycleOptions& cycle, const auto& simulate) {
        return recorder->run(cycle, simulate);
      });
      if (outcome.interrupted())
        throw Interrupted(arguments.record.checkpoint.empty()
                              ? "oscillate: interrupted; nothing was written"
                              : "oscillate: interrupted; the same command with --resume continues");
    }
  }
  finish(outcomes, arguments, names, session);
  if (recorder) recorder->done();
}

}  // namespace

void add_oscillate_command(Program& program) {
  auto arguments = std::make_shared<OscillateArguments>();
  arguments->motion.mode = "equal-frequency";
  Command& command = program.add_command(
      "oscillate", "three-dimensional simulation of an oscillating contact",
      {"salebra oscillate --shape cylinder,paraboloid,pyramids,sinusoids --contact-modulus 1GPa "
       "--poisson 0.3 --plot figure3.png",
       "salebra oscillate --surface rough.h5 --pressure 10MPa --contact-modulus 115GPa --poisson "
       "0.3 "
       "--mode drag --normal-amplitude 5nm --drag-velocity 1um/s --frequency 20kHz -o cycle.h5"},
      [arguments](Session& session) { run(*arguments, session); },
      "contact regions and the work over a cycle, a column for each shape; with friction the loop "
      "too");
  command
      .add_option("--shape", arguments->shapes,
                  "shape of the rigid body, with defaults for everything but the material; or "
                  "several shapes, such as those of the paper's Fig. 3")
      ->delimiter(',')
      ->type_name("NAMES")
      ->choices(oscillating_shapes());
  arguments->surface.add_to(command, false, "--surface");
  command.add_option(
      "--points", arguments->points,
      "cells along x of a shape; default 128, or 64 at the start of --relative-error");
  arguments->point.add_to(command);
  arguments->motion.add_to(command);
  add_choice<Hold>(command, "--hold", arguments->hold,
                   "which mean value the oscillation keeps; default auto: the indentation, or the "
                   "force once the contact lifts off under a given load");
  add_direction(command, arguments->direction, "direction of the tangential motion");
  add_choice(command, "--lateral", arguments->lateral, {"held", "free"},
             "displacement across the motion: held at 0, or free of traction; default held");
  add_choice<Boundary>(
      command, "--boundary", arguments->boundary,
      "whether the surface repeats itself or is alone on a half-space; default: as the surface is");
  add_choice(command, "--method", arguments->method, {"intervals", "both"},
             "intervals: contact sets at a few indentations; both: also step through the cycle; "
             "default both");
  add_steps(command, arguments->steps, "steps per cycle; default 64")->range(4, 10000000);
  command
      .add_option("--intervals", arguments->intervals,
                  "number of contacts in the cycle; default 16, 32 for drag")
      ->range(0, 4096);
  add_quantity(command, "--relative-error", arguments->relative_error, Dimension::dimensionless,
               "error allowed for the loss by intervals, such as 1%; chooses their number "
               "and, for a shape, the cells");
  add_quantity(
      command, "--decay-length", arguments->decay_length, Dimension::length,
      "decay length l of F = F0 exp(-gap/l), as fit finds it, for a comparison with Eq. (16)");
  arguments->record.add_to(command);
  arguments->friction.add_to(command);
  arguments->assumptions.add_to(command);
  arguments->material.add_to(command);
  arguments->material.add_body_to(command, "the surface is then periodic");
}

}  // namespace salebra::cli
