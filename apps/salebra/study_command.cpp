// SPDX-License-Identifier: GPL-3.0-or-later
// Common part of `salebra study` and `salebra compare`: options, run, files, text about the
// ensemble.
#include "study_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/base/version.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/report/report.hpp>
#include <salebra/study/study_file.hpp>
#include <salebra/study/twin_file.hpp>
#include <set>

#include "base/stage_time.hpp"
#include "dry_run.hpp"
#include "results/answer_json.hpp"
#include "results/columns.hpp"
#include "several_files.hpp"
#include "study/surface_table.hpp"
#include "text.hpp"

namespace salebra::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Rate and remaining time of a study, estimated from the surfaces computed in this run.
class Pace {
 public:
  void restored() { ++restored_; }
  /// Text such as ", 4.1/min, 2 min 05 s left"; empty while too few surfaces are finished.
  /// fraction: of the whole study that is done.
  std::string at(double fraction, std::size_t finished, std::size_t wanted) {
    const double begun = double(restored_) / double(wanted);
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    if (elapsed < 1 || fraction <= begun) return "";
    std::string text;
    if (finished > restored_)
      text = fmt::format(", {:.3g}/min", 60 * double(finished - restored_) / elapsed);
    return text + ", " + format_duration(elapsed * (1 - fraction) / (fraction - begun)) + " left";
  }

 private:
  Clock::time_point start_ = Clock::now();
  std::size_t restored_ = 0;
};

}  // namespace

void StudyArguments::add_to(Command& command, bool over_processes) {
  const std::string file =
      "study file (TOML); options override its entries, a material option all of [material]";
  if (over_processes) {
    command
        .add_option(
            "CONFIG", names,
            file +
                ". Several files, a folder or a quoted pattern such as '*.sur' are surfaces "
                "(a study file among them ends in .toml): each is studied, and all give one "
                "table; files that fail are listed after it (exit status 1, or 2 if all "
                "fail)")
        ->file(FileUse::input);
    add_table_file(command, csv);
  } else {
    command.add_option("CONFIG", configuration, file)->file(FileUse::input);
  }
  surface.add_to(command, false, "--surface");
  command
      .add_option("--twin", twin,
                  "result of twin: generate surfaces with its spectra, on the grid and with the "
                  "seeds of the study file")
      ->file(FileUse::input);
  material.add_to(command);
  material.add_body_to(command, "boundary elements alone are then computed");
  add_conduction(command, conduction);
  motion.add_to(command);
  assumptions.add_to(command);
  add_values(command, "--pressures", pressures, Dimension::pressure,
             "nominal pressures at which contacts are solved, such as 1MPa:1GPa:16");
  add_quantity(command, "--target-precision", precision, Dimension::dimensionless,
               "stop as soon as the means of l and of the area slope are this precise, such as 2%");
  add_quantity(command, "--relative-error", relative_error, Dimension::dimensionless,
               "numerical error allowed for each damping constant, such as 5%; cells are halved "
               "until it is met");
  command.add_option(
      "--intervals", intervals,
      "intervals between the contacts that are solved inside the oscillation: 4, 8, 16 or 32, half "
      "as many on finer grids and for each of several surfaces; default 4. 0 solves none and takes "
      "the loss from the curve between loads: faster, but the error is not known");
  add_direction(command, direction, "direction of the tangential motion");
  add_choice<SeamCheck>(command, "--seam-error", seam_error,
                        "add the error of continuing a scan periodically, estimated from its "
                        "heights with a window or from the scan alone on a half-space");
  command.add_flag("--no-stick", no_stick,
                   "take K_t = (G*/E*)K instead of solving each contact in full stick: faster, and "
                   "exact at nu = 0 without coupling");
  command.add_flag("--flow-factors", flow_factors,
                   "also compute the flow factors of the gap of each contact");
  dry_run.add_to(command, over_processes);
  if (over_processes) add_groups(command, groups, "holds one surface at a time; default 1");
  add_quantity(
      command, "--shard-seconds", shard_seconds, Dimension::time,
      "with --dry-run: propose a number of shards that each take no longer than this, such as 1h");
  command.add_flag(
      "--resume", resume,
      "continue an interrupted run from the surfaces that it kept next to the output file");
  command
      .add_option_function(
          "--shard", [this](const std::string& text) { shard = parse_shard(text); },
          "compute the K-th of N parts of the surfaces, or with any those that no other process "
          "has taken, and keep them next to the output file for --merge")
      ->type_name("K/N or any");
  command.add_flag("--merge", merge,
                   "make the result from the surfaces of all shards; computes none, and exits with "
                   "3 if some are missing");
  command.add_flag("--no-report", no_report,
                   "write no report page (.html) next to the output file");
}

