// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/surface_picture.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Damping at one pressure of a curve, by the three routes that a user must see side by side.
struct DampingPoint {
  double pressure = 0;  ///< Pa
  double force = 0;     ///< F = pA0, N
  /// Eq. (16), or (12) with F'' = F/l², with the l fitted to the curve.
  double law_work = ForceSample::unknown;              ///< J
  double law_damping_constant = ForceSample::unknown;  ///< N s/m
  /// Eq. (15) or (12) with the F'' that the curve itself has there: small amplitudes, no law.
  double small_work = ForceSample::unknown;              ///< J
  double small_damping_constant = ForceSample::unknown;  ///< N s/m
  /// The theorem on the curve itself at the amplitude given; NaN where the motion leaves the curve.
  double curve_work = ForceSample::unknown;              ///< J
  double curve_damping_constant = ForceSample::unknown;  ///< N s/m

  double deviation() const { return law_work / curve_work - 1; }
};

/// What one contact model says about one surface.
struct ModelResult {
  ForceCurve curve;  ///< empty where the model was not asked for
  ExponentialFit
      fit;  ///< unknown for fewer than three points in the window, as the law's damping is
  /// How far the law bends over the window of the fit; unknown for fewer than four points.
  ExponentialTest test;
  WindowSensitivity sensitivity;
  LocalDecayLength local;
  /// κ of A/A0 = κ p/(E*h'): least squares through the origin over loads of 0.002 to 0.05 E*h', h' that of the surface.
  double area_slope = ForceSample::unknown;
  std::vector<DampingPoint> damping;  ///< for each sample of the curve
};

/// Patches of contact of the boundary elements at one pressure.
struct SpotStatistics {
  double count = ForceSample::unknown;
  double corrected_area_fraction = ForceSample::unknown;  ///< see ContactSpots
  double largest_area = ForceSample::unknown;             ///< m²
  double mean_area = ForceSample::unknown;                ///< m²
  std::vector<double> sizes;  ///< spots of 2^k to 2^(k+1) − 1 cells, k = 0, 1, …
};

/// Everything computed for one surface.
struct Realisation {
  std::uint64_t seed = 0;  ///< 0 for a measured surface
  Grid2D grid;
  bool periodic = true;
  double seam_step = 0;  ///< rms difference of opposite edges over rms height
  HeightStatistics heights;
  SpectralMoments moments;
  SummitStatistics summits;
  SummitEnsemble ensemble;  ///< of the Greenwood–Williamson theory, from the moments
  ModelResult bem, gw_moments, gw_deterministic;
  ModelResult gw_monte_carlo, gw_interacting,
      persson;                        ///< where StudyConfiguration::models has them
  std::vector<SpotStatistics> spots;  ///< for each pressure
  double corrected_area_slope = ForceSample::
      unknown;  ///< κ of the boundary elements with the area corrected by its perimeter
  /// u0 of Persson's p ∝ exp(−ū/u0), which is also K = pA0/u0 of Campañá, Persson and Müser, m; with ContactModel::persson.
  double persson_decay_length = ForceSample::unknown;
  SurfacePicture
      picture;  ///< of one realisation of a study, see wants_picture(); of the others empty
};

/// Where the results of a model are, and what people call it.
struct StudyModel {
  ContactModel model;
  const char* title;
  ModelResult Realisation::*result;
};
inline constexpr std::array study_models{
    StudyModel{ContactModel::bem, "boundary elements", &Realisation::bem},
    StudyModel{ContactModel::gw_moments, "GW, summits from spectral moments",
               &Realisation::gw_moments},
    StudyModel{ContactModel::gw_deterministic, "GW, the surface's own summits",
               &Realisation::gw_deterministic},
    StudyModel{ContactModel::gw_monte_carlo, "GW, summits drawn at random",
               &Realisation::gw_monte_carlo},
    StudyModel{ContactModel::gw_interacting, "GW, own summits, interacting",
               &Realisation::gw_interacting},
    StudyModel{ContactModel::persson, "Persson's theory", &Realisation::persson}};

/// Whether K_t of the boundary elements comes from stick solves: where they are wanted, and the moduli are those of a body.
bool stick_solves(const StudyConfiguration& configuration);

/// Those of the configuration, in the order of study_models.
std::vector<StudyModel> models_of(const StudyConfiguration& configuration);

/// The surface of a seed, or the measured one (its plane removed, as the configuration says). Throws as generators and readers do.
/// progress: of the generator.
Surface study_surface(const StudyConfiguration& configuration, std::uint64_t seed,
                      const Progress& progress = {});

/// The unit of relative pressures, E*h'_rms, Pa, without looking at chance: what the lattice has in the mean, or what was measured.
double contact_scale(const StudyConfiguration& configuration);

/// Pressures of the sweep in Pa. Throws InvalidInput for a window of the fit with fewer than three of them.
std::vector<double> study_pressures(const StudyConfiguration& configuration);

/// Surface → statistics → contact models → exponential law → damping for one surface of the configuration, whose ensemble lists
/// are empty. progress: of this surface, "realisation"; a stop throws Interrupted.
/// Throws NotConverged where fewer than four contacts of a sweep converged.
Realisation analyse_realisation(const StudyConfiguration& configuration, std::uint64_t seed,
                                const std::vector<double>& pressures,
                                const Progress& progress = {});

}  // namespace salebra
