// SPDX-License-Identifier: GPL-3.0-or-later
// Ensemble means of a study: decay length, area slope, force curves, damping, ratios to boundary
// elements.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/study/study.hpp>

#include "estimate.hpp"
#include "results/describe.hpp"

namespace salebra {

namespace {

EnsembleMean estimate(const StudyConfiguration& configuration, const std::vector<double>& values,
                      Sign sign) {
  return configuration.of_twin() ? prediction(values) : Bootstrap().mean(values, sign);
}

EnsembleMean mean_of(const StudyResult& result, const NumberOf<Realisation>& number, Sign sign) {
  std::vector<double> values;
  for (const Realisation& realisation : result.realisations) values.push_back(number(realisation));
  return estimate(result.configuration, values, sign);
}

/// A number that follows from a loss, with the error that belongs to it. If `constant` is set it is
/// a damping constant, and its error is that of the loss times damping_per_work.
struct StatedNumber {
  std::string_view name;
  bool constant;
  double Loss::*value;
  ErrorBudget Loss::*error;
};
constexpr StatedNumber stated_numbers[] = {
    {"work_per_cycle", false, &Loss::work_per_cycle, &Loss::error},
    {"damping_constant", true, &Loss::damping_constant, &Loss::error},
    {"work_per_cycle_without_slip", false, &Loss::work_per_cycle_without_slip,
     &Loss::error_without_slip},
    {"damping_constant_without_slip", true, &Loss::damping_constant_without_slip,
     &Loss::error_without_slip}};

const StatedNumber* stated_number(std::string_view name) {
  const auto found = std::ranges::find(stated_numbers, name, &StatedNumber::name);
  return found == std::end(stated_numbers) ? nullptr : found;
}

}  // namespace

double StudyResult::direction() const {
  if (realisations.empty()) return ForceSample::unknown;
  return realisations.front().of(ContactModel::bem).curve.direction();
}

std::vector<StudyResult> StudyResult::in_directions() const {
  std::vector<StudyResult> results{*this};
  const std::size_t others =
      realisations.empty() ? 0 : realisations.front().other_directions.size();
  for (std::size_t k = 0; k < others; ++k) {
    StudyResult& other = results.emplace_back(*this);
    for (Realisation& realisation : other.realisations)
      realisation.of(ContactModel::bem) = realisation.other_directions.at(k);
  }
  for (StudyResult& result : results)
    for (Realisation& realisation : result.realisations) realisation.other_directions.clear();
  return results;
}

EnsembleMean StudyResult::mean(const NumberOf<Realisation>& number) const {
  // Some numbers of a surface, such as its skewness, have either sign.
  return mean_of(*this, number, Sign::either);
}

EnsembleMean StudyResult::mean(const NumberOf<ModelResult>& number, ContactModel model) const {
  return mean([&](const Realisation& r) { return number(r.of(model)); });
}

EnsembleMean StudyResult::decay_length(ContactModel model) const {
  return fitted("decay_length", model);
}

EnsembleMean StudyResult::decay_length_over_rms_height(ContactModel model) const {
  return mean_of(
      *this,
      [&](const Realisation& r) { return r.of(model).fit.decay_length / r.heights.rms_height; },
      Sign::positive);
}

EnsembleMean StudyResult::fitted(std::string_view column, ContactModel model) const {
  if (column == "decay_length_over_rms_height") return decay_length_over_rms_height(model);
  const NumberOf<ModelResult> number = number_of<ModelResult>(column, "column");
  return mean_of(
      *this, [&](const Realisation& r) { return number(r.of(model)); },
      column == "law_bend" ? Sign::either : Sign::positive);
}

std::optional<LawDescription> StudyResult::law_description(ContactModel model) const {
  const auto over_rms_height = [&](const char* length) {
    return fitted(std::string(length) + "_over_rms_height", model).mean;
  };
  const double at_min_gap = over_rms_height("decay_length_at_min_gap");
  if (!(at_min_gap > 0)) return {};
  return describe_law(over_rms_height("decay_length"), at_min_gap,
                      over_rms_height("decay_length_at_max_gap"));
}

std::vector<EnsembleMean> StudyResult::at_pressures(
    const std::function<double(const Realisation&, std::size_t)>& number) const {
  std::vector<EnsembleMean> means;
  for (std::size_t k = 0; k < pressures.size(); ++k)
    means.push_back(
        mean_of(*this, [&](const Realisation& r) { return number(r, k); }, Sign::positive));
  return means;
}

std::vector<EnsembleMean> StudyResult::curve(const NumberOf<ForceSample>& number,
                                             ContactModel model) const {
  // Of all numbers of a sample only a separation may have either sign.
  ForceSample separated;
  separated.separation = 1;
  const Sign sign = std::isnan(number(separated)) ? Sign::positive : Sign::either;
  std::vector<EnsembleMean> means;
  for (std::size_t k = 0; k < pressures.size(); ++k)
    means.push_back(mean_of(
        *this,
        [&](const Realisation& r) {
          const auto& samples = r.of(model).curve.samples;
          return k < samples.size() && samples[k].converged ? number(samples[k])
                                                            : ForceSample::unknown;
        },
        sign));
  return means;
}

std::vector<EnsembleMean> StudyResult::damping(const NumberOf<DampingPoint>& number,
                                               ContactModel model) const {
  return at_pressures([&](const Realisation& r, std::size_t k) {
    const auto& points = r.of(model).damping;
    return k < points.size() ? number(points[k]) : ForceSample::unknown;
  });
}

std::vector<EnsembleMean> StudyResult::damping(std::string_view quantity,
                                               ContactModel model) const {
  if (quantity == "deviation") return deviation(model);
  constexpr std::string_view of_error = "_error";
  const bool error = quantity.ends_with(of_error);
  const std::string_view number = quantity.substr(0, quantity.size() - error * of_error.size());
  if (!stated_number(number)) return damping(number_of<DampingPoint>(quantity, "quantity"), model);
  std::vector<EnsembleMean> means;
  for (const StatedMean& one : stated(number, model))
    means.push_back(error ? EnsembleMean{.mean = one.error} : EnsembleMean(one));
  return means;
}

std::vector<EnsembleMean> StudyResult::deviation(ContactModel model) const {
  const auto law = damping(&DampingPoint::damping_constant_closed_form, model);
  const auto computed = stated("damping_constant_without_slip", model);
  std::vector<EnsembleMean> deviations;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    const double constant = computed[k].mean, ratio = law[k].mean / constant;
    const EnsembleMean scatter = mean([&](const Realisation& r) {
      const auto& points = r.of(model).damping;
      if (k >= points.size()) return ForceSample::unknown;
      return (points[k].damping_constant_closed_form -
              ratio * points[k].damping_constant_without_slip) /
             constant;
    });
    // If both damping constants are known on all surfaces, the mean of the scatter is 0; otherwise
    // it is subtracted.
    deviations.push_back({ratio - 1, ratio - 1 + (scatter.low - scatter.mean),
                          ratio - 1 + (scatter.high - scatter.mean)});
  }
  return deviations;
}

