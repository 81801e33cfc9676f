// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <string>
#include <vector>

#include "options.hpp"
#include "assumption_options.hpp"
#include "results/answer_json.hpp"
#include "results/describe.hpp"
#include "session.hpp"

/// What `study` and `compare` have in common.
namespace salebra::cli {

struct StudyArguments {
  std::string twin, configuration;
  SurfaceOptions surface;
  MaterialOptions material;
  Conduction conduction;
  MotionOptions motion;
  AssumptionOptions assumptions;
  std::vector<double> pressures;
  std::optional<double> precision, relative_error;
  std::optional<int> intervals;
  std::string seam_error;
  bool no_stick = false, flow_factors = false;
  bool resume = false;
  DryRunOptions dry_run;
  std::optional<double> shard_seconds;
  std::optional<Shard> shard;
  bool merge = false;
  bool no_report = false;
  bool verbose = false;  ///< of study
  int groups = 0;        ///< of processes; 0: one

  /// over_processes: those of salebra-mpi may share the work.
  void add_to(Command& command, bool over_processes);
  /// The study file, or what a measured surface needs without one, with the options in place of
  /// what either says.
  StudyConfiguration study() const;
};

/// For commands that end in run_study(), which looks at the output itself.
inline constexpr OutputCheck study_output = OutputCheck::by_command;

/// What a command says of the ensemble at one point.
struct PointAnswer {
  Json answer;
  std::string text;
};

/// Runs, plots and keeps a study, and answers with what answer_point says of each point, or in its
/// place with what --dry-run and --shard ask for. With --merge nothing is computed: throws
/// Incomplete where surfaces are missing. What stopped the run before its end throws Interrupted,
/// which says how to continue, after the surfaces that were finished have been answered where they
/// are not kept. Throws NotConverged where a relative error was requested and is not met.
/// command: its name.
void run_study(const std::string& command, const StudyConfiguration& configuration,
               const StudyArguments& arguments, Session& session,
               const std::function<PointAnswer(const StudyResult&)>& answer_point);

/// An object with to_json(means(number)) for every number that the description of T names.
template <Described T, class MeansOf>
Json columns_json(const MeansOf& means) {
  Json object = Json::object();
  for_each_number<T>([&](const NumberOf<T>& number, const Quantity& quantity) {
    object[std::string(quantity.name)] = to_json(means(number));
  });
  return object;
}
/// 1 of a cycle without hysteresis: its mean is the share of the surfaces.
double reversible_share(const AdhesiveCycleNumbers& cycle);
/// "low … high"; empty where there is no interval.
std::string interval(const EnsembleMean& estimate, Dimension dimension, int digits = 4);
/// Size, roughness and moduli of the surfaces.
std::string heading(const StudyResult& result);
/// One sentence: "F ~ exp(-gap/l) is a poor description of this surface: …". what: "this surface".
std::string in_words(const LawDescription& law, const std::string& what);
/// Whether the exponential law holds, in a sentence.
std::string law_verdict(const StudyResult& result);
/// How the mean of l/h_rms settled, and what else may be wrong with the ensemble.
std::string ensemble_warnings(const StudyResult& result);
/// The assumptions of an answer with a list of pressures.
AssumptionReport assumptions_of(const StudySolution& answer, const StudyResult& result);
/// γ and work of the motion as described, with the shares of slip.
Json damping_json(const StudySolution& answer);
/// Adds conductances and flow factors where the study asks for them, how many surfaces there are,
/// what is wrong with them, their first loading where a hardness is known, and the assumptions.
void add_ensemble(Json& answer, const StudyResult& result, const StudySolution& found);

}  // namespace salebra::cli
