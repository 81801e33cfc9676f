// SPDX-License-Identifier: GPL-3.0-or-later
// JSON, HDF5, figures and warnings of an oscillating contact.
#include "oscillation_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "options.hpp"
#include "results/columns.hpp"
#include "results/describe.hpp"
#include "results/quantity_group.hpp"

namespace salebra::cli {
namespace {

/// JSON with the numbers of a cycle. The energy balance is left out if the loss is not larger than
/// the error of the solvers.
Json cycle_json(const OscillationOutcome& outcome, const CycleResult& cycle) {
  Json object = json_of(cycle);
  object["balance"] = outcome.balance(cycle);
  return object;
}

/// Adds columns of a cycle over the time, by their names in the description.
void add_columns(Json& object, const CycleResult& cycle,
                 std::initializer_list<std::string_view> names) {
  const Json all = json_of(cycle.samples);
  for (const std::string_view name : names) object[name] = all[name];
}

void add_friction(Json& object, const OscillationOutcome& outcome) {
  if (outcome.frictional) {
    const CycleResult& cycle = *outcome.frictional;
    Json& friction = object["friction"];
    friction["friction_coefficient"] = outcome.friction_coefficient;
    friction.add(cycle_json(outcome, cycle));
    friction.add(json_of(slip_effect(outcome)));
    add_columns(friction, cycle, {"tangential", "tangential_force"});
  }
  if (outcome.coupled) {
    Json& coupling = object["coupling"];
    coupling["dundurs"] = outcome.dundurs;
    coupling.add(cycle_json(outcome, *outcome.coupled));
    coupling.add(json_of(coupling_effect(outcome)));
  }
}

/// Writes a cycle: coordinates, columns over the time, and maps of contact and of the energy lost.
void write_cycle(QuantityGroup& group, const CycleResult& cycle, const Grid2D& grid) {
  group.axes(grid);
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

void warn_of_cycle(const char* which, const CycleResult& cycle, double uncertain,
                   Session& session) {
  if (!cycle.converged() || std::abs(cycle.work_per_cycle) <= uncertain) return;
  if (!cycle.steady)
    session.warn(
        fmt::format("{}: after {} periods the loss still changes by more than 1e-5 of itself per "
                    "period; raise --max-periods",
                    which, cycle.periods));
  if (std::abs(cycle.balance()) > 0.01)
    session.warn(
        fmt::format("{}: work and dissipation in a period should be equal but differ by {:.2g} %; "
                    "more --steps may help",
                    which, 100 * cycle.balance()));
  const double gaps = cycle.gap_work / cycle.work_per_cycle;
  if (std::abs(gaps) > 0.01)
    session.warn(
        fmt::format("{}: {:.2g} % of the loss is work across gaps that close and open within a "
                    "step; use more --steps",
                    which, 100 * gaps));
}

}  // namespace

Json to_json(const OscillationOutcome& outcome) {
  const IntervalQuadratureResult& intervals = outcome.intervals;
  const Grid2D& grid = outcome.run.body.surface.grid;
  Json object = json_of(loss_of(outcome));
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
    object["routes_agree"] = outcome.routes_agree();
    object.add(cycle_json(outcome, cycle));
    add_columns(object, cycle, {"time_in_periods", "work"});
    const double omega =
        std::visit([](const auto& motion) { return motion.angular_frequency; }, outcome.run.motion);
    // Times in seconds are unknown without a frequency.
    std::vector<double> time = column(cycle, &CycleSample::t);
    for (double& moment : time)
      moment = omega > 0 ? moment * 2 * std::numbers::pi / omega
                         : std::numeric_limits<double>::quiet_NaN();
    object["time"] = time;
  } else {
    const auto& samples = intervals.curve.samples;
    object["contact_area_min"] = samples.front().contact_area_fraction * grid.area();
    object["contact_area_max"] = samples.back().contact_area_fraction * grid.area();
  }
  object["fft_count"] = intervals.fft_count + (outcome.cycle ? outcome.cycle->fft_count : 0);
  add_first_loading(object, outcome.run.first_loading);
  add_friction(object, outcome);
  return object;
}

void write_outcome(ResultFile& file, const std::string& prefix, const OscillationOutcome& outcome) {
  if (outcome.cycle) {
    QuantityGroup group(file.group(prefix + "cycle"));
    write_cycle(group, *outcome.cycle, outcome.run.body.surface.grid);
    group.dataset("heights", outcome.run.body.surface.heights);
    group.attribute("error_estimate", outcome.cycle->step_error);
    group.attribute("small_amplitude_work", outcome.intervals.small_amplitude_work);
    group.attribute("work_by_force", outcome.intervals.work_by_force);
  }
  if (outcome.frictional) {
    QuantityGroup friction(file.group(prefix + "friction"));
    friction.attribute("friction_coefficient", outcome.friction_coefficient);
    write_cycle(friction, *outcome.frictional, outcome.run.body.surface.grid);
  }
  if (outcome.coupled) {
    QuantityGroup coupling(file.group(prefix + "coupling"));
    coupling.attribute("dundurs", outcome.dundurs);
    coupling.attribute("normal_work", outcome.coupled->normal_work);
    write_cycle(coupling, *outcome.coupled, outcome.run.body.surface.grid);
  }
  QuantityGroup group(file.group(prefix + "intervals"));
  const ForceCurve& curve = outcome.intervals.curve;
  group.coordinate("indentation", curve.column(&ForceSample::indentation));
  for (const char* name :
       {"force", "normal_stiffness", "tangential_stiffness", "contact_area_fraction"}) {
    std::vector<double> values;
    std::ranges::transform(curve.samples, std::back_inserter(values),
                           number_of<ForceSample>(name, "intervals"));
    group.dataset(name, values, {"indentation"});
  }
  group.attribute("work_per_cycle", outcome.intervals.work_per_cycle);
  group.attribute("error_estimate", outcome.intervals.error_estimate);
  group.attribute("work_by_whole_cells", outcome.intervals.work_by_intervals);
}

void warn_of(const OscillationOutcome& outcome, Session& session) {
  if (outcome.frictional)
    warn_of_cycle("friction", *outcome.frictional, outcome.uncertain_loss(), session);
  if (outcome.coupled) {
    warn_of_cycle("coupling", *outcome.coupled, outcome.uncertain_loss(), session);
    if (outcome.dundurs == 0)
      session.inform("Dundurs' beta is 0, so normal and tangential directions are not coupled");
  }
  if (outcome.choice && !outcome.choice->reached)
    session.warn(
        fmt::format("the requested relative error was not reached: it is {:.2g} with {} x {} cells "
                    "and {} intervals",
                    outcome.choice->error_estimate / std::abs(outcome.intervals.work_per_cycle),
                    outcome.choice->grid.nx, outcome.choice->grid.ny, outcome.choice->intervals));
}

}  // namespace salebra::cli
