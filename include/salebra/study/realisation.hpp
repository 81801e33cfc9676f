// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/normal/adhesive_cycle.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/damping/loss.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <vector>

namespace salebra {

/// The loss at one pressure of a curve, with two small-amplitude forms without slip.
///
/// For boundary elements it comes from contacts solved inside the oscillation (surface_damping());
/// for other models from their curve with smoothly joined loads, NaN where the motion leaves it.
/// For a single surface a number is NaN if it is no larger than its error.
struct DampingPoint : Loss {
  double pressure = 0;  ///< Pa
  double force = 0;     ///< F = pA0, N
  /// Eq. (16), or (12) with F'' = F/l², with l fitted to the curve.
  double work_per_cycle_closed_form = unknown;    ///< J
  double damping_constant_closed_form = unknown;  ///< N s/m
  /// Eq. (15) or (12) with F'' of the curve itself: small amplitudes, no fitted law.
  double small_amplitude_work = unknown;              ///< J
  double small_amplitude_damping_constant = unknown;  ///< N s/m

  const ErrorBudget& error_by_cause() const { return error; }
  double deviation() const { return work_per_cycle_closed_form / work_per_cycle_without_slip - 1; }
};

constexpr void describe(auto&& visit, std::type_identity<DampingPoint>) {
  using enum Dimension;
  using S = DampingPoint;
  describe(visit, std::type_identity<Loss>{});
  visit(&S::pressure, Quantity{"pressure", Dimension::pressure, "nominal pressure"});
  visit(&S::force, Quantity{"force", Dimension::force, "normal force"});
  visit(&S::work_per_cycle_closed_form,
        Quantity{"work_per_cycle_closed_form", energy,
                 "energy dissipated in a cycle, Eq. (16) or (12) with the fitted law"});
  visit(&S::damping_constant_closed_form, Quantity{"damping_constant_closed_form", damping,
                                                   "damping constant P/v^2, by the fitted law"});
  visit(&S::small_amplitude_work, quantity::small_amplitude_work);
  visit(&S::small_amplitude_damping_constant,
        Quantity{"small_amplitude_damping_constant", damping,
                 "damping constant P/v^2, by F'' of the curve"});
  visit(&S::error_by_cause, Part{"error_by_cause", "numerical error of work_per_cycle"});
  visit(&S::deviation,
        Quantity{"deviation", dimensionless,
                 "damping by the fitted law over the damping computed without slip, less 1"});
}

/// Result of one contact model for one surface.
struct ModelResult {
  ContactModel model = ContactModel::bem;
  ForceCurve curve = {};
  ExponentialFit fit =
      {};  ///< unknown for fewer than three points in the window, and so is the law's damping
  /// Curvature of the law over the window of the fit; unknown for fewer than four points.
  ExponentialTest test = {};
  WindowSensitivity sensitivity = {};
  LocalDecayLength local{};
  /// l of a fit with equal weights of all loads, m; see FitWeights.
  double decay_length_equal_weights = ForceSample::unknown;
  /// κ of A/A0 = κ p/(E*h') with h' of the surface: least squares through the origin over loads of
  /// 0.002 to 0.05 E*h'.
  double area_slope = ForceSample::unknown;
  /// α of K = αF/h_rms: least squares through the origin over the pressures of the fit; h_rms/l
  /// where the exponential law holds.
  double stiffness_coefficient = ForceSample::unknown;
  /// u0 of Persson's p ∝ exp(−ū/u0), m, for ContactModel::persson; it is also that of K = pA0/u0 of
  /// Campañá, Persson and Müser.
  double asymptotic_decay_length = ForceSample::unknown;
  /// Pull-off pressure of the adhesive models, Pa; for boundary elements, from the cycle.
  double pull_off_pressure = ForceSample::unknown;
  std::vector<DampingPoint> damping = {};  ///< for each sample of the curve

