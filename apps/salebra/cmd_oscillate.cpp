// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/level_quadrature.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/io/result_file.hpp>

#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct OscillateArguments {
  std::string shape, method = "both", boundary, lateral = "held";
  SurfaceOptions surface;
  PositionOptions position;
  MaterialOptions material;
  MotionOptions motion;
  int points = 128, steps = 64, levels = 0;
  std::optional<double> direction;
};

// A surface with its boundary, and the indentation and sweep of a shape that the command line leaves open.
struct Body {
  Surface surface;
  Boundary boundary = Boundary::free;
  double indentation = 0, normal_amplitude = 0;
};

constexpr double default_size = 1e-3;  // m

Body shape_of(const OscillateArguments& arguments) {
  require(arguments.points >= 16, "--points", arguments.points, "must be >= 16");
  const double size = arguments.surface.size_x.value_or(default_size);
  const double width = arguments.surface.size_y.value_or(size);
  const Grid2D grid{
      arguments.points,
      std::max<Index>(1, static_cast<Index>(std::lround(arguments.points * width / size))), size,
      width};
  grid.validate();
  const PlanePoint center = off_grid_center(grid);
  const PlanePoint shift{0.31 * grid.dx(), 0.17 * grid.dy()};
  const std::string& shape = arguments.shape;
  // Contacts that fill a third of the grid or less at the end of the sweep, u_z = 0.3 of the indentation.
  if (shape == "cylinder")
    return {flat_punch_surface(grid, 0.3 * size, size, center), Boundary::free, 0.02 * size,
            0.006 * size};
  if (shape == "parabola")
    return {paraboloid_surface(grid, 4 * size, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "cone")
    return {cone_surface(grid, 0.05, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "ellipsoid")
    return {elliptic_paraboloid_surface(grid, 6 * size, 2 * size, center), Boundary::free,
            0.02 * size, 0.006 * size};
  if (shape == "pyramids")
    return {pyramids_surface(grid, 4, 4, 0.1, shift), Boundary::free, 0.006 * size, 0.0018 * size};
  return {sinusoid_surface(grid, 0.01 * size, 1, 4, shift), Boundary::periodic, 0.0045 * size,
          0.00135 * size};
}

Body file_of(const OscillateArguments& arguments) {
  Body body;
  body.surface = arguments.surface.read();
  body.boundary = body.surface.periodic ? Boundary::periodic : Boundary::free;
  require(arguments.position.count() == 1, "--indentation", "not given",
          "beside --surface; give one position");
  return body;
}

double indentation_of(const OscillateArguments& arguments, const Body& body,
                      const Material& material, const NormalContactOptions& options) {
  const PositionOptions& position = arguments.position;
  require(position.count() <= 1, "--indentation", "given", "beside another position; give one");
  const double area = body.surface.grid.area();
  if (position.count() == 0) return body.indentation;
  if (position.indentation) return *position.indentation;
  NormalContactState state;
  if (position.mean_gap)
    state = press_to_mean_gap(body.surface, material.contact_modulus, *position.mean_gap, options);
  else
    state =
        press_to_pressure(body.surface, material.contact_modulus,
                          position.pressure ? *position.pressure : *position.force / area, options);
  if (!state.converged)
    throw NotConverged("oscillate: the contact at the mean position did not converge");
  return state.indentation;
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
  require(motion.varied().second.empty(), motion.varied().first, "is a range",
          "of a single simulation; give one value");
  return motion.motions().front();
}

std::vector<double> column(const CycleResult& cycle, double CycleSample::*quantity) {
  std::vector<double> values;
  for (const CycleSample& sample : cycle.samples) values.push_back(sample.*quantity);
  return values;
}

Field map_of(const CycleResult& cycle) {
  return cycle.smallest.cast<double>() + cycle.largest.cast<double>();
}

void write(Session& session, const Body& body, const CycleResult* cycle,
           const LevelQuadratureResult* levels) {
  ResultFile file(session.output(), session.provenance(), session.write_options());
  if (cycle) {
    ResultGroup group = file.group("cycle");
    const Grid2D& grid = body.surface.grid;
    std::vector<double> x, y;
    for (Index ix = 0; ix < grid.nx; ++ix) x.push_back(static_cast<double>(ix) * grid.dx());
    for (Index iy = 0; iy < grid.ny; ++iy) y.push_back(static_cast<double>(iy) * grid.dy());
    group.coordinate("x", x, "m", "position along x");
    group.coordinate("y", y, "m", "position along y");
    group.dataset("heights", body.surface.heights, "x", "y", "m", "height, a hill is positive");
    group.dataset("contact", map_of(*cycle), "x", "y", "1",
                  "0 never in contact, 1 during a part of the cycle, 2 always");
    group.coordinate("time", column(*cycle, &CycleSample::t), "1", "time in periods");
    const auto add = [&](const char* name, double CycleSample::*quantity, const char* units,
                         const char* text) {
      group.dataset(name, column(*cycle, quantity), {"time"}, units, text);
    };
    add("indentation", &CycleSample::indentation, "m", "indentation");
    add("tangential", &CycleSample::tangential, "m", "tangential displacement");
    add("tangential_force", &CycleSample::tangential_force, "N", "tangential force");
    add("force", &CycleSample::normal_force, "N", "normal force");
    add("work", &CycleSample::work, "J", "work of the tangential force since the start");
    add("released_energy", &CycleSample::released_energy, "J", "energy released since the start");
    add("contact_area", &CycleSample::contact_area, "m^2", "contact area");
  }
  if (levels) {
    ResultGroup group = file.group("levels");
    const ForceCurve& curve = levels->curve;
    group.coordinate("indentation", curve.column(&ForceSample::indentation), "m", "indentation");
    group.dataset("force", curve.column(&ForceSample::force), {"indentation"}, "N", "normal force");
    group.dataset("normal_stiffness", curve.column(&ForceSample::normal_stiffness), {"indentation"},
                  "N/m", "normal stiffness");
    group.dataset("tangential_stiffness", curve.column(&ForceSample::tangential_stiffness),
                  {"indentation"}, "N/m", "tangential stiffness in full stick");
    group.dataset("contact_area_fraction", curve.column(&ForceSample::contact_area_fraction),
                  {"indentation"}, "1", "contact area over nominal area");
  }
  file.commit();
}

void run(const OscillateArguments& arguments, Session& session) {
  require(arguments.shape.empty() != !arguments.surface.given(), "--shape",
          arguments.shape.empty() ? "not given;" : "given beside --surface;",
          "give exactly one of --shape and --surface");
  const Material material = arguments.material.material_with_tangential_modulus();
  Body body = arguments.shape.empty() ? file_of(arguments) : shape_of(arguments);
  if (!arguments.boundary.empty())
    body.boundary = arguments.boundary == "free" ? Boundary::free : Boundary::periodic;
  const NormalContactOptions contact{.boundary = body.boundary};
  const double indentation = indentation_of(arguments, body, material, contact);
  const Oscillation motion = motion_of(arguments.motion, body, indentation);
  const Grid2D& grid = body.surface.grid;
  const ContactLevels levels =
      boundary_element_levels(body.surface, material.contact_modulus, contact);

  LevelQuadratureOptions level_options;
  level_options.levels = arguments.levels;
  level_options.direction = arguments.direction.value_or(0);
  level_options.stick.boundary = body.boundary;
  level_options.stick.hold_lateral = arguments.lateral == "held";
  level_options.on_progress = session.progress();
  const LevelQuadratureResult quadrature =
      level_quadrature(levels, grid, material, motion, indentation, level_options);
  if (quadrature.interrupted) throw Interrupted("oscillate: interrupted; nothing was written");

  const bool simulate = arguments.method != "levels";
  CycleResult cycle;
  if (simulate) {
    CycleOptions options;
    options.steps = arguments.steps;
    options.direction = level_options.direction;
    options.stick.boundary = body.boundary;
    options.stick.hold_lateral = level_options.stick.hold_lateral;
    options.on_progress = session.progress();
    cycle = simulate_cycle(levels, grid, material, trajectory_of(motion, indentation), options);
    if (cycle.interrupted) throw Interrupted("oscillate: interrupted; nothing was written");
  }

  const double work = simulate ? cycle.work_per_cycle : quadrature.work_per_cycle;
  // A contact whose cells do not change has no loss to compare with: what the solvers leave is no reference.
  const double motion_scale =
      std::holds_alternative<Drag>(motion)
          ? std::get<Drag>(motion).drag_velocity / std::get<Drag>(motion).angular_frequency
          : std::get<EqualFrequency>(motion).tangential_amplitude;
  double stiffness = 0;
  for (const ForceSample& sample : quadrature.curve.samples)
    if (std::isfinite(sample.normal_stiffness))
      stiffness = std::max(stiffness, sample.normal_stiffness);
  const double no_loss = 1e-9 * stiffness * motion_scale * motion_scale;
  const auto over = [&](double reference) -> Json {
    if (std::abs(reference) <= no_loss) return nullptr;
    return work / reference;
  };
  Json object;
  object["work_per_cycle"] = work;
  object["work_by_levels"] = quadrature.work_per_cycle;
  object["error_estimate"] = quadrature.error_estimate;
  object["predicted"] = quadrature.small_amplitude_work;
  object["ratio"] = over(quadrature.small_amplitude_work);
  object["predicted_finite"] = quadrature.work_by_force;
  object["ratio_finite"] = over(quadrature.work_by_force);
  object["indentation"] = indentation;
  object["force"] = quadrature.force;
  object["curvature"] = quadrature.curvature;
  if (simulate) {
    object["released_energy"] = cycle.released_energy;
    object["contact_area_min"] = cycle.contact_area_min;
    object["contact_area_max"] = cycle.contact_area_max;
    object["fft_count"] = cycle.fft_count + quadrature.fft_count;
    object["time"] = column(cycle, &CycleSample::t);
    object["work"] = column(cycle, &CycleSample::work);
  } else {
    const auto& samples = quadrature.curve.samples;
    object["contact_area_min"] = samples.front().contact_area_fraction * grid.area();
    object["contact_area_max"] = samples.back().contact_area_fraction * grid.area();
    object["fft_count"] = quadrature.fft_count;
  }
  object["converged"] = quadrature.converged && (!simulate || cycle.converged);
  if (session.has_output()) write(session, body, simulate ? &cycle : nullptr, &quadrature);
  session.answer(object);
  if (!object["converged"])
    throw NotConverged("oscillate: a contact or a stick solve did not reach its tolerance");
}

}  // namespace

void add_oscillate_command(Program& program) {
  auto arguments = std::make_shared<OscillateArguments>();
  arguments->motion.mode = "equal-frequency";
  CLI::App& command = program.add_command(
      "oscillate", "three-dimensional simulation of an oscillating contact without slip",
      {"salebra oscillate --shape pyramids --contact-modulus 1GPa --poisson 0.3 --phase 45deg "
       "--json",
       "salebra oscillate --surface rough.h5 --pressure 10MPa --contact-modulus 115GPa --poisson "
       "0.3 "
       "--mode drag --normal-amplitude 5nm --drag-velocity 1mm/s --frequency 20kHz -o cycle.h5"},
      [arguments](Session& session) { run(*arguments, session); });
  add_choice(command, "--shape", arguments->shape,
             {"cylinder", "parabola", "cone", "ellipsoid", "pyramids", "sinusoids"},
             "the rigid body; with defaults for everything but the material");
  arguments->surface.add_to(command, false, "--surface");
  command.add_option("--points", arguments->points, "cells along x of a shape; default 128");
  arguments->position.add_to(command, true);
  arguments->motion.add_to(command);
  add_quantity(command, "--direction", arguments->direction, Dimension::angle,
               "of the tangential motion against x; default 0");
  add_choice(command, "--lateral", arguments->lateral, {"held", "free"},
             "displacement across the motion: held at 0, or free of traction; default held");
  add_choice(command, "--boundary", arguments->boundary, {"periodic", "free"},
             "default: as the surface is");
  add_choice(command, "--method", arguments->method, {"levels", "both"},
             "levels: contact sets at a few indentations; both: also step through the cycle; "
             "default both");
  command.add_option("--steps", arguments->steps, "changes of the contact in a cycle; default 64");
  command.add_option("--levels", arguments->levels, "contact levels; default 16, 32 for drag");
  arguments->material.add_to(command);
}

}  // namespace salebra::cli
