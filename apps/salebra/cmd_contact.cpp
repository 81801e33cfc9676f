// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra contact`: its options, and which of them can be combined.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/surface/lay.hpp>

#include "contact_command.hpp"
#include "option_words.hpp"
#include "program.hpp"
#include "results/columns.hpp"
#include "several_files.hpp"

namespace salebra::cli {

FlowFactors flow_of(const NormalContactState& state, const Surface& surface,
                    const Progress& progress) {
  const SurfaceLay lay = surface_lay(surface);
  FlowFactors flow = flow_factors(
      state, surface.grid,
      {.lay_angle = lay.found() ? lay.angle : FlowFactors::unknown, .on_progress = progress});
  if (!flow.converged())
    flow.pressure_flow_factor_x = flow.pressure_flow_factor_y = flow.pressure_flow_factor_xy =
        flow.effective_gap = FlowFactors::unknown;
  return flow;
}

std::size_t ContactArguments::count() const {
  const std::vector<OperatingPoints> given = at.given();
  for (const OperatingPoints& kind : given)
    for (const double value : kind.values)
      if (!adhesive() || (cycle && kind.control != ControlQuantity::indentation))
        require_positive(value, "--" + option_word(kind.control));
  if (given.size() > 1)
    throw InvalidInput(
        "--" + option_word(given[1].control),
        fmt::format("given together with --{}; give one of them", option_word(given[0].control)));
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

std::vector<std::string> warnings_of_direction(const ContactArguments& arguments,
                                               const Surface& surface) {
  if (!arguments.wants_stiffness() || arguments.sticks() || surface.undefined_points() > 0 ||
      !std::isfinite(arguments.material.material().tangential_modulus))
    return {};
  return warnings_of_lay(surface_lay(surface), 0,
                         "the tangential stiffness is (G*/E*)K, that of an isotropic surface; "
                         "along and across the lay it differs, as `stick` shows",
                         {});
}

std::vector<double> ContactArguments::directions_on(const Surface& surface) const {
  if (!sticks()) return {0};
  return directions_of(direction_choice(direction, "--direction"), surface);
}

namespace {

/// Throws InvalidInput before the work if the file of --residual must not be written.
void check_residual(const ContactArguments& arguments, const Session& session) {
  if (arguments.residual.empty()) return;
  require(arguments.hardness.has_value(), "--residual", arguments.residual,
          "needs --hardness: only a plastic contact leaves a changed surface");
  require_surface_name(arguments.residual);
  require_output(arguments.residual, session.write_options());
}

// Headings of the help; the options under each of them are allowed or refused together.
const std::string boundary_elements = "Boundary elements", once = "One operating point",
                  often = "Several operating points", adhesion = "Adhesion", summits = "Summits",
                  parameters = "Summits without a surface";

/// Throws InvalidInput for options that cannot be combined with adhesion.
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
               "with adhesion takes one pressure or normal force, the end of a first loading");
  for (const auto& [given, option] : {std::pair(!arguments.initial.empty(), "--initial"),
                                      {!arguments.checkpoint.file.empty(), "--checkpoint"},
                                      {arguments.groups > 0, "--groups"}})
    require_that(!given, option, "cannot be used with adhesion; leave it out");
  if (!arguments.cycle) return;
  require(points > 1, "--cycle", points,
          "value given; a cycle needs several, such as --mean-gap 10:100nm:20");
  session.require_result_name();
}

/// Throws InvalidInput for options that cannot be combined with --body.
void check_body(const ContactArguments& arguments) {
  const std::string& file = arguments.material.body_file;
  if (file.empty()) return;
  for (const auto& [given, option] :
       {std::pair(arguments.material.given(),
                  "--young, --poisson, --contact-modulus or --tangential-modulus"),
        {arguments.model != "bem", "--model"},
        {arguments.boundary != "periodic", "--boundary"},
        {arguments.hardness.has_value(), "--hardness"},
        {arguments.conduction.given(), "--conductivity or --resistivity"}})
    require(!given, "--body", file,
            fmt::format("cannot be combined with {}; give one of them", option));
}

/// Throws InvalidInput for missing options and for options that cannot be combined.
void check(const ContactArguments& arguments, std::size_t points, const Session& session) {
  const Command& command = *arguments.command;
  const bool bem = arguments.model == "bem";
  check_body(arguments);
  std::vector<std::string> missing;
  if (arguments.material.body_file.empty()) missing = arguments.material.missing(false);
  if (points == 0)
    missing.insert(missing.begin(), "--pressure (or --normal-force, --mean-gap, --indentation)");
  if (bem && !arguments.surface.given()) missing.insert(missing.begin(), "SURFACE (or --recipe)");
  require_options(missing, "a contact");
  arguments.conduction.validate();
  if (!bem) {
    for (const std::string& group : {boundary_elements, once, often, adhesion})
      command.require_none_of(
          group, "applies only to boundary elements; leave it out with --model " + arguments.model);
    return;
  }
  for (const std::string& group : {summits, parameters})
    command.require_none_of(group,
                            "applies only to summits; give --model gw_moments or gw_deterministic");
  for (const auto& [given, option] : {std::pair(arguments.hardness.has_value(), "--hardness"),
                                      {session.has_plot(), "--plot"},
                                      {arguments.flow_factors, "--flow-factors"}})
    if (given) session.require_one_process(option);
  if (arguments.hardness) require_positive(*arguments.hardness, "--hardness");
  require_that(!arguments.flow_factors || arguments.boundary == "periodic", "--flow-factors",
               "needs a surface that repeats itself; leave out --boundary free");
  require_that(arguments.wants_stiffness() || !arguments.stick, "--stick",
               "given without --stiffness; give both");
  require_that(arguments.sticks() || arguments.direction == "auto", "--direction",
               "given without --stick: (G*/E*)K has no direction; give both");
  direction_choice(arguments.direction, "--direction");
  check_adhesion(arguments, points, session);
  if (points > 1) {
    command.require_none_of(once, fmt::format("takes one load, and {} are given", points));
    require(arguments.adhesive() || !arguments.at.pressure.empty() || !arguments.at.force.empty(),
            arguments.at.mean_gap.empty() ? "--indentation" : "--mean-gap", points,
            "values given; only pressures and normal forces may be several");
    return;
  }
  command.require_none_of(often, "needs several loads; give --pressure more than one value");
  session.require_result_name();
  check_residual(arguments, session);
  for (const auto& [given, option] : {std::pair(!arguments.fields.empty(), "--fields"),
                                      {!arguments.field_type.empty(), "--field-type"}})
    require_that(!given || session.has_output(), option, "given without --output; name the file");
  arguments.checkpoint.check(session, arguments.initial);
}

FileTable table_of_files(const ContactArguments& arguments, std::size_t loads) {
  FileTable table{.columns = {column("pressure", "curve.pressure", "pressure", false)},
                  .loads = loads,
                  .csv = arguments.csv};
  for (const auto& [heading, name] : {std::pair("A/A0", "contact_area_fraction"),
                                      {"mean gap", "mean_gap"},
                                      {"indentation", "indentation"},
                                      {"K/A0", "normal_stiffness_per_area"},
                                      {"K_t/A0", "tangential_stiffness_per_area"},
                                      {"direction", "direction"},
                                      {"h", "thermal_conductance"},
                                      {"C", "electrical_conductance"},
                                      {"flow x", "pressure_flow_factor_x"},
                                      {"flow y", "pressure_flow_factor_y"}})
    table.columns.push_back(
        column(heading, std::string("curve.") + name, name, std::string_view(name) != "direction"));
  return table;
}

/// Presses each of several surfaces to the same pressures.
void press_files(ContactArguments arguments, const std::vector<std::string>& files,
                 Session& session) {
  require_options_of_one(session, {{!arguments.surface.recipe.empty(), "--recipe"},
                                   {arguments.model != "bem", "--model"},
                                   {arguments.groups > 0, "--groups"},
                                   {arguments.dry_run.dry_run, "--dry-run"}});
  arguments.command->require_none_of(once, takes_one_surface);
  const std::vector<double> pressures = arguments.at.pressure;
  require_that(!pressures.empty(), "--pressure",
               "not given; several surfaces are compared at the same nominal pressures");
  arguments.surface.file = files.front();
  if (arguments.sticks()) arguments.direction = one_direction(arguments.direction);
  check(arguments, arguments.count(), session);
  answer_files(files, table_of_files(arguments, pressures.size()), session,
               [&](const std::string& file) {
                 arguments.surface.file = file;
                 press_often(arguments, session);
               });
}

void run(ContactArguments arguments, Session& session) {
  const std::vector<std::string> files = arguments.surface.several(!arguments.csv.empty());
  if (!files.empty()) return press_files(std::move(arguments), files, session);
  require_that(arguments.csv.empty(), "--csv", "needs the files of surfaces; give SURFACE");
  const std::size_t points = arguments.count();
  check(arguments, points, session);
  if (arguments.model != "bem") return press_summits(arguments, session);
  if (arguments.material.body_file.empty()) arguments.material.material();
  if (!arguments.wants_stiffness() && arguments.material.contact_modulus &&
      !arguments.material.poisson.empty())
    session.warn("--poisson: has no effect; it serves to compute K_t, which needs --stiffness");
  if (arguments.dry_run.dry_run) return estimate_contacts(arguments, session);
  if (points > 1 && arguments.adhesive()) return press_adhesively(arguments, session);
  return points > 1 ? press_often(arguments, session) : press_once(arguments, session);
}

void add_boundary_elements(Command& command, ContactArguments& arguments) {
  command.under(boundary_elements);
  command.add_flag(
      "--stiffness", arguments.stiffness,
      "also compute K by a linear solve on the contact set, and K_t = (G*/E*)K if G* is known; "
      "both are null in full contact of a periodic surface, where they are infinite");
  command.add_flag("--stick", arguments.stick,
                   "with --stiffness: compute K_t by solving each contact in full stick");
  add_direction(command, arguments.direction, "with --stick: direction of K_t");
  command.add_flag("--flow-factors", arguments.flow_factors,
                   "also compute how a fluid passes the gap: percolation, pressure flow factors "
                   "and effective gap; null where nothing flows");
  add_choice<Boundary>(
      command, "--boundary", arguments.boundary,
      "whether the surface repeats itself or is alone on a half-space; default periodic");
  add_quantity(command, "--hardness", arguments.hardness, Dimension::pressure,
               "hardness of the softer body: cells that reach it yield and sink in. One load is "
               "the end of the first loading; with several, the surface is first loaded to the "
               "largest, and the curve is that of unloading; default none");
  add_quantity(command, "--tolerance", arguments.tolerance, Dimension::dimensionless,
               "tolerance of the complementarity residual, default 1e-10; with adhesion, tolerance "
               "of the tension, default 1e-5");
  command.add_option("--max-iterations", arguments.max_iterations,
                     fmt::format("maximum number of iterations on the finest grid; default {}",
                                 arguments.max_iterations));
  add_choice<Precision>(
      command, "--precision", arguments.precision,
      "precision of the iterations; residuals are always in double; default mixed");
}

void add_adhesion(Command& command, ContactArguments& arguments) {
  command.under(adhesion);
  add_quantity(command, "--work-of-adhesion", arguments.work_of_adhesion,
               Dimension::energy_per_area,
               "energy w per area that separates the surfaces. A single pressure or force may "
               "pull; with several loads each contact starts from the one before");
  add_quantity(command, "--adhesion-range", arguments.adhesion_range, Dimension::length,
               "range of the tension across the gap");
  add_choice<AdhesionPotential>(command, "--adhesion", arguments.potential,
                                "how the tension falls with the gap; default exponential");
  command.add_flag("--cycle", arguments.cycle,
                   "solve several operating points in the order given and back again: reports the "
                   "pull-off and, at mean gaps or indentations, the work lost in the cycle");
  command.add_flag("--force-coarse", arguments.force_coarse,
                   "compute even if the cells are too coarse for adhesion and decide what sticks");
}

void add_one_position(Command& command, ContactArguments& arguments) {
  command.under(once);
  command
      .add_option("--residual", arguments.residual,
                  "with --hardness: write the surface that is left after unloading. Its later "
                  "contacts are elastic up to this load; read it back with --detrend none")
      ->file(FileUse::output);
  command
      .add_option("--initial", arguments.initial,
                  "earlier result of this command, on the same grid, to start from; saves "
                  "iterations and does not change the result")
      ->file(FileUse::input);
  arguments.checkpoint.add_to(command);
  command
      .add_option("--distributions", arguments.distributions,
                  "also compute the densities of contact pressure and gap in this many bins of "
                  "equal width; 100 if no number is given")
      ->value_without("100")
      ->range(1, 100000);
  add_choice(command, "--fields", arguments.fields, {"none", "pressure", "all"},
             "fields to write to the output; none writes only the numbers; default all");
  add_choice(command, "--field-type", arguments.field_type, {"double", "float"},
             "number type of the fields in the output; default double");
}

}  // namespace