  /// Deviation from F ∝ exp(−ū/l) over the window of the fit: l at its far end over l at its close
  /// end, minus 1, by the parabola of test_exponential(); unknown for fewer than four points.
  double law_bend() const;
  /// Lengths over h_rms:
  double decay_length_at_min_gap_over_rms_height() const {
    return test.decay_length_at_min_gap / curve.rms_height;
  }
  double decay_length_at_max_gap_over_rms_height() const {
    return test.decay_length_at_max_gap / curve.rms_height;
  }
  double decay_length_min_over_rms_height() const {
    return sensitivity.decay_length_min / curve.rms_height;
  }
  double decay_length_max_over_rms_height() const {
    return sensitivity.decay_length_max / curve.rms_height;
  }
  double decay_length_equal_weights_over_rms_height() const {
    return decay_length_equal_weights / curve.rms_height;
  }
  double asymptotic_decay_length_over_rms_height() const {
    return asymptotic_decay_length / curve.rms_height;
  }
};

constexpr void describe(auto&& visit, std::type_identity<ModelResult>) {
  using enum Dimension;
  using S = ModelResult;
  visit(&S::model, Kept{"model", "contact model"});
  visit(&S::curve, Kept{"curve", "force curve"});
  visit(&S::fit, Part{"fit", "exponential law fitted to the curve"});
  visit(&S::test, Part{"test", "whether the law bends"});
  visit(&S::sensitivity, Part{"sensitivity", "how much the fit owes to its window"});
  visit(&S::local, Kept{"local", "local decay length"});
  visit(&S::decay_length_equal_weights,
        Quantity{"decay_length_equal_weights", length, "decay length, all loads weighted alike"});
  visit(&S::area_slope,
        Quantity{"area_slope", dimensionless, "slope of A/A0 over p/(E* rms slope)"});
  visit(&S::stiffness_coefficient,
        Quantity{"stiffness_coefficient", dimensionless,
                 "slope of normal stiffness times rms height over force, within the fit"});
  visit(&S::asymptotic_decay_length,
        Quantity{"asymptotic_decay_length", length,
                 "decay length of force with mean gap in the limit of small pressures"});
  visit(&S::pull_off_pressure,
        Quantity{"pull_off_pressure", pressure, "mean tension at which the surfaces come off"});
  visit(&S::damping, Kept{"damping", "damping at each pressure"});
  visit(&S::law_bend,
        Quantity{"law_bend", dimensionless,
                 "decay length at the far end of the window over that at its close end, less 1"});
  visit(&S::decay_length_at_min_gap_over_rms_height,
        Quantity{"decay_length_at_min_gap_over_rms_height", dimensionless,
                 "local decay length at the close end of the window over rms height"});
  visit(&S::decay_length_at_max_gap_over_rms_height,
        Quantity{"decay_length_at_max_gap_over_rms_height", dimensionless,
                 "local decay length at the far end of the window over rms height"});
  visit(&S::decay_length_min_over_rms_height,
        Quantity{"decay_length_min_over_rms_height", dimensionless,
                 "minimum decay length over parts of the window, over rms height"});
  visit(&S::decay_length_max_over_rms_height,
        Quantity{"decay_length_max_over_rms_height", dimensionless,
                 "maximum decay length over parts of the window, over rms height"});
  visit(&S::decay_length_equal_weights_over_rms_height,
        Quantity{"decay_length_equal_weights_over_rms_height", dimensionless,
                 "decay length, all loads weighted alike, over rms height"});
  visit(&S::asymptotic_decay_length_over_rms_height,
        Quantity{"asymptotic_decay_length_over_rms_height", dimensionless,
                 "decay length in the limit of small pressures over rms height"});
}

/// Contact patches of the boundary elements at one pressure.
struct SpotStatistics {
  double spot_count = ForceSample::unknown;
  double corrected_area_fraction = ForceSample::unknown;  ///< see ContactSpots
  double max_spot_area = ForceSample::unknown;        ///< m²
  double mean_spot_area = ForceSample::unknown;           ///< m²
  std::vector<double> spots_by_size;  ///< patches of 2^k to 2^(k+1) − 1 cells, k = 0, 1, …

