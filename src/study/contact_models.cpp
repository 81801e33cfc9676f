// SPDX-License-Identifier: GPL-3.0-or-later
// The registry of contact models: how each presses the surface of a study.
#include "contact_models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <mutex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/adhesive_summits.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/asperity/interacting_summits.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra {
namespace {

using detail::ModelWork;

SpotStatistics spot_statistics(const ContactSpots& contact, const Grid2D& grid) {
  SpotStatistics statistics;
  statistics.spot_count = double(contact.spots.size());
  statistics.corrected_area_fraction = contact.corrected_area_fraction;
  statistics.max_spot_area = contact.spots.empty() ? 0 : contact.spots.front().area;
  statistics.mean_spot_area = contact.spots.empty() ? 0
                                                    : contact.contact_area_fraction * grid.area() /
                                                          double(contact.spots.size());
  statistics.spots_by_size.assign(std::size_t(std::bit_width(std::uint64_t(grid.points()))), 0.0);
  for (const ContactSpot& spot : contact.spots) {
    const auto cells = std::uint64_t(std::llround(spot.area / grid.cell_area()));
    statistics.spots_by_size[std::size_t(std::bit_width(cells) - 1)] += 1;
  }
  return statistics;
}

/// The result of a model that cannot describe this surface: no pressure has a converged contact.
ModelResult no_curve(const ModelWork& work) {
  ModelResult result;
  for (const double pressure : work.pressures)
    result.curve.samples.push_back({.pressure = pressure, .converged = false});
  return result;
}

/// The adhesive loading cycle: approach from one mean gap to the next, then withdrawal.
AdhesionOfSurface cycle_of(const ModelWork& work, const AdhesiveContactOptions& contact) {
  const AdhesionPlan& plan = *work.configuration.adhesion;
  std::vector<OperatingPoint> gaps;
  for (const double gap : plan.cycle) gaps.push_back(at_mean_gap(gap));
  const AdhesiveCycle cycle = adhesive_cycle(work.surface, work.configuration.pressed(), gaps,
                                             plan.adhesion, {.contact = contact, .unload = true});
  AdhesionOfSurface found{cycle, std::vector<AdhesionSample>(gaps.size())};
  if (!cycle.converged()) return found;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const AdhesiveContactState &in = cycle.loading[k], &out = cycle.unloading[gaps.size() - 1 - k];
    found.samples[k] = {in.mean_pressure, out.mean_pressure, in.contact_area_fraction,
                        out.contact_area_fraction};
  }
  return found;
}

/// Solves the adhesive contacts load by load, each from the pressures of the previous one, and then
/// the loading cycle.
ModelResult adhesive_elements(ModelWork& work, const SweepOptions& sweep) {
  const AdhesionPlan& plan = *work.configuration.adhesion;
  const Body body = work.configuration.pressed();
  ModelResult result = no_curve(work);
  ForceCurve& curve = result.curve;
  curve.model = "bem";
  curve.nominal_area = work.surface.grid.area();
  curve.rms_height = work.realisation.heights.rms_height;
  curve.adhesive = true;
  curve.body = body.fingerprint();
  AdhesiveCycleOptions options{
      .contact = {.contact = {.on_progress = work.progress}, .force_coarse = plan.force_coarse}};
  std::size_t k = 0;
  options.on_state = [&](bool, const AdhesiveContactState& state) {
    curve.samples[k] = force_sample(state, work.surface, body, sweep);
    sweep.on_state(k++, state);
  };
  std::vector<OperatingPoint> loads;
  for (const double pressure : work.pressures) loads.push_back(at_pressure(pressure));
  adhesive_cycle(work.surface, body, loads, plan.adhesion, options);
  if (!plan.cycle.empty()) work.realisation.adhesion = cycle_of(work, options.contact);
  result.pull_off_pressure = work.realisation.adhesion.pull_off_pressure;
  return result;
}