std::vector<EnsembleMean> StudyResult::spots(const NumberOf<SpotStatistics>& number) const {
  return at_pressures([&](const Realisation& r, std::size_t k) { return number(r.spots[k]); });
}

std::vector<EnsembleMean> StudyResult::flow(const NumberOf<FlowFactors>& number) const {
  return at_pressures([&](const Realisation& r, std::size_t k) {
    const bool known = k < r.flow.size() && !std::isnan(r.flow[k].mean_gap);
    return known ? number(r.flow[k]) : FlowFactors::unknown;
  });
}

std::vector<EnsembleMean> StudyResult::adhesion(const NumberOf<AdhesionSample>& number) const {
  std::vector<EnsembleMean> means;
  for (std::size_t k = 0; configuration.adhesion && k < configuration.adhesion->cycle.size(); ++k)
    means.push_back(mean([&](const Realisation& r) { return number(r.adhesion.samples[k]); }));
  return means;
}

EnsembleMean StudyResult::adhesion_cycle(const NumberOf<AdhesiveCycleNumbers>& number) const {
  return mean([&](const Realisation& r) { return number(r.adhesion); });
}

std::vector<EnsembleMean> StudyResult::conductance(double Conductances::*kind) const {
  const double modulus = configuration.material.contact_modulus;
  if (std::isnan(conductances(1, modulus, configuration.conduction).*kind)) return {};
  return curve([&](const ForceSample& sample) {
    return conductances(sample.normal_stiffness / grid.area(), modulus, configuration.conduction).*
           kind;
  });
}

