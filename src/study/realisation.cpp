// SPDX-License-Identifier: GPL-3.0-or-later
// Analysis of one surface: statistics, force curves of all models, fits and damping.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/study/realisation.hpp>
#include <string>
#include <utility>

#include "base/memory.hpp"
#include "base/stage_time.hpp"
#include "case_run.hpp"
#include "contact_models.hpp"
#include "damping/phase_quadrature.hpp"
#include "damping/surface_contacts.hpp"
#include "damping/wide_oscillation.hpp"
#include "surface/gather_summits.hpp"
#include "surface/seam_step.hpp"

namespace salebra {
namespace {

// Range of p/(E*h') for the fit of the area law. Below it, single contact patches of a few cells
// decide the area; above it, the area is no longer proportional to the load.
constexpr double area_slope_from = 0.002, area_slope_to = 0.05;

/// The area slope κ of A/A0 = κ p/(E*h') (A/A0: contact area fraction), fitted to the loads between
/// area_slope_from and area_slope_to. scale: E*h', Pa.
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

/// The coefficient α of K = αF/h_rms, fitted to the loads in the window.
double stiffness_coefficient(const ForceCurve& curve, const PressureWindow& window) {
  double product = 0, square = 0;
  for (const ForceSample& sample : curve.samples) {
    if (!sample.converged || !window.contains(sample.pressure, PressureWindow::round_off) ||
        std::isnan(sample.normal_stiffness))
      continue;
    product += sample.force * sample.normal_stiffness;
    square += sample.force * sample.force;
  }
  return curve.rms_height * product / square;
}

std::vector<DampingPoint> damping_curve(const ModelResult& model,
                                        const StudyConfiguration& configuration) {
  const detail::StageTime time(detail::Stage::oscillation);
  const double modulus_ratio = configuration.pressed().modulus_ratio();
  const bool adhesive = configuration.adhesion.has_value();
  std::optional<ExponentialLaw> fitted_law;
  if (std::isfinite(model.fit.decay_length) && std::isfinite(modulus_ratio))
    fitted_law.emplace(1, model.fit.decay_length, modulus_ratio);
  std::optional<TabulatedLaw> curve_law;
  try {
    curve_law.emplace(model.curve, modulus_ratio);
  } catch (const InvalidInput&) {
    // Too few samples converged for a contact law, so no loss is known.
  }
  DampingOptions options = configuration.damping;
  options.hold = configuration.hold();
  DampingOptions small = options;
  small.amplitude = Amplitude::small;
  std::vector<DampingPoint> points;
  for (const ForceSample& sample : model.curve.samples) {
    DampingPoint point;
    point.pressure = sample.pressure;
    point.force = sample.force;
    points.push_back(point);
    if (adhesive || !sample.converged || !(sample.force > 0)) continue;
    const OperatingPoint held = at_force(sample.force);
    if (fitted_law) {
      const auto by_law = relaxation_damping(*fitted_law, held, configuration.motion, small);
      point.work_per_cycle_closed_form = by_law.work_per_cycle;
      point.damping_constant_closed_form = by_law.damping_constant;
    }
    if (curve_law) {
      try {
        if (std::isfinite(modulus_ratio)) {
          const auto by_curvature =
              relaxation_damping(*curve_law, held, configuration.motion, small);
          point.small_amplitude_work = by_curvature.work_per_cycle;
          point.small_amplitude_damping_constant = by_curvature.damping_constant;
        }
        auto by_curve = relaxation_damping(*curve_law, held, configuration.motion, options);
        if (by_curve.converged) {
          point.mean_force = by_curve.mean_force;
          point.max_force = by_curve.max_force;
          point.contact_time = by_curve.contact_time;
          // First sets the loss without slip. With friction add_slip() may throw, because slip
          // reaches indentations below the curve; then only this loss without slip stays.
          static_cast<Loss&>(point) = by_curve;
          if (!std::isnan(configuration.known.friction_coefficient)) point.forget();
          add_slip(by_curve, *curve_law, motion_of(configuration.motion), configuration.known);
          static_cast<Loss&>(point) = by_curve;
          // The error by the distances between the loads is not that of the surface, whose cells
          // nobody examined here.
          point.error = point.error_without_slip = {};
        }
      } catch (const InvalidInput&) {
        // A cycle at the first or last loads of the curve leaves its range, so the loss stays
        // unknown.
      }
    }
    points.back() = point;
  }
  return points;
}

/// In the results of the boundary-element model in all directions, replaces losses computed from the
/// curve by losses from contacts solved inside the oscillation.
void resolve_damping(const std::vector<ModelResult*>& results, const Surface& surface,
                     const detail::KeptContacts& contacts, const StudyConfiguration& configuration,
                     std::uint64_t seed, const Progress& progress) {
  SurfaceDampingOptions options = surface_damping_options(configuration, surface.grid, seed);
  options.on_progress = progress;
  options.friction_coefficient = configuration.known.friction_coefficient;
  options.excursion = configuration.known.excursion;
  std::vector<ForceCurve> curves;
  for (const ModelResult* result : results) curves.push_back(result->curve);
  const std::vector<std::vector<SurfaceDamping>> resolved =
      detail::surface_damping(surface, configuration.pressed(), configuration.motion, curves,
                              options, contacts, configuration.tolerance);
  // In a mean over surfaces large errors average out. A study of a single surface drops a loss that
  // does not exceed its error.
  const bool alone = detail::seeds_of(configuration).size() == 1;
  const bool known = why_loss_unknown(motion_of(configuration.motion), configuration.known).empty();
  for (std::size_t d = 0; d < results.size(); ++d)
    for (std::size_t k = 0; k < resolved[d].size(); ++k) {
      const SurfaceDamping& found = resolved[d][k];
      DampingPoint& point = results[d]->damping[k];
      point.mean_force = found.mean_force;
      point.max_force = found.max_force;
      point.contact_time = found.contact_time;
      point.possible_amplitude = found.possible_amplitude;
      Loss& loss = point;
      loss = found;
      if (alone) loss.drop_uncertain();
      if (!known) loss.forget();
    }
}

void require_converged(const ForceCurve& curve, const StudyConfiguration& configuration) {
  const auto converged = std::ranges::count_if(curve.samples, &ForceSample::converged);
  if (converged < 4)
    throw NotConverged(
        fmt::format("contact: only {} of {} pressures converged to {}; allow a larger tolerance, "
                    "or take lower pressures if these are near full contact",
                    converged, curve.samples.size(), configuration.tolerance));
}

/// The surface that the models press. If a hardness is known, this is the surface that the first
/// loading leaves behind.
ResidualSurface first_loaded(Surface surface, const StudyConfiguration& configuration,
                             double max_pressure, const Progress& progress) {
  if (std::isnan(configuration.known.hardness)) return {.surface = std::move(surface)};
  NormalContactOptions options;
  options.tolerance = configuration.tolerance;
  options.hardness = configuration.known.hardness;
  options.on_progress = progress;
  ResidualSurface residual = detail::loaded_by_motion(
      std::move(surface), configuration.material.contact_modulus, max_pressure, options,
      detail::normal_amplitude(configuration.motion), configuration.hold());
  if (residual.termination == Termination::interrupted) throw Interrupted("study: interrupted");
  if (!residual.converged())
    throw NotConverged(
        fmt::format("contact: the first loading did not converge to {}; allow a larger tolerance",
                    configuration.tolerance));
  return residual;
}

/// The statistics of a surface after the first loading and before it is pressed by the models.
Realisation described(const ResidualSurface& loaded, const SummitList& summits) {
  const Surface& surface = loaded.surface;
  Realisation realisation;
  realisation.first_loading = loaded.first_loading;
  realisation.grid = surface.grid;
  realisation.heights = height_statistics(surface);
  realisation.periodic = surface.periodic;
  if (!surface.periodic)
    realisation.seam_step = detail::seam_step(surface) / realisation.heights.rms_height;
  realisation.moments = surface_moments(surface);
  realisation.summits = summit_statistics(summits);
  if (realisation.has_random_summits()) {
    const SpectralMoments& moments = realisation.moments;
    realisation.ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
    realisation.ensemble.rms_height = realisation.heights.rms_height;
  }
  return realisation;
}

/// Fits an exponential law to the curve of a model and tests it. With too few samples in the window
/// there is no decay length, and no loss by Eq. (16). scale: E*h', Pa.
void analyse(ModelResult& result, const StudyConfiguration& configuration, double scale) {
  constexpr double unknown = ForceSample::unknown;
  const ForceCurve& curve = result.curve;
  const PressureWindow nowhere{unknown, unknown, 0};
  result.fit = {unknown, unknown, unknown, unknown, unknown, nowhere, unknown};
  result.test = {unknown, unknown, unknown, unknown, unknown, nowhere};
  result.sensitivity = {unknown, unknown, 0};
  try {
    result.fit = fit_exponential(curve, configuration.window);
    if (result.fit.window.points >= 4) result.test = test_exponential(curve, configuration.window);
    result.sensitivity = window_sensitivity(curve, configuration.window);
    result.decay_length_equal_weights =
        fit_exponential(curve, configuration.window, FitWeights::equal).decay_length;
  } catch (const InvalidInput&) {
  }
  try {
    result.local = local_decay_length(curve);
  } catch (const InvalidInput&) {
  }
  result.area_slope = area_slope(curve.column(&ForceSample::pressure),
                                 curve.column(&ForceSample::contact_area_fraction), scale);
  result.stiffness_coefficient = stiffness_coefficient(curve, result.fit.window);
  result.damping = damping_curve(result, configuration);
}

}  // namespace

bool stick_solves(const StudyConfiguration& configuration) {
  return configuration.body ||
         (configuration.stick && std::isfinite(configuration.material.cerruti_isotropic));
}

SurfaceDampingOptions surface_damping_options(const StudyConfiguration& configuration,
                                              const Grid2D& grid, std::uint64_t seed) {
  constexpr Index max_halved = 256;
  const std::vector<std::uint64_t> seeds = detail::seeds_of(configuration);
  const bool alone = seeds.size() == 1, to_error = configuration.relative_error > 0;
  SurfaceDampingOptions options;
  options.hold = configuration.hold();
  options.amplitude = configuration.damping.amplitude;
  options.intervals = configuration.intervals.value_or(4);
  options.choose_intervals = alone || to_error;
  options.relative_error = configuration.relative_error;
  options.seam = configuration.seam;
  options.keep_cells = !alone && !to_error;
  options.refinements = 0;
  if (to_error || (alone && std::max(grid.nx, grid.ny) <= max_halved))
    options.refinements = 1;
  else if (seed == seeds.front())
    options.coarsen = true;
  return options;
}

std::vector<StudyModel> models_of(const StudyConfiguration& configuration) {
  std::vector<StudyModel> chosen;
  for (const StudyModel& model : contact_models())
    if (configuration.has(model.id)) chosen.push_back(model);
  return chosen;
}

double ModelResult::law_bend() const {
  return test.window.points >= 4 ? test.decay_length_at_max_gap / test.decay_length_at_min_gap - 1
                                 : ForceSample::unknown;
}

const ModelResult& Realisation::of(ContactModel model) const {
  const auto found = std::ranges::find(models, model, &ModelResult::model);
  if (found == models.end())
    throw InvalidInput("model", fmt::format("'{}'", name_of(model)),
                       "was not computed; request it in the configuration");
  return *found;
}

ModelResult& Realisation::of(ContactModel model) {
  return const_cast<ModelResult&>(std::as_const(*this).of(model));
}

Hold hold_of(const StudyConfiguration& configuration, const Surface& surface,
             double lowest_pressure, const Progress& progress) {
  // Only a motion of finite amplitude has a mean force other than that at rest.
  if (configuration.damping.hold == Hold::automatic &&
      (configuration.adhesion || configuration.damping.amplitude == Amplitude::small))
    return Hold::indentation;
  return detail::hold_of(surface, configuration.pressed(), lowest_pressure,
                         detail::normal_amplitude(configuration.motion), configuration.damping.hold,
                         progress);
}

Realisation analyse_realisation(Surface drawn, const StudyConfiguration& asked, std::uint64_t seed,
                                const std::vector<double>& pressures, const Progress& progress) {
  const detail::StageTime time(detail::Stage::statistics);
  StudyConfiguration configuration = asked;
  if (!configuration.found_hold)
    configuration.found_hold = hold_of(asked, drawn, pressures.front(), progress);
  const std::vector<StudyModel> models = models_of(configuration);
  double cost = 0, spent = 0;
  for (const StudyModel& model : models) cost += model.seconds_per_cell;
  bool stopped = false;
  const auto part = [&](double share) -> Progress {
    return [&, share](const ProgressReport& report) {
      stopped = stopped ||
                (progress && !progress({.stage = "realisation",
                                        .fraction = (spent + share * report.fraction) / cost}));
      return !stopped;
    };
  };
  const ResidualSurface loaded =
      first_loaded(std::move(drawn), configuration, pressures.back(), part(0));
  const Surface& surface = loaded.surface;
  const Communicator& communicator = surface.communicator;
  SummitList summits = find_summits(surface);
  Realisation realisation = described(loaded, summits);
  realisation.seed = seed;
  if (configuration.has(ContactModel::gw_deterministic))
    summits = detail::gathered(std::move(summits), surface.grid);
  const double scale =
      configuration.body ? pressure_scale(surface, *configuration.body)
                         : configuration.material.contact_modulus * realisation.moments.rms_slope();
  if (wants_picture(configuration, seed)) {
    realisation.picture = picture_of(surface, configuration);
    realisation.picture.mapped_load = Index(pressures.size() / 2);
  }

  const std::vector<double> directions = directions_of(configuration, surface);
  const double lay_angle =
      configuration.flow_factors ? detail::lay_angle_of(configuration, surface) : 0;
  std::vector<RoughnessShell> shells;
  if (configuration.has(ContactModel::persson)) shells = detail::shells_of(surface);

  for (const StudyModel& model : models) {
    const Progress share = part(model.seconds_per_cell);
    detail::ModelWork work{configuration, surface,   summits,     shells, pressures,
                           directions,    lay_angle, realisation, share};
    const bool bem = model.id == ContactModel::bem;
    const bool resolves = bem && configuration.intervals != 0 && !configuration.adhesion;
    detail::KeptContacts contacts;
    if (resolves) work.contacts = &contacts;
    ModelResult result;
    if (bem)
      result = model.press(work);
    else
      collectively(communicator, [&] {
        if (communicator.is_root()) result = model.press(work);
      });
    if (!communicator.all_agree(!stopped)) throw Interrupted("study: interrupted");
    result.model = model.id;
    if (bem) require_converged(result.curve, configuration);
    std::vector<ModelResult*> results{&result};
    if (bem)
      for (ModelResult& other : realisation.other_directions) results.push_back(&other);
    for (ModelResult* one : results) analyse(*one, configuration, scale);
    if (resolves) resolve_damping(results, surface, contacts, configuration, seed, share);
    realisation.models.push_back(std::move(result));
    spent += model.seconds_per_cell;
  }
  if (!realisation.picture.empty()) realisation.picture.gather(communicator);
  std::vector<double> corrected;
  for (const SpotStatistics& spots : realisation.spots)
    corrected.push_back(spots.corrected_area_fraction);
  realisation.corrected_area_slope = area_slope(pressures, corrected, scale);
  return realisation;
}

}  // namespace salebra
