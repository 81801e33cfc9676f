// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra contact`: one contact by boundary elements.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/share.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/results/columns.hpp>
#include <salebra/results/describe.hpp>
#include <salebra/results/quantity_group.hpp>

#include "contact_checkpoint.hpp"
#include "curve_figure.hpp"
#include "dry_run.hpp"
#include "first_loading.hpp"
#include "grid_axes.hpp"
#include "options.hpp"
#include "program.hpp"

namespace salebra::cli {
namespace {

struct ContactArguments {
  SurfaceOptions surface;
  MaterialOptions material;
  PositionOptions position;
  std::string boundary = "periodic", precision = "mixed";
  std::optional<double> tolerance, hardness;
  std::string initial, residual, fields, field_type;
  ContactCheckpoint checkpoint;
  bool stiffness = false;
  DryRunOptions dry_run;
  int max_iterations = NormalContactOptions().max_iterations;
};

NormalContactOptions contact_options(const ContactArguments& arguments, Session& session) {
  NormalContactOptions options;
  options.boundary = *value_of<Boundary>(arguments.boundary);
  options.precision = *value_of<Precision>(arguments.precision);
  if (arguments.tolerance) options.tolerance = *arguments.tolerance;
  if (arguments.hardness) options.hardness = *arguments.hardness;
  options.max_iterations = arguments.max_iterations;
  options.on_progress = session.progress();
  return options;
}

NormalContactState solve(const PositionOptions& position, const Surface& surface,
                         double contact_modulus, const NormalContactOptions& options) {
  if (position.mean_gap)
    return press_to_mean_gap(surface, contact_modulus, *position.mean_gap, options);
  if (position.indentation)
    return press_to_indentation(surface, contact_modulus, *position.indentation, options);
  const double pressure =
      position.pressure ? *position.pressure : *position.force / surface.grid.area();
  return press_to_pressure(surface, contact_modulus, pressure, options);
}

/// Whether the contact of any process reaches the edge.
bool reaches_edge(const Surface& surface, const Field& pressure) {
  const Share share = surface.share();
  const Index rows = pressure.rows(), columns = pressure.cols();
  const bool reached =
      pressure.size() > 0 && ((share.begin() == 0 && (pressure.row(0) > 0).any()) ||
                              (share.end() == share.rows() && (pressure.row(rows - 1) > 0).any()) ||
                              (pressure.col(0) > 0).any() || (pressure.col(columns - 1) > 0).any());
  return !surface.ranks.all_agree(!reached);
}

void write_contact(const ContactArguments& arguments, const Session& session, const Grid2D& grid,
                   const NormalContactState& state) {
  const FieldType type = arguments.field_type == "float" ? FieldType::float32 : FieldType::float64;
  const bool has_pressure = arguments.fields != "none";
  const bool has_gap = has_pressure && arguments.fields != "pressure";
  std::optional<ResultFile> file;
  collectively(session.ranks(), [&] {
    file.emplace(session.output(), session.provenance(), session.write_options(), session.ranks());
    QuantityGroup group(file->group("contact"));
    if (has_pressure) write_axes(group, grid);
    if (has_pressure) group.dataset("contact_pressure", state.contact_pressure, "x", "y", type);
    if (has_gap) group.dataset("gap", state.gap, "x", "y", type);
    group.attribute("pressure", state.mean_pressure);
    for_each_number<NormalContactState>([&](const auto& number, const Quantity& quantity) {
      group.attribute(std::string(quantity.name), number(state));
    });
  });
  file->commit();
}

/// The largest pressure of all processes.
double max_pressure(const Communicator& ranks, const NormalContactState& state) {
  return -ranks.least_of(state.contact_pressure.size() > 0 ? -state.contact_pressure.maxCoeff()
                                                           : 0.0);
}

/// Reads the rows of this process.
Field read_initial(const std::string& file, const Share& share) {
  const ResultReader reader(file);
  const std::string pressure = "contact/contact_pressure";
  if (reader.has("contact") && !reader.has(pressure))
    throw InvalidInput(
        "--initial", file,
        "has no contact pressure; name a file that was written without --fields none");
  return reader.field(pressure, share);
}

/// Bad names are refused before the work.
void check_residual(const ContactArguments& arguments, const Session& session) {
  if (arguments.residual.empty()) return;
  require(arguments.hardness.has_value(), "--residual", arguments.residual,
          "is what a plastic contact leaves; give --hardness");
  require_surface_name(arguments.residual);
  require_output(arguments.residual, session.write_options());
}

void estimate(const ContactArguments& arguments, double contact_modulus, Session& session) {
  const SurfaceOutline outline = arguments.surface.outline(session);
  SurfaceWork work = planned(arguments.dry_run, outline.grid, session);
  // A gap or an indentation does not tell the load: contact on a tenth of the cells is assumed.
  double load = 0.05;
  if (const auto& [gap, pressure, indentation, force] = arguments.position; pressure || force)
    load = pressure.value_or(force.value_or(0) / outline.grid.area()) /
           (contact_modulus * outline.rms_slope);
  work.loads = {load};
  work.normal_stiffness = arguments.stiffness;
  work.boundary = *value_of<Boundary>(arguments.boundary);
  answer_dry_run(work, outline.origin, session);
}

void run(const ContactArguments& arguments, Session& session) {
  for (const auto& [given, option] :
       {std::pair(arguments.hardness.has_value(), "--hardness"), {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  std::vector<std::string> missing = arguments.material.missing(false);
  if (arguments.position.count() == 0)
    missing.insert(missing.begin(), "--pressure (or --mean-gap, --normal-force or --indentation)");
  if (!arguments.surface.given()) missing.insert(missing.begin(), "SURFACE (or --recipe)");
  require_options(missing, "a contact");
  require(arguments.position.count() == 1, "--pressure", arguments.position.count(),
          "positions are given; give exactly one of --pressure, --mean-gap, --normal-force, "
          "--indentation");
  if (arguments.position.force) require_positive(*arguments.position.force, "--normal-force");
  if (arguments.position.pressure) require_positive(*arguments.position.pressure, "--pressure");
  if (arguments.position.mean_gap) require_positive(*arguments.position.mean_gap, "--mean-gap");
  if (arguments.position.indentation)
    require_positive(*arguments.position.indentation, "--indentation");
  if (arguments.hardness) require_positive(*arguments.hardness, "--hardness");
  check_residual(arguments, session);
  for (const auto& [given, option] : {std::pair(!arguments.fields.empty(), "--fields"),
                                      {!arguments.field_type.empty(), "--field-type"}})
    require_that(!given || session.has_output(), option, "given without --output; name the file");
  arguments.checkpoint.check(session, arguments.initial);
  const double contact_modulus = arguments.material.material().contact_modulus;
  if (arguments.material.contact_modulus && !arguments.material.poisson.empty())
    session.warn(
        "--poisson: has no effect with --contact-modulus; a contact is pressed by E* alone");
  if (arguments.dry_run.dry_run) return estimate(arguments, contact_modulus, session);
  NormalContactOptions options = contact_options(arguments, session);
  const Surface surface = arguments.surface.read(session);
  if (const auto pressure = arguments.position.nominal_pressure(surface.grid))
    session.doubt(doubt_of_pressure(*pressure, contact_modulus));
  Field initial;
  if (arguments.checkpoint.starts_anew(session, arguments.initial)) {
    session.note(arguments.initial + " is not there yet: the contact starts anew");
  } else if (!arguments.initial.empty()) {
    collectively(session.ranks(),
                 [&] { initial = read_initial(arguments.initial, surface.share()); });
    options.initial_pressure = &initial;
  }
  arguments.checkpoint.add_to(options, session, surface.grid);
  const auto start = std::chrono::steady_clock::now();
  const NormalContactState state = solve(arguments.position, surface, contact_modulus, options);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  const bool kept =
      !state.converged && arguments.checkpoint.write(session, surface.grid, state.contact_pressure);
  if (state.interrupted)
    throw Interrupted(kept ? fmt::format("contact: interrupted; continue with --initial {}",
                                         arguments.checkpoint.file)
                           : "contact: interrupted; nothing was written");
  if (options.boundary == Boundary::free && reaches_edge(surface, state.contact_pressure))
    session.warn(
        "the contact reaches the edge of the surface, beyond which there is nothing; press less, "
        "or take a larger piece of the surface");

  if (state.converged && session.has_output()) {
    write_contact(arguments, session, surface.grid, state);
  }
  if (state.converged && session.has_plot()) session.plot(pressure_figure(surface.grid, state));
  std::optional<FirstLoading> first_loading;
  if (arguments.hardness && state.converged) {
    const ResidualSurface residual = residual_surface(surface, contact_modulus, state, options);
    first_loading = residual.first_loading;
    if (!arguments.residual.empty())
      write_surface(arguments.residual, residual.surface, session.provenance(),
                    session.write_options());
  }
  Json answer = {{"pressure", state.mean_pressure},
                 {"max_pressure", max_pressure(session.ranks(), state)}};
  answer.add(json_of(state));
  answer["seconds"] = elapsed.count();
  add_first_loading(answer, first_loading);
  if (arguments.stiffness && state.converged) {
    const double stiffness = normal_stiffness(state, surface.grid, contact_modulus, options);
    answer["normal_stiffness"] = stiffness;
    answer["normal_stiffness_per_area"] = stiffness / surface.grid.area();
    if (session.stopped()) {
      arguments.checkpoint.write(session, surface.grid, state.contact_pressure);
      throw Interrupted("contact: interrupted; the stiffness was not computed");
    }
  }
  session.answer(answer);
  if (!state.converged) {
    throw NotConverged(
        fmt::format("contact: residual {:.3g} after {} iterations did not reach the tolerance; {}",
                    state.residual, state.iterations,
                    state.iterations >= arguments.max_iterations ? "raise --max-iterations"
                                                                 : "allow a larger --tolerance"));
  }
  arguments.checkpoint.remove(session);
}

}  // namespace

void add_contact_command(Program& program) {
  auto arguments = std::make_shared<ContactArguments>();
  Command& command = program.add_command(
      "contact", "press a surface against an elastic half-space by boundary elements",
      {"salebra contact rough.h5 --pressure 10MPa --contact-modulus 115GPa",
       "salebra contact scan.txt --boundary free --indentation 50nm --hardness 3GPa --young 200GPa "
       "--poisson 0.3 -o "
       "contact.h5"},
      [arguments](Session& session) { run(*arguments, session); }, "maps of pressure and gap");
  arguments->surface.add_to(command, false);
  arguments->surface.add_recipe_to(command);
  arguments->position.add_to(command, true);
  arguments->material.add_to(command);
  add_choice<Boundary>(command, "--boundary", arguments->boundary, "default periodic");
  add_quantity(command, "--hardness", arguments->hardness, Dimension::pressure,
               "largest pressure: cells saturate there and sink in; default none");
  command
      .add_option(
          "--residual", arguments->residual,
          "with --hardness: write the surface that unloading leaves, whose later contacts up "
          "to this load are elastic; read it back with --detrend none")
      ->file(FileUse::output);
  command.add_flag("--stiffness", arguments->stiffness,
                   "K of the contact set too, as normal_stiffness in N/m; null in full contact of "
                   "a periodic surface, where "
                   "it is infinite");
  command
      .add_option("--initial", arguments->initial,
                  "result of this command to start from, of the same grid; saves iterations and "
                  "changes no result")
      ->file(FileUse::input);
  arguments->checkpoint.add_to(command);
  add_choice(command, "--fields", arguments->fields, {"none", "pressure", "all"},
             "of the output: none leaves its numbers; default all");
  add_choice(command, "--field-type", arguments->field_type, {"double", "float"},
             "of the fields of the output; default double");
  add_choice<Precision>(command, "--precision", arguments->precision,
                        "of the iterations; residuals are in double always; default mixed");
  command.add_option("--max-iterations", arguments->max_iterations, "on the finest grid")
      ->show_default();
  add_quantity(command, "--tolerance", arguments->tolerance, Dimension::dimensionless,
               "of the complementarity residual; default 1e-10");
  arguments->dry_run.add_to(command);
}

}  // namespace salebra::cli
