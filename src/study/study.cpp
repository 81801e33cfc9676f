// SPDX-License-Identifier: GPL-3.0-or-later
// Run of a whole study: all combinations of parameters, and warnings about the results.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/units.hpp>
#include <salebra/study/parts.hpp>
#include <salebra/study/study.hpp>

#include "base/memory.hpp"
#include "case_run.hpp"
#include "cost.hpp"
#include "damping/max_motion.hpp"

namespace salebra {
namespace {

/// The smallest amplitude that is possible where the motion presses a surface beyond full contact;
/// NaN if it does not.
double min_possible_amplitude(const StudyResult& result) {
  double least = ForceSample::unknown;
  for (const Realisation& realisation : result.realisations)
    for (const DampingPoint& point : realisation.of(ContactModel::bem).damping)
      least = std::fmin(least, point.possible_amplitude);
  return least;
}

void warn_of_full_contact(StudyResult& result) {
  std::vector<double> pressures;
  std::size_t surfaces = 0;
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    const auto full =
        std::size_t(std::ranges::count_if(result.realisations, [&](const Realisation& realisation) {
          const auto& damping = realisation.of(ContactModel::bem).damping;
          return k < damping.size() && !std::isnan(damping[k].possible_amplitude);
        }));
    if (full == 0) continue;
    pressures.push_back(result.pressures[k]);
    surfaces = std::max(surfaces, full);
  }
  if (pressures.empty()) return;
  const double amplitude = std::visit([](const auto& motion) { return motion.normal_amplitude; },
                                      result.configuration.motion);
  result.warnings.push_back(fmt::format(
      "a normal amplitude of {} presses {} of {} surfaces beyond full contact at {} of {} "
      "pressures, from {} on, where no loss is known; amplitudes up to {} are possible at all of "
      "them",
      format_quantity(amplitude, Dimension::length, 3), surfaces, result.realisations.size(),
      pressures.size(), result.pressures.size(),
      format_quantity(pressures.front(), Dimension::pressure, 3),
      format_quantity(min_possible_amplitude(result), Dimension::length, 3)));
}

void warn_of_held_indentation(StudyResult& result) {
  std::vector<DampingResult> losses;
  for (const Realisation& realisation : result.realisations)
    for (const DampingPoint& point : realisation.of(ContactModel::bem).damping) {
      DampingResult& loss = losses.emplace_back();
      loss.hold = result.configuration.hold();
      loss.force = point.force;
      loss.mean_force = point.mean_force;
    }
  if (const auto warning = detail::warning_of_held_indentation(losses))
    result.warnings.push_back(*warning);
}

void warn(StudyResult& result) {
  if (result.configuration.stick && !stick_solves(result.configuration)) {
    result.warnings.push_back(
        "no elastic body has this G*/E*, so that K_t = (G*/E*)K is used instead of stick solves; "
        "give `poisson`, or leave out the stick solves");
  }
  const Realisation& first = result.realisations.front();
  if (!first.periodic) {
    result.warnings.push_back(fmt::format(
        "the measured surface is not periodic but continued periodically: its opposite edges "
        "differ by {:.2g} rms heights, which adds a few steep contacts along the seam",
        first.seam_step));
  }
  int lost = 0, unconverged = 0;
  for (const Realisation& realisation : result.realisations) {
    lost += int(std::ranges::count_if(
        realisation.of(ContactModel::bem).damping,
        [](const DampingPoint& point) { return std::isnan(point.work_per_cycle_without_slip); }));
    unconverged += int(std::ranges::count(realisation.of(ContactModel::bem).curve.samples, false,
                                          &ForceSample::converged));
  }
  if (unconverged > 0) {
    result.warnings.push_back(fmt::format("{} contacts did not converge to {} and were left out",
                                          unconverged, result.configuration.tolerance));
  }
  const auto smooth = std::ranges::count_if(
      result.realisations, [](const Realisation& r) { return !r.has_random_summits(); });
  if (smooth > 0)
    result.warnings.push_back(
        fmt::format("Nayak's parameter is below 1 on {} of {} surfaces, which are smooth shapes; "
                    "models with summits from moments leave them out",
                    smooth, result.realisations.size()));
  for (const StudyModel& model : result.models()) {
    const auto without = std::ranges::count_if(result.realisations, [&](const Realisation& r) {
      return r.has_random_summits() && std::isnan(r.of(model.id).fit.decay_length);
    });
    if (without > 0)
      result.warnings.push_back(
          fmt::format("{}: no decay length on {} of {} surfaces, because their curves have fewer "
                      "than 3 pressures {}",
                      model.name, without, result.realisations.size(),
                      result.configuration.window ? "in the pressure_window; widen it"
                                                  : "at mean gaps of 1 to 2.5 rms heights; compute "
                                                    "more pressures or give a pressure_window"));
  }
  const auto total = result.realisations.size() * result.pressures.size();
  warn_of_full_contact(result);
  warn_of_held_indentation(result);
  if (!result.configuration.adhesion && lost > 0 && std::size_t(lost) == total &&
      std::isnan(min_possible_amplitude(result))) {
    result.warnings.push_back(
        "the normal oscillation leaves the computed range of the contact at every force; reduce "
        "normal_amplitude or widen the pressures");
  }
}

/// Refuses options that need the whole surface in one process, if a group has several processes.
void require_spreadable(const StudyConfiguration& point, const Groups& groups) {
  if (groups.all().size() == groups.count()) return;
  constexpr const char* why =
      "needs each whole surface in one process; use groups of one process each, or one process";
  require(std::isnan(point.known.hardness), "hardness", point.known.hardness, why);
  require(!(point.relative_error > 0), "relative_error", point.relative_error, why);
  require(!point.flow_factors, "flow_factors", true, why);
  require(!point.has(ContactModel::gw_interacting), "models",
          contact_models()[std::size_t(ContactModel::gw_interacting)].name, why);
}

/// Refuses generated surfaces that do not fit into the memory of one process or of the processes of
/// a group.
void require_disk_space(const StudyResult& result, const Groups& groups) {
  if (result.grid.nx == 0) return;
  const StudyConfiguration& point = result.configuration;
  if (groups.all().alone())
    return require_memory(result.grid, study_memory(point, result.grid, parallel::threads()),
                          "the surfaces of all threads (fewer `threads` need less)");
  const SurfaceWork work =
      surface_work(point, result.grid, {result.pressures.back() / result.contact_scale},
                   {.ranks = groups.all().size(), .groups = groups.count()});
  require_memory(result.grid, surface_memory(work),
                 groups.count() > 1 ? "the surfaces of all groups (fewer groups need less)"
                                    : "a surface of the study",
                 groups.all());
}

/// The first surface of a study, on which it depends what the motion keeps; empty if it does not.
Surface first_surface(const StudyConfiguration& point, const StudyRun& run) {
  if (point.damping.hold != Hold::automatic || point.adhesion ||
      point.damping.amplitude == Amplitude::small)
    return {};
  return study_surface(point, detail::seeds_of(point).front(), {}, run.groups.own());
}

constexpr double min_waves_in_cell = 16, min_cells_in_wave = 8, min_spots = 50;

void warn_of_ensemble(StudyResult& result) {
  const auto of_loading = [&](double FirstLoading::*member) {
    return result.mean([&](const Realisation& r) { return r.first_loading.*member; }).mean;
  };
  if (const double area = of_loading(&FirstLoading::yielded_area_fraction); area > 0)
    result.ensemble_warnings.push_back(
        {"first_loading",
         fmt::format(
             "plastic first loading: at {} pressures reached the hardness, {}, on {:.2g} % of the "
             "area, which sank in by up to {}; all numbers describe the surface after unloading",
             format_quantity(of_loading(&FirstLoading::pressure), Dimension::pressure),
             format_quantity(result.configuration.known.hardness, Dimension::pressure), 100 * area,
             format_quantity(of_loading(&FirstLoading::max_plastic_depth), Dimension::length))});
  if (const auto* recipe = std::get_if<GeneratedSurfaces>(&result.configuration.surfaces)) {
    const double shortest = 2 * std::numbers::pi / recipe->spectrum_of_all()->highest_wavenumber();
    const double size = std::min(result.grid.lx, result.grid.ly);
    const SelfAffineParameters& spectrum = recipe->spectrum;
    const Anisotropy& lay = recipe->textures.front().lay;
    // For a tabulated spectrum the roll-off wavelength is unknown, so the check is skipped.
    const double longest = recipe->tables.empty()
                               ? std::max(lay.along, lay.across) *
                                     spectrum.rolloff.value_or(spectrum.long_cutoff.value_or(size))
                               : 0;
    const double cell = std::max(result.grid.dx(), result.grid.dy());
    // The factor 1 + 1e-9 allows for rounding: a shortest wave of exactly 8 cells must not give a
    // warning.
    constexpr double slack = 1 + 1e-9;
    if (longest * min_waves_in_cell > size * slack)
      result.ensemble_warnings.push_back(
          {"finite_size",
           fmt::format("finite size: the roll-off is 1/{:.3g} of the surface, more than 1/16; few "
                       "independent hills carry the load, so surfaces scatter widely",
                       size / longest)});
    if (shortest * slack < min_cells_in_wave * cell)
      result.ensemble_warnings.push_back(
          {"discretisation",
           fmt::format("discretisation: the shortest wave has {:.3g} cells, fewer than 8; the "
                       "contact area is too large, while the force hardly changes",
                       shortest / cell)});
  }
  if (const double share = result.scan_share(); !std::isnan(share))
    result.ensemble_warnings.push_back(
        {"twin", fmt::format("surface twin: these are prediction intervals for one surface of the "
                             "part; {:.0f} % of the variance of the loss comes from the limited "
                             "scans, the rest from differences between places",
                             100 * share)});
  // The smallest load in the range of the fit has the fewest contact patches.
  double fewest = std::numeric_limits<double>::infinity();
  for (const Realisation& realisation : result.realisations)
    for (std::size_t k = 0; k < realisation.spots.size(); ++k)
      if (realisation.of(ContactModel::bem)
              .fit.window.contains(result.pressures[k], PressureWindow::round_off) &&
          !std::isnan(realisation.spots[k].spot_count))
        fewest = std::min(fewest, realisation.spots[k].spot_count);
  if (fewest < min_spots)
    result.ensemble_warnings.push_back(
        {"few_spots",
         fmt::format(
             "few contact spots: the lowest load of the fit has {:.0f} on one surface, fewer "
             "than 50; a larger surface, more seeds or a higher window helps",
             fewest)});
}

}  // namespace

