// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <salebra/base/communicator.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/realisation.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace salebra {

class StudyParts;
struct Shard;

/// What a reader has to know of a result: that it is of the residual surface, or why it may be off
/// for other reasons than chance.
struct StudyFlag {
  std::string name;  ///< "first_loading", "finite_size", "discretisation", "twin" or "few_spots"
  std::string text;  ///< a sentence for the user
};

constexpr void describe(auto&& visit, std::type_identity<StudyFlag>) {
  visit(&StudyFlag::name, Kept{"name", "what may be off"});
  visit(&StudyFlag::text, Kept{"text", "a sentence for the user"});
}

/// A mean with its 95 % interval; NaN limits if unavailable.
struct EnsembleMean {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();

  /// Half the width of the interval over |mean|; NaN without one.
  double relative_precision() const;
};

/// Their unit is that of what the mean is of.
constexpr void describe(auto&& visit, std::type_identity<EnsembleMean>) {
  using S = EnsembleMean;
  visit(&S::mean, Kept{"mean", "mean over the surfaces"});
  visit(&S::low, Kept{"low", "lower limit of the interval"});
  visit(&S::high, Kept{"high", "upper limit of the interval"});
  visit(&S::relative_precision,
        Kept{"relative_precision", "half the width of the interval over the mean"});
}

/// Whether the mean over the first `surfaces` of an ensemble is looked at on its own, for a
/// convergence curve and for the precision: every number from 2 to 128, beyond that 32 numbers in
/// each doubling. Intervals for every number would take a time that grows with the square of the
/// surfaces.
bool is_milestone(std::size_t surfaces);

/// A mean with its numerical error, which is no interval: levels, cells, stiffness ratio, seam.
struct StatedMean : EnsembleMean {
  double error = ForceSample::unknown;  ///< NaN where it is not known
};

constexpr void describe(auto&& visit, std::type_identity<StatedMean>) {
  describe(visit, std::type_identity<EnsembleMean>{});
  visit(&StatedMean::error, Kept{"error", "numerical error of the mean"});
}

/// How far the loss by the fitted law is off that of the curve.
struct DeviationRange {
  double deviation_min = 0, deviation_max = 0;  ///< of StudyResult::deviation(); NaN without any
};

constexpr void describe(auto&& visit, std::type_identity<DeviationRange>) {
  using enum Dimension;
  using S = DeviationRange;
  visit(&S::deviation_min,
        Quantity{"deviation_min", dimensionless, "minimum deviation over the pressures"});
  visit(&S::deviation_max,
        Quantity{"deviation_max", dimensionless, "maximum deviation over the pressures"});
}

/// What closed theories say of the surfaces of a study.
struct StudyTheories {
  double bgt_area_slope = 0;                        ///< of A/A0 over p/(E*h') as p → 0: √(2π)
  double persson_area_slope = 0;                    ///< √(8/π)
  std::vector<double> relative_pressure;            ///< p/(E*h') of each pressure
  std::vector<EnsembleMean> bearing_area_fraction;  ///< at the mean gaps of the boundary elements
  /// u0/h_rms and K = pA0/u0 of Campañá, Persson and Müser; unknown and empty without
  /// ContactModel::persson.
  EnsembleMean decay_length_over_rms_height;
  std::vector<EnsembleMean> normal_stiffness;
};

constexpr void describe(auto&& visit, std::type_identity<StudyTheories>) {
  using enum Dimension;
  using S = StudyTheories;
  visit(&S::bgt_area_slope,
        Quantity{"bgt_area_slope", dimensionless, "area slope of Bush, Gibson and Thomas"});
  visit(&S::persson_area_slope,
        Quantity{"persson_area_slope", dimensionless, "area slope of Persson's theory"});
  visit(&S::relative_pressure,
        Quantity{"relative_pressure", dimensionless, "nominal pressure over E* times rms slope"});
  visit(&S::bearing_area_fraction,
        Quantity{"bearing_area_fraction", dimensionless,
                 "part of the undeformed surface above the mean gap of the contact"});
  visit(&S::decay_length_over_rms_height,
        Kept{"decay_length_over_rms_height", "decay length by the simple theory over rms height"});
  visit(&S::normal_stiffness,
        Kept{"normal_stiffness", "normal stiffness by the simple theory", stiffness});
}

/// The ensemble at one point of the parameter grid.
struct StudyResult {
  StudyConfiguration configuration;  ///< of this point: its ensemble lists are empty
  Grid2D grid;
  double contact_scale = 0;  ///< E*h'_rms, Pa: the unit of relative pressures
  std::vector<double> pressures;
  std::vector<Realisation> realisations;
  std::vector<std::string> warnings;  ///< sentences for the user
  std::vector<StudyFlag> flags;
  bool interrupted = false;        ///< realisations holds those that were finished
  bool precision_reached = false;  ///< fewer realisations than seeds were enough

