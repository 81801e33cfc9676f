// SPDX-License-Identifier: GPL-3.0-or-later
// `salebra study`: the path from surfaces to damping for an ensemble.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/study/sensitivity.hpp>
#include <salebra/study/study.hpp>
#include <tuple>

#include "figures/axes.hpp"
#include "option_words.hpp"
#include "program.hpp"
#include "result_tables.hpp"
#include "sensitivity_answer.hpp"
#include "several_files.hpp"
#include "study_command.hpp"
#include "terminal.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

Json lengths_json(const StudyResult& result, ContactModel model) {
  return {{"decay_length", to_json(result.decay_length(model))},
          {"decay_length_over_rms_height", to_json(result.decay_length_over_rms_height(model))}};
}

Json damping_of_study(const StudyResult& result, const StudySolution& answer) {
  std::vector<double> forces;
  for (const double pressure : result.pressures) forces.push_back(pressure * result.grid.area());
  Json damping;
  damping["pressure"] = result.pressures;
  damping["force"] = forces;
  damping["hold"] = std::string(name_of(result.configuration.hold()));
  if (const std::optional<Body>& body = result.configuration.body)
    damping["datum"] = std::string(name_of(body->datum()));
  if (!std::isnan(answer.direction)) damping["direction"] = answer.direction;
  damping.add(damping_json(answer));
  damping["deviation"] = to_json(result.deviation());
  damping.add(damping_columns(result, ContactModel::bem));
  return damping;
}

Json study_json(const StudyResult& result, const StudySolution& answer) {
  Json object = lengths_json(result, ContactModel::bem);
  if (result.configuration.adhesion) {
    object["curve"]["pressure"] = result.pressures;
    object["curve"].add(
        columns_json<ForceSample>([&](const auto& number) { return result.curve(number); }));
  } else {
    object["damping"] = damping_of_study(result, answer);
  }
  for (const StudyModel& model : result.models())
    object["comparison"][model.name] = lengths_json(result, model.id);
  add_ensemble(object, result, answer);
  return object;
}

/// The place value of the last digit to print for a value with this error, in units of `unit`; at
/// most three digits are printed.
double last_place(double value, double error, double unit) {
  if (value == 0 || std::isnan(value)) return 1;
  const double relative = std::isnan(error) ? 0 : error / std::abs(value);
  const double digits =
      relative > 0 ? std::clamp(std::ceil(-std::log10(relative)) + 1, 1.0, 3.0) : 3;
  return std::pow(10, std::floor(std::log10(std::abs(value / unit))) + 1 - digits);
}

std::string rounded(double value, double unit, double digit) {
  if (std::isnan(value)) return "n/a";
  const int decimals = std::max(0, int(-std::floor(std::log10(digit) + 1e-9)));
  // Removes the sign of a zero.
  return fmt::format("{:.{}f}", std::round(value / unit / digit) * digit + 0.0, decimals);
}

std::string digits_of(double value, double error, double unit) {
  return rounded(value, unit, last_place(value, error, unit));
}

/// Formats a ratio as its deviation from 1, "+25 %", or as "x 48" beyond a factor of two.
std::string off_by(double ratio) {
  return std::isnan(ratio) ? "n/a"
         : ratio > 2       ? fmt::format("x {:.2g}", ratio)
                           : fmt::format("{:+.0f} %", 100 * (ratio - 1));
}

/// A unit, with its factor, in which the largest of the damping constants has one to five digits
/// before the point.
std::pair<double, std::string> unit_of(const std::vector<StatedMean>& constants) {
  double most = 0;
  for (const StatedMean& one : constants) most = std::fmax(most, std::abs(one.mean));
  return most > 2e4             ? std::pair(1e3, "kN s/m")
         : most > 0 && most < 1 ? std::pair(1e-3, "mN s/m")
                                : std::pair(1.0, "N s/m");
}

