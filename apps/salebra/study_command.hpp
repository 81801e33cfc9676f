// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/figures/figure.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <string>
#include <vector>

#include "assumption_options.hpp"
#include "options.hpp"
#include "results/answer_json.hpp"
#include "results/describe.hpp"
#include "session.hpp"

/// Common part of `salebra study` and `salebra compare`.
namespace salebra::cli {

struct StudyArguments {
  std::string twin, configuration;
  std::vector<std::string> names;  ///< of `study`: study file and surfaces
  std::string csv;                 ///< of `study`: table of several surfaces
  SurfaceOptions surface;
  MaterialOptions material;
  Conduction conduction;
  MotionOptions motion;
  AssumptionOptions assumptions;
  std::vector<double> pressures;
  std::optional<double> precision, relative_error;
  std::optional<int> intervals;
  std::string seam_error, direction;
  bool no_stick = false, flow_factors = false;
  bool resume = false;
  DryRunOptions dry_run;
  std::optional<double> shard_seconds;
  std::optional<Shard> shard;
  bool merge = false;
  bool no_report = false;
  bool verbose = false;                 ///< only an option of `study`
  bool sensitivity = false;             ///< only an option of `study`
  std::vector<std::string> tolerances;  ///< of `study`: NAME=VALUE
  int groups = 0;                       ///< number of groups of processes; 0: one group

  /// over_processes: whether several processes of salebra-mpi may compute the study, and whether it
  /// takes several surfaces.
  void add_to(Command& command, bool over_processes);
  /// The study in the study file, or the default study of a measured surface, after the options
  /// have replaced its values.
  StudyConfiguration study() const;
};

/// How commands check --output that end in run_study(), which checks the file itself.
inline constexpr OutputCheck study_output = OutputCheck::by_command;

/// The answer for the ensemble at one point of the parameter grid.
struct PointAnswer {
  Json answer;
  std::string text;
  figures::Figure more = {};  ///< panels that follow those of the study, if it has one point
};

/// Runs a study, draws its picture, keeps it, and answers with answer_point for each point of the
/// parameter grid; --dry-run and --shard have their own answers. --merge computes nothing, and
/// throws Incomplete if surfaces are missing. A run that is stopped throws Interrupted, whose
/// message says how to continue; if finished surfaces are not kept in files, they are answered
/// first. Throws NotConverged if a requested relative error is not reached. command: name of the
/// command.
void run_study(const std::string& command, const StudyConfiguration& configuration,
               const StudyArguments& arguments, Session& session,
               const std::function<PointAnswer(const StudyResult&)>& answer_point);

/// JSON object with a member to_json(means(number)) for every number in the description of T.
template <Described T, class MeansOf>
Json columns_json(const MeansOf& means) {
  Json object = Json::object();
  for_each_number<T>([&](const NumberOf<T>& number, const Quantity& quantity) {
    object[std::string(quantity.name)] = to_json(means(number));
  });
  return object;
}
/// 1 if the loading cycle of a surface has no hysteresis, otherwise 0. The mean over surfaces is
/// thus the fraction of surfaces without hysteresis.
double reversible_share(const AdhesiveCycleNumbers& cycle);
/// The limits of an estimate as "low … high"; empty if it has no interval.
std::string interval(const EnsembleMean& estimate, Dimension dimension, int digits = 4);
/// Text about the size, the roughness and the moduli of the surfaces, printed above the results.
std::string heading(const StudyResult& result);
/// The verdict on the exponential law in words, such as "F ~ exp(-gap/l) is a poor description of
/// this surface: …". what: what the law describes, such as "this surface".
std::string in_words(const LawDescription& law, const std::string& what);
/// The verdict on the exponential law for the mean curve of the study.
std::string law_verdict(const StudyResult& result);
/// Text about the convergence of the mean of l/h_rms with the number of surfaces, and the warnings
/// of the ensemble.
std::string ensemble_warnings(const StudyResult& result);

/// Numbers of the losses of a model over the pressures, with means and intervals. The error of a
/// loss is the stated error of its mean over the surfaces, as in tables, result files and Python,
/// and not the mean over those surfaces whose error is known.
Json damping_columns(const StudyResult& result, ContactModel model);
/// The assumptions of an answer with a list of pressures.
AssumptionReport assumptions_of(const StudySolution& answer, const StudyResult& result);
/// JSON of the damping constant γ and the loss of the motion as the user described it, with the
/// fractions of relaxation and slip.
Json damping_json(const StudySolution& answer);
/// Adds to the answer the number of surfaces, warnings and assumptions and, if the study has them,
/// conductances, flow factors and the first loading.
void add_ensemble(Json& answer, const StudyResult& result, const StudySolution& found);

}  // namespace salebra::cli