std::vector<EnsembleMean> StudyResult::over_bem(const NumberOf<ForceSample>& number,
                                                ContactModel model) const {
  return at_pressures([&](const Realisation& r, std::size_t k) {
    const auto &samples = r.of(model).curve.samples,
               &reference = r.of(ContactModel::bem).curve.samples;
    const bool known = k < samples.size() && samples[k].converged && reference[k].converged;
    return known ? number(samples[k]) / number(reference[k]) : ForceSample::unknown;
  });
}

std::vector<EnsembleMean> StudyResult::damping_over_bem(
    const NumberOf<DampingPoint>& number, ContactModel model,
    const NumberOf<DampingPoint>& reference) const {
  return at_pressures([&](const Realisation& r, std::size_t k) {
    const auto& points = r.of(model).damping;
    return k < points.size() ? number(points[k]) / reference(r.of(ContactModel::bem).damping[k])
                             : ForceSample::unknown;
  });
}

std::vector<std::pair<std::string, std::vector<EnsembleMean>>> StudyResult::comparison(
    ContactModel model) const {
  std::vector<std::pair<std::string, std::vector<EnsembleMean>>> ratios;
  for (const char* name : {"mean_gap", "contact_area_fraction", "normal_stiffness"})
    ratios.emplace_back(name, over_bem(number_of<ForceSample>(name, "quantity"), model));
  for (const char* name :
       {"work_per_cycle_closed_form", "small_amplitude_work", "work_per_cycle_without_slip"})
    ratios.emplace_back(name, damping_over_bem(number_of<DampingPoint>(name, "quantity"), model));
  // Like is compared with like: a loss with slip is divided by a loss with slip.
  const NumberOf<DampingPoint> described = &DampingPoint::work_per_cycle;
  ratios.emplace_back("work_per_cycle", damping_over_bem(described, model, described));
  return ratios;
}

std::vector<StatedMean> StudyResult::stated(std::string_view quantity, ContactModel model) const {
  const StatedNumber* number = stated_number(quantity);
  if (!number)
    throw InvalidInput("quantity", "'" + std::string(quantity) + "'",
                       "has no numerical error; call damping() for it");
  // The noise of cells is independent on each surface, so it decreases in the mean; the other
  // errors are the same on all surfaces.
  const double alike = 1 - 1 / double(realisations.size());
  std::vector<StatedMean> means;
  for (const EnsembleMean& value : damping(number->value, model)) {
    const std::size_t k = means.size();
    StatedMean& mean = means.emplace_back(StatedMean{value});
    double sum = 0, count = 0;
    for (const Realisation& realisation : realisations) {
      const auto& points = realisation.of(model).damping;
      if (k >= points.size()) continue;
      const ErrorBudget& error = points[k].*number->error;
      const double absolute =
          std::sqrt(std::pow(error.total(), 2) - alike * std::pow(error.noise, 2)) *
          (number->constant ? points[k].damping_per_work : 1);
      // A single surface states its error even if the number itself is unknown.
      if (realisations.size() == 1) mean.error = absolute;
      const double relative = absolute / std::abs(points[k].*number->value);
      if (std::isnan(relative)) continue;
      sum += relative;
      ++count;
    }
    if (realisations.size() > 1 && count > 0) mean.error = sum / count * std::abs(mean.mean);
    if (mean.error >= std::abs(mean.mean)) mean.mean = mean.low = mean.high = ForceSample::unknown;
  }
  return means;
}

