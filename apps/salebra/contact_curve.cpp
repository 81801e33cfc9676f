// SPDX-License-Identifier: GPL-3.0-or-later
// Several operating points of `salebra contact`: the force curve, the groups of processes that
// share it, and the estimated cost.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <salebra/figures/figures.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "base/memory.hpp"
#include "contact/half_space/normal_symbol.hpp"
#include "contact_command.hpp"
#include "dry_run.hpp"
#include "results/columns.hpp"

namespace salebra::cli {
namespace {

/// Number of groups of processes. For generated surfaces it is the largest one that memory allows;
/// a file is read once, by one group.
int groups_of(const ContactArguments& arguments, const SurfaceWork& work, const Session& session) {
  if (arguments.groups > 0) return arguments.groups;
  if (arguments.surface.recipe.empty() || work.ranks == 1 || work.loads.size() == 1) return 1;
  return groups_that_fit(work, [&](double bytes) {
    if (!arguments.dry_run.dry_run)
      return memory_of_nodes(bytes, session.communicator()).suffices();
    const double available = static_cast<double>(available_memory());
    return available == 0 || bytes * std::ceil(double(work.ranks) / work.nodes) <= available;
  });
}

SurfaceWork work_of(const ContactArguments& arguments, const SurfaceOutline& outline,
                    Session& session) {
  SurfaceWork work = planned(arguments.dry_run, outline.grid, session);
  const std::optional<Body> body = arguments.material.body_of_file();
  const double modulus = body ? detail::reference_modulus(*body, outline.grid)
                              : arguments.material.material().contact_modulus;
  const double unit = modulus * outline.rms_slope;
  for (const double pressure : arguments.pressures_on(outline.grid.area()))
    work.loads.push_back(pressure / unit);
  // A gap or an indentation does not tell the load, which decides the cost. A load of 0.05 E*h' is
  // assumed, at which about a tenth of the cells are in contact.
  if (work.loads.empty()) work.loads = {0.05};
  work.normal_stiffness = arguments.wants_stiffness();
  work.tangential_stiffness = arguments.sticks();
  work.adhesive = arguments.adhesive();
  work.boundary = *parse_enum<Boundary>(arguments.boundary);
  work.groups = groups_of(arguments, work, session);
  return work;
}

}  // namespace

Json to_json(const ForceCurve& curve) {
  const Json columns = json_of(curve.samples, curve.nominal_area);
  Json object = Json::object();
  // The direction is the first column of the rows that it distinguishes.
  if (by_direction(curve).size() > 1) object["direction"] = columns["direction"];
  object.add(columns);
  const auto unknown = [](const Json& value) { return !std::isfinite(value.number()); };
  for (const char* name :
       {"separation", "normal_stiffness_per_area", "tangential_stiffness_per_area"})
    if (object.contains(name) && std::ranges::all_of(object[name].elements(), unknown))
      object.erase(name);
  return object;
}

std::vector<CurveColumn> add_beside(const ContactArguments& arguments, const ForceCurve& curve,
                                    const std::vector<FlowFactors>& flow, Json& columns) {
  std::vector<CurveColumn> beside;
  if (arguments.conduction.given()) {
    std::vector<Conductances> found;
    for (const ForceSample& sample : curve.samples)
      found.push_back(arguments.conductances_of(sample, curve.nominal_area));
    columns.add(conductances_json(found, arguments.conduction));
    beside = columns_beside(found);
  }
  if (!flow.empty()) {
    // A curve of several directions repeats its loads, and so their flow.
    std::vector<FlowFactors> rows;
    while (rows.size() < curve.samples.size()) rows.insert(rows.end(), flow.begin(), flow.end());
    columns.add(json_of(rows));
    std::ranges::move(columns_beside(rows), std::back_inserter(beside));
  }
  return beside;
}

void answer_curve(const ContactArguments& arguments, const ForceCurve& curve, Json answer,
                  Session& session, const std::vector<FlowFactors>& flow) {
  const auto beside = add_beside(arguments, curve, flow, answer["curve"]);
  collectively(session.communicator(), [&] {
    if (session.has_output() && session.communicator().is_root())
      write_force_curve(session.output(), curve, session.provenance(), session.write_options(),
                        beside);
  });
  if (session.has_plot()) session.plot(figures::figure_of(curve, std::nullopt));
  session.answer(answer);
}

void estimate_contacts(const ContactArguments& arguments, Session& session) {
  const SurfaceOutline outline = arguments.surface.outline(session);
  answer_dry_run(work_of(arguments, outline, session), outline.origin, session);
}

int contact_groups(const ContactArguments& arguments, Session& session) {
  if (arguments.groups > 0 || arguments.surface.recipe.empty() || session.communicator().alone())
    return std::max(1, arguments.groups);
  return work_of(arguments, arguments.surface.outline(session), session).groups;
}

void press_often(const ContactArguments& arguments, Session& session) {
  const std::optional<Body> body = arguments.material.body_of_file();
  const Material material = body ? Material{} : arguments.material.material();
  const int groups = contact_groups(arguments, session);
  SweepOptions options;
  options.contact = arguments.contact_options(session);
  options.stiffness = arguments.wants_stiffness();
  options.stick = arguments.sticks();
  options.groups = Groups(session.communicator(), groups);
  Surface surface = arguments.surface.read(session, options.groups->own());
  const std::vector<double> pressures = arguments.pressures_on(surface.grid.area());
  if (!body) session.warn_if(warning_of_pressure(pressures.back(), material.contact_modulus));
  session.warn(warnings_of_direction(arguments, surface));
  const std::optional<FirstLoading> first_loading = load_first(
      surface, arguments.hardness, material.contact_modulus, pressures.back(), options.contact);
  const std::vector<double> directions = arguments.directions_on(surface);
  std::vector<FlowFactors> flow(arguments.flow_factors ? pressures.size() : 0);
  if (arguments.flow_factors)
    options.on_state = [&](std::size_t k, const NormalContactState& state) {
      flow[k] = flow_of(state, surface, {});
    };
  const ForceCurve curve =
      joined(body ? sweep_directions(surface, *body, pressures, directions, options)
                  : sweep_directions(surface, material, pressures, directions, options));
  if (session.stopped()) throw Interrupted("contact: interrupted; nothing was written");
  Json answer = {{"curve", to_json(curve)}};
  if (body) answer["datum"] = std::string(name_of(body->datum()));
  if (!session.communicator().alone()) answer["groups"] = groups;
  add_first_loading(answer, first_loading);
  answer_curve(arguments, curve, std::move(answer), session, flow);
  const auto lost = std::ranges::count(curve.samples, false, &ForceSample::converged);
  if (lost > 0)
    throw NotConverged(
        fmt::format("contact: {} of {} pressures did not converge; allow a larger --tolerance",
                    lost, curve.samples.size()));
  if (!std::ranges::all_of(flow, &FlowFactors::converged)) throw NotConverged(flow_failure);
}

}  // namespace salebra::cli