ModelResult boundary_elements(ModelWork& work) {
  Realisation& realisation = work.realisation;
  const Surface& surface = work.surface;
  std::mutex picture_guard;
  SweepOptions sweep;
  sweep.contact.tolerance = work.configuration.tolerance;
  sweep.contact.on_progress = work.progress;
  sweep.stick = stick_solves(work.configuration);
  sweep.direction = work.directions.front();
  realisation.spots.resize(work.pressures.size());
  if (work.configuration.flow_factors) realisation.flow.resize(work.pressures.size());
  sweep.on_state = [&](std::size_t k, const NormalContactState& state) {
    realisation.spots[k] = spot_statistics(contact_spots(state.contact_pressure, surface.grid,
                                                         Boundary::periodic, surface.communicator),
                                           surface.grid);
    if (work.configuration.flow_factors)
      if (const FlowFactors flow = flow_factors(state, surface.grid, {.lay_angle = work.lay_angle});
          flow.converged())
        realisation.flow[k] = flow;
    if (realisation.picture.empty()) return;
    const std::scoped_lock lock(picture_guard);
    realisation.picture.add_contact(std::int16_t(k), state, surface);
  };
  if (work.contacts) {
    work.contacts->resize(work.pressures.size());
    sweep.on_stiffness = [&](std::size_t k, const NormalContactState& state, double stiffness,
                             const Field& growth) {
      (*work.contacts)[k].emplace(state, stiffness, growth, surface);
    };
  }
  if (work.configuration.adhesion) return adhesive_elements(work, sweep);
  std::vector<ForceCurve> curves = sweep_directions(surface, work.configuration.pressed(),
                                                    work.pressures, work.directions, sweep);
  for (std::size_t k = 1; k < curves.size(); ++k)
    realisation.other_directions.push_back(
        {.model = ContactModel::bem, .curve = std::move(curves[k])});
  return {.curve = std::move(curves.front())};
}

ModelResult statistical_summits(ModelWork& work) {
  if (!work.realisation.has_random_summits()) return no_curve(work);
  const StatisticalSummits summits(work.realisation.ensemble, work.configuration.material,
                                   work.surface.grid.area());
  return {.curve = curve_at_pressures(summits, work.pressures)};
}

ModelResult own_summits(ModelWork& work) {
  const HeightStatistics& heights = work.realisation.heights;
  const DeterministicSummits summits(work.summits.summits, work.configuration.material,
                                     work.summits.searched_area, heights.mean, heights.rms_height);
  return {.curve = curve_at_pressures(summits, work.pressures)};
}

ModelResult drawn_summits(ModelWork& work) {
  if (!work.realisation.has_random_summits()) return no_curve(work);
  const SummitEnsemble& ensemble = work.realisation.ensemble;
  const double area = work.surface.grid.area();
  const int count = std::max(1, int(std::lround(ensemble.summit_density * area)));
  const DeterministicSummits summits(
      draw_summits(ensemble, count, std::sqrt(area), work.realisation.seed),
      work.configuration.material, area, -ensemble.mean_height,
      work.realisation.heights.rms_height);
  ModelResult result{.curve = curve_at_pressures(summits, work.pressures)};
  result.curve.model = "greenwood-williamson-monte-carlo";
  return result;
}

ModelResult interacting_summits(ModelWork& work) {
  const HeightStatistics& heights = work.realisation.heights;
  const InteractingSummits summits(work.summits.summits, work.configuration.material,
                                   work.surface.grid, heights.mean, heights.rms_height);
  return {.curve = curve_at_pressures(summits, work.pressures, work.progress)};
}

ModelResult persson_theory(ModelWork& work) {
  const Material& material = work.configuration.material;
  const PerssonTheory theory(work.shells, material.contact_modulus);
  ModelResult result{
      .curve = persson_curve(theory, material, work.surface.grid.area(), work.pressures),
      .asymptotic_decay_length = theory.asymptote().decay_length};
  result.curve.rms_height = work.realisation.heights.rms_height;
  return result;
}

/// Greenwood and Tripp's model. The surface is taken as the sum of two rough surfaces, equal and
/// independent, so each has half of its spectral moments.
ModelResult two_rough_sides(ModelWork& work) {
  if (!work.realisation.has_random_summits()) return no_curve(work);
  const SpectralMoments& moments = work.realisation.moments;
  const double rms_height = work.realisation.heights.rms_height;
  SummitEnsemble side =
      summit_ensemble(moments.moment0 / 2, moments.moment2() / 2, moments.moment4() / 2);
  side.rms_height = rms_height / std::numbers::sqrt2;
  const GreenwoodTripp sides(side, side, work.configuration.material, work.surface.grid.area());
  ModelResult result{.curve = curve_at_pressures(sides, work.pressures)};
  result.curve.rms_height = rms_height;
  return result;
}