/// The table over the loads: damping constant γ of the motion as the user described it, γ without
/// slip by the theorem, and γ by the closed form for exponential contacts.
std::string answer_table(const StudyResult& result, const StudySolution& answer) {
  const bool sample = result.realisations.size() > 1, slip = answer.slip_followed;
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  const std::string law = drag ? "Eq. (16)" : "Eq. (12)";
  const auto& without = answer.damping_constant_without_slip;
  const auto by_law = result.damping(&DampingPoint::damping_constant_closed_form);
  const auto [unit, name] = unit_of(answer.slips() ? answer.damping_constant : without);
  std::vector<std::string> head{"nominal p", "force", slip ? "γ, " + name : "γ no slip, " + name};
  if (sample) head.push_back("95 % interval");
  head.push_back("error");
  const auto peak = result.damping(&DampingPoint::max_force),
             time = result.damping(&DampingPoint::contact_time);
  const bool wide = std::ranges::any_of(time, [](const EnsembleMean& one) { return one.mean < 1; });
  if (wide) head.insert(head.end(), {"largest force", "in contact"});
  if (answer.slips()) head.push_back("by slip");
  if (slip) head.push_back("no slip");
  head.push_back(law);
  if (!slip) head.push_back("off by");
  std::vector<std::vector<std::string>> rows{head};
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    const StatedMean& main = answer.damping_constant[k];
    const double relative = main.error / std::abs(main.mean);
    std::vector<std::string> row{
        format_quantity(result.pressures[k], Dimension::pressure, 3),
        format_quantity(result.pressures[k] * result.grid.area(), Dimension::force, 3),
        digits_of(main.mean, main.error, unit)};
    const double digit = last_place(main.mean, main.error, unit);
    if (sample)
      row.push_back(std::isnan(main.low)
                        ? "n/a"
                        : rounded(main.low, unit, digit) + " … " + rounded(main.high, unit, digit));
    row.push_back(std::isfinite(relative) ? fmt::format("{:.2g} %", 100 * relative) : "n/a");
    if (wide) {
      row.push_back(format_quantity(peak[k].mean, Dimension::force, 3));
      row.push_back(std::isnan(time[k].mean) ? "n/a" : fmt::format("{:.0f} %", 100 * time[k].mean));
    }
    if (answer.slips())
      row.push_back(std::isnan(answer.slip_share[k])
                        ? "n/a"
                        : fmt::format("{:.0f} %", 100 * answer.slip_share[k]));
    if (slip) row.push_back(digits_of(without[k].mean, without[k].error, unit));
    row.push_back(digits_of(by_law[k].mean, ForceSample::unknown, unit));
    if (!slip) row.push_back(off_by(by_law[k].mean / without[k].mean));
    rows.push_back(std::move(row));
  }
  return to_table(rows);
}

/// Warnings that are printed next to the table of damping constants.
std::string notes(const StudyResult& result, const StudySolution& answer) {
  std::string text;
  if (!answer.unknown.empty())
    text += wrapped(in_options("γ is n/a: " + answer.unknown + "."), 78) + "\n";
  const auto& constants =
      answer.unknown.empty() ? answer.damping_constant : answer.damping_constant_without_slip;
  const auto unstated = std::ranges::count_if(constants, [](const StatedMean& one) {
    return std::isnan(one.mean) && !std::isnan(one.error);
  });
  if (unstated > 0)
    text += fmt::format(
        "n/a at {} of {} loads: the error is larger than the number, because too few cells\ntouch "
        "and separate; a finer grid or --relative-error may help.\n",
        unstated, result.pressures.size());
  return text;
}

/// The decay length with its interval, and whether an exponential law describes the curve.
std::string law_line(const StudyResult& result) {
  const EnsembleMean length = result.decay_length(), ratio = result.decay_length_over_rms_height();
  if (std::isnan(length.mean)) return "Force law: no window to fit\n";
  const std::optional<LawDescription> law = result.law_description();
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  return fmt::format(
      "Force law: l = {}{} = {:.2f} h_rms{}\n", format_quantity(length.mean, Dimension::length, 3),
      std::isnan(length.low)
          ? ""
          : fmt::format(" ({} … {})", format_quantity(length.low, Dimension::length, 3),
                        format_quantity(length.high, Dimension::length, 3)),
      ratio.mean,
      !law ? ""
      : law->fair
          ? ", exp(-gap/l) is fair"
          : fmt::format("; exp(-gap/l) is poor, do not use {}", drag ? "Eq. (16)" : "Eq. (12)"));
}

