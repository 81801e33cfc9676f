// SPDX-License-Identifier: GPL-3.0-or-later
// Frictional and coupled cycles of `oscillate`: options, run, JSON, HDF5 and figure.
#include "friction_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/results/columns.hpp>

namespace salebra::cli {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// Largest |a − b| over a cycle over the largest |b|.
double change(const CycleResult& a, const CycleResult& b, double CycleSample::*quantity) {
  std::vector<double> values = column(a, quantity);
  const std::vector<double> reference = column(b, quantity);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= reference[i];
  const double scale = greatest(reference);
  return scale > 0 ? greatest(values) / scale : unknown;
}

// The last sample is the first of the next period.
double mean_over_period(const CycleResult& cycle, double CycleSample::*quantity) {
  const std::vector<double> values = column(cycle, quantity);
  return std::accumulate(values.begin() + 1, values.end(), 0.0) /
         static_cast<double>(values.size() - 1);
}

double dundurs_of(const CycleOptions& cycle, const OscillationOutcome& outcome) {
  return dundurs_constant(outcome.run.material.contact_modulus, *cycle.coupling_constant);
}

void warn_of_cycle(const char* which, const CycleResult& cycle, double uncertain,
                   Session& session) {
  if (!cycle.converged || std::abs(cycle.work_per_cycle) <= uncertain) return;
  if (!cycle.steady)
    session.warn(fmt::format(
        "{}: after {} periods the loss still differs from that of the period before by more than "
        "1e-5 of it; raise --max-periods",
        which, cycle.periods));
  if (std::abs(cycle.balance()) > 0.01)
    session.warn(
        fmt::format("{}: work and dissipation of a period, which should be equal, differ by "
                    "{:.2g} %; more --steps may help",
                    which, 100 * cycle.balance()));
  const double gaps = cycle.gap_work / cycle.work_per_cycle;
  if (std::abs(gaps) > 0.01)
    session.warn(
        fmt::format("{}: {:.2g} % of the loss is work across gaps that close and open within a "
                    "step; more --steps help",
                    which, 100 * gaps));
}

}  // namespace

void FrictionOptions::add_to(Command& app) {
  const std::string group = "Friction";
  add_quantity(app, "--friction", friction_coefficient, Dimension::dimensionless,
               "Coulomb's coefficient: steps through the cycle once more, with slip where the "
               "traction would exceed it; without it nothing slips")
      ->group(group);
  app.add_flag("--coupled", coupled,
               "steps once more with pressures and tractions coupled by Dundurs' beta")
      ->group(group);
  add_quantity(app, "--dundurs", dundurs, Dimension::dimensionless,
               "Dundurs' beta, with --coupled; default: that of the material")
      ->group(group);
  app.add_option("--max-periods", max_periods,
                 "periods with friction, at most, until two lose the same; default 6")
      ->group(group);
}

void FrictionOptions::check() const {
  if (friction_coefficient) require_positive(*friction_coefficient, "--friction");
  require(max_periods >= 2, "--max-periods", max_periods,
          "must be >= 2: a loss is steady where two periods agree");
  require(max_periods == 6 || given(), "--max-periods", max_periods,
          "is of a cycle with friction; add --friction or --coupled");
  if (!dundurs) return;
  require(coupled, "--dundurs", *dundurs, "means nothing by itself; add --coupled");
  require(std::abs(*dundurs) <= 0.5, "--dundurs", *dundurs, "must be -0.5 ... 0.5");
}

void FrictionOptions::check(const Oscillation& motion, double indentation) const {
  if (!coupled) return;
  const double amplitude =
      std::visit([](const auto& kind) { return kind.normal_amplitude; }, motion);
  require_that(
      indentation >= amplitude, "--coupled",
      fmt::format("given, but the body leaves the surface ({:g} m < amplitude {:g} m); the coupled "
                  "cycle needs a contact that stays",
                  indentation, amplitude));
}

void FrictionOptions::apply(CycleOptions& cycle, const MaterialOptions& bodies,
                            const Material& material) const {
  if (friction_coefficient) cycle.friction_coefficient = *friction_coefficient;
  cycle.max_periods = max_periods;
  if (!coupled) return;
  if (dundurs)
    cycle.coupling_constant = *dundurs / (std::numbers::pi * material.contact_modulus);
  else if (bodies.young.size() == 2)
    cycle.coupling_constant = coupling_constant(ElasticBody{bodies.young[0], bodies.poisson[0]},
                                                ElasticBody{bodies.young[1], bodies.poisson[1]});
  else
    cycle.coupling_constant = coupling_constant(material);
}

