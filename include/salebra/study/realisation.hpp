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

/// The loss at one pressure of a force curve, and two small-amplitude forms of it without slip.
///
/// For boundary elements the loss comes from contacts solved inside the oscillation
/// (surface_damping()); for all other models it comes from a smooth interpolation of their force
/// curve, and is NaN if the motion leaves the range of the curve. For a single surface a number is
/// NaN if it is no larger than its error.
struct DampingPoint : Loss {
  double pressure = 0;  ///< Pa
  double force = 0;     ///< F = pA0, N
  /// Eq. (16) for a Drag, or Eq. (12) with F'' = F/l² for an EqualFrequency, with the decay length
  /// l fitted to the curve.
  double work_per_cycle_closed_form = unknown;    ///< J
  double damping_constant_closed_form = unknown;  ///< N s/m
  /// Eq. (15) for a Drag or Eq. (12) for an EqualFrequency with F'' of the curve itself, without a
  /// fitted law.
  double small_amplitude_work = unknown;              ///< J
  double small_amplitude_damping_constant = unknown;  ///< N s/m
  double mean_force = unknown;                        ///< cycle mean of F, N
  double max_force = unknown;     ///< F at the largest indentation of the cycle, N
  double contact_time = unknown;  ///< share of the period in which the bodies touch
  /// Largest normal amplitude at this load, m, if the motion presses the surface beyond full
  /// contact; NaN otherwise.
  double possible_amplitude = unknown;

  const ErrorBudget& error_by_cause() const { return error; }
  /// Relative deviation of the loss by the fitted law from the loss without slip.
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
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::max_force, quantity::max_force);
  visit(&S::contact_time, quantity::contact_time);
  visit(&S::possible_amplitude,
        Kept{"possible_amplitude", "largest normal amplitude, if the motion is impossible"});
  visit(&S::error_by_cause, Part{"error_by_cause", "numerical error of work_per_cycle"});
  visit(&S::deviation,
        Quantity{"deviation", dimensionless,
                 "damping by the fitted law over the damping computed without slip, less 1"});
}

/// Result of one contact model for one surface.
struct ModelResult {
  ContactModel model = ContactModel::bem;
  ForceCurve curve = {};
  /// Exponential fit of the curve; NaN for fewer than three points in the window, and so is the
  /// damping by the fitted law.
  ExponentialFit fit = {};
  /// Test for curvature of ln p over the window of the fit; NaN for fewer than four points.
  ExponentialTest test = {};
  WindowSensitivity sensitivity = {};
  LocalDecayLength local{};
  /// Decay length of a fit with equal weights of all loads, m; see FitWeights.
  double decay_length_equal_weights = ForceSample::unknown;
  /// Area slope κ of A/A0 = κ p/(E*h') with the rms slope h' of the surface: least squares through
  /// the origin over pressures of 0.002 to 0.05 E*h'.
  double area_slope = ForceSample::unknown;
  /// Coefficient α of K = αF/h_rms: least squares through the origin over the pressures of the fit;
  /// it equals h_rms/l if the exponential law holds.
  double stiffness_coefficient = ForceSample::unknown;
  /// Decay length u0 of Persson's p ∝ exp(−ū/u0), m, for ContactModel::persson; the same u0 appears
  /// in K = pA0/u0 of Campañá, Persson and Müser.
  double asymptotic_decay_length = ForceSample::unknown;
  /// Pull-off pressure of the adhesive models, Pa; for boundary elements, from their adhesive
  /// cycle.
  double pull_off_pressure = ForceSample::unknown;
  std::vector<DampingPoint> damping = {};  ///< loss at each sample of the curve

  /// Deviation from F ∝ exp(−ū/l) over the window of the fit: l at the largest mean gap over l at
  /// the smallest mean gap of the window, minus 1, by the parabola of test_exponential(); NaN for
  /// fewer than four points.
  double law_bend() const;
  /// Decay lengths divided by h_rms of the surface:
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
  double spot_count = ForceSample::unknown;               ///< number of contact patches
  double corrected_area_fraction = ForceSample::unknown;  ///< ContactSpots::corrected_area_fraction
  double max_spot_area = ForceSample::unknown;            ///< of the largest patch, m²
  double mean_spot_area = ForceSample::unknown;           ///< mean over the patches, m²
  /// Number of patches by size: entry k, counted from 0, holds patches of 2^k to 2^(k+1) − 1 cells.
  std::vector<double> spots_by_size;

