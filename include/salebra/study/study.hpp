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

/// A warning on a result: it is that of the residual surface, or it may be biased, not only
/// scattered.
struct EnsembleWarning {
  std::string name;  ///< "first_loading", "finite_size", "discretisation", "twin" or "few_spots"
  std::string text;  ///< a sentence for the user
};

constexpr void describe(auto&& visit, std::type_identity<EnsembleWarning>) {
  visit(&EnsembleWarning::name, Kept{"name", "what may be off"});
  visit(&EnsembleWarning::text, Kept{"text", "a sentence for the user"});
}

/// A mean with its 95 % interval; NaN limits if unavailable.
struct EnsembleMean {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();

  /// Half the width of the interval over |mean|; NaN without one.
  double relative_precision() const;
};

/// The unit is that of the averaged number.
constexpr void describe(auto&& visit, std::type_identity<EnsembleMean>) {
  using S = EnsembleMean;
  visit(&S::mean, Kept{"mean", "mean over the surfaces"});
  visit(&S::low, Kept{"low", "lower limit of the interval"});
  visit(&S::high, Kept{"high", "upper limit of the interval"});
  visit(&S::relative_precision,
        Kept{"relative_precision", "half the width of the interval over the mean"});
}

/// Whether the mean over the first `surfaces` of an ensemble is evaluated on its own, for a
/// convergence curve and for the precision: every number from 2 to 128, and 32 numbers in each
/// doubling beyond. With intervals for every number the time would grow with the square of the
/// surfaces.
bool is_milestone(std::size_t surfaces);

/// A mean with its numerical error (intervals, cells, stiffness ratio, seam), which is separate
/// from its 95 % interval.
struct StatedMean : EnsembleMean {
  double error = ForceSample::unknown;  ///< NaN if unknown
};

constexpr void describe(auto&& visit, std::type_identity<StatedMean>) {
  describe(visit, std::type_identity<EnsembleMean>{});
  visit(&StatedMean::error, Kept{"error", "numerical error of the mean"});
}

/// Deviation of the loss by the fitted law from that of the curve.
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

/// Predictions of closed theories for the surfaces of a study.
struct StudyTheories {
  double bgt_area_slope = 0;              ///< slope of A/A0 over p/(E*h') as p → 0: √(2π)
  double persson_area_slope = 0;          ///< √(8/π)
  std::vector<double> relative_pressure;  ///< p/(E*h') of each pressure
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
  StudyConfiguration configuration;  ///< of this point, with empty ensemble lists
  Grid2D grid;
  double contact_scale = 0;  ///< E*h'_rms, Pa: the unit of relative pressures
  std::vector<double> pressures;
  std::vector<Realisation> realisations;
  std::vector<std::string> warnings;  ///< sentences for the user
  std::vector<EnsembleWarning> ensemble_warnings;
  bool interrupted = false;        ///< realisations has only the finished ones
  bool precision_reached = false;  ///< fewer realisations than seeds sufficed

  std::vector<StudyModel> models() const { return models_of(configuration); }
  /// Mean over realisations of a number of a realisation, or of a model on it.
  EnsembleMean mean(const NumberOf<Realisation>& number) const;
  EnsembleMean mean(const NumberOf<ModelResult>& number, ContactModel model) const;
  /// Mean over realisations; a single surface has no interval.
  EnsembleMean decay_length(ContactModel model = ContactModel::bem) const;
  EnsembleMean decay_length_over_rms_height(ContactModel model = ContactModel::bem) const;
  /// mean() of a column of ModelResult, such as "area_slope" or "law_bend". Throws InvalidInput for
  /// an unknown name.
  EnsembleMean fitted(std::string_view column, ContactModel model = ContactModel::bem) const;

  /// Compares the exponential law with the mean curve of a model; empty where no local l is known.
  std::optional<LawDescription> law_description(ContactModel model = ContactModel::bem) const;

  StudyTheories theories() const;

