// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra sweep`: force curve of a surface over a list of pressures.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "curve_figure.hpp"
#include "curve_json.hpp"
#include "first_loading.hpp"
#include "options.hpp"
#include "plausibility.hpp"
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
};

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
  options.contact.on_progress = session.progress();
  for (const double pressure : arguments.pressures) require_positive(pressure, "--pressures");
  std::vector<double> pressures = arguments.pressures;
  std::ranges::sort(pressures);
  const Material material = arguments.material.material();
  if (!arguments.stiffness && arguments.material.contact_modulus &&
      !arguments.material.poisson.empty())
    session.warn("--poisson: has no effect without --stiffness, which K_t needs");
  for (const std::string& line : doubts_of_pressures(pressures, material.contact_modulus))
    session.warn(line);
  Surface surface = arguments.surface.read(session);
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
}

}  // namespace salebra::cli
