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

/// A warning about an ensemble: its results are those of the residual surface, or they may have a
/// systematic error in addition to their scatter.
struct EnsembleWarning {
  std::string name;  ///< "first_loading", "finite_size", "discretisation", "twin" or "few_spots"
  std::string text;  ///< a sentence for the user
};

constexpr void describe(auto&& visit, std::type_identity<EnsembleWarning>) {
  visit(&EnsembleWarning::name, Kept{"name", "what may be off"});
  visit(&EnsembleWarning::text, Kept{"text", "a sentence for the user"});
}

/// A mean over surfaces with its 95 % interval, in the unit of the averaged number; the limits are
/// NaN if there is no interval.
struct EnsembleMean {
  double mean = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN();
  double high = std::numeric_limits<double>::quiet_NaN();

  /// Half the width of the interval over |mean|; NaN without an interval.
  double relative_precision() const;
};

/// The columns have no unit of their own: it is the unit of the averaged number.
constexpr void describe(auto&& visit, std::type_identity<EnsembleMean>) {
  using S = EnsembleMean;
  visit(&S::mean, Kept{"mean", "mean over the surfaces"});
  visit(&S::low, Kept{"low", "lower limit of the interval"});
  visit(&S::high, Kept{"high", "upper limit of the interval"});
  visit(&S::relative_precision,
        Kept{"relative_precision", "half the width of the interval over the mean"});
}

/// Returns true if the mean over the first `surfaces` surfaces of an ensemble is evaluated, for the
/// convergence curve and for checking the precision. This is so for every number from 2 to 128 and,
/// above 128, for 32 numbers in each doubling. (If every number were evaluated, the time would grow
/// with the square of the number of surfaces.)
bool is_milestone(std::size_t surfaces);

/// A mean over surfaces with its numerical error (due to intervals, cells, stiffness ratio and
/// seam), which is not part of its 95 % interval.
struct StatedMean : EnsembleMean {
  double error = ForceSample::unknown;  ///< numerical error; NaN if unknown
};

constexpr void describe(auto&& visit, std::type_identity<StatedMean>) {
  describe(visit, std::type_identity<EnsembleMean>{});
  visit(&StatedMean::error, Kept{"error", "numerical error of the mean"});
}

/// Range over the pressures of the deviation of the loss by the fitted law from the loss by the
/// curve.
struct DeviationRange {
  double deviation_min = 0, deviation_max = 0;  ///< extremes of StudyResult::deviation(), or NaN
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
  double persson_area_slope = 0;          ///< the same of Persson's theory: √(8/π)
  std::vector<double> relative_pressure;  ///< p/(E*h') of each pressure
  std::vector<EnsembleMean> bearing_area_fraction;  ///< at mean gaps of the boundary elements
  /// Decay length u0 over h_rms, and K = pA0/u0 at each pressure, by Campañá, Persson and Müser;
  /// without ContactModel::persson NaN and empty.
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
  StudyConfiguration configuration;  ///< configuration of this point; its ensemble lists are empty
  Grid2D grid;
  double contact_scale = 0;  ///< E*h'_rms, Pa: the unit of relative pressures
  std::vector<double> pressures;
  std::vector<Realisation> realisations;
  std::vector<std::string> warnings;  ///< sentences for the user
  std::vector<EnsembleWarning> ensemble_warnings;
  bool interrupted = false;        ///< true: `realisations` has only the finished surfaces
  bool precision_reached = false;  ///< true: the precision was reached before all seeds

  std::vector<StudyModel> models() const { return models_of(configuration); }
  /// Direction of the tangential motion, from the x axis, rad: that of the boundary elements on the
  /// first surface; NaN if K_t has no direction.
  double direction() const;
  /// This result, followed by the same in the further directions of the tangential motion, if there
  /// are any: `across` the lay, then `along` it. They share all surfaces and normal contacts.
  std::vector<StudyResult> in_directions() const;
  /// Mean over realisations of a number of the realisation, or of a number of one model's result.
  EnsembleMean mean(const NumberOf<Realisation>& number) const;
  EnsembleMean mean(const NumberOf<ModelResult>& number, ContactModel model) const;
  /// Mean decay length over realisations, m and divided by h_rms; a single surface has no interval.
  EnsembleMean decay_length(ContactModel model = ContactModel::bem) const;
  EnsembleMean decay_length_over_rms_height(ContactModel model = ContactModel::bem) const;
  /// mean() of a column of ModelResult, given by its name, such as "area_slope" or "law_bend".
  /// Throws InvalidInput for an unknown name.
  EnsembleMean fitted(std::string_view column, ContactModel model = ContactModel::bem) const;