std::string accuracy(const StudyResult& result) {
  std::string text;
  for (const EnsembleWarning& found : result.ensemble_warnings) {
    std::string item = wrapped(found.text, 72);
    for (std::size_t at = 0; (at = item.find('\n', at)) != item.npos; ++at)
      if (at + 1 < item.size()) item.insert(at + 1, "      ");
    text += "  !   " + item + (item.ends_with('\n') ? "" : "\n");
  }
  return text.empty() ? "" : "Accuracy\n" + text;
}

/// Conductances and flow factors at each load with their intervals, if the study has them.
std::string transport_table(const StudyResult& result, const StudySolution& answer) {
  std::vector<std::pair<std::string, std::vector<EnsembleMean>>> columns{
      {"h, W/(m² K)", answer.thermal_conductance}, {"C, S/m²", answer.electrical_conductance}};
  if (result.configuration.flow_factors)
    columns.insert(columns.end(), {{"flow x", result.flow(&FlowFactors::pressure_flow_factor_x)},
                                   {"flow y", result.flow(&FlowFactors::pressure_flow_factor_y)}});
  std::erase_if(columns, [](const auto& column) { return column.second.empty(); });
  if (columns.empty()) return "";
  const bool sample = result.realisations.size() > 1;
  std::vector<std::vector<std::string>> rows(result.pressures.size() + 1);
  rows[0] = {"nominal p"};
  for (std::size_t k = 0; k < result.pressures.size(); ++k)
    rows[k + 1] = {format_quantity(result.pressures[k], Dimension::pressure, 3)};
  for (const auto& [name, means] : columns) {
    rows[0].push_back(name);
    if (sample) rows[0].push_back("95 % interval");
    for (std::size_t k = 0; k < means.size(); ++k) {
      rows[k + 1].push_back(std::isnan(means[k].mean) ? "n/a"
                                                      : fmt::format("{:.3g}", means[k].mean));
      if (sample) rows[k + 1].push_back(interval(means[k], Dimension::dimensionless, 3));
    }
  }
  return "\nThrough the contacts\n" + to_table(rows);
}

/// Tables of the adhesive contact at each load, and of the loading cycle.
std::string adhesion_table(const StudyResult& result) {
  const Adhesion& adhesion = result.configuration.adhesion->adhesion;
  const auto gap = result.curve(&ForceSample::mean_gap);
  const auto area = result.curve(&ForceSample::contact_area_fraction);
  std::vector<std::vector<std::string>> rows{
      {"nominal p", "mean gap", "95 % interval", "A/A0 %", "95 % interval"}};
  const auto percent = [](EnsembleMean mean) {
    for (double EnsembleMean::*part :
         {&EnsembleMean::mean, &EnsembleMean::low, &EnsembleMean::high})
      mean.*part *= 100;
    return mean;
  };
  for (std::size_t k = 0; k < result.pressures.size(); ++k)
    rows.push_back({format_quantity(result.pressures[k], Dimension::pressure, 3),
                    format_quantity(gap[k].mean, Dimension::length, 3),
                    interval(gap[k], Dimension::length, 3),
                    fmt::format("{:.3g}", percent(area[k]).mean),
                    interval(percent(area[k]), Dimension::dimensionless, 3)});
  std::string text = fmt::format("Adhesion: w = {}, range {}, {}\n{}",
                                 format_quantity(adhesion.work, Dimension::energy_per_area, 3),
                                 format_quantity(adhesion.range, Dimension::length, 3),
                                 name_of(adhesion.potential), to_table(rows));
  if (result.configuration.adhesion->cycle.empty()) return text;
  const auto line = [&](const char* name, Dimension dimension,
                        double AdhesiveCycleNumbers::*number) {
    const EnsembleMean mean = result.adhesion_cycle(number);
    const std::string limits = interval(mean, dimension, 3);
    return fmt::format("{}{}{}", name, format_quantity(mean.mean, dimension, 3),
                       limits.empty() ? "" : " (95 %: " + limits + ")");
  };
  return text + "\nCycle of mean gaps\n" +
         line("  pull-off       ", Dimension::pressure, &AdhesiveCycleNumbers::pull_off_pressure) +
         line(", by the steps +", Dimension::pressure, &AdhesiveCycleNumbers::pull_off_error) +
         line("\n  adhesion work  ", Dimension::energy,
              &AdhesiveCycleNumbers::adhesion_work_per_cycle) +
         line(", by the steps ±", Dimension::energy, &AdhesiveCycleNumbers::adhesion_work_error) +
         fmt::format("\n  reversible     on {:.3g} % of the surfaces\n",
                     100 * result.adhesion_cycle(reversible_share).mean);
}

