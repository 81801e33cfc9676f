// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra contact`: its options, and what goes together.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/configuration.hpp>

#include "contact_command.hpp"
#include "option_words.hpp"
#include "program.hpp"
#include "results/columns.hpp"

namespace salebra::cli {

FlowFactors flow_of(const NormalContactState& state, const Grid2D& grid, const Progress& progress) {
  FlowFactors flow = flow_factors(state, grid, {.on_progress = progress});
  if (!flow.converged())
    flow.pressure_flow_factor_x = flow.pressure_flow_factor_y = flow.effective_gap =
        FlowFactors::unknown;
  return flow;
}

std::size_t ContactArguments::count() const {
  const std::vector<OperatingPoints> given = at.given();
  for (const OperatingPoints& kind : given)
    for (const double value : kind.values)
      if (!adhesive() || (cycle && kind.control != ControlQuantity::indentation))
        require_positive(value, "--" + option_word(kind.control));
  require(given.size() <= 1, "--pressure", given.size(),
          "kinds of operating points are given; give exactly one of --pressure, --normal-force, "
          "--mean-gap, --indentation");
  return given.empty() ? 0 : given.front().values.size();
}

std::vector<double> ContactArguments::pressures_on(double area) const {
  std::vector<double> pressures = at.pressure;
  for (const double newtons : at.force) pressures.push_back(newtons / area);
  std::ranges::sort(pressures);
  return pressures;
}

Conductances ContactArguments::conductances_of(const ForceSample& sample,
                                               double nominal_area) const {
  return conductances(sample.normal_stiffness / nominal_area, material.material().contact_modulus,
                      conduction);
}

NormalContactOptions ContactArguments::contact_options(Session& session) const {
  NormalContactOptions options;
  options.boundary = *parse_enum<Boundary>(boundary);
  options.precision = *parse_enum<Precision>(precision);
  if (tolerance) options.tolerance = *tolerance;
  options.max_iterations = max_iterations;
  options.on_progress = session.progress();
  return options;
}

namespace {

/// Bad names are refused before the work.
void check_residual(const ContactArguments& arguments, const Session& session) {
  if (arguments.residual.empty()) return;
  require(arguments.hardness.has_value(), "--residual", arguments.residual,
          "is what a plastic contact leaves; give --hardness");
  require_surface_name(arguments.residual);
  require_output(arguments.residual, session.write_options());
}

// Headings of the help, and what belongs together.
const std::string boundary_elements = "Boundary elements", once = "One operating point",
                  often = "Several operating points", adhesion = "Adhesion", summits = "Summits",
                  parameters = "Summits without a surface";

/// What adhesion does not go together with.
void check_adhesion(const ContactArguments& arguments, std::size_t points, const Session& session) {
  const bool adhesive = arguments.adhesive();
  for (const auto& [given, option] :
       {std::pair(arguments.adhesion_range.has_value(), "--adhesion-range"),
        {arguments.cycle, "--cycle"},
        {arguments.force_coarse, "--force-coarse"}})
    require_that(adhesive || !given, option, "given without --work-of-adhesion; give both");
  if (!adhesive) return;
  required(arguments.adhesion_range, "--adhesion-range", "--work-of-adhesion needs it");
  require_that(!arguments.hardness || (points <= 1 && !arguments.cycle), "--hardness",
               "with adhesion is of a first loading; give one pressure or normal force");
  for (const auto& [given, option] : {std::pair(!arguments.initial.empty(), "--initial"),
                                      {!arguments.checkpoint.file.empty(), "--checkpoint"},
                                      {arguments.groups > 0, "--groups"}})
    require_that(!given, option, "is of contacts without adhesion; leave it out");
  if (!arguments.cycle) return;
  require(points > 1, "--cycle", points,
          "operating point is no cycle; give several, such as --mean-gap 10:100nm:20");
  session.require_result_name();
}

/// What is missing, and what does not go together.
void check(const ContactArguments& arguments, std::size_t points, const Session& session) {
  const Command& command = *arguments.command;
  const bool bem = arguments.model == "bem";
  std::vector<std::string> missing = arguments.material.missing(false);
  if (points == 0)
    missing.insert(missing.begin(), "--pressure (or --normal-force, --mean-gap, --indentation)");
  if (bem && !arguments.surface.given()) missing.insert(missing.begin(), "SURFACE (or --recipe)");
  require_options(missing, "a contact");
  arguments.conduction.validate();
  if (!bem) {
    for (const std::string& group : {boundary_elements, once, often, adhesion})
      command.require_none_of(
          group, "is of boundary elements; leave it out with --model " + arguments.model);
    return;
  }
  for (const std::string& group : {summits, parameters})
    command.require_none_of(group, "is of summits; give --model gw_moments or gw_deterministic");
  for (const auto& [given, option] : {std::pair(arguments.hardness.has_value(), "--hardness"),
                                      {session.has_plot(), "--plot"},
                                      {arguments.flow_factors, "--flow-factors"}})
    if (given) session.require_one_process(option);
  if (arguments.hardness) require_positive(*arguments.hardness, "--hardness");
  require_that(!arguments.flow_factors || arguments.boundary == "periodic", "--flow-factors",
               "are of a gap that repeats itself; leave out --boundary free");
  require_that(arguments.wants_stiffness() || !arguments.stick, "--stick",
               "given without --stiffness; give both");
  check_adhesion(arguments, points, session);
  if (points > 1) {
    command.require_none_of(once,
                            fmt::format("is for one operating point, and {} are given", points));
    require(arguments.adhesive() || !arguments.at.pressure.empty() || !arguments.at.force.empty(),
            arguments.at.mean_gap.empty() ? "--indentation" : "--mean-gap", points,
            "values are given; several operating points are pressures or normal forces");
    return;
  }
  command.require_none_of(often,
                          "is for several operating points; give --pressure more than one value");
  session.require_result_name();
  check_residual(arguments, session);
  for (const auto& [given, option] : {std::pair(!arguments.fields.empty(), "--fields"),
                                      {!arguments.field_type.empty(), "--field-type"}})
    require_that(!given || session.has_output(), option, "given without --output; name the file");
  arguments.checkpoint.check(session, arguments.initial);
}

void run(const ContactArguments& arguments, Session& session) {
  const std::size_t points = arguments.count();
  check(arguments, points, session);
  if (arguments.model != "bem") return press_summits(arguments, session);
  arguments.material.material();
  if (!arguments.wants_stiffness() && arguments.material.contact_modulus &&
      !arguments.material.poisson.empty())
    session.warn("--poisson: has no effect without --stiffness, which K_t needs");
  if (arguments.dry_run.dry_run) return estimate_contacts(arguments, session);
  if (points > 1 && arguments.adhesive()) return press_adhesively(arguments, session);
  return points > 1 ? press_often(arguments, session) : press_once(arguments, session);
}

void add_boundary_elements(Command& command, ContactArguments& arguments) {
  command.under(boundary_elements);
  command.add_flag("--stiffness", arguments.stiffness,
                   "also K by a linear solve on the contact set, and K_t = (G*/E*)K where G* is "
                   "known; null in full contact of a periodic surface, where both are infinite");
  command.add_flag("--stick", arguments.stick,
                   "with --stiffness: K_t by a stick solve on each contact");
  command.add_flag("--flow-factors", arguments.flow_factors,
                   "also how a fluid passes the gap: whether the gap percolates, its pressure flow "
                   "factors, and the effective gap; null where nothing flows");
  add_choice<Boundary>(command, "--boundary", arguments.boundary, "default periodic");
  add_quantity(
      command, "--hardness", arguments.hardness, Dimension::pressure,
      "of the softer body: cells saturate there and sink in. One operating point ends the first "
      "loading; of several, the largest is first loaded to, and the curve is that of "
      "unloading; default none");
  add_quantity(command, "--tolerance", arguments.tolerance, Dimension::dimensionless,
               "of the complementarity residual; default 1e-10. With adhesion of the tension; "
               "default 1e-5");
  command.add_option("--max-iterations", arguments.max_iterations,
                     fmt::format("on the finest grid; default {}", arguments.max_iterations));
  add_choice<Precision>(command, "--precision", arguments.precision,
                        "of the iterations; residuals are in double always; default mixed");
}

void add_adhesion(Command& command, ContactArguments& arguments) {
  command.under(adhesion);
  add_quantity(command, "--work-of-adhesion", arguments.work_of_adhesion,
               Dimension::energy_per_area,
               "w, the energy per area that parts the surfaces. One pressure or force may pull; of "
               "several operating points each contact follows from the one before");
  add_quantity(command, "--adhesion-range", arguments.adhesion_range, Dimension::length,
               "of the tension between surfaces with a gap");
  add_choice<AdhesionPotential>(command, "--adhesion", arguments.potential,
                                "tension over the gap; default exponential");
  command.add_flag(
      "--cycle", arguments.cycle,
      "for several operating points: in and out again, with the pull-off and, at mean gaps or "
      "indentations, the work that a cycle loses");
  command.add_flag("--force-coarse", arguments.force_coarse,
                   "compute where cells, not surfaces, decide what sticks");
}

void add_one_position(Command& command, ContactArguments& arguments) {
  command.under(once);
  command
      .add_option("--residual", arguments.residual,
                  "with --hardness: write the surface that unloading leaves, whose later contacts "
                  "up to this load are elastic; read it back with --detrend none")
      ->file(FileUse::output);
  command
      .add_option("--initial", arguments.initial,
                  "result of this command to start from, of the same grid; saves iterations and "
                  "changes no result")
      ->file(FileUse::input);
  arguments.checkpoint.add_to(command);
  command
      .add_option("--distributions", arguments.distributions,
                  "densities of contact pressure and of gap in so many bins of equal width; 100 "
                  "without a number")
      ->value_without("100")
      ->range(1, 100000);
  add_choice(command, "--fields", arguments.fields, {"none", "pressure", "all"},
             "of the output: none leaves its numbers; default all");
  add_choice(command, "--field-type", arguments.field_type, {"double", "float"},
             "of the fields of the output; default double");
}

}  // namespace

void add_contact_command(Program& program) {
  auto arguments = std::make_shared<ContactArguments>();
  Command& command = program.add_command(
      "contact", "press a surface to one load, or to many",
      {"salebra contact rough.h5 --pressure 10MPa --contact-modulus 115GPa",
       "salebra contact rough.h5 --pressure 1:100MPa:16 --contact-modulus 115GPa --poisson 0.3 "
       "--stiffness -o curve.h5"},
      [arguments](Session& session) { run(*arguments, session); },
      "of one operating point maps of pressure and gap, of several pressure over gap, area, "
      "stiffness",
      OutputCheck::curve);
  arguments->command = &command;
  arguments->surface.add_to(command, false);
  arguments->surface.add_recipe_to(command);
  std::vector<std::string> models;
  for (const ContactModel model :
       {ContactModel::bem, ContactModel::gw_moments, ContactModel::gw_deterministic})
    models.emplace_back(name_of(model));
  add_choice(command, "--model", arguments->model, models,
             "boundary elements, or Greenwood and Williamson's summits, as spectral moments tell "
             "of them or each by itself; default bem");
  arguments->at.add_to(command, "Operating point (several pressures or forces give a curve)");
  arguments->material.add_to(command);
  add_conduction(command, arguments->conduction);

  add_boundary_elements(command, *arguments);
  add_adhesion(command, *arguments);
  add_one_position(command, *arguments);
  command.under(often);
  add_groups(command, arguments->groups,
             "holds the surface and presses some of the loads; default: with --recipe as many as "
             "memory holds, else 1");

  command.under(summits);
  add_choice(command, "--distribution", arguments->distribution, {"gaussian", "exponential"},
             "of summit heights; default gaussian");
  command.under(parameters);
  add_quantity(command, "--summit-density", arguments->summit_density,
               Dimension::inverse_length_squared, "summits per area");
  add_quantity(command, "--radius", arguments->radius, Dimension::length, "of the summits");
  add_quantity(command, "--summit-rms", arguments->summit_rms, Dimension::length,
               "standard deviation of their heights");
  arguments->dry_run.add_to(command);
}

}  // namespace salebra::cli
