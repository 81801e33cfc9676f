// SPDX-License-Identifier: GPL-3.0-or-later
// Analysis of one surface: statistics, force curves of all models, fits and damping.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/asperity/interacting_summits.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra {
namespace {

Surface generate(const GeneratedSurfaces& recipe, std::uint64_t seed, const Progress& progress) {
  const SelfAffineSpectrum spectrum(recipe.spectrum);
  return recipe.method == GenerationMethod::random_phase
             ? random_phase(recipe.grid, spectrum, seed, progress)
             : filtered_noise(recipe.grid, spectrum, seed, progress);
}

Surface read(const MeasuredSurface& recipe) {
  require(!recipe.file.empty(), "surface", "none",
          "is given; name a file by --surface, or add a table [surface]");
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

// Below, single contacts of a few cells decide; above, the law is no longer linear.
constexpr double area_slope_from = 0.002, area_slope_to = 0.05;

/// κ of A/A0 = κ p/(E*h') over the loads for which that is a law.
double area_slope(const std::vector<double>& pressures, const std::vector<double>& areas,
                  double scale) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < pressures.size(); ++i) {
    const double load = pressures[i] / scale;
    if (!(load >= area_slope_from && load <= area_slope_to) || std::isnan(areas[i])) continue;
    product += load * areas[i];
    square += load * load;
  }
  return product / square;
}

std::vector<DampingPoint> damping_curve(const ModelResult& model,
                                        const StudyConfiguration& configuration) {
  const double modulus_ratio = configuration.material.modulus_ratio();
  std::optional<ExponentialLaw> fitted_law;
  if (std::isfinite(model.fit.decay_length))
    fitted_law.emplace(1, model.fit.decay_length, modulus_ratio);
  std::optional<TabulatedLaw> curve_law;
  try {
    curve_law.emplace(model.curve, modulus_ratio);
  } catch (const InvalidInput&) {
    // Too few samples for a law: nothing to lose energy by.
  }
  DampingOptions small = configuration.damping;
  small.amplitude = Amplitude::small;
  std::vector<DampingPoint> points;
  for (const ForceSample& sample : model.curve.samples) {
    DampingPoint point;
    point.pressure = sample.pressure;
    point.force = sample.force;
    points.push_back(point);
    if (!sample.converged || !(sample.force > 0)) continue;
    const AtForce position{sample.force};
    if (fitted_law) {
      const auto by_law = relaxation_damping(*fitted_law, position, configuration.motion, small);
      point.law_work = by_law.work_per_cycle;
      point.law_damping_constant = by_law.damping_constant;
    }
    if (curve_law) {
      try {
        const auto by_curvature =
            relaxation_damping(*curve_law, position, configuration.motion, small);
        point.small_work = by_curvature.work_per_cycle;
        point.small_damping_constant = by_curvature.damping_constant;
        const auto by_curve =
            relaxation_damping(*curve_law, position, configuration.motion, configuration.damping);
        if (by_curve.converged) {
          point.curve_work = by_curve.work_per_cycle;
          point.curve_damping_constant = by_curve.damping_constant;
        }
      } catch (const InvalidInput&) {
        // Near its ends the curve does not cover the whole cycle: no value there.
      }
    }
    points.back() = point;
  }
  return points;
}

/// What can be said of a model's curve. One that has too few samples in the window has no decay length, and no loss by Eq. (16).
ModelResult analysed(ForceCurve curve, const StudyConfiguration& configuration, double scale) {
  constexpr double unknown = ForceSample::unknown;
  ModelResult result;
  const PressureWindow nowhere{unknown, unknown, 0};
  result.fit = {unknown, unknown, unknown, unknown, unknown, nowhere, unknown};
  result.test = {unknown, unknown, unknown, unknown, unknown, nowhere};
  result.sensitivity = {unknown, unknown, 0};
  try {
    result.fit = fit_exponential(curve, configuration.window);
    if (result.fit.window.points >= 4) result.test = test_exponential(curve, configuration.window);
    result.sensitivity = window_sensitivity(curve, configuration.window);
  } catch (const InvalidInput&) {
  }
  try {
    result.local = local_decay_length(curve);
  } catch (const InvalidInput&) {
  }
  result.area_slope = area_slope(curve.column(&ForceSample::pressure),
                                 curve.column(&ForceSample::contact_area_fraction), scale);
  result.curve = std::move(curve);
  result.damping = damping_curve(result, configuration);
  return result;
}

