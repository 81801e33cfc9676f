// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_answer.hpp>
#include <string>
#include <vector>

#include "options.hpp"
#include "premise_options.hpp"
#include "results/answer_json.hpp"
#include "results/describe.hpp"
#include "session.hpp"

/// What `study` and `compare` have in common.
namespace salebra::cli {

struct StudyArguments {
  std::string configuration;
  SurfaceOptions surface;
  MaterialOptions material;
  MotionOptions motion;
  PremiseOptions premises;
  std::vector<double> pressures;
  std::optional<double> precision, relative_error;
  std::optional<int> levels;
  std::string seam_error;
  bool no_stick = false;
  bool resume = false;
  DryRunOptions dry_run;
  std::optional<double> shard_seconds;
  std::optional<Shard> shard;
  bool merge = false;
  bool no_report = false;
  bool verbose = false;  ///< of study
  int groups = 0;  ///< of processes; 0: one

  /// over_processes: those of salebra-mpi may share the work.
  void add_to(Command& command, bool over_processes);
  /// The study file, or what a measured surface needs without one, with the options in place of
  /// what either says.
  StudyConfiguration study() const;
};

/// For commands that end in run_and_keep(), which looks at the output itself.
inline constexpr OutputCheck study_output = OutputCheck::by_command;

/// The page that lies beside the results of a study, made by the first process.
class StudyReport {
 public:
  /// Throws where the page cannot be put in its place, before any work. Collective. Nothing is
  /// planned where there is no output, where the user wants no page, or where this build cannot
  /// make one, which write() then says.
  StudyReport(const StudyArguments& arguments, Session& session);
  /// Writes what was planned, from the results file; its path, or empty. Of several processes the
  /// first does so. The results are safe by now, and their answer comes first: a page that is in
  /// the way is a warning, and one that could not be written is thrown by require_written().
  std::string write();
  /// Throws IoError where the system refused the page. Collective.
  void require_written() const;
  /// Makes the page where none was made of these results yet, as of a study that was killed before
  /// it; otherwise returns the path alone.
  std::string complete();

 private:
  Session& session_;
  bool lacks_assets_ = false;
  std::filesystem::path page_;
  std::string failure_;
};

/// Where a run left its results and their page; empty: nowhere.
struct StudyFiles {
  std::string results, report;

  Json json() const;
  std::string text() const;
};

/// Runs the ensembles with progress, keeps finished surfaces beside the session's output as it
/// goes, and writes the result there. Without an output nothing is kept. Where a resumed study has
/// its result already, tidies up after it, makes a page that is missing, answers so and returns
/// nothing. With --merge nothing is computed: throws Incomplete where surfaces are missing.
/// Otherwise returns at least one finished surface; what stopped the run before its end throws
/// Interrupted, which says how to continue, after the surfaces that were finished have been
/// answered where they are not kept.
std::vector<StudyResult> run_and_keep(const StudyConfiguration& configuration,
                                      const StudyArguments& arguments, StudyReport& page,
                                      Session& session);

/// The file of a measured surface, which no option names.
void name_surface(const StudyConfiguration& configuration, Session& session);

/// What ends a command before its results: --dry-run and --shard. False where there is neither.
bool run_without_results(const StudyConfiguration& configuration, const StudyArguments& arguments,
                         Session& session);

/// An object with to_json(means(number)) for every number that the description of T names.
template <Described T, class MeansOf>
Json columns_json(const MeansOf& means) {
  Json object = Json::object();
  for_each_number<T>([&](const NumberOf<T>& number, const Quantity& quantity) {
    object[std::string(quantity.name)] = to_json(means(number));
  });
  return object;
}
/// Throws NotConverged where a relative error was requested and is not met: the loads, with what
/// was reached.
void require_relative_error(const std::vector<StudyResult>& results);
/// "low … high"; empty where there is no interval.
std::string interval(const EnsembleMean& estimate, Dimension dimension, int digits = 4);
std::string describe_motion(const Oscillation& motion);
/// Size, roughness and moduli of the surfaces.
std::string heading(const StudyResult& result);
/// One sentence: "F ~ exp(-gap/l) is a poor description of this surface: …". what: "this surface".
std::string in_words(const LawDescription& law, const std::string& what);
/// Whether the exponential law holds, in a sentence.
std::string law_verdict(const StudyResult& result);
/// How the mean of l/h_rms settled, and what else may be wrong with the ensemble.
std::string ensemble_remarks(const StudyResult& result);
Json flags_json(const StudyResult& result);

/// Adds `first_loading`, where a hardness is known.
void add_first_loading(Json& answer, const StudyResult& result);
/// The premises of an answer with a list of pressures.
PremiseReport premises_of(const StudyAnswer& answer, const StudyResult& result);
/// γ and work of the motion as described, with the shares of slip and the regime.
Json damping_json(const StudyAnswer& answer);

}  // namespace salebra::cli