  /// Area of the largest patch over the area of all patches.
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

/// Adhesive contact at one mean gap of a cycle, during loading and during unloading.
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

/// The adhesive cycle of one surface; NaN where a contact did not converge.
struct AdhesionOfSurface : AdhesiveCycleNumbers {
  std::vector<AdhesionSample> samples;  ///< for each mean gap
};

constexpr void describe(auto&& visit, std::type_identity<AdhesionOfSurface>) {
  describe(visit, std::type_identity<AdhesiveCycleNumbers>{});
  visit(&AdhesionOfSurface::samples, Kept{"samples", "at each mean gap"});
}

/// Data to plot one surface of a study: heights, contacts, spectrum and height distribution. Maps
/// hold every stride-th point along each axis, at most picture_side points per axis. Single points
/// are used instead of averages over blocks because they keep the height distribution and, on
/// average, the contact area of the surface.
struct SurfacePicture {
  static constexpr Index picture_side = 512;

  std::string origin;  ///< file, or generator with its seed
  Index stride = 0;    ///< 0: no picture
  Index nx = 0, ny = 0;
  double step_x = 0, step_y = 0;  ///< distance of points of the maps, m
  std::vector<float> heights;     ///< (nx, ny), y contiguous, from the mean height, m
  std::vector<std::int16_t>
      first_load;         ///< index of the smallest load at which a point touches; −1: none
  Index mapped_load = 0;  ///< index of the load of contact_pressure and gap
  std::vector<float>
      contact_pressure;    ///< (nx, ny), Pa; empty until boundary elements have solved that load
  std::vector<float> gap;  ///< (nx, ny), gap of the deformed surfaces, m

  std::vector<double> wavenumber, psd;  ///< radial spectrum C, rad/m and m⁴
  std::vector<double> law_psd;          ///< C of the self-affine law, m⁴; NaN outside its range
  std::string law;                      ///< origin of law_psd; empty: no law
  double hurst = 0, hurst_low = 0,
         hurst_high = 0;  ///< estimate with its 95 % interval; NaN: no self-affine range

  std::vector<double> height, height_density;  ///< histogram, m and 1/m

  bool empty() const { return stride == 0; }
  /// Marks the points that carry pressure under the load with index k; if k is mapped_load, also
  /// stores the maps of pressure and gap. If the surface is distributed over processes, each
  /// process has its rows of the maps.
  void add_contact(std::int16_t k, const NormalContactState& state, const Surface& surface);
  /// Collects the rows of the maps from all processes in the first process. Collective.
  void gather(const Communicator& communicator);
  /// Distribution of the rows of the maps over the processes of a surface.
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

/// Whether the surface of this seed gets a SurfacePicture: only the first seed of a study does, or
/// the measured surface.
bool wants_picture(const StudyConfiguration& configuration, std::uint64_t seed);

/// Makes the picture of a surface, without contacts, which add_contact() adds. law_psd of a
/// generated surface is its input spectrum; for a measured surface it is a power law fitted to the
/// self-affine range. The height distribution is that of the points of the maps. If the surface is
/// distributed over processes, the first process gets the picture. Collective. Cost: one FFT.
SurfacePicture picture_of(const Surface& surface, const StudyConfiguration& configuration);

/// Everything computed for one surface.
struct Realisation {
  std::uint64_t seed = 0;  ///< 0 for a measured surface
  Grid2D grid;
  bool periodic = true;
  double seam_step = 0;  ///< rms height difference of opposite edges over h_rms
  /// First loading, if a hardness is known; all members that follow then describe the residual
  /// surface.
  FirstLoading first_loading;
  HeightStatistics heights;
  SpectralMoments moments;
  SummitStatistics summits;
  SummitEnsemble ensemble;          ///< for Greenwood–Williamson, from `moments`
  std::vector<ModelResult> models;  ///< of configured models, in the order of contact_models()
  /// The boundary elements in further directions of the tangential motion: the result in the first
  /// direction is in `models`.
  std::vector<ModelResult> other_directions = {};
  std::vector<SpotStatistics> spots;  ///< for each pressure
  /// Flow factors at each pressure, if the configuration requests them; NaN where the contact or
  /// the flow did not converge.
  std::vector<FlowFactors> flow;
  AdhesionOfSurface adhesion;  ///< if the configuration has an adhesive cycle
  /// Area slope κ of the boundary elements, with the contact area corrected by its perimeter
  /// (ContactSpots).
  double corrected_area_slope = ForceSample::unknown;
  SurfacePicture picture;  ///< empty unless wants_picture() is true for this surface

  /// Whether the moments can be those of a random surface. A smooth shape may have a Nayak
  /// parameter below 1; models that derive their summits from the moments then have no force curve.
  bool has_random_summits() const { return !(moments.nayak() < 1); }