namespace {

/// The report page next to the results of a study; only the first process makes it.
class StudyReport {
 public:
  /// Plans the page. Throws before any work if it could not be written. No page is planned if there
  /// is no --output, if the user wants none, or if this build cannot make one; in the last case
  /// write() says so. All processes must call.
  StudyReport(const StudyArguments& arguments, Session& session);
  /// Writes the planned page from the file of results and returns its path. Returns nothing if no
  /// page is planned, and in all processes but the first. The results are already saved, so an
  /// error does not end the command before its answer: an existing page only gives a warning, and
  /// require_written() throws any other error.
  std::optional<std::string> write();
  /// Throws the IoError of a page that could not be written. All processes must call.
  void require_written() const;
  /// Makes the page if it is missing or older than the results, for example because the study was
  /// killed before it made the page. Returns its path.
  std::optional<std::string> complete();

 private:
  Session& session_;
  bool lacks_assets_ = false;
  std::filesystem::path page_;
  std::string failure_;
};

StudyReport::StudyReport(const StudyArguments& arguments, Session& session) : session_(session) {
  if (arguments.no_report || !session.has_output()) return;
  lacks_assets_ = !can_report();
  if (lacks_assets_) return;
  session.writes("--output", session.output().replace_extension(".html"));
  collectively(session.communicator(), [&] {
    if (!session.communicator().is_root()) return;
    page_ = session.output().replace_extension(".html");
    require(page_ != session.output(), "--output", page_.string(),
            "is the name of the report page; name the results .h5, or add --no-report");
    // If a study is resumed that already has its results, only files that a killed run left are
    // removed.
    if ((arguments.resume || arguments.merge) && std::filesystem::exists(session.output())) return;
    require_report(page_, session.write_options());
  });
}

std::optional<std::string> StudyReport::write() {
  session_.may_read_output(true);
  if (lacks_assets_)
    session_.inform(
        "no report was written: this build does not contain plotly.js (scripts/report-assets "
        "fetches it)");
  if (page_.empty()) return {};
  try {
    try {
      require_report(page_, session_.write_options());
    } catch (const InvalidInput& error) {
      session_.warn(fmt::format("no report was written: {}", error.what()));
      return {};
    }
    write_report(session_.output(), page_, {.write = session_.write_options()});
    return page_.string();
  } catch (const Error& error) {
    failure_ = error.what();
    return {};
  }
}

void StudyReport::require_written() const {
  collectively(session_.communicator(), [&] {
    if (!failure_.empty())
      throw IoError(
          fmt::format("{}; the results are complete in {}", failure_, session_.output().string()));
  });
}

std::optional<std::string> StudyReport::complete() {
  std::error_code missing;
  const auto made = std::filesystem::last_write_time(page_, missing);
  if (!missing && made >= std::filesystem::last_write_time(session_.output()))
    return page_.string();
  return write();
}

/// Whether a file contains a surface, with or without its lateral size.
bool is_surface(const std::string& file) {
  ReadOptions options;
  options.size_x = options.size_y = 1;
  options.known_formats = true;
  try {
    read_surface(file, options);
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// The study in the study file, or the default study of a measured surface, before further options
/// are applied.
StudyConfiguration study_of(const StudyArguments& arguments) {
  const std::string& file = arguments.configuration;
  const SurfaceOptions& surface = arguments.surface;
  StudyConfiguration study;
  if (!file.empty()) {
    try {
      study = arguments.twin.empty() || surface.given()
                  ? read_study_configuration(file)
                  : detail::read_study_of_twin(file, arguments.twin);
    } catch (const InvalidInput&) {
      require(!is_surface(file), "CONFIG", file,
              "is a surface, not a study file; give it as --surface " + file);
      throw;
    }
  } else {
    if (!surface.given())
      throw InvalidInput("CONFIG",
                         "not given; give a study file, or --surface with material and motion");
    std::vector<std::string> missing = arguments.material.missing(true);
    for (const std::string& option : arguments.motion.missing()) missing.push_back(option);
    require_options(missing, "a study without a file");
    study.pressures = parse_values("5e-4:0.2:16", Dimension::dimensionless, "pressures");
    study.relative_pressures = true;
    study.pressures_below_hardness = true;
  }
  if (!arguments.twin.empty()) {
    require(std::holds_alternative<GeneratedSurfaces>(study.surfaces) && !surface.given(), "--twin",
            arguments.twin, "needs a study file whose [surface] has points, size_x and seeds");
    require(
        study.ensemble.empty(), "--twin", arguments.twin,
        "fixes the spectrum; remove [ensemble] from the study file, because nothing can be varied");
  }
  if (!surface.given()) return study;
  return with_surface(std::move(study), surface.measured());
}

}  // namespace

StudyConfiguration StudyArguments::study() const {
  const bool from_file = !configuration.empty();
  StudyConfiguration study = study_of(*this);
  if (!from_file || material.given() || !material.body_file.empty())
    study.press_on(material.body());
  if (!from_file || motion.given()) {
    const auto motions = (from_file ? motion.completed_from(study.motion) : motion).motions();
    require(motions.size() == 1, motion.varied().first, motions.size(),
            "values given; a study has one motion");
    study.motion = motions.front();
  }
  if (!pressures.empty()) {
    require(pressures.size() >= 4, "--pressures", pressures.size(),
            "values given; a curve needs at least 4. For one load: salebra damping --surface");
    study.pressures = pressures;
    study.relative_pressures = false;
    study.pressures_below_hardness = false;
  }
  if (precision) {
    require(*precision > 0 && *precision < 1, "--target-precision", *precision,
            "must be between 0 and 1, such as 2%");
    study.target_precision = *precision;
  }
  if (relative_error) {
    require(*relative_error > 0 && *relative_error < 1, "--relative-error", *relative_error,
            "must be between 0 and 1, such as 5%");
    study.relative_error = *relative_error;
  }
  if (intervals) {
    require(*intervals == 0 || allowed_intervals(*intervals), "--intervals", *intervals,
            "must be 0, 4, 8, 16 or 32");
    study.intervals = intervals;
  }
  if (const auto seam = parse_enum<SeamCheck>(seam_error)) study.seam = seam;
  if (!direction.empty()) study.direction = direction_choice(direction, "--direction");
  if (no_stick) study.stick = false;
  if (flow_factors) study.flow_factors = true;
  conduction.validate();
  if (!conduction.conductivity.empty()) study.conduction.conductivity = conduction.conductivity;
  if (!conduction.resistivity.empty()) study.conduction.resistivity = conduction.resistivity;
  if (study.adhesion)
    for (const auto& [given, option] : {std::pair(motion.given(), "--normal-amplitude"),
                                        {intervals.has_value(), "--intervals"},
                                        {relative_error.has_value(), "--relative-error"},
                                        {!seam_error.empty(), "--seam-error"}})
      require_that(!given, option, std::string(no_damping_with_adhesion));
  const ContactParameters parameters = assumptions.parameters({});
  for (double ContactParameters::*parameter :
       {&ContactParameters::friction_coefficient, &ContactParameters::hardness,
        &ContactParameters::density, &ContactParameters::excursion})
    if (!std::isnan(parameters.*parameter)) study.known.*parameter = parameters.*parameter;
  return study;
}

namespace {

/// The files that a run has written: the results and their report page.
struct StudyFiles {
  std::optional<std::string> results = {}, report = {};

  std::string text() const {
    return (results ? fmt::format("results: {}\n", *results) : "") +
           (report ? fmt::format("report:  {}\n", *report) : "");
  }
};

constexpr void describe(auto&& visit, std::type_identity<StudyFiles>) {
  visit(&StudyFiles::results, Kept{"results", "what the report is made of"});
  visit(&StudyFiles::report, Kept{"report", "the page beside them"});
}

std::filesystem::path parts_folder(const Session& session) {
  return session.output().string() + ".parts";
}

/// Reports the progress of a run: a bar, and lines about finished surfaces.
class Reporter {
 public:
  explicit Reporter(Session& session, Groups groups = {})
      : session_(session), groups_(std::move(groups)), progress_(session.progress()) {}

  StudyRun run(StudyParts* parts) {
    return {.on_progress = [this](const ProgressReport& report) { return draw(report); },
            .on_realisation = [this](const RealisationReport& report) { note(report); },
            .on_warning = [this](const std::string& warning) { session_.warn(warning); },
            .parts = parts,
            .groups = groups_};
  }

 private:
  void note(const RealisationReport& report) {
    last_ = report;
    if (report.restored) pace_.restored();
    if (bar_ || report.restored) return;
    const double fraction = double(report.finished) / double(report.wanted);
    session_.inform(fmt::format(
        "study: surface {} of {} (seed {}{}) in {:.1f} s{}", report.finished, report.wanted,
        report.seed,
        report.points > 1 ? fmt::format(", point {} of {}", report.point + 1, report.points) : "",
        report.seconds, pace_.at(fraction, report.finished, report.wanted)));
  }

  bool draw(const ProgressReport& report) {
    const std::string stage =
        std::string(report.stage) +
        pace_.at(report.fraction, std::size_t(report.step), std::max(last_.wanted, std::size_t{1}));
    ProgressReport timed = report;
    timed.stage = stage;
    return progress_(timed);
  }

  Session& session_;
  const Groups groups_;
  const Progress progress_;
  const bool bar_ = isatty(STDERR_FILENO) != 0;
  Pace pace_;
  RealisationReport last_;
};

/// Formats numbers of shards as "3,7-9", the notation of job schedulers.
std::string ranges_of(const std::set<std::size_t>& numbers) {
  std::string text;
  for (auto first = numbers.begin(); first != numbers.end();) {
    auto last = first, next = std::next(first);
    while (next != numbers.end() && *next == *last + 1) last = next++;
    text += (text.empty() ? "" : ",") + fmt::format("{}", *first);
    if (*last != *first) text += fmt::format("-{}", *last);
    first = next;
  }
  return text;
}

/// Text that advises which shards to run again to compute the missing surfaces. The number of
/// shards is assumed to be that with which most of the present surfaces were computed.
std::string shards_to_run(const std::vector<std::size_t>& missing,
                          const std::vector<PartOrigin>& origins) {
  std::map<std::size_t, std::size_t> uses;
  for (const PartOrigin& origin : origins)
    if (!origin.shard.empty())
      if (const Shard shard = parse_shard(origin.shard); !shard.any()) ++uses[shard.count];
  if (uses.empty()) return "run --shard any, or all shards";
  const std::size_t count =
      std::ranges::max_element(uses, {}, [](const auto& use) { return use.second; })->first;
  std::set<std::size_t> numbers;
  for (const std::size_t index : missing) numbers.insert(index % count + 1);
  return fmt::format("run shard{} {} of {} again, or --shard any", numbers.size() == 1 ? "" : "s",
                     ranges_of(numbers), count);
}

/// Says which kept surfaces do not belong to the study, as in "3 surfaces there are of other
/// settings or seeds, 2 of version 0.0.9"; empty if there are none.
std::string strangers(const std::vector<PartOrigin>& others) {
  std::map<std::string, std::size_t> kinds;
  for (const PartOrigin& origin : others)
    ++kinds[origin.version.empty()        ? "another version"
            : origin.version == version() ? "other settings or seeds"
                                          : "version " + origin.version];
  std::string text;
  for (const auto& [kind, count] : kinds)
    text += fmt::format(
        "{}{}{} of {}", text.empty() ? "" : ", ", count,
        text.empty() ? (count == 1 ? " surface there is" : " surfaces there are") : "", kind);
  return text;
}

/// Hosts that computed kept surfaces, and number of these surfaces, for one arithmetic().
struct Machines {
  std::set<std::string> hosts;
  std::size_t surfaces = 0;
};

std::map<std::string, Machines> machines_of(const std::vector<PartOrigin>& origins) {
  std::map<std::string, Machines> machines;
  for (const PartOrigin& origin : origins) {
    machines[origin.arithmetic].hosts.insert(origin.host);
    ++machines[origin.arithmetic].surfaces;
  }
  return machines;
}

void warn_of_parts(const StudyParts& parts, const std::vector<PartOrigin>& others, bool merge,
                   Session& session) {
  if (parts.damaged() > 0)
    session.warn(fmt::format("{} damaged files of {} were deleted{}", parts.damaged(),
                             parts.folder().string(),
                             merge ? "" : "; their surfaces are computed again"));
  if (!merge) return;
  if (const auto machines = machines_of(parts.origins()); machines.size() > 1) {
    std::string text;
    for (const auto& [arithmetic, found] : machines)
      text += fmt::format("{}{} by {} on {}", text.empty() ? "" : "; ", found.surfaces, arithmetic,
                          fmt::join(found.hosts, ", "));
    session.warn("the surfaces were computed on machines that differ in the last digits: " + text);
  }
  if (!others.empty())
    session.warn(fmt::format("{}: {}; these are not used and not deleted", parts.folder().string(),
                             strangers(others)));
}

/// The provenance of the session. For merged surfaces it contains the arithmetic by which they were
/// computed.
Provenance provenance_of(const StudyParts& parts, const Session& session) {
  Provenance provenance = session.provenance();
  for (const auto& [arithmetic, found] : machines_of(parts.origins()))
    provenance.arithmetic += (provenance.arithmetic.empty() ? "" : "; ") + arithmetic;
  return provenance;
}

/// Whether --output already contains the results of all surfaces, so that the kept surfaces can be
/// removed.
bool is_complete(const StudyConfiguration& configuration, const std::filesystem::path& folder,
                 Session& session) {
  const Communicator& communicator = session.communicator();
  bool complete = false;
  collectively(communicator, [&] {
    complete = communicator.is_root() && is_result_of(session.output(), configuration);
    if (complete) StudyParts(folder, true).discard();
  });
  communicator.broadcast(&complete, sizeof complete);
  return complete;
}

/// Throws Incomplete if surfaces are missing, with advice how to compute them.
void require_all(const StudyParts& parts, const std::vector<std::size_t>& missing,
                 const std::vector<PartOrigin>& others, std::size_t surfaces) {
  if (missing.empty()) return;
  const std::string other = strangers(others);
  throw Incomplete(fmt::format(
      "{}: {} of {} surfaces are missing{}; {}, then --merge{}", parts.folder().string(),
      missing.size(), surfaces,
      parts.damaged() > 0 ? fmt::format(", {} of them damaged", parts.damaged()) : "",
      shards_to_run(missing, parts.origins()), other.empty() ? "" : " (" + other + ")"));
}

/// Throws Interrupted if not all surfaces were computed. The message says which surfaces are kept
/// and how to continue.
void require_finished(const std::vector<StudyResult>& results,
                      const StudyConfiguration& configuration, const StudyParts* parts,
                      const Communicator& communicator) {
  const bool interrupted = results.size() < parameter_combinations(configuration).size() ||
                           std::ranges::any_of(results, &StudyResult::interrupted);
  collectively(communicator, [&] {
    if (interrupted && parts && parts->count() > 0)
      throw Interrupted(
          fmt::format("study: interrupted; {} finished surfaces are kept in {}; continue with the "
                      "same command and --resume",
                      parts->count(), parts->folder().string()));
  });
  if (std::ranges::all_of(results,
                          [](const StudyResult& result) { return result.realisations.empty(); }))
    throw Interrupted("study: interrupted before the first surface was finished");
}

/// Throws NotConverged if the requested relative error was not reached. The message lists the loads
/// concerned, with the errors that were reached.
void require_relative_error(const std::vector<StudyResult>& results) {
  std::string missed;
  double wanted = 0;
  for (const StudyResult& result : results) {
    wanted = result.configuration.relative_error;
    const auto stated = result.stated("damping_constant");
    const auto means = result.damping(&DampingPoint::damping_constant);
    for (std::size_t k = 0; k < stated.size(); ++k) {
      // A load without value and error is skipped: its contact did not converge, or the oscillation
      // leaves the range of the contacts.
      if (std::isnan(stated[k].error)) continue;
      const double reached = stated[k].error / std::abs(means[k].mean);
      if (reached <= wanted) continue;
      missed += fmt::format(
          "{}{} ({})", missed.empty() ? "" : ", ",
          format_quantity(result.pressures[k], Dimension::pressure),
          std::isfinite(reached) ? fmt::format("{:.2g} %", 100 * reached) : "100 % or more");
    }
  }
  if (!missed.empty())
    throw NotConverged(fmt::format(
        "relative_error: {:.3g} % is not met at {} with cells of 1/{} of their size, so there is "
        "no result; allow a larger error, leave out these loads, or use a finer surface",
        100 * wanted, missed, SurfaceDampingOptions().max_refined));
}

/// Runs the ensembles with progress, keeps finished surfaces next to the file of --output, and
/// writes the results to this file. Without --output nothing is kept. If a resumed study already
/// has its results, it removes files that a killed run left, makes a missing page, answers with the
/// names of the files and returns nothing. Otherwise returns at least one result, with at least one
/// finished surface.
std::vector<StudyResult> run_and_keep(const StudyConfiguration& configuration,
                                      const StudyArguments& arguments, StudyReport& page,
                                      Session& session) {
  const bool merge = arguments.merge, resume = arguments.resume || merge;
  require_that(
      !resume || session.has_output(), merge ? "--merge" : "--resume",
      merge ? "needs the --output of the shards" : "needs the --output of the run to continue");
  const std::filesystem::path folder = parts_folder(session);
  const Communicator& communicator = session.communicator();
  session.may_read_output(resume);
  const bool complete = resume && is_complete(configuration, folder, session);
  session.may_read_output(false);
  if (complete) {
    const StudyFiles files{session.output().string(), page.complete()};
    session.answer(Json{{"files", salebra::to_json(files)}},
                   fmt::format("results: {}, complete already\n", *files.results) +
                       StudyFiles{{}, files.report}.text());
    page.require_written();
    return {};
  }
  session.require_free_output();
  std::unique_ptr<StudyParts> parts;
  collectively(communicator, [&] {
    if (!communicator.is_root()) return;
    if (merge)
      parts = StudyParts::to_merge(folder);
    else if (session.has_output())
      parts = std::make_unique<StudyParts>(folder, resume);
  });

  Reporter reporter(session, Groups(communicator, std::max(1, arguments.groups)));
  StudyRun run = reporter.run(parts.get());
  std::vector<std::size_t> missing;
  if (merge) run.missing = &missing;
  std::vector<StudyResult> results = run_ensembles(configuration, run);
  const std::vector<std::uint64_t> keys =
      merge ? StudyParts::keys(configuration) : std::vector<std::uint64_t>();
  if (parts) {
    const std::vector<PartOrigin> others = merge ? parts->others(keys) : std::vector<PartOrigin>();
    require_all(*parts, missing, others, keys.size());
    warn_of_parts(*parts, others, merge, session);
  }
  for (const StudyResult& result : results) session.warn(result.warnings);
  require_finished(results, configuration, parts.get(), communicator);
  if (configuration.relative_error > 0) {
    try {
      require_relative_error(results);
    } catch (const NotConverged&) {
      if (parts && !merge) parts->discard();
      throw;
    }
  }
  collectively(communicator, [&] {
    if (!parts) return;
    write_ensembles(session.output(), results, provenance_of(*parts, session),
                    session.write_options());
    parts->discard(keys);
  });
  if (!session.has_output())
    session.inform("no file was written; add --output FILE to keep the results");
  return results;
}

/// Runs --dry-run or --shard, after which the command ends, and returns true. Returns false if
/// neither was given.
bool run_without_results(const StudyConfiguration& configuration, const StudyArguments& arguments,
                         Session& session) {
  require_that(arguments.dry_run.dry_run || !arguments.shard_seconds, "--shard-seconds",
               "needs --dry-run; add it");
  if (arguments.dry_run.dry_run) {
    if (std::holds_alternative<MeasuredSurface>(configuration.surfaces))
      session.require_one_process("--dry-run of a file");
    const SurfaceWork work = planned(arguments.dry_run, {}, session);
    answer_dry_run(configuration, {work.ranks, work.nodes, std::max(1, arguments.groups)},
                   arguments.shard_seconds, session);
    return true;
  }
  if (!arguments.shard) return false;
  const Shard& shard = *arguments.shard;
  require_that(!arguments.merge, "--merge",
               "cannot be combined with --shard; run it after the shards");
  require_that(session.has_output(), "--shard",
               "needs the --output of the study; its surfaces are kept next to it");
  require_that(!session.has_plot(), "--plot",
               "cannot be combined with --shard, which makes no result; use it with --merge");
  const std::string folder = parts_folder(session).string();
  const auto answer = [&](const ShardOutcome& outcome, const std::string& text) {
    session.answer(Json{{"shard", to_text(shard)},
                        {"surfaces", outcome.wanted},
                        {"computed", outcome.computed},
                        {"present", outcome.present},
                        {"elsewhere", outcome.elsewhere},
                        {"files", {{"parts", folder}}}},
                   fmt::format("shard {}: {}\n", to_text(shard), text));
    return true;
  };
  if (!session.overwrites() && is_result_of(session.output(), configuration))
    return answer({}, session.output().string() + " is complete already");
  parameter_combinations(configuration);  // throws for an invalid study before a folder is made
  const auto parts = StudyParts::of_shard(folder, shard);
  Reporter reporter(session);
  const ShardOutcome outcome = run_shard(configuration, shard, reporter.run(parts.get()));
  warn_of_parts(*parts, {}, false, session);
  if (outcome.interrupted)
    throw Interrupted(fmt::format(
        "study: interrupted; {} finished surfaces of this shard are kept in {}; continue with "
        "the same command",
        outcome.present + outcome.computed, folder));
  return answer(outcome, fmt::format("{} surfaces, {} computed now{}, kept in {}; --merge instead "
                                     "of --shard makes the result of all",
                                     outcome.wanted, outcome.computed,
                                     outcome.elsewhere > 0
                                         ? fmt::format(", {} being computed by other processes",
                                                       outcome.elsewhere)
                                         : "",
                                     folder));
}

}  // namespace

namespace {

std::string text_of_stages() {
  const auto seconds = detail::stage_seconds();
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  std::string text = fmt::format("processor time, {:.2f} s:", all);
  for (std::size_t k = 0; k < seconds.size(); ++k)
    if (seconds[k] > 0)
      text += fmt::format("\n  {:<23} {:7.2f} s  {:3.0f} %", detail::stage_names[k], seconds[k],
                          100 * seconds[k] / all);
  return text;
}

}  // namespace

void run_study(const std::string& command, const StudyConfiguration& configuration,
               const StudyArguments& arguments, Session& session,
               const std::function<PointAnswer(const StudyResult&)>& answer_point) {
  const detail::StageTime time(detail::Stage::results);
  if (const auto* measured = std::get_if<MeasuredSurface>(&configuration.surfaces))
    session.reads("surface.file", measured->file);
  if (run_without_results(configuration, arguments, session)) return;
  StudyReport report(arguments, session);
  const std::vector<StudyResult> results = run_and_keep(configuration, arguments, report, session);
  if (results.empty()) return;
  figures::Figure picture;
  if (session.has_plot()) picture = figures::figure_of(results, configuration.ensemble);
  StudyFiles files{.report = report.write()};
  if (session.has_output()) files.results = session.output().string();
  Json answer;
  std::string text;
  for (const StudyResult& result : results) {
    PointAnswer point = answer_point(result);
    if (configuration.ensemble.empty()) {
      answer = std::move(point.answer);
    } else {
      const std::string name = describe_point(configuration.ensemble, result.configuration);
      Json named{{"point", name}};
      named.add(point.answer);
      answer["points"].push_back(std::move(named));
      text += (text.empty() ? "== " : "\n== ") + name + " ==\n";
    }
    text += point.text;
    if (results.size() == 1) {
      std::ranges::move(point.more.panels, std::back_inserter(picture.panels));
      picture.caption += (point.more.caption.empty() ? "" : " ") + point.more.caption;
    }
  }
  if (session.has_plot()) session.plot(picture);
  answer["files"] = salebra::to_json(files);
  if (!session.communicator().alone()) answer["groups"] = std::max(1, arguments.groups);
  if (const std::string where = files.text(); !where.empty()) text += "\n" + where;
  session.answer(session.with_processes(std::move(answer)), text);
  report.require_written();
  if (arguments.verbose) session.inform(text_of_stages());
  if (std::ranges::any_of(results, &StudyResult::interrupted))
    throw Interrupted(command + ": interrupted; the output covers the finished surfaces");
}

std::string interval(const EnsembleMean& estimate, Dimension dimension, int digits) {
  if (std::isnan(estimate.low)) return "";
  return fmt::format("{} … {}", format_quantity(estimate.low, dimension, digits),
                     format_quantity(estimate.high, dimension, digits));
}

std::string heading(const StudyResult& result) {
  const Grid2D& grid = result.grid;
  const Material& material = result.configuration.material;
  const auto count = result.realisations.size();
  const bool flowed = std::ranges::any_of(
      result.realisations, [](const Realisation& r) { return r.first_loading.yielded(); });
  const std::string modulus = format_quantity(material.contact_modulus, Dimension::pressure);
  const std::optional<Body>& body = result.configuration.body;
  return fmt::format(
      "surface     {} x {} points, {} x {}, {}{}\nrms height  {}\nrms slope   {}\n{}\n\n", grid.nx,
      grid.ny, format_quantity(grid.lx, Dimension::length),
      format_quantity(grid.ly, Dimension::length),
      count == 1 ? "1 surface" : fmt::format("{} surfaces", count),
      flowed ? ", as the first loading left it" : "",
      format_quantity(result.mean([](const auto& r) { return r.heights.rms_height; }).mean,
                      Dimension::length),
      format_quantity(result.mean([](const auto& r) { return r.moments.rms_slope(); }).mean,
                      Dimension::dimensionless),
      body ? fmt::format("body        like a half-space with E* = {}, datum {}", modulus,
                         name_of(body->datum()))
           : "E*, G*      " + modulus + ", " +
                 format_quantity(material.tangential_modulus, Dimension::pressure));
}

std::string in_words(const LawDescription& law, const std::string& what) {
  return fmt::format(
      "F ~ exp(-gap/l) is a {} description of {}: F/l^2 differs from F'' by {:+.0f} % (smallest "
      "gap) and {:+.0f} % (largest gap) at the ends of the window.{}",
      law.fair ? "fair" : "poor", what, 100 * law.law_off_at_min_gap, 100 * law.law_off_at_max_gap,
      law.fair ? "" : " Do not use Eq. (16) here.");
}

std::string law_verdict(const StudyResult& result) {
  const auto over_rms_height = [&](const char* length) {
    return result.fitted(std::string(length) + "_over_rms_height").mean;
  };
  const std::optional<LawDescription> law = result.law_description();
  if (!law) return "";
  const EnsembleMean bend = result.fitted("law_bend");
  const bool sample = !std::isnan(bend.low);
  std::string text = fmt::format(
      "  Over the fitted window the local l of boundary elements changes from {:.2f} h_rms "
      "(smallest gap) to {:.2f} h_rms (largest gap), by {:+.0f} %{}.\n  {}\n",
      over_rms_height("decay_length_at_min_gap"), over_rms_height("decay_length_at_max_gap"),
      100 * bend.mean,
      sample ? fmt::format(" ({:+.0f} to {:+.0f} % at 95 %)", 100 * bend.low, 100 * bend.high) : "",
      in_words(*law, sample ? "these surfaces" : "this surface"));
  return text + fmt::format(
                    "  Fits to parts of the window give l from {:.2f} to {:.2f} h_rms; a fit with "
                    "equal weights, not weights by gap, gives {:.2f} h_rms.\n",
                    over_rms_height("decay_length_min"), over_rms_height("decay_length_max"),
                    over_rms_height("decay_length_equal_weights"));
}

Json damping_columns(const StudyResult& result, ContactModel model) {
  Json columns =
      columns_json<DampingPoint>([&](const auto& number) { return result.damping(number, model); });
  for (const char* name :
       {"work_per_cycle_error", "damping_constant_error", "damping_constant_without_slip_error"})
    if (columns.contains(name)) columns[name] = to_json(result.damping(name, model));
  return columns;
}

std::string ensemble_warnings(const StudyResult& result) {
  std::string text;
  const std::vector<std::size_t> counts = result.convergence_counts();
  if (counts.size() >= 3) {
    const std::vector<EnsembleMean> means = result.convergence();
    text += "l/h_rms of boundary elements over the first surfaces\n";
    std::vector<std::vector<std::string>> rows{{"surfaces", "mean", "95 % interval"}};
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const std::size_t count = counts[i];
      if (!std::has_single_bit(count) && count != counts.back()) continue;
      const EnsembleMean& estimate = means[i];
      rows.push_back({fmt::format("{}", count),
                      std::isnan(estimate.mean) ? "n/a" : fmt::format("{:.4f}", estimate.mean),
                      interval(estimate, Dimension::dimensionless)});
    }
    text += to_table(rows) + "\n";
  }
  if (result.precision_reached)
    text += fmt::format("{} surfaces were enough for a precision of {:.2g} %.\n",
                        result.realisations.size(), 100 * result.configuration.target_precision);
  for (const EnsembleWarning& found : result.ensemble_warnings)
    text += "Warning: " + found.text + ".\n";
  return text;
}

AssumptionReport assumptions_of(const StudySolution& answer, const StudyResult& result) {
  return {.cases = answer.assumptions,
          .list = true,
          .pressures = result.pressures,
          .slip_followed = answer.slips()};
}

namespace {

constexpr const char* transport_names[] = {"thermal_conductance", "electrical_conductance"};

void add_transport(Json& answer, const StudyResult& result, const StudySolution& found) {
  const Json all = answer_json(found);
  if (result.configuration.conduction.given()) answer["conductance"]["pressure"] = result.pressures;
  for (const char* name : transport_names)
    if (all.contains(name)) answer["conductance"][name] = all[name];
  if (!result.configuration.flow_factors) return;
  Json& flow = answer["flow_factors"];
  flow["pressure"] = result.pressures;
  for (const auto& [name, percolates] : {std::pair("percolates_x", &FlowFactors::percolates_x),
                                         {"percolates_y", &FlowFactors::percolates_y}})
    flow[name] = to_json(
        result.flow([percolates = percolates](const FlowFactors& one) { return one.*percolates; }));
  flow.add(columns_json<FlowFactors>([&](const auto& number) { return result.flow(number); }));
}

void add_adhesion(Json& answer, const StudyResult& result) {
  if (!result.configuration.adhesion || result.configuration.adhesion->cycle.empty()) return;
  Json& adhesion = answer["adhesion"];
  adhesion["mean_gap"] = result.configuration.adhesion->cycle;
  adhesion.add(
      columns_json<AdhesionSample>([&](const auto& number) { return result.adhesion(number); }));
  adhesion.add(columns_json<AdhesiveCycleNumbers>(
      [&](const auto& number) { return result.adhesion_cycle(number); }));
  adhesion["reversible"] = to_json(result.adhesion_cycle(reversible_share));
}

}  // namespace

double reversible_share(const AdhesiveCycleNumbers& cycle) {
  const std::optional<bool> reversible = cycle.reversible();
  return reversible ? double(*reversible) : ForceSample::unknown;
}

Json damping_json(const StudySolution& answer) {
  Json object = answer_json(answer);
  object["relaxation_share"] = answer.relaxation_share;
  object["slip_share"] = answer.slip_share;
  for (const char* name : transport_names) object.erase(name);
  return object;
}

void add_ensemble(Json& answer, const StudyResult& result, const StudySolution& found) {
  add_transport(answer, result, found);
  add_adhesion(answer, result);
  answer["realisations"] = result.realisations.size();
  Json& ensemble = answer["ensemble_warnings"] = Json::object();
  for (const EnsembleWarning& found : result.ensemble_warnings) ensemble[found.name] = found.text;
  if (!std::isnan(result.configuration.known.hardness))
    answer["first_loading"] = columns_json<FirstLoading>([&](const auto& number) {
      return result.mean([&](const Realisation& r) { return number(r.first_loading); });
    });
  if (!result.configuration.adhesion) assumptions_of(found, result).add_to(answer);
}

}  // namespace salebra::cli