/// The damping constant at each load in one direction, with its assumptions.
std::string damping_text(const StudyResult& result, const StudySolution& answer) {
  const double friction = result.configuration.known.friction_coefficient;
  const std::string motion =
      "Damping constant: " +
      std::visit(
          [&](const auto& one) {
            return figures::motion_text(one, {}, result.configuration.known.excursion);
          },
          result.configuration.motion) +
      (result.configuration.hold() == Hold::force ? ", mean force held" : "");
  const std::string beside = fmt::format(
      "{}{}", std::isnan(answer.direction) ? "" : ", " + direction_in_words(answer.direction),
      std::isnan(friction) ? "" : fmt::format(", µ = {:g}", friction));
  // "µ" has two bytes and is one column wide.
  constexpr std::size_t columns = 80;
  const bool fits = motion.size() + beside.size() <= columns;
  const AssumptionReport assumptions = assumptions_of(answer, result);
  return motion + (fits || beside.empty() ? beside : ",\n  " + beside.substr(2)) + "\n" +
         assumptions.warning() + answer_table(result, answer) + notes(result, answer) + "\n" +
         assumptions.text();
}

std::string study_text(const StudyResult& result, const StudySolution& answer) {
  const auto count = result.realisations.size();
  const bool flowed = std::ranges::any_of(
      result.realisations, [](const Realisation& r) { return r.first_loading.yielded(); });
  std::string text = fmt::format(
      "{} of {} x {} points, {} x {}, h_rms {}{}{}\n\n",
      count == 1 ? "1 surface" : fmt::format("{} surfaces", count), result.grid.nx, result.grid.ny,
      format_quantity(result.grid.lx, Dimension::length, 3),
      format_quantity(result.grid.ly, Dimension::length, 3),
      format_quantity(result.mean([](const auto& r) { return r.heights.rms_height; }).mean,
                      Dimension::length, 3),
      flowed ? ",\nas the first loading left it" : "",
      result.configuration.body
          ? fmt::format(",\non a body, displacements from the {}",
                        result.configuration.body->datum() == Datum::base ? "base" : "mean plane")
          : "");
  if (result.configuration.adhesion)
    return text + adhesion_table(result) + "\n" + accuracy(result) + law_line(result) +
           transport_table(result, answer);
  return text + damping_text(result, answer) + accuracy(result) + law_line(result) +
         transport_table(result, answer);
}

/// Text of --verbose: results of all models, deviation of the curve from an exponential law,
/// convergence of the mean.
std::string details(const StudyResult& result) {
  const bool sample = result.realisations.size() > 1;
  std::string text = "\n" + heading(result) + "Decay length l of pressure = p0 exp(-mean gap/l)\n";
  std::vector<std::vector<std::string>> rows{{"model", "l", "l/h_rms", "95 % interval"}};
  for (const StudyModel& model : result.models()) {
    const EnsembleMean ratio = result.decay_length_over_rms_height(model.id);
    rows.push_back({model.title,
                    format_quantity(result.decay_length(model.id).mean, Dimension::length),
                    std::isnan(ratio.mean) ? "n/a" : fmt::format("{:.3f}", ratio.mean),
                    sample ? interval(ratio, Dimension::dimensionless) : "n/a"});
  }
  return text + to_table(rows, 2, true) + "  (" + result.interval_method() + ")\n" +
         law_verdict(result) + "\n" + ensemble_warnings(result);
}