  /// Area of the largest patch over that of all.
  double max_spot_share() const { return max_spot_area / (spot_count * mean_spot_area); }
};

constexpr void describe(auto&& visit, std::type_identity<SpotStatistics>) {
  using enum Dimension;
  using S = SpotStatistics;
  visit(&S::spot_count, Quantity{"spot_count", dimensionless, "number of contact spots"});
  visit(&S::corrected_area_fraction,
        Quantity{"corrected_area_fraction", dimensionless,
                 "contact area over nominal area, corrected by the perimeter"});
  visit(&S::max_spot_area,
        Quantity{"max_spot_area", length_squared, "area of the largest contact spot"});
  visit(&S::mean_spot_area,
        Quantity{"mean_spot_area", length_squared, "mean area of contact spots"});
  visit(&S::spots_by_size, Quantity{"spots_by_size", dimensionless,
                                    "contact spots of min_cells to twice as many cells"});
  visit(&S::max_spot_share, Quantity{"max_spot_share", dimensionless,
                                         "area of the largest contact spot over that of all"});
}

/// Adhesive contact at one mean gap of a cycle, loading and unloading.
struct AdhesionSample {
  double loading_pressure = ForceSample::unknown;  ///< Pa; < 0: attraction
  double unloading_pressure = ForceSample::unknown;
  double loading_area_fraction = ForceSample::unknown;
  double unloading_area_fraction = ForceSample::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionSample>) {
  using enum Dimension;
  using S = AdhesionSample;
  visit(&S::loading_pressure,
        Quantity{"loading_pressure", pressure, "nominal pressure when surfaces come closer"});
  visit(&S::unloading_pressure,
        Quantity{"unloading_pressure", pressure, "nominal pressure when surfaces are drawn apart"});
  visit(&S::loading_area_fraction,
        Quantity{"loading_area_fraction", dimensionless,
                 "contact area over nominal area when surfaces come closer"});
  visit(&S::unloading_area_fraction,
        Quantity{"unloading_area_fraction", dimensionless,
                 "contact area over nominal area when surfaces are drawn apart"});
}

/// The adhesive cycle of one surface; unknown where a contact did not converge.
struct AdhesionOfSurface : AdhesiveCycleNumbers {
  std::vector<AdhesionSample> samples;  ///< for each mean gap
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionOfSurface>) {
  describe(visit, std::type_identity<AdhesiveCycleNumbers>{});
  visit(&AdhesionOfSurface::samples, Kept{"samples", "at each mean gap"});
}

/// Data to plot one surface of a study: heights, contacts, spectrum and height distribution. Maps
/// hold every stride-th point along either axis, at most picture_side of them: a sample of points
/// has the height distribution and, on average, the contact area of all points, while averages over
/// blocks have not.
struct SurfacePicture {
  static constexpr Index picture_side = 512;

  std::string origin;  ///< file, or generator with its seed
  Index stride = 0;    ///< 0: no picture
  Index nx = 0, ny = 0;
  double step_x = 0, step_y = 0;  ///< between points of the maps, m
  std::vector<float> heights;     ///< (nx, ny), y contiguous, less the mean of the surface, m
  std::vector<std::int16_t>
      first_load;         ///< index of the smallest load at which a point touches; −1: none
  Index mapped_load = 0;  ///< index of the load of the next two maps
  std::vector<float>
      contact_pressure;    ///< (nx, ny), Pa; empty until boundary elements have solved that load
  std::vector<float> gap;  ///< (nx, ny), of the deformed surfaces, m

  std::vector<double> wavenumber, psd;  ///< radial spectrum C, rad/m and m⁴
  std::vector<double> law_psd;          ///< NaN outside the range of the law
  std::string law;                      ///< origin of the law; empty: no law
  double hurst = 0, hurst_low = 0,
         hurst_high = 0;  ///< estimate with its 95 % interval; NaN: no self-affine range

  std::vector<double> height, height_density;  ///< histogram, m and 1/m

