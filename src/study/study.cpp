// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <salebra/base/error.hpp>
#include <salebra/contact/law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/study/study.hpp>

namespace salebra {
namespace {

Surface generate(const GeneratedSurfaces& recipe, std::uint64_t seed) {
  const SelfAffineSpectrum spectrum(recipe.spectrum);
  return recipe.method == GenerationMethod::random_phase
             ? random_phase(recipe.grid, spectrum, seed)
             : filtered_noise(recipe.grid, spectrum, seed);
}

Surface read(const MeasuredSurface& recipe) {
  require(!recipe.file.empty(), "surface", "none", "is given; add [surface] or name a file");
  ReadOptions options;
  options.size_x = recipe.size_x;
  options.size_y = recipe.size_y;
  options.height_unit = recipe.height_unit;
  Surface surface = read_surface(recipe.file, options);
  surface.require_complete("a study");
  const Detrend trend = recipe.detrend.value_or(customary_detrend(surface));
  return detrended(std::move(surface), trend);
}

/// Root mean square of the steps between opposite edges, which a periodic continuation turns into cliffs.
double seam_step(const Surface& surface) {
  const Field& h = surface.heights;
  const double along_x = (h.row(0) - h.row(h.rows() - 1)).square().mean();
  const double along_y = (h.col(0) - h.col(h.cols() - 1)).square().mean();
  return std::sqrt((along_x + along_y) / 2);
}

bool stick_solves(const StudyConfiguration& configuration) {
  return configuration.stick && std::isfinite(configuration.material.cerruti_isotropic);
}

ModelResult fitted(ForceCurve curve, const StudyConfiguration& configuration) {
  ModelResult result;
  result.fit = fit_exponential(curve, configuration.window);
  if (result.fit.window.points >= 4) result.test = test_exponential(curve, configuration.window);
  result.local = local_decay_length(curve);
  result.curve = std::move(curve);
  return result;
}

std::vector<DampingPoint> damping_curve(const ModelResult& bem,
                                        const StudyConfiguration& configuration) {
  const double modulus_ratio = configuration.material.modulus_ratio();
  const TabulatedLaw curve_law(bem.curve, modulus_ratio);
  const ExponentialLaw fitted_law(1, bem.fit.decay_length, modulus_ratio);
  DampingOptions small = configuration.damping;
  small.amplitude = Amplitude::small;
  std::vector<DampingPoint> points;
  for (const ForceSample& sample : bem.curve.samples) {
    DampingPoint point;
    point.pressure = sample.pressure;
    point.force = sample.force;
    points.push_back(point);
    if (!sample.converged) continue;
    const AtForce position{sample.force};
    const auto by_law = relaxation_damping(fitted_law, position, configuration.motion, small);
    point.law_work = by_law.work_per_cycle;
    point.law_damping_constant = by_law.damping_constant;
    try {
      const auto by_curve =
          relaxation_damping(curve_law, position, configuration.motion, configuration.damping);
      if (by_curve.converged) {
        point.curve_work = by_curve.work_per_cycle;
        point.curve_damping_constant = by_curve.damping_constant;
      }
    } catch (const InvalidInput&) {
      // Near its ends the curve does not cover the whole cycle: no value there.
    }
    points.back() = point;
  }
  return points;
}

/// Everything about one surface. The progress of its sweep is reported as a part of the whole study.
Realisation analyse(const Surface& surface, const StudyConfiguration& configuration,
                    const std::vector<double>& pressures, const Progress& progress) {
  Realisation realisation;
  realisation.heights = height_statistics(surface);
  realisation.moments = surface_moments(surface);
  const SummitList summits = find_summits(surface);
  realisation.summits = summit_statistics(summits);
  const Material& material = configuration.material;

  const SpectralMoments& moments = realisation.moments;
  realisation.ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  realisation.ensemble.rms_height = realisation.heights.rms_height;
  const StatisticalSummits statistical(realisation.ensemble, material, surface.grid.area());
  realisation.gw_moments = fitted(curve_at_pressures(statistical, pressures), configuration);
  const DeterministicSummits deterministic(summits.summits, material, summits.searched_area,
                                           realisation.heights.mean,
                                           realisation.heights.rms_height);
  realisation.gw_deterministic =
      fitted(curve_at_pressures(deterministic, pressures), configuration);

  SweepOptions sweep;
  sweep.contact.tolerance = configuration.tolerance;
  sweep.contact.on_progress = progress;
  sweep.stick = stick_solves(configuration);
  ForceCurve curve = sweep_pressures(surface, material, pressures, sweep);
  const auto converged = std::ranges::count_if(curve.samples, &ForceSample::converged);
  if (converged < 4) {
    throw NotConverged(
        fmt::format("contact: only {} of {} pressures converged to {}; allow a larger tolerance",
                    converged, pressures.size(), configuration.tolerance));
  }
  realisation.bem = fitted(std::move(curve), configuration);
  realisation.damping = damping_curve(realisation.bem, configuration);
  return realisation;
}

/// The unit of relative pressures, without looking at chance: what the lattice has in the mean, or what was measured.
double contact_scale(const StudyConfiguration& configuration, const Surface& first) {
  double slope = 0;
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces)) {
    slope = SelfAffineSpectrum(recipe->spectrum).lattice_moments(recipe->grid).rms_slope();
  } else {
    slope = surface_moments(first).rms_slope();
  }
  return configuration.material.contact_modulus * slope;
}