  /// Compares the exponential law with the mean curve of a model; empty if no local decay length is
  /// known.
  std::optional<LawDescription> law_description(ContactModel model = ContactModel::bem) const;

  StudyTheories theories() const;

  /// Means over realisations of a number at each pressure (the second argument of `number` is the
  /// index of the pressure); contacts that did not converge are left out.
  std::vector<EnsembleMean> at_pressures(
      const std::function<double(const Realisation&, std::size_t)>& number) const;
  std::vector<EnsembleMean> curve(const NumberOf<ForceSample>& number,
                                  ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> damping(const NumberOf<DampingPoint>& number,
                                    ContactModel model = ContactModel::bem) const;
  /// A quantity of DampingPoint, given by its name, as solutions and files contain it: stated() if
  /// the quantity has a numerical error, deviation() for "deviation", and otherwise the mean over
  /// realisations. Throws InvalidInput for an unknown name.
  std::vector<EnsembleMean> damping(std::string_view quantity,
                                    ContactModel model = ContactModel::bem) const;
  /// The mean of damping_constant_closed_form (γ16) divided by the mean of
  /// damping_constant_without_slip (γ), minus 1. It is a ratio of means, not the mean of the ratios
  /// of single surfaces. To first order in the scatter, its interval is that of the mean of γ16/⟨γ⟩
  /// − r(γ/⟨γ⟩ − 1) over the surfaces, with r = ⟨γ16⟩/⟨γ⟩.
  std::vector<EnsembleMean> deviation(ContactModel model = ContactModel::bem) const;
  std::vector<EnsembleMean> spots(const NumberOf<SpotStatistics>& number) const;
  /// Means of flow numbers over the surfaces whose gap percolates. The mean of
  /// FlowFactors::percolates_x is the fraction of surfaces whose gap percolates along x.
  std::vector<EnsembleMean> flow(const NumberOf<FlowFactors>& number) const;
  /// Means over realisations of a number at each mean gap of the adhesive cycle, and of a number of
  /// the whole cycle; contacts that did not converge are left out.
  std::vector<EnsembleMean> adhesion(const NumberOf<AdhesionSample>& number) const;
  EnsembleMean adhesion_cycle(const NumberOf<AdhesiveCycleNumbers>& number) const;
  /// Mean conductance at each pressure from K of the boundary elements; empty if the configuration
  /// does not request it. A conductance is K times a constant, so its interval is that of K times
  /// the same constant.
  std::vector<EnsembleMean> conductance(double Conductances::*kind) const;
  /// Mean ratio of a number of a model to the same number of the boundary elements on the same
  /// surface, at each pressure.
  std::vector<EnsembleMean> over_bem(const NumberOf<ForceSample>& number, ContactModel model) const;
  /// Mean ratio of a loss of a model to a loss of the boundary elements on the same surface, by
  /// default the loss without slip, at each pressure.
  std::vector<EnsembleMean> damping_over_bem(
      const NumberOf<DampingPoint>& number, ContactModel model,
      const NumberOf<DampingPoint>& reference = &DampingPoint::work_per_cycle_without_slip) const;
  /// All ratios of a model to the boundary elements that files and solutions contain, each with the
  /// name of its quantity.
  std::vector<std::pair<std::string, std::vector<EnsembleMean>>> comparison(
      ContactModel model) const;

  /// Mean of work_per_cycle or damping_constant, with or without slip (`quantity` is the name), at
  /// each pressure with its numerical error. The error is the mean times the mean relative error of
  /// those surfaces that have an error, in which the noise is divided by √n for n surfaces. The
  /// mean is NaN if it is no larger than its error. Throws InvalidInput for an unknown name.
  std::vector<StatedMean> stated(std::string_view quantity,
                                 ContactModel model = ContactModel::bem) const;

  /// Range of deviation() over the pressures.
  DeviationRange deviation_range(ContactModel model = ContactModel::bem) const;
  /// Numbers of surfaces at which convergence() is evaluated: those for which is_milestone() is
  /// true, and the number of all surfaces.
  std::vector<std::size_t> convergence_counts() const;
  /// Mean l/h_rms of the boundary elements over the first M realisations, for each M of
  /// convergence_counts(); it shows how the mean converges.
  std::vector<EnsembleMean> convergence() const;
  /// For a surface twin, the fraction of the variance of ln W over the surfaces that comes from the
  /// uncertainty of the spectrum, which the scans leave open. It is 1 minus the ratio of the
  /// variance within pairs of surfaces that share a spectrum to the variance of all surfaces,
  /// averaged over the pressures. The rest of the variance is variation from place to place, which
  /// larger surfaces reduce. NaN for other ensembles and for fewer than three pairs.
  double scan_share() const;
  /// One line of text that says how the 95 % intervals were computed.
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
  visit(&S::ensemble_warnings,
        Kept{"ensemble_warnings", "why the result may be off for other reasons than chance"});
  visit(&S::interrupted, Kept{"interrupted", "whether surfaces that were asked for are missing"});
  visit(&S::precision_reached,
        Kept{"precision_reached", "whether fewer surfaces than seeds were enough"});
}

/// Report on one finished surface; the callback runs in the thread that called the run.
struct RealisationReport {
  std::size_t point = 0, points = 1;     ///< index, and number of points of the parameter grid
  std::size_t finished = 0, wanted = 0;  ///< number of surfaces, over all points
  std::uint64_t seed = 0;
  double seconds = 0;     ///< computing time, s; 0 if restored
  bool restored = false;  ///< true: read from `parts`, not computed
};

/// How a study runs: callbacks, storage of its parts, and the processes that share it.
struct StudyRun {
  Progress on_progress = {};  ///< progress of the whole run
  std::function<void(const RealisationReport&)> on_realisation = {};
  /// Called in every process, before the computation starts, with each warning of
  /// StudyResult::warnings that is known by then.
  std::function<void(const std::string&)> on_warning = {};
  /// Folder of finished realisations, which are not computed again. A new realisation is on the
  /// disk before its thread begins the next one.
  StudyParts* parts = nullptr;
  /// If given, nothing is computed, and the vector receives the indices of the realisations that
  /// `parts` lacks (counted from 0 over all points and, within a point, all seeds). If none is
  /// missing, the results are those of a whole run.
  std::vector<std::size_t>* missing = nullptr;
  /// The processes of the run. Each group distributes one surface after the other over its
  /// processes. All processes make the call, each with its own on_progress, and get the same
  /// results. Only the first process uses on_realisation and `parts`.
  Groups groups = {};
};

/// Progress of one process with its shard of a study.
struct ShardOutcome {
  std::size_t wanted = 0;     ///< number of surfaces of this shard
  std::size_t present = 0;    ///< finished earlier or by other processes
  std::size_t computed = 0;   ///< computed in this run
  std::size_t elsewhere = 0;  ///< being computed by other processes, of any shard
  int damaged = 0;            ///< damaged files, removed and computed again
  bool interrupted = false;
};

/// Computes the surfaces of a shard that are missing in the folder run.parts, and stores them
/// there. Any number of processes may do so at once, on any hosts that see the folder.
///
///     auto parts = StudyParts::of_shard("study.parts", shard);
///     ShardOutcome outcome = run_shard(study, shard, {.parts = parts.get()});
///
/// Afterwards run_ensembles() with StudyRun::missing assembles the result, with the same bits as in
/// one process. A target precision does not end a numbered shard early, because other shards have
/// some of the surfaces in between; a shard with any() checks the precision before each surface. A
/// shard with any() claims a surface by a file that it locks until its process ends.
/// throws  InvalidInput for a configuration that cannot be run, and if the folder has realisations
///         but none belongs to the configuration; NotConverged and IoError wherever run_ensembles()
///         does
ShardOutcome run_shard(const StudyConfiguration& configuration, const Shard& shard,
                       const StudyRun& run);

/// Computes the ensembles of every point of the parameter grid, in the order of
/// parameter_combinations(), by analyse_realisation() of every surface, in parallel over surfaces.
///
///     StudyRun run{.on_progress = progress};
///     std::vector<StudyResult> results = run_ensembles(study, run);
///
/// With a target precision, a point of the parameter grid ends after the first M surfaces (M >=
/// min_realisations, is_milestone(M)) for which the 95 % intervals of l/h_rms and of the area slope
/// κ of the boundary elements are narrower than ±precision of their means. The result has the same
/// bits for every number of threads, processes and groups. If the run is stopped, points not yet
/// begun are left out. A measured surface is treated as periodic after its plane is removed; the
/// result carries a warning with the size of the resulting step at the seam.
/// throws  InvalidInput for a configuration that cannot be run, such as one with a hardness, a
///         relative error or interacting summits over several processes of a group, and if
///         run.parts has realisations but none belongs to the configuration; NotConverged if fewer
///         than four contacts of a sweep converged; IoError if a realisation cannot be written
/// cost    the BEM sweep for each surface; interacting summits cost about as much again
std::vector<StudyResult> run_ensembles(const StudyConfiguration& configuration,
                                       const StudyRun& run = {});

/// Runs a configuration with a single point by run_ensembles(). Throws InvalidInput if it has
/// several points.
StudyResult run_study(const StudyConfiguration& configuration, const StudyRun& run = {});

}  // namespace salebra