std::vector<StudyResult> run_ensembles(const StudyConfiguration& configuration,
                                       const StudyRun& run) {
  configuration.pressed().modulus_ratio();
  const std::vector<StudyConfiguration> points = parameter_combinations(configuration);
  RealisationReport report{.points = points.size()};
  for (const StudyConfiguration& point : points) {
    const std::size_t count = detail::seeds_of(point).size();
    require(count > 0, "seeds", 0, "given; give at least one");
    report.wanted += count;
  }
  for (const StudyConfiguration& point : points) require_spreadable(point, run.groups);
  collectively(run.groups.all(), [&] {
    if (run.parts && !run.missing && run.parts->count() > 0)
      detail::require_some_of(*run.parts, points);
  });
  std::vector<StudyResult> results;
  std::optional<Hold> hold;
  for (const StudyConfiguration& point : points) {
    StudyResult result;
    result.configuration = point;
    if (const auto* recipe = std::get_if<GeneratedSurfaces>(&point.surfaces))
      result.grid = recipe->grid;
    StudyLoads loads = study_loads(point, run.groups.own());
    result.contact_scale = loads.contact_scale;
    if (point.body)
      result.configuration.material = Material::of_contact_modulus(loads.contact_modulus);
    result.pressures = std::move(loads.pressures);
    result.warnings = std::move(loads.warnings);
    if (run.on_warning) std::ranges::for_each(result.warnings, run.on_warning);
    if (!run.missing) require_disk_space(result, run.groups);
    // Every process finds the same, because it presses the same first surface. All results of a
    // study can then be compared.
    const auto find_hold = [&] {
      if (!hold) hold = hold_of(point, first_surface(point, run), result.pressures.front());
      result.configuration.found_hold = hold;
    };
    if (!run.missing) find_hold();
    report.point = results.size();
    detail::run_case(result, run, report);
    report.finished += detail::seeds_of(point).size();
    const bool interrupted = result.interrupted;
    if (!result.realisations.empty()) {
      find_hold();
      result.grid = result.realisations.front().grid;
      warn(result);
      warn_of_ensemble(result);
      results.push_back(std::move(result));
    }
    if (interrupted && !run.missing) break;
  }
  return results;
}

StudyResult run_study(const StudyConfiguration& configuration, const StudyRun& run) {
  const auto points = parameter_combinations(configuration).size();
  require(points == 1, "ensemble", points, "points; this function takes one, run_ensembles all");
  std::vector<StudyResult> results = run_ensembles(configuration, run);
  if (!results.empty()) return std::move(results.front());
  StudyResult nothing;
  nothing.configuration = configuration;
  nothing.interrupted = true;
  return nothing;
}

}  // namespace salebra