void warn(StudyResult& result) {
  int lost = 0, unconverged = 0;
  for (const Realisation& realisation : result.realisations) {
    lost += int(std::ranges::count_if(realisation.damping, [](const DampingPoint& point) {
      return std::isnan(point.curve_work);
    }));
    unconverged +=
        int(std::ranges::count(realisation.bem.curve.samples, false, &ForceSample::converged));
  }
  if (unconverged > 0) {
    result.warnings.push_back(fmt::format("{} contacts did not converge to {} and were left out",
                                          unconverged, result.configuration.tolerance));
  }
  const auto total = result.realisations.size() * result.pressures.size();
  if (lost > 0 && std::size_t(lost) == total) {
    result.warnings.push_back(
        "the normal oscillation leaves the computed curve at every force: make normal_amplitude "
        "smaller or widen the pressures");
  }
}

}  // namespace

EnsembleMean student_mean(const std::vector<double>& values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known),
                       [](double value) { return !std::isnan(value); });
  EnsembleMean estimate;
  if (known.empty()) return estimate;
  const double count = double(known.size());
  double sum = 0;
  for (const double value : known) sum += value;
  estimate.mean = sum / count;
  if (known.size() < 2) return estimate;
  double squares = 0;
  for (const double value : known) squares += (value - estimate.mean) * (value - estimate.mean);
  const double half =
      gsl_cdf_tdist_Pinv(0.975, count - 1) * std::sqrt(squares / (count - 1) / count);
  estimate.low = estimate.mean - half;
  estimate.high = estimate.mean + half;
  return estimate;
}

StudyResult run_study(const StudyConfiguration& configuration, const Progress& progress) {
  StudyResult result;
  result.configuration = configuration;
  const auto* generated = std::get_if<GeneratedSurfaces>(&configuration.surfaces);
  const std::vector<std::uint64_t> seeds =
      generated ? generated->seeds : std::vector<std::uint64_t>{0};
  require(!seeds.empty(), "seeds", 0, "is too few; give at least one");
  configuration.material.modulus_ratio();

  if (configuration.stick && !stick_solves(configuration)) {
    result.warnings.push_back(
        "G*/E* is not that of any elastic body: K_t = (G*/E*)K instead of stick solves; give "
        "Poisson's ratio, or --no-stick to say that it is meant");
  }
  const double share = 1.0 / double(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const auto report = [&](double fraction) {
      return !progress ||
             progress(
                 {.stage = "study", .fraction = (double(i) + fraction) * share, .step = int(i)});
    };
    if (!report(0)) {
      result.interrupted = true;
      break;
    }
    const Surface surface = generated ? generate(*generated, seeds[i])
                                      : read(std::get<MeasuredSurface>(configuration.surfaces));
    if (i == 0) {
      result.grid = surface.grid;
      result.contact_scale = contact_scale(configuration, surface);
      result.pressures = configuration.pressures;
      if (configuration.relative_pressures) {
        for (double& pressure : result.pressures) pressure *= result.contact_scale;
      }
      if (!surface.periodic) {
        result.warnings.push_back(fmt::format(
            "the surface is measured, not periodic, and is continued periodically: its opposite "
            "edges differ by {:.2g} rms heights, which adds a few steep contacts along the seam",
            seam_step(surface) / height_statistics(surface).rms_height));
      }
    }
    bool stopped = false;
    const Progress part = [&](const ProgressReport& sweep) {
      stopped = stopped || !report(sweep.fraction);
      return !stopped;
    };
    Realisation realisation;
    try {
      realisation = analyse(surface, configuration, result.pressures, part);
    } catch (const Error&) {
      if (!stopped) throw;
    }
    if (stopped) {
      result.interrupted = true;
      break;
    }
    realisation.seed = seeds[i];
    result.realisations.push_back(std::move(realisation));
  }
  warn(result);
  return result;
}

EnsembleMean StudyResult::decay_length(ModelResult Realisation::*model) const {
  std::vector<double> values;
  for (const Realisation& realisation : realisations)
    values.push_back((realisation.*model).fit.decay_length);
  if (values.size() != 1) return student_mean(values);
  const ExponentialFit& fit = (realisations.front().*model).fit;
  return {fit.decay_length, fit.decay_length_low, fit.decay_length_high};
}

EnsembleMean StudyResult::decay_length_over_rms_height(ModelResult Realisation::*model) const {
  std::vector<double> values;
  for (const Realisation& realisation : realisations) {
    values.push_back((realisation.*model).fit.decay_length / realisation.heights.rms_height);
  }
  if (values.size() != 1) return student_mean(values);
  const ExponentialFit& fit = (realisations.front().*model).fit;
  const double rms_height = realisations.front().heights.rms_height;
  return {fit.decay_length / rms_height, fit.decay_length_low / rms_height,
          fit.decay_length_high / rms_height};
}

namespace {

template <class Value>
std::vector<EnsembleMean> over_realisations(const StudyResult& result, Value value) {
  std::vector<EnsembleMean> estimates;
  for (std::size_t i = 0; i < result.pressures.size(); ++i) {
    std::vector<double> values;
    for (const Realisation& realisation : result.realisations) {
      values.push_back(std::invoke(value, realisation.damping[i]));
    }
    estimates.push_back(student_mean(values));
  }
  return estimates;
}

}  // namespace

std::vector<EnsembleMean> StudyResult::damping(double DampingPoint::*quantity) const {
  return over_realisations(*this, quantity);
}

std::vector<EnsembleMean> StudyResult::damping_deviation() const {
  return over_realisations(*this, &DampingPoint::deviation);
}

std::string StudyResult::interval_method() const {
  return realisations.size() == 1
             ? "95 % limits of the least-squares fit; one surface says nothing about the spread "
               "between surfaces"
             : fmt::format("95 % Student-t interval of the mean over {} surfaces",
                           realisations.size());
}

}  // namespace salebra