  std::vector<StudyModel> models() const { return models_of(configuration); }
  /// Mean over the realisations of a number that belongs to one, or to what a model says of one.
  EnsembleMean mean(const NumberOf<Realisation>& number) const;
  EnsembleMean mean(const NumberOf<ModelResult>& number, ContactModel model) const;
  /// Mean over the realisations; one surface has no interval.
  EnsembleMean decay_length(ContactModel model = ContactModel::bem) const;
  EnsembleMean decay_length_over_rms_height(ContactModel model = ContactModel::bem) const;
  /// mean() of a column of ModelResult, such as "area_slope" or "law_bend". Throws InvalidInput for
  /// another name.
  EnsembleMean fitted(std::string_view column, ContactModel model = ContactModel::bem) const;

  /// The exponential law against the mean curve of a model; none where no local l is known.
  std::optional<LawDescription> law_description(ContactModel model = ContactModel::bem) const;

  StudyTheories theories() const;

  /// Means of a quantity of each pressure, in the order of pressures; contacts that did not
  /// converge take no part.
  std::vector<EnsembleMean> at_pressures(
      const std::function<double(const Realisation&, std::size_t)>& number) const;
  std::vector<EnsembleMean> curve(const NumberOf<ForceSample>& number,
                                  ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> damping(const NumberOf<DampingPoint>& number,
                                    ContactModel model = ContactModel::bem) const;
  /// A quantity of DampingPoint as answers and files have it: stated() where it has a numerical
  /// error, deviation(), and otherwise the mean over the surfaces. Throws InvalidInput for another
  /// name.
  std::vector<EnsembleMean> damping(std::string_view quantity,
                                    ContactModel model = ContactModel::bem) const;
  /// The mean of damping_constant_closed_form over that of damping_constant_without_slip, less 1: what
  /// the two columns say, which is not the mean of the ratios of single surfaces. Its interval is that of
  /// the mean of γ16/⟨γ⟩ − r(γ/⟨γ⟩ − 1) over the surfaces, r the ratio of the means: the ratio to
  /// first order in the scatter.
  std::vector<EnsembleMean> deviation(ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> spots(const NumberOf<SpotStatistics>& number) const;
  /// Over the surfaces whose gap lets pass a flow, where the number is one of the flow. The mean of
  /// FlowFactors::percolates_x is the part of the surfaces that do.
  std::vector<EnsembleMean> flow(const NumberOf<FlowFactors>& number) const;
  /// At each mean gap of the cycle of adhesive contacts, and of the cycle; contacts that did not
  /// converge take no part.
  std::vector<EnsembleMean> adhesion(const NumberOf<AdhesionSample>& number) const;
  EnsembleMean adhesion_cycle(const NumberOf<AdhesiveCycleNumbers>& number) const;
  /// Those that the configuration asks about, of the boundary elements' K; empty: not asked. Each is
  /// K times a constant, and so is its interval.
  std::vector<EnsembleMean> conductance(double Conductances::*kind) const;
  /// A quantity of a model over that of the boundary elements on the same surface.
  std::vector<EnsembleMean> over_bem(const NumberOf<ForceSample>& number, ContactModel model) const;
  /// A loss of a model over that of the boundary elements on the same surface without slip.
  std::vector<EnsembleMean> damping_over_bem(const NumberOf<DampingPoint>& number,
                                             ContactModel model) const;
  /// Those ratios of a model that files and answers have, by the names of their quantities.
  std::vector<std::pair<std::string, std::vector<EnsembleMean>>> comparison(
      ContactModel model) const;

  /// work_per_cycle, damping_constant or one of both without slip, at each pressure with its
  /// numerical error: the mean relative error of the surfaces that have one, with their noise over
  /// √n, times the mean. The mean is NaN where the error is not smaller. Throws InvalidInput for
  /// another name.
  std::vector<StatedMean> stated(std::string_view quantity,
                                 ContactModel model = ContactModel::bem) const;

  /// Over the pressures.
  DeviationRange deviation_range(ContactModel model = ContactModel::bem) const;
  /// The numbers of surfaces of convergence(): the milestones, and all.
  std::vector<std::size_t> convergence_counts() const;
  /// The mean of l/h_rms of the boundary elements over the first convergence_counts() realisations:
  /// how the mean converges.
  std::vector<EnsembleMean> convergence() const;
  /// Of a surface twin, the part of the variance of ln W over the surfaces that the scans leave open:
  /// one less the variance within pairs of surfaces that share a spectrum over that of all, the mean
  /// over the pressures. What remains is chance from place to place, which larger surfaces reduce.
  /// NaN of another ensemble and below three pairs.
  double scan_share() const;
  /// How the intervals came about: one line.
  std::string interval_method() const;
};

constexpr void describe(auto&& visit, std::type_identity<StudyResult>) {
  using S = StudyResult;
  visit(&S::configuration, Kept{"configuration", "what decides the result"});
  visit(&S::grid, Kept{"grid", "points and size"});
  visit(&S::contact_scale,
        Kept{"contact_scale", "E* times rms slope: the unit of relative pressures",
             Dimension::pressure});
  visit(&S::pressures, Kept{"pressures", "nominal pressures", Dimension::pressure});
  visit(&S::realisations, Kept{"realisations", "what was computed for each surface"});
  visit(&S::warnings, Kept{"warnings", "sentences for the user"});
  visit(&S::flags, Kept{"flags", "why the result may be off for other reasons than chance"});
  visit(&S::interrupted, Kept{"interrupted", "whether surfaces that were asked for are missing"});
  visit(&S::precision_reached,
        Kept{"precision_reached", "whether fewer surfaces than seeds were enough"});
}

/// Report on one finished surface, on the thread that called the run.
struct RealisationReport {
  std::size_t point = 0, points = 1;     ///< of the parameter grid
  std::size_t finished = 0, wanted = 0;  ///< surfaces, over all points
  std::uint64_t seed = 0;
  double seconds = 0;     ///< that it took; 0 where it was on the disk already
  bool restored = false;  ///< read, not computed
};

/// How a study runs: who is told, where its parts are kept, and which processes share it.
struct StudyRun {
  Progress on_progress = {};  ///< of the whole run
  std::function<void(const RealisationReport&)> on_realisation = {};
  /// Called with each of StudyResult::warnings that is known before the work, before it begins, in
  /// every process.
  std::function<void(const std::string&)> on_warning = {};
  /// Realisations that it holds are not computed again; each that is computed is on the disk before
  /// its thread begins another.
  StudyParts* parts = nullptr;
  /// Where it is given, nothing is computed: it receives the places, from 0 on over all points and
  /// seeds in their order, of the realisations that `parts` lacks, and results are those of a whole
  /// run where there are none.
  std::vector<std::size_t>* missing = nullptr;
  /// The processes that make the run together: each group spreads one surface after the other over
  /// its processes. All make the call, each with its own on_progress, and get the same results.
  /// on_realisation and `parts` are of the first process alone.
  Groups groups = {};
};

/// How far one process has come with its share of a study.
struct ShardOutcome {
  std::size_t wanted = 0;     ///< surfaces of this shard
  std::size_t present = 0;    ///< that other processes, or earlier ones, had finished
  std::size_t computed = 0;   ///< in this run
  std::size_t elsewhere = 0;  ///< of any shard: that other processes are computing
  int damaged = 0;            ///< files that were removed, their surfaces computed again
  bool interrupted = false;
};

/// Computes the surfaces of a shard that the folder lacks, and leaves them there: any number of
/// processes may do so at once, on any hosts that see the folder. run.parts is
/// StudyParts::of_shard(). run_ensembles() with `missing` puts the result together, with the bits
/// of one process. A precision ends no numbered shard early, as others hold the surfaces between;
/// Shard::any() heeds it before each surface. Shard::any() claims a surface by a file that it
/// locks, and that ends with its process.
/// throws  InvalidInput for a configuration that cannot be run, and for parts none of which belongs
///         to it; NotConverged and IoError as run_ensembles()
ShardOutcome run_shard(const StudyConfiguration& configuration, const Shard& shard,
                       const StudyRun& run);

/// The ensembles of every point of the configuration's parameter grid, in the order of
/// parameter_combinations(): every surface through analyse_realisation(), in parallel over
/// surfaces. With a precision, a point ends at the first M >= min_realisations surfaces (in the
/// order of the seeds, M a milestone) for which the 95 % intervals of l/h_rms and of κ of the
/// boundary elements are narrower than ±precision of their means. The result has the same bits for
/// every number of threads, processes and groups. A point that was not begun when the run was
/// stopped is left out. A measured surface is treated as periodic after its plane is removed; the
/// result carries a warning with the size of the step that this makes at the seam.
/// throws  InvalidInput for a configuration that cannot be run, as one with a hardness, a relative
///         error or interacting summits over several processes of a group, and for parts none of
///         which belongs to it; NotConverged where fewer than four contacts of a sweep converged;
///         IoError where a part cannot be written
/// cost    the BEM sweep, for each surface; interacting summits cost about as much again
std::vector<StudyResult> run_ensembles(const StudyConfiguration& configuration,
                                       const StudyRun& run = {});

/// run_ensembles() of a configuration with one point. Throws InvalidInput where it has more.
StudyResult run_study(const StudyConfiguration& configuration, const StudyRun& run = {});

}  // namespace salebra