void add_contact_command(Program& program) {
  auto arguments = std::make_shared<ContactArguments>();
  Command& command = program.add_command(
      "contact", "press a surface to one load or to many",
      {"salebra contact rough.h5 --pressure 10MPa --contact-modulus 115GPa",
       "salebra contact rough.h5 --pressure 1:100MPa:16 --contact-modulus 115GPa --poisson 0.3 "
       "--stiffness -o curve.h5"},
      [arguments](Session& session) { run(*arguments, session); },
      "maps of pressure and gap at one load; pressure over gap, area and stiffness for several",
      OutputCheck::curve);
  arguments->command = &command;
  arguments->surface.add_several_to(command);
  add_table_file(command, arguments->csv);
  arguments->surface.add_recipe_to(command);
  std::vector<std::string> models;
  for (const ContactModel model :
       {ContactModel::bem, ContactModel::gw_moments, ContactModel::gw_deterministic})
    models.emplace_back(name_of(model));
  add_choice(command, "--model", arguments->model, models,
             "boundary elements, or Greenwood-Williamson with summits from spectral moments "
             "(gw_moments) or those of the surface (gw_deterministic); default bem");
  arguments->at.add_to(command, "Operating point (several pressures or forces give a curve)");
  arguments->material.add_to(command);
  arguments->material.add_body_to(command,
                                  "with --stiffness, K_t is computed by solving each contact in "
                                  "full stick");
  add_conduction(command, arguments->conduction);

  add_boundary_elements(command, *arguments);
  add_adhesion(command, *arguments);
  add_one_position(command, *arguments);
  command.under(often);
  add_groups(command, arguments->groups,
             "holds the surface and solves some of the loads; default: with --recipe as many as "
             "memory holds, else 1");

  command.under(summits);
  add_choice(command, "--distribution", arguments->distribution, {"gaussian", "exponential"},
             "distribution of the summit heights; default gaussian");
  command.under(parameters);
  add_quantity(command, "--summit-density", arguments->summit_density,
               Dimension::inverse_length_squared, "summits per area");
  add_quantity(command, "--radius", arguments->radius, Dimension::length, "radius of the summits");
  add_quantity(command, "--summit-rms", arguments->summit_rms, Dimension::length,
               "standard deviation of the summit heights");
  arguments->dry_run.add_to(command);
}

}  // namespace salebra::cli
