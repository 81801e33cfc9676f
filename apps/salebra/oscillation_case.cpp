// SPDX-License-Identifier: GPL-3.0-or-later
// One oscillating contact by theorem and by direct simulation: run, JSON, HDF5 and panels.
#include "oscillation_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/generators/shapes.hpp>
#include <salebra/results/columns.hpp>

#include "first_loading.hpp"
#include "grid_axes.hpp"

namespace salebra::cli {
namespace {

double tangential_scale(const Oscillation& motion) {
  if (const auto* drag = std::get_if<Drag>(&motion))
    return drag->drag_velocity / drag->angular_frequency;
  return std::get<EqualFrequency>(motion).tangential_amplitude;
}

ContactLevels levels_of(const Body& body, const Material& material) {
  return boundary_element_levels(body.surface, material.contact_modulus,
                                 {.boundary = body.boundary});
}

}  // namespace

const std::vector<std::string>& shape_names() {
  static const std::vector<std::string> names{"cylinder",  "parabola", "pyramids",
                                              "sinusoids", "cone",     "elliptic-paraboloid"};
  return names;
}

Body shape_body(const std::string& shape, const Grid2D& grid) {
  const double size = grid.lx;
  const PlanePoint center = off_grid_center(grid);
  const PlanePoint shift{0.31 * grid.dx(), 0.17 * grid.dy()};
  // u_z = 0.3 of the indentation.
  if (shape == "cylinder")
    return {flat_punch_surface(grid, 0.3 * size, size, center), Boundary::free, 0.02 * size,
            0.006 * size};
  if (shape == "parabola")
    return {paraboloid_surface(grid, 4 * size, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "cone")
    return {cone_surface(grid, 0.05, center), Boundary::free, 0.02 * size, 0.006 * size};
  if (shape == "elliptic-paraboloid")
    return {elliptic_paraboloid_surface(grid, 6 * size, 2 * size, center), Boundary::free,
            0.02 * size, 0.006 * size};
  if (shape == "pyramids")
    return {pyramids_surface(grid, 4, 4, 0.1, shift), Boundary::free, 0.006 * size, 0.0018 * size};
  require(shape == "sinusoids", "--shape", shape, "is not known; see --help");
  return {sinusoid_surface(grid, 0.01 * size, 1, 4, shift), Boundary::periodic, 0.0045 * size,
          0.00135 * size};
}

double OscillationOutcome::work_per_cycle() const {
  return cycle ? cycle->work_per_cycle : levels.work_per_cycle;
}

double OscillationOutcome::error_estimate() const {
  if (!cycle) return levels.error_estimate;
  return cycle->step_error + (choice ? choice->cell_error : 0);
}

std::vector<std::string> OscillationOutcome::error_contains() const {
  std::vector<std::string> parts{cycle ? "steps" : "levels"};
  if (choice && choice->cell_error > 0) parts.emplace_back("cells");
  return parts;
}

double OscillationOutcome::elastic_energy() const {
  double stiffness = 0;
  for (const ForceSample& sample : levels.curve.samples)
    if (std::isfinite(sample.tangential_stiffness))
      stiffness = std::max(stiffness, sample.tangential_stiffness);
  const double scale = tangential_scale(run.motion);
  return stiffness * scale * scale / 2;
}

double OscillationOutcome::uncertain_loss() const { return 1e-7 * elastic_energy(); }

std::optional<double> OscillationOutcome::over(double reference) const {
  // The quadrature of a contact whose cells do not change sums what its solvers leave.
  if (std::abs(reference) <= std::max(levels.error_estimate, uncertain_loss())) return {};
  return work_per_cycle() / reference;
}

bool OscillationOutcome::bends_down() const {
  // A flat punch has F'' = 0 but for the noise of its force.
  return levels.small_amplitude_work < -1e-3 * elastic_energy();
}

bool OscillationOutcome::converged() const {
  const auto done = [](const std::optional<CycleResult>& one) { return !one || one->converged; };
  return levels.converged && done(cycle) && done(frictional) && done(coupled);
}

CycleResult simulate(const OscillationCase& run, const CycleOptions& options) {
  return simulate_cycle(levels_of(run.body, run.material), run.body.surface.grid, run.material,
                        trajectory_of(run.motion, run.indentation), options);
}

OscillationOutcome run_routes(OscillationCase run, const OscillationRoutes& routes) {
  OscillationOutcome outcome;
  outcome.run = std::move(run);
  OscillationCase& contact = outcome.run;
  const Grid2D& grid = contact.body.surface.grid;
  if (routes.relative_error) {
    AdaptiveQuadratureOptions options;
    options.relative_error = *routes.relative_error;
    options.most_points = routes.most_points;
    options.quadrature = routes.levels;
    const auto choose = [&](const auto& levels) {
      return adaptive_level_quadrature(levels, grid, contact.material, contact.motion,
                                       contact.indentation, options);
    };
    if (routes.shape.empty()) {
      outcome.choice = choose(levels_of(contact.body, contact.material));
    } else {
      const auto shape_on = [&, boundary = contact.body.boundary](const Grid2D& finer) {
        Body body = shape_body(routes.shape, finer);
        body.boundary = boundary;
        return body;
      };
      outcome.choice = choose(LevelsOnGrid(
          [&](const Grid2D& finer) { return levels_of(shape_on(finer), contact.material); }));
      contact.body = shape_on(outcome.choice->grid);
    }
    outcome.levels = outcome.choice->quadrature;
  } else {
    outcome.levels =
        level_quadrature(levels_of(contact.body, contact.material), grid, contact.material,
                         contact.motion, contact.indentation, routes.levels);
  }
  if (outcome.levels.interrupted) throw Interrupted("interrupted; nothing was written");
  if (routes.simulate) outcome.cycle = simulate(contact, routes.cycle);
  return outcome;
}

Json cycle_json(const OscillationOutcome& outcome, const CycleResult& cycle) {
  Json object = json_of(cycle);
  if (std::abs(cycle.work_per_cycle) <= outcome.uncertain_loss()) object["balance"] = nullptr;
  return object;
}

Json to_json(const OscillationOutcome& outcome) {
  const LevelQuadratureResult& levels = outcome.levels;
  const Grid2D& grid = outcome.run.body.surface.grid;
  OscillationLoss loss{
      .work_per_cycle = outcome.work_per_cycle(),
      .error_estimate = outcome.error_estimate(),
      .work_by_levels = levels.work_per_cycle,
      .work_by_levels_error = levels.error_estimate,
      .work_by_whole_cells = levels.work_by_levels,
      .work_by_force = levels.work_by_force,
      .ratio_finite = outcome.over(levels.work_by_force),
      .work_over_elastic_energy = outcome.work_per_cycle() / outcome.elastic_energy(),
      .indentation = outcome.run.indentation,
      .force = levels.force,
      // The ends of the sweep are levels without a tangential solve, but for the last of a drag.
      .levels = levels.curve.samples.size() - 2};
  if (!outcome.bends_down()) {
    loss.small_amplitude_work = levels.small_amplitude_work;
    loss.ratio = outcome.over(levels.small_amplitude_work);
    loss.force_curvature = levels.force_curvature;
  }
  Json object = json_of(loss);
  object["error_contains"] = outcome.error_contains();
  object.add(json_of(grid));
  if (outcome.choice) {
    object["error_reached"] = outcome.choice->reached;
    for (const QuadratureTrial& trial : outcome.choice->trials)
      object["trials"].push_back(json_of(trial));
  }
  object["converged"] = outcome.converged();
  if (outcome.cycle) {
    const CycleResult& cycle = *outcome.cycle;
    object["routes_agree"] = std::abs(levels.work_per_cycle - cycle.work_per_cycle) <=
                             levels.error_estimate + cycle.step_error + outcome.uncertain_loss();
    object.add(cycle_json(outcome, cycle));
    object["fft_count"] = cycle.fft_count + levels.fft_count;
    std::vector<double> time = column(cycle, &CycleSample::t);
    object["time_in_periods"] = time;
    const double omega =
        std::visit([](const auto& motion) { return motion.angular_frequency; }, outcome.run.motion);
    // Unknown without a frequency.
    for (double& moment : time)
      moment = omega > 0 ? moment * 2 * std::numbers::pi / omega
                         : std::numeric_limits<double>::quiet_NaN();
    object["time"] = time;
    object["work"] = column(cycle, &CycleSample::work);
  } else {
    const auto& samples = levels.curve.samples;
    object["contact_area_min"] = samples.front().contact_area_fraction * grid.area();
    object["contact_area_max"] = samples.back().contact_area_fraction * grid.area();
    object["fft_count"] = levels.fft_count;
  }
  add_first_loading(object, outcome.run.first_loading);
  return object;
}

Premises premises_of(const OscillationOutcome& outcome, ContactFacts facts) {
  const OscillationCase& run = outcome.run;
  const ForceCurve& curve = outcome.levels.curve;
  const Grid2D& grid = run.body.surface.grid;
  const double contact = curve.samples.back().contact_area_fraction * grid.area();
  const bool spot = run.body.boundary == Boundary::free;
  facts.contact_modulus = run.material.contact_modulus;
  facts.mean_contact_pressure = curve.samples.back().force / contact;
  facts.loaded_size = spot ? std::sqrt(contact / std::numbers::pi) : grid.lx;
  facts.nominal_pressure = outcome.levels.force / (spot ? contact : grid.area());
  if (run.first_loading && run.first_loading->yielded())
    facts.first_load = run.first_loading->pressure * grid.area();
  const auto touching = std::ranges::count_if(curve.samples, [](const ForceSample& sample) {
    return sample.converged && sample.force > 0;
  });
  if (touching < 4) return {};
  return premises_of(TabulatedLaw(curve, run.material.modulus_ratio()), run.indentation, run.motion,
                     facts);
}

void write_cycle(QuantityGroup& group, const CycleResult& cycle, const Grid2D& grid) {
  write_axes(group, grid);
  group.dataset("contact_map", cycle.contact_map());
  if (cycle.loss.size() > 0) group.dataset("loss", cycle.loss);
  describe(
      [&](double CycleSample::*member, const Quantity& quantity) {
        const std::string name(quantity.name);
        if (member == &CycleSample::t)
          group.coordinate(name, column(cycle, member));
        else
          group.dataset(name, column(cycle, member), {"time_in_periods"});
      },
      std::type_identity<CycleSample>{});
  group.attribute("work_per_cycle", cycle.work_per_cycle);
  group.attribute("relaxation_work", cycle.relaxation_work);
  group.attribute("slip_work", cycle.slip_work);
}

void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome) {
  if (outcome.cycle) {
    QuantityGroup group(file.group(prefix + "cycle"));
    write_cycle(group, *outcome.cycle, outcome.run.body.surface.grid);
    group.dataset("heights", outcome.run.body.surface.heights);
    group.attribute("error_estimate", outcome.cycle->step_error);
    group.attribute("small_amplitude_work", outcome.levels.small_amplitude_work);
    group.attribute("work_by_force", outcome.levels.work_by_force);
  }
  QuantityGroup group(file.group(prefix + "levels"));
  const ForceCurve& curve = outcome.levels.curve;
  group.coordinate("indentation", curve.column(&ForceSample::indentation));
  for (const auto& [name, quantity] :
       {std::pair{"force", &ForceSample::force},
        {"normal_stiffness", &ForceSample::normal_stiffness},
        {"tangential_stiffness", &ForceSample::tangential_stiffness},
        {"contact_area_fraction", &ForceSample::contact_area_fraction}})
    group.dataset(name, curve.column(quantity), {"indentation"});
  group.attribute("work_per_cycle", outcome.levels.work_per_cycle);
  group.attribute("error_estimate", outcome.levels.error_estimate);
  group.attribute("work_by_whole_cells", outcome.levels.work_by_levels);
}

PlotPanel contact_panel(const OscillationOutcome& outcome, const std::string& title) {
  const Grid2D& grid = outcome.run.body.surface.grid;
  PlotPanel panel;
  panel.title = title;
  panel.x = {.label = "x", .unit = "m"};
  panel.y = {.label = "y", .unit = "m"};
  panel.equal_scales = true;
  panel.image = PlotImage{.x = positions(grid.nx, grid.dx()),
                          .y = positions(grid.ny, grid.dy()),
                          .values = outcome.cycle->contact_map(),
                          .scale = {.low = 0, .high = 2},
                          .palette = PlotPalette::grey,
                          .color_bar = false};
  return panel;
}

PlotPanel work_panel(const OscillationOutcome& outcome, const std::string& title) {
  const bool drag = std::holds_alternative<Drag>(outcome.run.motion);
  const CycleResult& cycle = *outcome.cycle;
  const double predicted = outcome.levels.small_amplitude_work;
  const bool lossless = !outcome.over(predicted);
  std::vector<double> values = column(cycle, drag ? &CycleSample::dissipated : &CycleSample::work);
  const double reference = lossless ? outcome.elastic_energy() : predicted;
  for (double& value : values) value /= reference;
  PlotPanel panel;
  panel.title = title;
  panel.x = {.label = "time in periods", .low = 0, .high = 1};
  const std::string work = drag ? "energy released" : "W(t)";
  panel.y = {.label = lossless ? work + " / (K_x u_x^2/2)"
                               : work + (drag ? " / W_{Eq. 15}" : " / W_{Eq. 12}")};
  panel.curves.push_back({.x = column(cycle, &CycleSample::t), .y = std::move(values), .color = 0});
  panel.lines.push_back({.at = lossless ? 0.0 : 1.0});
  return panel;
}

}  // namespace salebra::cli