/// The modes that the surface has, ring by ring.
std::vector<RoughnessShell> shells_of(const Surface& surface) {
  const PowerSpectrum spectrum = power_spectrum(surface);
  const RadialSpectrum rings = radial_spectrum(spectrum, 16);
  std::vector<RoughnessShell> shells;
  for (std::size_t i = 0; i < rings.wavenumber.size(); ++i) {
    const double power = double(rings.modes[i]) * rings.density[i] * spectrum.cell();
    if (power > 0) shells.push_back({rings.wavenumber[i], power});
  }
  return shells;
}

SpotStatistics spot_statistics(const ContactSpots& contact, const Grid2D& grid) {
  SpotStatistics statistics;
  statistics.count = double(contact.spots.size());
  statistics.corrected_area_fraction = contact.corrected_area_fraction;
  statistics.largest_area = contact.spots.empty() ? 0 : contact.spots.front().area;
  statistics.mean_area = contact.spots.empty() ? 0
                                               : contact.contact_area_fraction * grid.area() /
                                                     double(contact.spots.size());
  statistics.sizes.assign(std::size_t(std::bit_width(std::uint64_t(grid.points()))), 0.0);
  for (const ContactSpot& spot : contact.spots) {
    const auto cells = std::uint64_t(std::llround(spot.area / grid.cell_area()));
    statistics.sizes[std::size_t(std::bit_width(cells) - 1)] += 1;
  }
  return statistics;
}

/// Those of Monte Carlo, interacting summits and Persson's theory that were asked for.
void add_other_models(Realisation& realisation, const Surface& surface, const SummitList& summits,
                      const StudyConfiguration& configuration, double scale,
                      const std::vector<double>& pressures, const Progress& progress) {
  const Material& material = configuration.material;
  const double area = surface.grid.area(), rms_height = realisation.heights.rms_height;
  if (configuration.has(ContactModel::gw_monte_carlo)) {
    const SummitEnsemble& ensemble = realisation.ensemble;
    const int count = std::max(1, int(std::lround(ensemble.density * area)));
    const DeterministicSummits drawn(
        draw_summits(ensemble, count, std::sqrt(area), realisation.seed), material, area,
        -ensemble.mean_height, rms_height);
    realisation.gw_monte_carlo =
        analysed(curve_at_pressures(drawn, pressures), configuration, scale);
  }
  if (configuration.has(ContactModel::persson)) {
    const PerssonTheory theory(shells_of(surface), material.contact_modulus);
    ForceCurve persson = persson_curve(theory, material, area, pressures);
    persson.rms_height = rms_height;
    realisation.persson = analysed(persson, configuration, scale);
    realisation.persson_decay_length = theory.asymptote().decay_length;
  }
  if (configuration.has(ContactModel::gw_interacting)) {
    const InteractingSummits interacting(summits.summits, material, surface.grid,
                                         realisation.heights.mean, rms_height);
    realisation.gw_interacting =
        analysed(curve_at_pressures(interacting, pressures, progress), configuration, scale);
  }
}

}  // namespace

bool stick_solves(const StudyConfiguration& configuration) {
  return configuration.stick && std::isfinite(configuration.material.cerruti_isotropic);
}

std::vector<StudyModel> models_of(const StudyConfiguration& configuration) {
  std::vector<StudyModel> chosen;
  for (const StudyModel& model : study_models)
    if (configuration.has(model.model)) chosen.push_back(model);
  return chosen;
}

Surface study_surface(const StudyConfiguration& configuration, std::uint64_t seed,
                      const Progress& progress) {
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces))
    return generate(*recipe, seed, progress);
  return read(std::get<MeasuredSurface>(configuration.surfaces));
}

double contact_scale(const StudyConfiguration& configuration) {
  double slope = 0;
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&configuration.surfaces)) {
    slope = SelfAffineSpectrum(recipe->spectrum).lattice_moments(recipe->grid).rms_slope();
  } else {
    slope = surface_moments(study_surface(configuration, 0)).rms_slope();
  }
  return configuration.material.contact_modulus * slope;
}