DeviationRange StudyResult::deviation_range(ContactModel model) const {
  double low = ForceSample::unknown, high = ForceSample::unknown;
  for (const EnsembleMean& ratio : deviation(model)) {
    low = std::fmin(low, ratio.mean);
    high = std::fmax(high, ratio.mean);
  }
  return {low, high};
}

StudyTheories StudyResult::theories() const {
  StudyTheories theories;
  theories.bgt_area_slope = std::sqrt(2 * std::numbers::pi);
  theories.persson_area_slope = std::sqrt(8 / std::numbers::pi);
  for (const double pressure : pressures)
    theories.relative_pressure.push_back(pressure / contact_scale);
  theories.bearing_area_fraction = at_pressures([](const Realisation& r, std::size_t k) {
    return bearing_area_fraction(r.of(ContactModel::bem).curve.samples[k].mean_gap,
                                 r.heights.rms_height);
  });
  if (!configuration.has(ContactModel::persson)) return theories;
  theories.decay_length_over_rms_height =
      fitted("asymptotic_decay_length_over_rms_height", ContactModel::persson);
  theories.normal_stiffness = at_pressures([&](const Realisation& r, std::size_t k) {
    return pressures[k] * grid.area() / r.of(ContactModel::persson).asymptotic_decay_length;
  });
  return theories;
}

bool is_milestone(std::size_t surfaces) {
  constexpr std::size_t first_octave = 128, per_octave = 32;
  if (surfaces <= first_octave) return surfaces >= 2;
  return surfaces % (std::bit_floor(surfaces) / per_octave) == 0;
}

std::vector<std::size_t> StudyResult::convergence_counts() const {
  std::vector<std::size_t> counts;
  for (std::size_t count = 2; count <= realisations.size(); ++count)
    if (is_milestone(count) || count == realisations.size()) counts.push_back(count);
  return counts;
}

std::vector<EnsembleMean> StudyResult::convergence() const {
  std::vector<double> ratios;
  for (const Realisation& realisation : realisations)
    ratios.push_back(realisation.of(ContactModel::bem).fit.decay_length /
                     realisation.heights.rms_height);
  std::vector<EnsembleMean> estimates;
  for (const std::size_t count : convergence_counts())
    estimates.push_back(estimate(
        configuration, {ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(count)},
        Sign::positive));
  return estimates;
}

double StudyResult::scan_share() const {
  if (!configuration.of_twin()) return ForceSample::unknown;
  const auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  double sum = 0, loads = 0;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    // Ln W of the surfaces, for each spectrum of the twin.
    std::map<std::size_t, std::vector<double>> of_table;
    double first = 0, second = 0, count = 0, within = 0, pairs = 0;
    for (const Realisation& realisation : realisations) {
      const double work = realisation.of(ContactModel::bem).damping[k].work_per_cycle;
      if (!(work > 0)) continue;
      of_table[surfaces.table_of(realisation.seed)].push_back(std::log(work));
      first += std::log(work), second += std::pow(std::log(work), 2), ++count;
    }
    for (const auto& [table, logarithms] : of_table) {
      if (logarithms.size() < 2) continue;
      within += std::pow(logarithms[0] - logarithms[1], 2) / 2;
      ++pairs;
    }
    constexpr double fewest_pairs = 3;
    if (pairs < fewest_pairs) continue;
    const double all = (second - first * first / count) / (count - 1);
    sum += std::clamp(1 - within / pairs / all, 0.0, 1.0);
    ++loads;
  }
  return loads > 0 ? sum / loads : ForceSample::unknown;
}

std::string StudyResult::interval_method() const {
  const std::size_t count = realisations.size();
  if (count == 1) return "one surface: no interval, because it needs several surfaces";
  if (configuration.of_twin())
    return fmt::format(
        "95 % prediction interval for a surface of the part, from {} surfaces of its twin", count);
  return fmt::format("95 % {} interval of the mean over {} surfaces",
                     count < Bootstrap::min_bootstrap_count ? "Student-t" : "bootstrap-t", count);
}

}  // namespace salebra