  bool empty() const { return stride == 0; }
  /// Marks the points that carry pressure under the load with index k, and takes the maps of one
  /// load. Of a surface spread over processes, each has its rows of these maps.
  void add_contact(std::int16_t k, const NormalContactState& state, const Surface& surface);
  /// Collects the maps in the first process. Collective.
  void gather(const Communicator& communicator);
  /// Rows of the maps by process.
  RowPartition rows_of(const Surface& surface) const;
};

constexpr void describe(auto&& visit, std::type_identity<SurfacePicture>) {
  using enum Dimension;
  using S = SurfacePicture;
  visit(&S::origin, Quantity{"origin", dimensionless, "file, or generator with its seed"});
  visit(&S::stride, Quantity{"stride", dimensionless, "points from one to the next that is kept"});
  visit(&S::nx, Kept{"nx", "points of the maps along x"});
  visit(&S::ny, Kept{"ny", "points of the maps along y"});
  visit(&S::step_x, Kept{"step_x", "between points of the maps along x", length});
  visit(&S::step_y, Kept{"step_y", "between points of the maps along y", length});
  visit(&S::heights,
        Quantity{"heights", length, "height, positive out of the material, from the mean"});
  visit(
      &S::first_load,
      Quantity{"first_load", dimensionless,
               "number of the lowest pressure of the curve at which the point touches; -1: none"});
  visit(&S::mapped_load,
        Kept{"mapped_load", "number of the pressure of the maps of pressure and gap"});
  visit(&S::contact_pressure, Quantity{"contact_pressure", pressure, "contact pressure"});
  visit(&S::gap, Quantity{"gap", length, "gap of the deformed surfaces"});
  visit(&S::wavenumber, Quantity{"wavenumber", Dimension::wavenumber, "wave number"});
  visit(&S::psd, Quantity{"psd", length_to_the_fourth,
                          "power spectral density C, rms_height^2 = integral of C d^2q"});
  visit(&S::law_psd,
        Quantity{"law_psd", length_to_the_fourth, "power spectral density of the self-affine law"});
  visit(&S::law, Quantity{"law", dimensionless, "where the law comes from"});
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::hurst_low, Quantity{"hurst_low", dimensionless, "Hurst exponent, lower 95 % limit"});
  visit(&S::hurst_high, Quantity{"hurst_high", dimensionless, "Hurst exponent, upper 95 % limit"});
  visit(&S::height, Quantity{"height", length, "height above the mean, middle of a bin"});
  visit(&S::height_density,
        Quantity{"height_density", inverse_length, "share of the points in a bin over its width"});
}

/// Whether this surface gets the picture: the first seed of a study, or the measured surface.
bool wants_picture(const StudyConfiguration& configuration, std::uint64_t seed);

/// Makes the picture, still without contacts. The law of a generated surface is its input; for any
/// other surface it is a power law through the self-affine range. The distribution is that of the
/// points of the maps. A surface may be spread over processes; the first one gets the picture.
/// Collective. Cost: one FFT.
SurfacePicture picture_of(const Surface& surface, const StudyConfiguration& configuration);

/// Everything computed for one surface.
struct Realisation {
  std::uint64_t seed = 0;  ///< 0 for a measured surface
  Grid2D grid;
  bool periodic = true;
  double seam_step = 0;  ///< rms difference of opposite edges over rms height
  /// Set where a hardness is known; everything below is then that of the residual surface.
  FirstLoading first_loading;
  HeightStatistics heights;
  SpectralMoments moments;
  SummitStatistics summits;
  SummitEnsemble ensemble;            ///< for the Greenwood–Williamson theory, from the moments
  std::vector<ModelResult> models;    ///< of the configuration, in the order of contact_models()
  std::vector<SpotStatistics> spots;  ///< for each pressure
  /// Flow factors at each pressure, where the configuration wants them; unknown where the contact
  /// or the flow did not converge.
  std::vector<FlowFactors> flow;
  AdhesionOfSurface adhesion;  ///< where the configuration has a cycle
  double corrected_area_slope = ForceSample::
      unknown;             ///< κ of the boundary elements with the area corrected by its perimeter
  SurfacePicture picture;  ///< of one realisation per study, see wants_picture(); otherwise empty

  /// Whether its moments can be those of a random surface. A smooth shape may have a Nayak
  /// parameter below 1; models that take their summits from the moments then have no curve.
  bool has_random_summits() const { return !(moments.nayak() < 1); }

  /// Returns the result of a model. Throws InvalidInput for one that was not run.
  const ModelResult& of(ContactModel model) const;
  ModelResult& of(ContactModel model);
};

