// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra export`: contact law as input for another program.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/export/deck.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "analysis/part.hpp"
#include "io/atomic_file.hpp"
#include "io/loaded_surface.hpp"
#include "law_options.hpp"
#include "options.hpp"
#include "program.hpp"
#include "results/answer_json.hpp"

namespace salebra::cli {
namespace {

struct ExportArguments {
  std::string result, format, units = "m,kg,s", of = "mean", name = "contact", direction = "auto";
  LawOptions law;
  MaterialOptions material;
  Conduction conduction;
  std::optional<double> friction_coefficient, min_force;
  std::vector<double> window;
  int rows = 200, sliders = 200;
};

/// Numbers that the result file of a study contains and that no option gave.
struct StudyParameters {
  double modulus_ratio = DeckContact::unknown;
  std::string comment = {};
};

StudyParameters parameters_of(const std::filesystem::path& file) {
  StudyParameters parameters;
  if (!detail::is_hdf5(file)) return parameters;
  const ResultReader reader(file);
  if (reader.has("points"))
    throw InvalidInput(file.string(),
                       "holds a study of several points; give that of one, without [ensemble]");
  if (!reader.has("damping")) return parameters;
  if (const auto ratio = reader.number_attribute("damping", "modulus_ratio"))
    parameters.modulus_ratio = *ratio;
  if (reader.has("solution"))
    if (const auto validity = reader.text_attribute("solution", "validity")) {
      require(parse_enum<Validity>(*validity).has_value(), file.string(), *validity,
              fmt::format("in solution/validity is not a verdict of a study; known are {}",
                          fmt::join(names_of<Validity>(), ", ")));
      parameters.comment = "Study: validity of its damping constant: " + *validity + ".";
    }
  return parameters;
}

/// Throws InvalidInput if the file belongs to an interrupted study.
void require_finished(const std::string& file) {
  const std::string parts = file + ".parts";
  if (!std::filesystem::exists(file) && std::filesystem::is_directory(parts))
    throw InvalidInput(
        file,
        "does not exist: its study was interrupted, and " + parts +
            " holds the finished surfaces; continue with the command of the study and --resume");
}

bool complete_forces(const ForceCurve& curve) {
  return std::ranges::none_of(curve.column(&ForceSample::force),
                              [](double force) { return std::isnan(force); });
}

/// Says in the deck which direction K_t of the curve has, if it has one.
void add_direction_comment(const ForceCurve& curve, const std::string& direction,
                           DeckProblem& problem) {
  const DirectionChoice choice = direction_choice(direction, "--direction");
  const double* angle = std::get_if<double>(&choice);
  const double found = angle ? directions_of(choice, SurfaceLay{}).front() : curve.direction();
  if (std::isnan(curve.direction())) return;
  problem.comment += std::string(problem.comment.empty() ? "" : " ") +
                     "The tangential stiffness is that of motion " + direction_in_words(found) +
                     ".";
}

std::vector<DeckContact> contacts_of_file(const ExportArguments& arguments, const std::string& file,
                                          DeckProblem& problem, Session& session) {
  require_finished(file);
  StudyParameters parameters = parameters_of(file);
  const MaterialOptions& material = arguments.material;
  // For the conductance of a curve that has K_t, or needs none, E* alone is enough.
  const bool modulus_only = !arguments.conduction.conductivity.empty() && material.young.empty() &&
                            material.poisson.empty() && !material.tangential_modulus;
  if (material.given() && !modulus_only) parameters.modulus_ratio = material.modulus_ratio();
  problem.comment = parameters.comment;
  const std::vector<OperatingPoints> at = arguments.law.at.given();
  if (at.size() > 1)
    throw InvalidInput(
        "--" + option_word(at[1].control),
        fmt::format("given together with --{}; give one of them", option_word(at[0].control)));
  const DirectionChoice choice = direction_choice(arguments.direction, "--direction");
  std::vector<DeckContact> contacts;
  for (ForceCurve& curve : read_force_curves(file)) {
    require_that(curve.nominal_area > 0 || arguments.law.nominal_area || complete_forces(curve),
                 "--nominal-area", "not given, but " + file + " has pressures without forces");
    require(curve.body.empty() || !material.given(), "curve", file,
            "is of a body that is not a half-space, which has no G*/E*; leave out the elastic "
            "constants");
    const double sample_area = curve.nominal_area;
    if (contacts.empty()) add_direction_comment(curve, arguments.direction, problem);
    if (arguments.law.nominal_area)
      curve = curve_of_part(std::move(curve), *arguments.law.nominal_area, file);
    contacts.push_back(deck_contact(CurveContact{.curve = std::move(curve),
                                                 .modulus_ratio = parameters.modulus_ratio,
                                                 .at = at.empty() ? OperatingPoints{} : at.front(),
                                                 .source = file,
                                                 .direction = choice},
                                    session.context()));
    if (sample_area > 0 && sample_area != contacts.back().nominal_area)
      contacts.back().sample_area = sample_area;
  }
  return contacts;
}

void run(const ExportArguments& arguments, Session& session) {
  const LawOptions& law = arguments.law;
  require_that(arguments.result.empty() || law.curve.empty(), "--curve",
               "given together with RESULT; give one of them");
  const std::string file = arguments.result.empty() ? law.curve : arguments.result;
  law.at.require_one("a deck takes one");
  DeckProblem problem{.contacts = {},
                      .format = *parse_enum<DeckFormat>(arguments.format),
                      .units = parse_unit_system(arguments.units, "--units"),
                      .rows = arguments.rows,
                      .of = *parse_enum<DeckCase>(arguments.of),
                      .sliders = arguments.sliders,
                      .name = arguments.name,
                      .provenance = session.provenance()};
  if (arguments.friction_coefficient)
    problem.friction_coefficient = *arguments.friction_coefficient;
  if (arguments.law.nominal_area) problem.nominal_area = *arguments.law.nominal_area;
  if (!arguments.conduction.conductivity.empty()) {
    require_options(arguments.material.missing(false), "--conductivity");
    problem.conductivity = arguments.conduction.conductivity;
    problem.contact_modulus = arguments.material.material().contact_modulus;
  }
  require_that(problem.format != DeckFormat::fmu || session.has_output(), "--output",
               "not given, but an FMU is a file; name it, as in -o contact.fmu");
  if (arguments.min_force) problem.min_force = *arguments.min_force;
  if (!arguments.window.empty()) {
    require(arguments.window.size() == 2, "--pressure-window", arguments.window.size(),
            "values given; it takes two, LOWER,UPPER");
    problem.pressure_window = {arguments.window[0], arguments.window[1]};
  }
  if (!file.empty()) {
    require_that(law.indenter.law.empty() && !law.surface.given() && !law.of_roughness(), "--law",
                 "or --surface or --rms-height given together with a file; give one of them");
    problem.contacts = contacts_of_file(arguments, file, problem, session);
    problem.source = file;
  } else {
    require_that(!law.indenter.law.empty() || law.surface.given() || law.of_roughness(), "RESULT",
                 "not given; name a file of contact or study, or give --law, --surface or "
                 "--rms-height");
    problem.contacts = {deck_contact(
        law.problem(
            arguments.material, session, {},
            law.surface.given() && arguments.direction == "auto" ? "0deg" : arguments.direction),
        session.context())};
    problem.source = law.surface.given()  ? law.surface.file
                     : law.of_roughness() ? "roughness of the sides"
                                          : fmt::format("law {}", law.indenter.law);
    if (law.of_roughness()) {
      const RoughnessLaw sides = law.law_of_sides(arguments.material);
      problem.comment = fmt::format(
          "The decay length follows from the roughness of the sides, {}: {}, and of 95 % of such "
          "pairs from {} to {}.",
          format_quantity(sides.rms_height, Dimension::length),
          format_quantity(sides.decay_length, Dimension::length, 3),
          format_quantity(sides.decay_length_low, Dimension::length, 3),
          format_quantity(sides.decay_length_high, Dimension::length, 3));
      session.warn(problem.comment);
    }
  }
  const DeckSolution answer = solve(problem);
  constexpr double max_error = 0.01;
  if (std::abs(answer.loss_error) > max_error)
    session.warn(
        fmt::format("from {:g} of the force at which all slips on, the loss is off by up to {:.3g} "
                    "%; give more --sliders or a larger --min-force",
                    problem.min_force, 100 * answer.loss_error));
  if (problem.format == DeckFormat::fmu && answer.platform.empty())
    session.warn(
        "no C compiler `cc` compiled the unit, so that it contains its sources only; the "
        "simulation program must compile them");
  const Json object = answer_json(answer);
  if (!session.has_output()) {
    Json whole = object;
    whole["text"] = answer.text;
    return session.answer(whole, answer.text);
  }
  detail::AtomicFile output(session.output(), session.write_options());
  output.write(answer.text);
  output.commit();
  session.answer(object);
}

}  // namespace

void add_export_command(Program& program) {
  auto arguments = std::make_shared<ExportArguments>();
  Command& command = program.add_command(
      "export", "contact law as input for another program",
      {"salebra export study.h5 --to calculix --units mm,t,s -o contact.inp",
       "salebra export --law exponential --decay-length 100nm --normal-force 10N --poisson 0.3 "
       "--friction-coefficient 0.3 --to jenkins --sliders 200 -o sliders.csv"},
      [arguments](Session& session) { run(*arguments, session); }, "", OutputCheck::any_name);
  command
      .add_option("RESULT", arguments->result,
                  "result of contact with several loads, result of a study, or a text table")
      ->file(FileUse::input);
  add_choice<DeckFormat>(command, "--to", arguments->format, "the format")->required();
  command.add_option("--units", arguments->units,
                     "units LENGTH,MASS,TIME of the other program, such as mm,t,s; default m,kg,s");
  add_quantity(command, "--friction-coefficient", arguments->friction_coefficient,
               Dimension::dimensionless,
               "coefficient of friction mu, for decks with friction and for sliders");
  add_quantity(command, "--nominal-area", arguments->law.nominal_area, Dimension::length_squared,
               "nominal area of the part: forces of a file or of --surface are scaled to it; the "
               "force of --law over it is the pressure");
  add_values(command, "--pressure-window", arguments->window, Dimension::pressure,
             "nominal pressures LOWER,UPPER of a table; default: the whole curve");
  command
      .add_option("--rows", arguments->rows,
                  "rows of a table; default 200, at most 198 for calculix and 19 for ansys")
      ->range(4, 100000);
  const std::string before =
      command.under("Sliders (--to jenkins) and springs (--to c-header, fmu)");
  command
      .add_option("--sliders", arguments->sliders,
                  "number of sliders, or of springs in a C header or FMU; default 200")
      ->range(2, 100000);
  add_direction(command, arguments->direction, "direction of the tangential motion");
  command.add_option("--name", arguments->name,
                     "prefix of the names in a C header, name of an FMU; default contact");
  add_quantity(command, "--min-force", arguments->min_force, Dimension::dimensionless,
               "T/(mu F) from which the loss of the sliders is right to 1 %; default 0.01");
  add_choice<DeckCase>(
      command, "--of", arguments->of,
      "which of several surfaces to take; default mean. Tables hold all three, except elmer");
  command.under(before);
  arguments->law.add_to(command);
  arguments->law.add_roughness_to(command);
  arguments->material.add_to(command);
  const std::string last = command.under("Conductance");
  add_values(
      command, "--conductivity", arguments->conduction.conductivity,
      Dimension::thermal_conductivity,
      "thermal conductivity K1[,K2], one value for both bodies: adds the thermal conductance "
      "over the pressure; needs the contact modulus");
  command.under(last);
}

}  // namespace salebra::cli
