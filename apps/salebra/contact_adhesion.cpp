// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra contact --work-of-adhesion`: several operating points with adhesion, in loading and then
// in unloading.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/force_curve_file.hpp>
#include <salebra/surface/moments.hpp>

#include "contact_command.hpp"
#include "option_words.hpp"

namespace salebra::cli {
namespace {

/// The converged states of loading or of unloading, as the answer lists them.
struct Branch {
  ForceCurve curve;
  std::vector<AdhesionOfState> adhesion;
  std::vector<FlowFactors> flow;
  std::vector<CurveColumn> beside;  ///< columns in addition to those of ForceCurve; set by json()

  void add(const Branch& other, std::size_t index) {
    curve.samples.push_back(other.curve.samples[index]);
    adhesion.push_back(other.adhesion[index]);
    if (!other.flow.empty()) flow.push_back(other.flow[index]);
  }
  Json json(const ContactArguments& arguments) {
    Json columns = to_json(curve);
    columns.add(json_of(adhesion));
    beside = columns_beside(adhesion);
    std::ranges::move(add_beside(arguments, curve, flow, columns), std::back_inserter(beside));
    return columns;
  }
};

std::vector<OperatingPoint> points_of(const ContactArguments& arguments) {
  OperatingPoints at = arguments.at.given().front();
  std::ranges::sort(at.values);
  if (at.control == ControlQuantity::mean_gap) std::ranges::reverse(at.values);
  std::vector<OperatingPoint> points;
  for (const double value : at.values) points.push_back({at.control, value});
  return points;
}

void require_converged(const AdhesiveCycle& cycle) {
  if (cycle.converged()) return;
  const auto& last = (cycle.unloading.empty() ? cycle.loading : cycle.unloading).back();
  throw NotConverged(
      fmt::format("contact: residual of the tension {:.3g} at {} after {} contacts {}",
                  last.adhesion_residual, format_quantity(last.mean_pressure, Dimension::pressure),
                  last.outer_iterations, in_options(message(last.termination))));
}

/// Writes both branches to --output; only the first process writes.
void write(const Branch& loading, const Branch& unloading, const AdhesiveCycle& cycle,
           const Session& session) {
  if (!session.has_output() || !session.communicator().is_root()) return;
  if (cycle.unloading.empty())
    return write_force_curve(session.output(), loading.curve, session.provenance(),
                             session.write_options(), loading.beside);
  ResultFile file(session.output(), session.provenance(), session.write_options());
  ResultGroup in = file.group("curve"), out = file.group("unloading");
  write_force_curve(in, loading.curve, loading.beside);
  write_force_curve(out, unloading.curve, unloading.beside);
  for (const auto& [quantity, values] : columns_beside(std::vector{cycle}))
    out.attribute(std::string(quantity.name), values.front());
  file.commit();
}

}  // namespace

Adhesion ContactArguments::adhesion() const {
  return {*parse_enum<AdhesionPotential>(potential), *work_of_adhesion, *adhesion_range};
}

AdhesiveContactOptions ContactArguments::adhesive_options(Session& session) const {
  AdhesiveContactOptions options;
  options.contact = contact_options(session);
  options.contact.tolerance = NormalContactOptions().tolerance;
  if (tolerance) options.tolerance = *tolerance;
  options.force_coarse = force_coarse;
  return options;
}

void press_adhesively(const ContactArguments& arguments, Session& session) {
  const std::optional<Body> body_of_file = arguments.material.body_of_file();
  const Body body = body_of_file ? *body_of_file : Body(arguments.material.material());
  const std::optional<Material>& material = body.half_space_material();
  const Surface surface = arguments.surface.read(session);
  const Adhesion adhesion = arguments.adhesion();
  const double area = surface.grid.area();
  for (const double pressure : arguments.pressures_on(area))
    if (material) session.warn_if(warning_of_pressure(pressure, material->contact_modulus));
  Branch loading;
  loading.curve.model = "bem";
  loading.curve.adhesive = true;
  loading.curve.body = body.fingerprint();
  loading.curve.nominal_area = area;
  loading.curve.rms_height = height_statistics(surface).rms_height;
  Branch unloading = loading;
  AdhesiveCycleOptions options{.contact = arguments.adhesive_options(session),
                               .unload = arguments.cycle};
  // The rows of a cycle are its states, one for each, so K_t has one direction.
  double direction = 0;
  if (arguments.direction != "auto") {
    const std::vector<double> directions = arguments.directions_on(surface);
    require(directions.size() == 1, "--direction", arguments.direction,
            "gives two directions; several contacts with adhesion take one");
    direction = directions.front();
  }
  const SweepOptions sample{.contact = options.contact.contact,
                            .stiffness = arguments.wants_stiffness(),
                            .stick = arguments.sticks(),
                            .direction = direction};
  options.on_state = [&](bool out, const AdhesiveContactState& state) {
    Branch& branch = out ? unloading : loading;
    if (out && branch.adhesion.empty()) branch.add(loading, loading.adhesion.size() - 1);
    if (state.detached)
      branch.curve.samples.push_back({.force = state.force, .pressure = state.mean_pressure});
    else
      branch.curve.samples.push_back(force_sample(state, surface, body, sample));
    branch.adhesion.push_back(state);
    if (arguments.flow_factors)
      branch.flow.push_back(state.detached ? FlowFactors() : flow_of(state, surface, {}));
  };
  const AdhesiveCycle cycle =
      adhesive_cycle(surface, body, points_of(arguments), adhesion, options);
  if (session.stopped()) throw Interrupted("contact: interrupted; nothing was written");
  session.warn_if(warning_of_process_zone(adhesion, surface.grid, body));
  require_converged(cycle);
  Json answer{{"curve", loading.json(arguments)}};
  if (arguments.cycle) {
    answer["unloading"] = unloading.json(arguments);
    answer.add(json_of(cycle));
    if (std::isnan(cycle.adhesion_work_per_cycle) && arguments.pressures_on(area).empty())
      session.warn(
          "the branches of the cycle do not meet at its outermost point, so its work is not known; "
          "begin farther out");
  }
  if (material) answer.add(json_of(mean_summit(surface, adhesion, material->contact_modulus)));
  arguments.material.add_datum_to(answer);
  collectively(session.communicator(), [&] { write(loading, unloading, cycle, session); });
  if (session.has_plot())
    session.plot(arguments.cycle ? figures::figure_of(loading.curve, unloading.curve)
                                 : figures::figure_of(loading.curve, std::nullopt));
  session.answer(answer);
  for (const Branch* branch : {&loading, &unloading})
    if (!std::ranges::all_of(branch->flow, &FlowFactors::converged))
      throw NotConverged(flow_failure);
}

}  // namespace salebra::cli