std::vector<double> study_pressures(const StudyConfiguration& configuration) {
  std::vector<double> pressures = configuration.pressures;
  if (configuration.relative_pressures) {
    const double scale = contact_scale(configuration);
    for (double& pressure : pressures) pressure *= scale;
  }
  if (const auto& window = configuration.window) {
    const auto inside = std::ranges::count_if(
        pressures, [&](double pressure) { return window->contains(pressure); });
    require(inside >= 3, "pressure_window", inside,
            "pressures lie in it and a fit needs 3; widen it or compute more of them");
  }
  return pressures;
}

Realisation analyse_realisation(const StudyConfiguration& configuration, std::uint64_t seed,
                                const std::vector<double>& pressures, const Progress& progress) {
  const Surface surface = study_surface(configuration, seed, [&](const ProgressReport&) {
    return !progress || progress({.stage = "realisation"});
  });
  Realisation realisation;
  realisation.seed = seed;
  realisation.grid = surface.grid;
  realisation.heights = height_statistics(surface);
  realisation.periodic = surface.periodic;
  if (!surface.periodic)
    realisation.seam_step = seam_step(surface) / realisation.heights.rms_height;
  realisation.moments = surface_moments(surface);
  const SummitList summits = find_summits(surface);
  realisation.summits = summit_statistics(summits);
  const Material& material = configuration.material;
  const SpectralMoments& moments = realisation.moments;
  const double scale = material.contact_modulus * moments.rms_slope();

  realisation.ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  realisation.ensemble.rms_height = realisation.heights.rms_height;
  const StatisticalSummits statistical(realisation.ensemble, material, surface.grid.area());
  realisation.gw_moments =
      analysed(curve_at_pressures(statistical, pressures), configuration, scale);
  const DeterministicSummits deterministic(summits.summits, material, summits.searched_area,
                                           realisation.heights.mean,
                                           realisation.heights.rms_height);
  realisation.gw_deterministic =
      analysed(curve_at_pressures(deterministic, pressures), configuration, scale);

  bool stopped = false;
  // The share of the interacting summits in the time.
  const double others = configuration.has(ContactModel::gw_interacting) ? 0.4 : 0.0;
  const auto part = [&](double begin, double share) -> Progress {
    return [&, begin, share](const ProgressReport& report) {
      stopped = stopped || (progress && !progress({.stage = "realisation",
                                                   .fraction = begin + share * report.fraction}));
      return !stopped;
    };
  };
  add_other_models(realisation, surface, summits, configuration, scale, pressures, part(0, others));
  if (stopped) throw Interrupted("study: interrupted");

  if (wants_picture(configuration, seed)) realisation.picture = picture_of(surface, configuration);
  std::mutex picture_guard;
  SweepOptions sweep;
  sweep.contact.tolerance = configuration.tolerance;
  sweep.contact.on_progress = part(others, 1 - others);
  sweep.stick = stick_solves(configuration);
  realisation.spots.resize(pressures.size());
  sweep.on_state = [&](std::size_t k, const NormalContactState& state) {
    realisation.spots[k] =
        spot_statistics(contact_spots(state.pressure, surface.grid), surface.grid);
    if (realisation.picture.empty()) return;
    const std::scoped_lock lock(picture_guard);
    realisation.picture.add_contact(std::int16_t(k), state);
  };
  ForceCurve curve = sweep_pressures(surface, material, pressures, sweep);
  if (stopped) throw Interrupted("study: interrupted");
  const auto converged = std::ranges::count_if(curve.samples, &ForceSample::converged);
  if (converged < 4) {
    throw NotConverged(
        fmt::format("contact: only {} of {} pressures converged to {}; allow a larger tolerance",
                    converged, pressures.size(), configuration.tolerance));
  }
  realisation.bem = analysed(std::move(curve), configuration, scale);
  std::vector<double> corrected;
  for (const SpotStatistics& spots : realisation.spots)
    corrected.push_back(spots.corrected_area_fraction);
  realisation.corrected_area_slope = area_slope(pressures, corrected, scale);
  return realisation;
}

}  // namespace salebra