/// Fuller and Tabor's model of adhesive summits. Loads are reached by approach; the pull-off
/// pressure follows from summits that are drawn apart.
template <SummitAdhesion adhesion>
ModelResult adhesive_summits(ModelWork& work) {
  if (!work.realisation.has_random_summits() || !work.configuration.adhesion) return no_curve(work);
  const auto summits = [&](bool unloading) {
    return AdhesiveSummits(work.realisation.ensemble, work.configuration.material,
                           work.surface.grid.area(), adhesion,
                           work.configuration.adhesion->adhesion.work, unloading);
  };
  ModelResult result{.curve = curve_at_pressures(summits(false), work.pressures)};
  result.curve.adhesive = true;
  result.pull_off_pressure = summits(true).pull_off_pressure();
  return result;
}

using enum ContactModel;
constexpr std::array registry{
    StudyModel{bem, "bem", "boundary elements", 0.218e-6, &boundary_elements},
    StudyModel{gw_moments, "gw_moments", "GW, summits from spectral moments", 0,
               &statistical_summits},
    StudyModel{gw_deterministic, "gw_deterministic", "GW, the surface's own summits", 0,
               &own_summits},
    StudyModel{gw_monte_carlo, "gw_monte_carlo", "GW, summits drawn at random", 0, &drawn_summits},
    StudyModel{gw_interacting, "gw_interacting", "GW, own summits, interacting", 0.155e-6,
               &interacting_summits},
    StudyModel{persson, "persson", "Persson's theory", 0, &persson_theory},
    StudyModel{greenwood_tripp, "greenwood_tripp", "Greenwood-Tripp, two equal rough sides", 0,
               &two_rough_sides},
    StudyModel{gw_dmt, "gw_dmt", "GW, summits that adhere by DMT", 0,
               &adhesive_summits<SummitAdhesion::dmt>},
    StudyModel{gw_jkr, "gw_jkr", "Fuller-Tabor, summits that adhere by JKR", 0,
               &adhesive_summits<SummitAdhesion::jkr>}};

static_assert(
    [] {
      for (std::size_t i = 0; i < registry.size(); ++i)
        if (registry[i].id != ContactModel(i)) return false;
      return true;
    }(),
    "a model stands at the place of its enumerator");

}  // namespace

std::vector<RoughnessShell> detail::shells_of(const Surface& surface) {
  const PowerSpectrum spectrum = power_spectrum(surface);
  const RadialSpectrum rings = radial_spectrum(spectrum, 16);
  std::vector<RoughnessShell> shells;
  for (std::size_t i = 0; i < rings.wavenumber.size(); ++i) {
    const double power = double(rings.modes[i]) * rings.psd[i] * spectrum.cell();
    if (power > 0) shells.push_back({rings.wavenumber[i], power});
  }
  return shells;
}

std::span<const StudyModel> contact_models() { return registry; }

ContactModel contact_model(std::string_view name) {
  std::vector<std::string_view> known;
  for (const StudyModel& model : registry) {
    if (name == model.name) return model.id;
    known.emplace_back(model.name);
  }
  throw InvalidInput("models", fmt::format("'{}'", name),
                     fmt::format("is not known; known are {}", fmt::join(known, ", ")));
}

std::string_view name_of(ContactModel model) { return registry[std::size_t(model)].name; }

std::vector<ContactModel> all_contact_models() {
  std::vector<ContactModel> models;
  for (const StudyModel& model : registry)
    if (!is_adhesive(model.id)) models.push_back(model.id);
  return models;
}

std::vector<ContactModel> contact_models(const std::vector<std::string>& names) {
  std::vector<ContactModel> models{ContactModel::bem};
  for (const std::string& name : names) {
    const ContactModel model = contact_model(name);
    if (std::ranges::find(models, model) == models.end()) models.push_back(model);
  }
  std::ranges::sort(models);
  return models;
}

}  // namespace salebra