/// Throws InvalidInput, before any work, for what has no sensitivities.
void require_sensitivities(const StudyArguments& arguments, const StudyConfiguration& configuration,
                           const Tolerances& tolerances) {
  for (const auto& [given, option] : {std::pair(arguments.dry_run.dry_run, "--dry-run"),
                                      {arguments.resume, "--resume"},
                                      {arguments.merge, "--merge"},
                                      {arguments.shard.has_value(), "--shard"},
                                      {arguments.shard_seconds.has_value(), "--shard-seconds"}})
    require_that(
        !given, "--sensitivity",
        fmt::format("given together with {}, which may print no results; leave one out", option));
  require_that(!configuration.adhesion, "--sensitivity",
               "known for contacts without adhesion only; leave it or the adhesion out");
  for (const auto& [parameter, tolerance] : tolerances) {
    const bool always =
        parameter == StudyParameter::rms_height || parameter == StudyParameter::pressure;
    require(always || !std::isnan(value_of(configuration, parameter)), "--tolerance",
            name_of(parameter), "has no value in this study");
  }
}

void run_one(const StudyArguments& arguments, Session& session) {
  for (const auto& [given, option] : {std::pair(arguments.merge, "--merge"),
                                      {arguments.shard.has_value(), "--shard"},
                                      {arguments.shard_seconds.has_value(), "--shard-seconds"},
                                      {arguments.sensitivity, "--sensitivity"},
                                      {session.has_plot(), "--plot"}})
    if (given) session.require_one_process(option);
  const Tolerances tolerances = tolerances_of(arguments.tolerances);
  require_that(tolerances.empty() || arguments.sensitivity, "--tolerance",
               "needs the sensitivities; add --sensitivity");
  StudyConfiguration configuration;
  collectively(session.communicator(), [&] { configuration = arguments.study(); });
  if (arguments.sensitivity) require_sensitivities(arguments, configuration, tolerances);
  run_study("study", configuration, arguments, session, [&](const StudyResult& result) {
    const std::vector<StudyResult> directions = result.in_directions();
    const StudySolution answer = solution_of(result);
    Json json = study_json(result, answer);
    std::string text = study_text(result, answer);
    for (std::size_t k = 1; k < directions.size(); ++k) {
      const StudySolution other = solution_of(directions[k]);
      Json row;
      row["damping"] = damping_of_study(directions[k], other);
      assumptions_of(other, directions[k]).add_to(row);
      Json& list = json["other_directions"];
      if (k == 1) list = Json::array();
      list.push_back(std::move(row));
      text += "\n" + damping_text(directions[k], other);
    }
    if (arguments.verbose) text += details(result);
    if (arguments.sensitivity) {
      const StudySensitivity found =
          study_sensitivity(result.configuration, {.on_progress = session.progress()});
      if (found.interrupted) throw Interrupted("study: interrupted");
      json["sensitivity"] = sensitivity_json(found);
      text += "\n" + sensitivity_text(found);
      if (!tolerances.empty()) text += add_tolerances(json["sensitivity"], found, tolerances);
      return PointAnswer{std::move(json), text, figures::figure_of(found)};
    }
    return PointAnswer{std::move(json), text};
  });
}

/// Sets the study file and the surfaces from the names that the command line gives, and returns the
/// surfaces if they are several. A single name is the study file unless it is a folder or a pattern.
std::vector<std::string> take_names(StudyArguments& arguments) {
  if (!arguments.surface.file.empty()) arguments.surface.names = {arguments.surface.file};
  for (const std::string& name : arguments.names) {
    const bool study =
        name.ends_with(".toml") || (arguments.names.size() == 1 && !are_several(arguments.names));
    require(!study || arguments.configuration.empty(), "CONFIG", name,
            "is a second study file; all surfaces have one");
    if (study)
      arguments.configuration = name;
    else
      arguments.surface.names.push_back(name);
  }
  return arguments.surface.several(!arguments.csv.empty(), "CONFIG");
}