  /// Returns the result of a model. Throws InvalidInput for a model that was not computed.
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
  visit(&S::other_directions,
        Kept{"other_directions", "boundary elements in further directions of the motion"});
  visit(&S::spots, Kept{"spots", "contact spots of boundary elements at each pressure"});
  visit(&S::flow, Kept{"flow", "flow through the gap at each pressure"});
  visit(&S::adhesion, Kept{"adhesion", "cycle of the adhesive contact"});
  visit(&S::corrected_area_slope,
        Quantity{"corrected_area_slope", dimensionless,
                 "slope of A/A0, corrected by the perimeter, over p/(E* rms slope)"});
  visit(&S::picture, Kept{"picture", "heights, first contacts, spectrum, distribution"});
}

/// Whether K_t of the boundary elements comes from stick solves, i.e. whether the configuration
/// requests them and its moduli are those of an elastic body.
bool stick_solves(const StudyConfiguration& configuration);

/// Returns how the damping of one surface is computed. For a single surface, the error comes from
/// cells of half the size or, beyond 256 points per side, of twice the size. For several surfaces,
/// each is computed with 4 intervals on the given cells, and the relative error of the first
/// surface, from cells of twice the size, is used for all. If the configuration has a
/// relative_error, the cells of each surface are halved until this error is reached.
SurfaceDampingOptions surface_damping_options(const StudyConfiguration& configuration,
                                              const Grid2D& grid, std::uint64_t seed);

/// Returns the models of the configuration, in the order of contact_models().
std::vector<StudyModel> models_of(const StudyConfiguration& configuration);

/// Reads and detrends a scan for a study. Warnings are added to the list `warnings`. Throws
/// wherever read_surface() does, and for undefined points.
Surface measured_surface(const MeasuredSurface& surface, const Communicator& communicator = {},
                         std::vector<std::string>* warnings = nullptr);

/// Returns the surface of a seed, or the measured one, detrended as configured. Throws wherever the
/// generators and read_surface do. progress: progress of the generator. communicator: the processes
/// over which the surface is distributed, as in filtered_noise and read_surface; the call is then
/// collective.
Surface study_surface(const StudyConfiguration& configuration, std::uint64_t seed,
                      const Progress& progress = {}, const Communicator& communicator = {});

/// The loads of a study, known before the computation.
struct StudyLoads {
  /// E*h'_rms, Pa, the unit of relative pressures. h'_rms is the rms slope that the spectrum has on
  /// the grid (without random scatter), or that of the measured surface.
  double contact_scale = 0;
  /// E*, Pa; of a body in place of half-spaces pressure_scale()/h'_rms of the first surface.
  double contact_modulus = 0;
  std::vector<double> pressures = {};  ///< of the sweep, Pa
  /// Warnings of read_surface(), warning_of_slope() and warning_of_pressure().
  std::vector<std::string> warnings = {};
};

/// Computes the loads of a study. Throws InvalidInput for a fit window with fewer than three
/// pressures and for a hardness below the largest pressure, and wherever read_surface does.
/// communicator: the processes that read a measured surface together; the call is then collective.
/// Cost: that of reading the measured surface.
StudyLoads study_loads(const StudyConfiguration& configuration,
                       const Communicator& communicator = {});

/// Directions of the tangential motion on the surfaces of a study, from the x axis, rad: those that
/// the configuration asks for. The lay of generated surfaces is that of their recipe. Without stick
/// solves, and by default with adhesion, the direction is along x. `surface` is one of them.
/// Collective. Throws InvalidInput wherever directions_of() does.
std::vector<double> directions_of(const StudyConfiguration& configuration, const Surface& surface);

/// What the motion of a study keeps at all its pressures, if its configuration leaves this open: the
/// mean force if the surface lifts off at its lowest pressure, Pa. One contact decides.
/// communicator: as in study_surface; the call is then collective.
Hold hold_of(const StudyConfiguration& configuration, const Surface& surface,
             double lowest_pressure, const Progress& progress = {});

/// Computes everything for one surface: statistics, contact models, exponential law, damping.
///
///     Realisation one = analyse_realisation(study_surface(study, 1), study, 1, loads.pressures);
///
/// `surface` must be study_surface() of the seed; the ensemble lists of the configuration must be
/// empty. With a hardness the surface is first loaded to the largest pressure plus the oscillation
/// about it, and all results are those of the residual surface.
/// progress  has the stage "realisation"; a stop throws Interrupted
/// throws    NotConverged if fewer than four contacts of a sweep converged, or if the first loading
///           did not converge
/// If the surface is distributed over processes, the call is collective: the first process gets the
/// complete realisation, with the same bits as in one process, and every other process gets its
/// part.
Realisation analyse_realisation(Surface surface, const StudyConfiguration& configuration,
                                std::uint64_t seed, const std::vector<double>& pressures,
                                const Progress& progress = {});

}  // namespace salebra