  /// Means over realisations at each pressure; contacts that did not converge are left out.
  std::vector<EnsembleMean> at_pressures(
      const std::function<double(const Realisation&, std::size_t)>& number) const;
  std::vector<EnsembleMean> curve(const NumberOf<ForceSample>& number,
                                  ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> damping(const NumberOf<DampingPoint>& number,
                                    ContactModel model = ContactModel::bem) const;
  /// A quantity of DampingPoint as answers and files state it: stated() where it has a numerical
  /// error, deviation(), and otherwise the mean over realisations. Throws InvalidInput for an
  /// unknown name.
  std::vector<EnsembleMean> damping(std::string_view quantity,
                                    ContactModel model = ContactModel::bem) const;
  /// The mean of damping_constant_closed_form over that of damping_constant_without_slip, minus 1;
  /// it compares the two columns and is not the mean of the ratios of single surfaces. To first
  /// order in the scatter, its interval is that of the mean of γ16/⟨γ⟩ − r(γ/⟨γ⟩ − 1) over the
  /// surfaces, with the ratio r of the means.
  std::vector<EnsembleMean> deviation(ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> spots(const NumberOf<SpotStatistics>& number) const;
  /// Means of flow numbers over the surfaces whose gap percolates. The mean of
  /// FlowFactors::percolates_x is the fraction of surfaces that do.
  std::vector<EnsembleMean> flow(const NumberOf<FlowFactors>& number) const;
  /// Means at each mean gap of the adhesive cycle, and for the whole cycle; contacts that did not
  /// converge are left out.
  std::vector<EnsembleMean> adhesion(const NumberOf<AdhesionSample>& number) const;
  EnsembleMean adhesion_cycle(const NumberOf<AdhesiveCycleNumbers>& number) const;
  /// Conductances from K of the boundary elements, as configured; empty otherwise. Each is K times
  /// a constant, and so is its interval.
  std::vector<EnsembleMean> conductance(double Conductances::*kind) const;
  /// A quantity of a model over that of the boundary elements on the same surface.
  std::vector<EnsembleMean> over_bem(const NumberOf<ForceSample>& number, ContactModel model) const;
  /// A loss of a model over that of the boundary elements on the same surface without slip.
  std::vector<EnsembleMean> damping_over_bem(const NumberOf<DampingPoint>& number,
                                             ContactModel model) const;
  /// The ratios of a model that files and answers contain, by the names of their quantities.
  std::vector<std::pair<std::string, std::vector<EnsembleMean>>> comparison(
      ContactModel model) const;

  /// work_per_cycle or damping_constant, with or without slip, at each pressure with its numerical
  /// error: the mean relative error of the surfaces that have one, with their noise over √n, times
  /// the mean. The mean is NaN if it is no larger than its error. Throws InvalidInput for an
  /// unknown name.
  std::vector<StatedMean> stated(std::string_view quantity,
                                 ContactModel model = ContactModel::bem) const;

  /// Range of deviation() over the pressures.
  DeviationRange deviation_range(ContactModel model = ContactModel::bem) const;
  /// Numbers of surfaces of convergence(): the milestones, and all.
  std::vector<std::size_t> convergence_counts() const;
  /// Mean l/h_rms of the boundary elements over the first convergence_counts() realisations: the
  /// convergence of the mean.
  std::vector<EnsembleMean> convergence() const;
  /// For a surface twin, the fraction of the variance of ln W over the surfaces that the scans
  /// leave open: 1 minus the variance within pairs of surfaces that share a spectrum over that of
  /// all, averaged over the pressures. The rest is variation from place to place, which larger
  /// surfaces reduce. NaN for other ensembles and below three pairs.
  double scan_share() const;
  /// One line on how the intervals were computed.
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
  visit(&S::ensemble_warnings, Kept{"ensemble_warnings", "why the result may be off for other reasons than chance"});
  visit(&S::interrupted, Kept{"interrupted", "whether surfaces that were asked for are missing"});
  visit(&S::precision_reached,
        Kept{"precision_reached", "whether fewer surfaces than seeds were enough"});
}

/// Report on one finished surface, on the thread that called the run.
struct RealisationReport {
  std::size_t point = 0, points = 1;     ///< of the parameter grid
  std::size_t finished = 0, wanted = 0;  ///< surfaces, over all points
  std::uint64_t seed = 0;
  double seconds = 0;     ///< computing time; 0 if it was on the disk already
  bool restored = false;  ///< read, not computed
};

/// How a study runs: callbacks, storage of its parts, and the processes that share it.
struct StudyRun {
  Progress on_progress = {};  ///< of the whole run
  std::function<void(const RealisationReport&)> on_realisation = {};
  /// Called before the work, in every process, with each of StudyResult::warnings that is known by
  /// then.
  std::function<void(const std::string&)> on_warning = {};
  /// Realisations in it are not computed again; a new one is on the disk before its thread begins
  /// another.
  StudyParts* parts = nullptr;
  /// If given, nothing is computed: it receives the indices, counted from 0 over all points and
  /// seeds in their order, of the realisations that `parts` lacks. If there are none, the results
  /// are those of a whole run.
  std::vector<std::size_t>* missing = nullptr;
  /// The processes of the run: each group spreads one surface after the other over its processes.
  /// All make the call, each with its own on_progress, and get the same results. Only the first
  /// process uses on_realisation and `parts`.
  Groups groups = {};
};

/// Progress of one process with its shard of a study.
struct ShardOutcome {
  std::size_t wanted = 0;     ///< surfaces of this shard
  std::size_t present = 0;    ///< finished earlier or by other processes
  std::size_t computed = 0;   ///< in this run
  std::size_t elsewhere = 0;  ///< being computed by other processes, of any shard
  int damaged = 0;            ///< files removed, their surfaces computed again
  bool interrupted = false;
};

/// Computes the surfaces of a shard that the folder lacks, and stores them there. Any number of
/// processes may do so at once, on any hosts that see the folder.
///
///     auto parts = StudyParts::of_shard("study.parts", shard);
///     ShardOutcome outcome = run_shard(study, shard, {.parts = parts.get()});
///
/// run_ensembles() with `missing` then assembles the result, with the bits of one process. A
/// precision does not end a numbered shard early, because other shards have the surfaces in
/// between; Shard::any() checks it before each surface. Shard::any() claims a surface by a file
/// that it locks until its process ends.
/// throws  InvalidInput for a configuration that cannot be run, and for parts none of which belongs
///         to it; NotConverged and IoError as run_ensembles()
ShardOutcome run_shard(const StudyConfiguration& configuration, const Shard& shard,
                       const StudyRun& run);

/// Computes the ensembles of every point of the parameter grid, in the order of
/// parameter_combinations(), by analyse_realisation() of every surface, in parallel over surfaces.
///
///     StudyRun run{.on_progress = progress};
///     std::vector<StudyResult> results = run_ensembles(study, run);
///
/// With a precision, a point ends at the first M >= min_realisations surfaces (in the order of the
/// seeds, M a milestone) for which the 95 % intervals of l/h_rms and of κ of the boundary elements
/// are narrower than ±precision of their means. The result has the same bits for every number of
/// threads, processes and groups. If the run is stopped, points not yet begun are left out. A
/// measured surface is treated as periodic after its plane is removed; the result carries a warning
/// with the size of the resulting step at the seam.
/// throws  InvalidInput for a configuration that cannot be run, such as one with a hardness, a
///         relative error or interacting summits over several processes of a group, and for parts
///         none of which belongs to it; NotConverged where fewer than four contacts of a sweep
///         converged; IoError where a part cannot be written
/// cost    the BEM sweep for each surface; interacting summits cost about as much again
std::vector<StudyResult> run_ensembles(const StudyConfiguration& configuration,
                                       const StudyRun& run = {});

/// Runs a configuration with one point by run_ensembles(). Throws InvalidInput where it has more.
StudyResult run_study(const StudyConfiguration& configuration, const StudyRun& run = {});

}  // namespace salebra