constexpr void describe(auto&& visit, std::type_identity<Realisation>) {
  using enum Dimension;
  using S = Realisation;
  visit(&S::seed,
        Quantity{"seed", dimensionless, "seed of the generator; 0 for a measured surface"});
  visit(&S::grid, Kept{"grid", "points and sizes"});
  visit(&S::periodic, Kept{"periodic", "whether the surface is"});
  visit(&S::seam_step,
        Quantity{"seam_step", dimensionless, "rms difference of opposite edges over rms height"});
  visit(&S::first_loading, Part{"first_loading", "plastic first loading"});
  visit(&S::heights, Part{"heights", "statistics of heights"});
  visit(&S::moments, Part{"moments", "spectral moments"});
  visit(&S::summits, Part{"summits", "statistics of summits"});
  visit(&S::ensemble, Kept{"ensemble", "summits of the Greenwood-Williamson theory"});
  visit(&S::models, Kept{"models", "what each contact model says"});
  visit(&S::spots, Kept{"spots", "contact spots of boundary elements at each pressure"});
  visit(&S::flow, Kept{"flow", "flow through the gap at each pressure"});
  visit(&S::adhesion, Kept{"adhesion", "cycle of the adhesive contact"});
  visit(&S::corrected_area_slope,
        Quantity{"corrected_area_slope", dimensionless,
                 "slope of A/A0, corrected by the perimeter, over p/(E* rms slope)"});
  visit(&S::picture, Kept{"picture", "heights, first contacts, spectrum, distribution"});
}

/// Whether K_t of the boundary elements comes from stick solves: the configuration wants them, and
/// its moduli are those of an elastic body.
bool stick_solves(const StudyConfiguration& configuration);

/// Returns how the damping of one surface is computed. A single surface: with the cells halved
/// once, or beyond 256 points compared with cells of twice the size. Several: with 4 intervals on
/// the given cells, and the error of all from the first of them, by cells of twice the size. With a
/// relative error: each with cells halved until it is reached.
SurfaceDampingOptions surface_damping_options(const StudyConfiguration& configuration,
                                              const Grid2D& grid, std::uint64_t seed);

/// Returns the models of the configuration, in the order of contact_models().
std::vector<StudyModel> models_of(const StudyConfiguration& configuration);

/// Reads and detrends a scan for a study. Lines of warnings are added to `warnings`. Throws as
/// read_surface(), and for undefined points.
Surface measured_surface(const MeasuredSurface& surface, const Communicator& communicator = {},
                         std::vector<std::string>* warnings = nullptr);

/// Returns the surface of a seed, or the measured one, detrended as configured. Throws as
/// generators and readers do. progress: of the generator. ranks: the processes over which the
/// surface is spread, as in filtered_noise and read_surface; collective.
Surface study_surface(const StudyConfiguration& configuration, std::uint64_t seed,
                      const Progress& progress = {}, const Communicator& communicator = {});

/// The loads of a study, known before the computation.
struct StudyLoads {
  /// E*h'_rms, Pa, the unit of relative pressures: from the mean spectrum on the lattice without
  /// random fluctuation, or from the measured surface.
  double contact_scale = 0;
  std::vector<double> pressures = {};  ///< of the sweep, Pa
  /// Warnings of read_surface(), warning_of_slope() and warning_of_pressure().
  std::vector<std::string> warnings = {};
};

/// Computes the loads. Throws InvalidInput for a window of the fit with fewer than three pressures,
/// and for a hardness below the largest; and as readers do. ranks: the processes that read a
/// measured surface together; collective. Cost: that of reading it.
StudyLoads study_loads(const StudyConfiguration& configuration, const Communicator& communicator = {});

/// Computes everything for one surface: statistics, contact models, exponential law, damping.
///
///     Realisation one = analyse_realisation(study_surface(study, 1), study, 1, loads.pressures);
///
/// The surface is study_surface() of the seed; the configuration has empty ensemble lists. With a
/// hardness the surface is first loaded to the largest pressure and by the oscillation about it,
/// and all results are those of the residual surface.
/// progress  of this surface, "realisation"; a stop throws Interrupted
/// throws    NotConverged where fewer than four contacts of a sweep converged, or the first loading
///           did not
/// The call is collective for a surface spread over processes: the first one gets the realisation,
/// with the bits of one process, and the others their part of it.
Realisation analyse_realisation(Surface surface, const StudyConfiguration& configuration,
                                std::uint64_t seed, const std::vector<double>& pressures,
                                const Progress& progress = {});

}  // namespace salebra
