// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <salebra/contact/fit.hpp>
#include <salebra/contact/force_curve.hpp>
#include <salebra/contact/greenwood_williamson.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>
#include <string>
#include <vector>

namespace salebra {

/// A mean with its 95 % interval; NaN limits where there is none to be had.
struct EnsembleMean {
  double mean = ForceSample::unknown;
  double low = ForceSample::unknown;
  double high = ForceSample::unknown;
};

/// Mean and Student-t 95 % interval of the mean, over the values that are not NaN; no limits for fewer than two.
EnsembleMean student_mean(const std::vector<double>& values);

/// What one contact model says about one surface.
struct ModelResult {
  ForceCurve curve;
  ExponentialFit fit;
  ExponentialTest
      test;  ///< how far the law bends over the window of the fit; all zero for fewer than four points
  LocalDecayLength local;
};

/// Damping at one pressure of the sweep, by the two routes that a user must see side by side.
struct DampingPoint {
  double pressure = 0;  ///< Pa
  double force = 0;     ///< F = pA0, N
  /// Eq. (16), or (12) with F'' = F/l², with the l fitted to the BEM curve.
  double law_work = ForceSample::unknown;              ///< J
  double law_damping_constant = ForceSample::unknown;  ///< N s/m
  /// The theorem on the BEM curve itself at the amplitude given; NaN where the motion leaves the curve.
  double curve_work = ForceSample::unknown;              ///< J
  double curve_damping_constant = ForceSample::unknown;  ///< N s/m

  double deviation() const { return law_work / curve_work - 1; }
};

/// Everything computed for one surface.
struct Realisation {
  std::uint64_t seed = 0;  ///< 0 for a measured surface
  HeightStatistics heights;
  SpectralMoments moments;
  SummitStatistics summits;
  SummitEnsemble ensemble;  ///< of the Greenwood–Williamson theory, from the moments
  ModelResult bem, gw_moments, gw_deterministic;
  std::vector<DampingPoint> damping;
};

struct StudyResult {
  StudyConfiguration configuration;
  Grid2D grid;
  double contact_scale = 0;  ///< E*h'_rms, Pa: the unit of relative pressures
  std::vector<double> pressures;
  std::vector<Realisation> realisations;
  std::vector<std::string> warnings;  ///< sentences for the user
  bool interrupted = false;           ///< realisations holds those that were finished

  /// Over the realisations; with one only, the interval of its fit.
  EnsembleMean decay_length(ModelResult Realisation::*model) const;
  EnsembleMean decay_length_over_rms_height(ModelResult Realisation::*model) const;
  /// Of a quantity of each pressure, in the order of pressures.
  std::vector<EnsembleMean> damping(double DampingPoint::*quantity) const;
  std::vector<EnsembleMean> damping_deviation() const;
  /// How the intervals came about: one line.
  std::string interval_method() const;
};

/// Surface → statistics → Greenwood–Williamson and boundary elements → exponential law → damping, for every surface of the
/// configuration. A measured surface is treated as periodic after its plane is removed; the result carries a warning with
/// the size of the step that this makes at the seam.
/// throws  InvalidInput for a configuration that cannot be run, NotConverged where fewer than four contacts of a sweep converged
/// cost    the BEM sweep, for each surface
StudyResult run_study(const StudyConfiguration& configuration, const Progress& progress = {});

/// The result in words and tables, for a terminal: decay lengths by each model, Eq. (16) beside the result from the curve with
/// the deviation, damping constants over force.
std::string summary(const StudyResult& result);

}  // namespace salebra