/// Studies each of several surfaces with the same material, motion and pressures.
void run_files(StudyArguments arguments, const std::vector<std::string>& files, Session& session) {
  require_options_of_one(session, {{!arguments.twin.empty(), "--twin"},
                                   {arguments.resume, "--resume"},
                                   {arguments.shard.has_value(), "--shard"},
                                   {arguments.shard_seconds.has_value(), "--shard-seconds"},
                                   {arguments.merge, "--merge"},
                                   {arguments.sensitivity, "--sensitivity"},
                                   {arguments.dry_run.dry_run, "--dry-run"}});
  arguments.surface.file = files.front();
  const StudyConfiguration configuration = arguments.study();
  if (const auto* named = std::get_if<LayDirection>(&configuration.direction);
      named && stick_solves(configuration) && !configuration.adhesion)
    arguments.direction = one_direction(std::string(name_of(*named)));
  require_that(!configuration.relative_pressures, "--pressures",
               "not given in Pa; several surfaces are compared at the same nominal pressures");
  FileTable table{.columns = {column("pressure", "damping.pressure", "pressure", false)},
                  .loads = configuration.pressures.size(),
                  .csv = arguments.csv};
  if (configuration.adhesion)
    table.columns = {column("pressure", "curve.pressure", "pressure", false),
                     column("A/A0", "curve.contact_area_fraction.mean", "contact_area_fraction"),
                     column("mean gap", "curve.mean_gap.mean", "mean_gap")};
  else
    add_damping_columns(table, "damping.", [](const Json& answer, std::size_t load) {
      return member(answer, "damping.force", load).number() /
             member(answer, "damping.pressure", load).number();
    });
  for (const auto& [heading, path, name] :
       {std::tuple("l", "decay_length.mean", "decay_length"),
        {"h", "conductance.thermal_conductance.mean", "thermal_conductance"},
        {"C", "conductance.electrical_conductance.mean", "electrical_conductance"},
        {"flow x", "flow_factors.pressure_flow_factor_x.mean", "pressure_flow_factor_x"},
        {"flow y", "flow_factors.pressure_flow_factor_y.mean", "pressure_flow_factor_y"}}) {
    table.columns.push_back(column(heading, path, name));
    table.columns.back().dimension = quantity_of(name).dimension;
  }
  if (!configuration.adhesion) {
    table.columns.push_back(column("validity", "validity", "validity", false));
    table.columns.back().unit = "text";
  }
  answer_files(files, table, session, [&](const std::string& file) {
    arguments.surface.file = file;
    run_one(arguments, session);
  });
}

void run(StudyArguments arguments, Session& session) {
  const std::vector<std::string> files = take_names(arguments);
  if (!files.empty()) return run_files(std::move(arguments), files, session);
  require_that(arguments.csv.empty(), "--csv", "needs the files of surfaces; name them");
  run_one(arguments, session);
}

}  // namespace

void add_study_command(Program& program) {
  auto arguments = std::make_shared<StudyArguments>();
  Command& command = program.add_command(
      "study", "from surfaces to damping constants in one run",
      {"salebra study data/quickstart.toml -o quickstart.h5",
       "salebra study --surface scan.txt --contact-modulus 115GPa --poisson 0.3 "
       "--normal-amplitude 1nm --drag-velocity 100nm/s --frequency 20kHz"},
      [arguments](Session& session) { run(*arguments, session); },
      "force, area, stiffness and damping of all models", study_output);
  arguments->add_to(command, true);
  command.add_flag(
      "--verbose", arguments->verbose,
      "also print all models, how the law bends, how the mean converged, and on stderr the "
      "processor time by stage");
  command.add_flag("--sensitivity", arguments->sensitivity,
                   "also compute how the results respond to the parameters and to each octave of "
                   "wavelengths: d ln result/d ln parameter. Takes a few times as long as the "
                   "study, and up to fifty times on layers and other bodies; "
                   "the answer has them, the file of --output has not");
  command
      .add_option("--tolerance", arguments->tolerances,
                  "with --sensitivity: tolerances of parameters, such as rms_height=10%; prints "
                  "the limits of the results, to first order")
      ->type_name("NAME=VALUE ...");
}

}  // namespace salebra::cli
