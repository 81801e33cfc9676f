// SPDX-License-Identifier: GPL-3.0-or-later
// Ensemble means of a study: decay length, area slope, curves, damping, ratios to BEM.
#include <fmt/format.h>

#include <bit>
#include <functional>
#include <salebra/study/study.hpp>

namespace salebra {

EnsembleMean StudyResult::mean(const std::function<double(const Realisation&)>& value) const {
  std::vector<double> values;
  for (const Realisation& realisation : realisations) values.push_back(value(realisation));
  return bootstrap.mean(values);
}

EnsembleMean StudyResult::decay_length(ModelResult Realisation::*model) const {
  return mean([&](const Realisation& r) { return (r.*model).fit.decay_length; });
}

EnsembleMean StudyResult::decay_length_over_rms_height(ModelResult Realisation::*model) const {
  return mean(
      [&](const Realisation& r) { return (r.*model).fit.decay_length / r.heights.rms_height; });
}

EnsembleMean StudyResult::area_slope(ModelResult Realisation::*model) const {
  return mean([&](const Realisation& r) { return (r.*model).area_slope; });
}

std::vector<EnsembleMean> StudyResult::curve(ModelResult Realisation::*model,
                                             double ForceSample::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto& samples = (r.*model).curve.samples;
      return k < samples.size() && samples[k].converged ? samples[k].*quantity
                                                        : ForceSample::unknown;
    }));
  }
  return estimates;
}

namespace {

template <class Value>
std::vector<EnsembleMean> over_realisations(const StudyResult& result,
                                            ModelResult Realisation::*model, Value value) {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    estimates.push_back(result.mean([&](const Realisation& r) {
      const auto& points = (r.*model).damping;
      return k < points.size() ? double(std::invoke(value, points[k])) : ForceSample::unknown;
    }));
  }
  return estimates;
}

}  // namespace

std::vector<EnsembleMean> StudyResult::damping(double DampingPoint::*quantity,
                                               ModelResult Realisation::*model) const {
  return over_realisations(*this, model, quantity);
}

std::vector<EnsembleMean> StudyResult::damping_deviation(ModelResult Realisation::*model) const {
  return over_realisations(*this, model, &DampingPoint::deviation);
}

EnsembleMean StudyResult::law_bend(ModelResult Realisation::*model) const {
  return mean([&](const Realisation& r) {
    const ExponentialTest& test = (r.*model).test;
    return test.window.points >= 4 ? test.decay_length_farthest / test.decay_length_closest - 1
                                   : ForceSample::unknown;
  });
}

std::vector<EnsembleMean> StudyResult::over_bem(ModelResult Realisation::*model,
                                                double ForceSample::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto &samples = (r.*model).curve.samples, &reference = r.bem.curve.samples;
      const bool known = k < samples.size() && samples[k].converged && reference[k].converged;
      return known ? samples[k].*quantity / (reference[k].*quantity) : ForceSample::unknown;
    }));
  }
  return estimates;
}

std::vector<EnsembleMean> StudyResult::damping_over_bem(ModelResult Realisation::*model,
                                                        double DampingPoint::*quantity) const {
  std::vector<EnsembleMean> estimates;
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    estimates.push_back(mean([&](const Realisation& r) {
      const auto& points = (r.*model).damping;
      return k < points.size() ? points[k].*quantity / r.bem.damping[k].curve_work
                               : ForceSample::unknown;
    }));
  }
  return estimates;
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
    ratios.push_back(realisation.bem.fit.decay_length / realisation.heights.rms_height);
  std::vector<EnsembleMean> estimates;
  for (const std::size_t count : convergence_counts())
    estimates.push_back(
        bootstrap.mean({ratios.begin(), ratios.begin() + static_cast<std::ptrdiff_t>(count)}));
  return estimates;
}

std::string StudyResult::interval_method() const {
  const std::size_t count = realisations.size();
  if (count == 1) return "one surface: no interval, which needs a sample of surfaces";
  return fmt::format("95 % {} interval of the mean over {} surfaces",
                     count < Bootstrap::least_bootstrap_count ? "Student-t" : "bootstrap-t", count);
}

}  // namespace salebra
