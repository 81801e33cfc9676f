// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra sweep`: force curve of a surface over a list of pressures.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "curve_figure.hpp"
#include "curve_json.hpp"
#include "dry_run.hpp"
#include "first_loading.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct SweepArguments {
  SurfaceOptions surface;
  MaterialOptions material;
  std::vector<double> pressures;
  bool stiffness = false, stick = false;
  std::string boundary = "periodic";
  std::optional<double> tolerance, hardness;
  int groups = 0;  // 0: as many as memory holds
  DryRunOptions dry_run;
};

/// Surfaces that are generated take as many groups as memory holds; a file is read once.
int groups_of(const SweepArguments& arguments, const SurfaceWork& work, Session& session) {
  if (arguments.groups > 0) return arguments.groups;
  if (arguments.surface.recipe.empty() || work.ranks == 1) return 1;
  return groups_that_fit(work, [&](double bytes) {
    if (!arguments.dry_run.dry_run) return memory_of_nodes(bytes, session.ranks()).suffices();
    const double available = static_cast<double>(available_memory());
    return available == 0 || bytes * std::ceil(double(work.ranks) / work.nodes) <= available;
  });
}

SurfaceWork work_of(const SweepArguments& arguments, const std::vector<double>& pressures,
                    const SurfaceOutline& outline, Session& session) {
  SurfaceWork work = planned(arguments.dry_run, outline.grid, session);
  const double unit = arguments.material.material().contact_modulus * outline.rms_slope;
  for (const double pressure : pressures) work.loads.push_back(pressure / unit);
  work.normal_stiffness = arguments.stiffness;
  work.tangential_stiffness = arguments.stick;
  work.boundary = *value_of<Boundary>(arguments.boundary);
  work.groups = groups_of(arguments, work, session);
  return work;
}

void run(const SweepArguments& arguments, Session& session) {
  for (const auto& [given, option] :
       {std::pair(arguments.hardness.has_value(), "--hardness"), {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  std::vector<std::string> missing = arguments.material.missing(false);
  if (arguments.pressures.empty()) missing.insert(missing.begin(), "--pressures");
  if (!arguments.surface.given()) missing.insert(missing.begin(), "SURFACE (or --recipe)");
  require_options(missing, "a sweep");
  SweepOptions options;
  require_that(arguments.stiffness || !arguments.stick, "--stick",
               "given without --stiffness; give both");
  options.stiffness = arguments.stiffness;
  options.stick = arguments.stick;
  options.contact.boundary = *value_of<Boundary>(arguments.boundary);
  if (arguments.tolerance) options.contact.tolerance = *arguments.tolerance;
  for (const double pressure : arguments.pressures) require_positive(pressure, "--pressures");
  std::vector<double> pressures = arguments.pressures;
  std::ranges::sort(pressures);
  const Material material = arguments.material.material();
  if (!arguments.stiffness && arguments.material.contact_modulus &&
      !arguments.material.poisson.empty())
    session.warn("--poisson: has no effect without --stiffness, which K_t needs");
  session.doubt(doubt_of_pressure(pressures.back(), material.contact_modulus));
  if (arguments.dry_run.dry_run) {
    const SurfaceOutline outline = arguments.surface.outline(session);
    return answer_dry_run(work_of(arguments, pressures, outline, session), outline.origin, session);
  }
  int groups = std::max(1, arguments.groups);
  if (arguments.groups == 0 && !arguments.surface.recipe.empty() && !session.ranks().alone())
    groups = work_of(arguments, pressures, arguments.surface.outline(session), session).groups;
  options.groups = Groups(session.ranks(), groups);
  options.contact.on_progress = session.progress();
  Surface surface = arguments.surface.read(session, options.groups->own());
  const std::optional<FirstLoading> first_loading = load_first(
      surface, arguments.hardness, material.contact_modulus, pressures.back(), options.contact);
  const ForceCurve curve = sweep_pressures(surface, material, pressures, options);
  if (session.stopped()) throw Interrupted("sweep: interrupted; nothing was written");
  collectively(session.ranks(), [&] {
    if (session.has_output() && session.ranks().is_root())
      write_force_curve(session.output(), curve, session.provenance(), session.write_options());
  });
  if (session.has_plot()) session.plot(curve_figure(curve));
  Json answer = {{"curve", to_json(curve)}};
  if (!session.ranks().alone()) answer["groups"] = groups;
  add_first_loading(answer, first_loading);
  session.answer(answer);
  const auto lost = std::ranges::count(curve.samples, false, &ForceSample::converged);
  if (lost > 0) {
    throw NotConverged(
        fmt::format("sweep: {} of {} pressures did not converge; allow a larger --tolerance", lost,
                    curve.samples.size()));
  }
}

}  // namespace

void add_sweep_command(Program& program) {
  auto arguments = std::make_shared<SweepArguments>();
  Command& command = program.add_command(
      "sweep", "force-gap curve of a surface over many pressures",
      {"salebra sweep rough.h5 --pressures 1:100MPa:16 --contact-modulus 115GPa --poisson 0.3 "
       "--stiffness -o curve.h5",
       "salebra sweep scan.txt --pressures 1MPa,5MPa,20MPa --young 70GPa --poisson 0.33 --json"},
      [arguments](Session& session) { run(*arguments, session); },
      "pressure over gap, area, stiffness", OutputCheck::curve);
  arguments->surface.add_to(command, false);
  arguments->surface.add_recipe_to(command);
  add_values(command, "--pressures", arguments->pressures, Dimension::pressure,
             "nominal pressures");
  command.add_flag("--stiffness", arguments->stiffness,
                   "also K by a linear solve on each contact, and K_t = (G*/E*)K where G* is "
                   "known; null in full contact of a "
                   "periodic surface, where both are infinite");
  command.add_flag("--stick", arguments->stick,
                   "with --stiffness: K_t by a stick solve on each contact");
  arguments->material.add_to(command);
  add_choice<Boundary>(command, "--boundary", arguments->boundary, "default periodic");
  add_quantity(
      command, "--hardness", arguments->hardness, Dimension::pressure,
      "of the softer body: the surface is first loaded to the largest pressure, with local "
      "pressures up to the hardness, and the curve is that of unloading; default none");
  add_quantity(command, "--tolerance", arguments->tolerance, Dimension::dimensionless,
               "of the complementarity residual; default 1e-10");
  add_groups(command, arguments->groups,
             "holds the surface and presses some of the loads; default: with --recipe as many as "
             "memory holds, else 1");
  arguments->dry_run.add_to(command);
}

}  // namespace salebra::cli