std::vector<std::string> FrictionOptions::cycles() const {
  std::vector<std::string> names{""};
  if (given()) names.emplace_back("-friction");
  if (coupled) names.emplace_back("-coupled");
  return names;
}

void run_with_friction(const FrictionOptions& options, const CycleOptions& cycle,
                       CycleRecorder& recorder, OscillationOutcome& outcome) {
  const OscillationCase& run = outcome.run;
  const Surface& surface = run.body.surface;
  const NormalContactOptions contact{.boundary = run.body.boundary};
  const Trajectory trajectory = trajectory_of(run.motion, run.indentation);
  const PressureLevels levels =
      boundary_element_pressures(surface, run.material.contact_modulus, contact);
  outcome.frictional = recorder.run(cycle, [&](const CycleOptions& recorded) {
    return simulate_frictional_cycle(levels, surface.grid, run.material, trajectory, recorded);
  });
  if (!options.coupled || outcome.frictional->interrupted) return;
  outcome.coupled = recorder.run(cycle, [&](const CycleOptions& recorded) {
    return simulate_coupled_cycle(surface, run.material, trajectory, recorded, contact);
  });
}

void add_friction(Json& object, const FrictionOptions& options, const CycleOptions& cycle,
                  const OscillationOutcome& outcome) {
  const CycleResult& frictional = *outcome.frictional;
  const auto over = [&](double value, double reference) {
    return std::abs(reference) > outcome.uncertain_loss() ? value / reference : unknown;
  };
  const bool drag = std::holds_alternative<Drag>(outcome.run.motion);
  Json& friction = object["friction"];
  friction["friction_coefficient"] =
      options.friction_coefficient ? Json(*options.friction_coefficient) : Json(nullptr);
  friction.add(cycle_json(outcome, frictional));
  friction.add(json_of(SlipEffect{
      .over_stick = over(frictional.work_per_cycle, outcome.work_per_cycle()),
      .mean_tangential_force =
          drag ? frictional.work_per_cycle / std::abs(frictional.samples.back().tangential)
               : unknown,
      .mean_force = mean_over_period(frictional, &CycleSample::normal_force)}));
  friction["tangential"] = column(frictional, &CycleSample::tangential);
  friction["tangential_force"] = column(frictional, &CycleSample::tangential_force);
  if (!outcome.coupled) return;
  const CycleResult& coupled = *outcome.coupled;
  Json& coupling = object["coupling"];
  coupling["dundurs"] = dundurs_of(cycle, outcome);
  coupling.add(cycle_json(outcome, coupled));
  coupling.add(json_of(CouplingEffect{
      .work_change =
          over(coupled.work_per_cycle - frictional.work_per_cycle, frictional.work_per_cycle),
      .force_change = change(coupled, frictional, &CycleSample::normal_force),
      .tangential_force_change = change(coupled, frictional, &CycleSample::tangential_force)}));
}

PlotPanel loop_panel(const FrictionOptions& options, const OscillationOutcome& outcome) {
  PlotPanel panel;
  panel.title = "loop";
  panel.x = {.label = "x", .unit = "m"};
  panel.y = {.label = "F_x", .unit = "N"};
  const auto add = [&](const char* name, const CycleResult& cycle) {
    panel.curves.push_back({.name = name,
                            .x = column(cycle, &CycleSample::tangential),
                            .y = column(cycle, &CycleSample::tangential_force)});
  };
  add("no slip", *outcome.cycle);
  if (options.friction_coefficient) add("friction", *outcome.frictional);
  if (outcome.coupled) add("coupled", *outcome.coupled);
  panel.legend = PlotLegend::top_left;
  return panel;
}

void write_friction(ResultFile& file, const CycleOptions& cycle,
                    const OscillationOutcome& outcome) {
  const Grid2D& grid = outcome.run.body.surface.grid;
  QuantityGroup friction(file.group("friction"));
  friction.attribute("friction_coefficient", cycle.friction_coefficient);
  write_cycle(friction, *outcome.frictional, grid);
  if (!outcome.coupled) return;
  QuantityGroup coupling(file.group("coupling"));
  coupling.attribute("dundurs", dundurs_of(cycle, outcome));
  coupling.attribute("normal_work", outcome.coupled->normal_work);
  write_cycle(coupling, *outcome.coupled, grid);
}

void warn_of_friction(const CycleOptions& cycle, const OscillationOutcome& outcome,
                      Session& session) {
  warn_of_cycle("friction", *outcome.frictional, outcome.uncertain_loss(), session);
  if (!outcome.coupled) return;
  warn_of_cycle("coupling", *outcome.coupled, outcome.uncertain_loss(), session);
  if (dundurs_of(cycle, outcome) == 0) session.note("Dundurs' beta is 0: nothing is coupled");
}

}  // namespace salebra::cli
