// SPDX-License-Identifier: GPL-3.0-or-later
// Frictional and coupled cycles of `oscillate`: options, run, JSON, HDF5 and figure.
#include "friction_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space/coupling.hpp>
#include <utility>

#include "cycle_columns.hpp"

namespace salebra::cli {
namespace {

double greatest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

// Largest |a − b| over a cycle over the largest |b|.
Json change(const FrictionalCycleResult& a, const FrictionalCycleResult& b,
            double FrictionalSample::*quantity) {
  std::vector<double> values = column(a, quantity);
  const std::vector<double> reference = column(b, quantity);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] -= reference[i];
  const double scale = greatest(reference);
  return scale > 0 ? Json(greatest(values) / scale) : Json(nullptr);
}

// Below this a loss is what the solvers leave.
double no_loss(const OscillationOutcome& stuck) { return 1e-7 * stuck.elastic_energy(); }

Json over(double value, double reference, double uncertain) {
  return std::abs(reference) > uncertain ? Json(value / reference) : Json(nullptr);
}

// How far the two sums of the loss are apart, J.
double unbalanced(const FrictionalCycleResult& cycle) {
  return cycle.dissipated + cycle.gap_work - cycle.work_per_cycle;
}

// What a cycle with friction says, coupled or not.
void add_cycle(Json& object, const FrictionalCycleResult& cycle, double uncertain) {
  object["work_per_cycle"] = cycle.work_per_cycle;
  object["relaxation_work"] = cycle.relaxation_work;
  object["slip_work"] = cycle.slip_work;
  object["dissipated"] = cycle.dissipated;
  object["balance"] = over(unbalanced(cycle), cycle.work_per_cycle, uncertain);
  object["stored_energy_change"] = cycle.stored_energy_change;
  object["periods"] = cycle.periods;
  object["steady"] = cycle.steady;
  object["converged"] = cycle.converged;
}

void write_cycle(ResultGroup group, const FrictionalCycleResult& cycle, const Grid2D& grid) {
  write_axes(group, grid);
  group.dataset("loss", cycle.loss, "x", "y", "J/m^2", "energy dissipated in a period by unit area");
  CycleColumns<FrictionalSample, FrictionalCycleResult> columns(group, cycle);
  columns.add("dissipated", &FrictionalSample::dissipated, "J", "energy dissipated by friction since the start");
  columns.add("slip_area", &FrictionalSample::slip_area, "m^2", "area of cells at their limit");
  group.attribute("work_per_cycle", cycle.work_per_cycle);
  group.attribute("relaxation_work", cycle.relaxation_work);
  group.attribute("slip_work", cycle.slip_work);
}

void warn_of_cycle(const char* which, const FrictionalCycleResult& cycle, double uncertain,
                   Session& session) {
  if (!cycle.converged || std::abs(cycle.work_per_cycle) <= uncertain) return;
  if (!cycle.steady)
    session.warn(fmt::format(
        "{}: after {} periods the loss still differs from that of the period before by more than "
        "1e-5 of it; raise --max-periods",
        which, cycle.periods));
  const double balance = unbalanced(cycle) / cycle.work_per_cycle;
  if (std::abs(balance) > 0.01)
    session.warn(
        fmt::format("{}: work and dissipation of a period, which should be equal, differ by "
                    "{:.2g} %; more --steps may help",
                    which, 100 * balance));
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
  require(indentation >= amplitude, "--coupled", "given,",
          fmt::format("but the body leaves the surface ({:g} m < amplitude {:g} m); the coupled "
                      "cycle needs a contact that stays",
                      indentation, amplitude));
}

double FrictionOptions::coupling(const MaterialOptions& bodies, const Material& material) const {
  if (dundurs) return *dundurs / (std::numbers::pi * material.contact_modulus);
  if (bodies.young.size() == 2)
    return coupling_constant(ElasticBody{bodies.young[0], bodies.poisson[0]},
                             ElasticBody{bodies.young[1], bodies.poisson[1]});
  return coupling_constant(material);
}

FrictionOutcome run_with_friction(const FrictionOptions& options, const OscillationCase& run,
                                  const CycleOptions& steps, double coupling,
                                  const FrictionRecord& record, Session& session) {
  FrictionalCycleOptions cycle;
  cycle.friction_coefficient =
      options.friction_coefficient.value_or(std::numeric_limits<double>::infinity());
  cycle.steps = steps.steps;
  cycle.max_periods = options.max_periods;
  cycle.direction = steps.direction;
  cycle.coupling = coupling;
  cycle.stick.boundary = run.body.boundary;
  cycle.stick.hold_lateral = steps.stick.hold_lateral;
  cycle.on_progress = session.progress();
  const NormalContactOptions contact{.boundary = run.body.boundary};
  const Surface& surface = run.body.surface;
  const Trajectory trajectory = trajectory_of(run.motion, run.indentation);
  FrictionalCycleOptions recorded = cycle;
  recorded.on_state = record.on_state;
  recorded.resume = record.resume;
  FrictionOutcome outcome;
  outcome.friction_coefficient = options.friction_coefficient;
  outcome.cycle = simulate_frictional_cycle(
      boundary_element_pressures(surface, run.material.contact_modulus, contact), surface.grid,
      run.material, trajectory, recorded);
  if (options.coupled && !outcome.cycle.interrupted) {
    outcome.dundurs = dundurs_constant(run.material.contact_modulus, coupling);
    outcome.coupled = simulate_coupled_cycle(surface, run.material, trajectory, cycle, contact);
  }
  return outcome;
}

void add_friction(Json& object, const FrictionOutcome& outcome, const OscillationOutcome& stuck) {
  const FrictionalCycleResult& cycle = outcome.cycle;
  const double uncertain = no_loss(stuck);
  Json& friction = object["friction"];
  friction["coefficient"] =
      outcome.friction_coefficient ? Json(*outcome.friction_coefficient) : Json(nullptr);
  add_cycle(friction, cycle, uncertain);
  friction["over_stick"] = over(cycle.work_per_cycle, stuck.work_per_cycle(), uncertain);
  friction["tangential"] = column(cycle, &FrictionalSample::tangential);
  friction["tangential_force"] = column(cycle, &FrictionalSample::tangential_force);
  if (!outcome.coupled) return;
  const FrictionalCycleResult& coupled = *outcome.coupled;
  Json& coupling = object["coupling"];
  coupling["dundurs"] = outcome.dundurs;
  add_cycle(coupling, coupled, uncertain);
  coupling["normal_work"] = coupled.normal_work;
  coupling["gap_work"] = coupled.gap_work;
  coupling["work_change"] =
      over(coupled.work_per_cycle - cycle.work_per_cycle, cycle.work_per_cycle, uncertain);
  coupling["force_change"] = change(coupled, cycle, &FrictionalSample::normal_force);
  coupling["tangential_force_change"] = change(coupled, cycle, &FrictionalSample::tangential_force);
}

PlotPanel loop_panel(const FrictionOutcome& outcome, const OscillationOutcome& stuck) {
  PlotPanel panel;
  panel.title = "loop";
  panel.x = {.label = "x", .unit = "m"};
  panel.y = {.label = "F_x", .unit = "N"};
  const auto add = [&](const char* name, std::vector<double> x, std::vector<double> force) {
    panel.curves.push_back({.name = name, .x = std::move(x), .y = std::move(force)});
  };
  std::vector<double> x, force;
  for (const CycleSample& sample : stuck.cycle->samples) {
    x.push_back(sample.tangential);
    force.push_back(sample.tangential_force);
  }
  add("no slip", std::move(x), std::move(force));
  const auto add_cycle = [&](const char* name, const FrictionalCycleResult& cycle) {
    add(name, column(cycle, &FrictionalSample::tangential),
        column(cycle, &FrictionalSample::tangential_force));
  };
  if (outcome.friction_coefficient) add_cycle("friction", outcome.cycle);
  if (outcome.coupled) add_cycle("coupled", *outcome.coupled);
  panel.legend = PlotLegend::top_left;
  return panel;
}

void write_friction(ResultFile& file, const FrictionOutcome& outcome, const Grid2D& grid) {
  ResultGroup friction = file.group("friction");
  friction.attribute("coefficient", outcome.friction_coefficient.value_or(
                                        std::numeric_limits<double>::infinity()));
  write_cycle(friction, outcome.cycle, grid);
  if (!outcome.coupled) return;
  ResultGroup coupling = file.group("coupling");
  coupling.attribute("dundurs", outcome.dundurs);
  coupling.attribute("normal_work", outcome.coupled->normal_work);
  write_cycle(coupling, *outcome.coupled, grid);
}

void warn_of_friction(const FrictionOutcome& outcome, const OscillationOutcome& stuck,
                      Session& session) {
  warn_of_cycle("friction", outcome.cycle, no_loss(stuck), session);
  if (!outcome.coupled) return;
  warn_of_cycle("coupling", *outcome.coupled, no_loss(stuck), session);
  if (outcome.dundurs == 0) session.note("Dundurs' beta is 0: nothing is coupled");
}

}  // namespace salebra::cli
