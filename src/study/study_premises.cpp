// SPDX-License-Identifier: GPL-3.0-or-later
// Premises and losses with slip of a study, from the mean curve of the boundary elements.
#include "study_premises.hpp"

#include <algorithm>
#include <cmath>
#include <salebra/base/units.hpp>
#include <salebra/damping/closed_form.hpp>

namespace salebra {
namespace {

ForceCurve mean_curve(const StudyResult& result) {
  const auto mean_gap = result.curve(&ForceSample::mean_gap);
  const auto normal = result.curve(&ForceSample::normal_stiffness);
  const auto tangential = result.curve(&ForceSample::tangential_stiffness);
  const auto area = result.curve(&ForceSample::contact_area_fraction);
  ForceCurve curve;
  double least_gap = HUGE_VAL;
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    ForceSample& sample = curve.samples.emplace_back();
    sample.mean_gap = mean_gap[k].mean;
    sample.pressure = result.pressures[k];
    sample.force = sample.pressure * result.grid.area();
    sample.normal_stiffness = normal[k].mean;
    sample.tangential_stiffness = tangential[k].mean;
    sample.contact_area_fraction = area[k].mean;
    // Means over different surfaces, where some did not converge, need not fall.
    sample.converged = sample.mean_gap < least_gap;
    if (sample.converged) least_gap = sample.mean_gap;
  }
  return curve;
}

}  // namespace

std::vector<double> StudyPremises::work_per_cycle_with_slip() const {
  std::vector<double> works;
  for (const LossWithSlip& loss : losses) works.push_back(loss.work_per_cycle);
  return works;
}

StudyPremises premises_of(const StudyResult& result) {
  const StudyConfiguration& configuration = result.configuration;
  const std::size_t count = result.pressures.size();
  StudyPremises all{std::vector<Premises>(count), std::vector<LossWithSlip>(count),
                    std::vector<double>(count, ContactFacts::unknown)};
  const ForceCurve curve = mean_curve(result);
  if (std::ranges::count(curve.samples, true, &ForceSample::converged) < 4) return all;
  const std::vector<StatedMean> damping = result.stated_damping();
  const TabulatedLaw law(curve, configuration.material.modulus_ratio());
  ContactFacts facts = configuration.known;
  facts.contact_modulus = configuration.material.contact_modulus;
  facts.loaded_size = std::max(result.grid.lx, result.grid.ly);
  facts.rms_slope = result.mean([](const Realisation& r) { return r.moments.rms_slope(); }).mean;
  for (const Realisation& realisation : result.realisations)
    if (realisation.first_loading.yielded())
      facts.first_load =
          std::fmin(facts.first_load, realisation.first_loading.pressure * result.grid.area());
  for (std::size_t k = 0; k < count; ++k) {
    const ForceSample& sample = curve.samples[k];
    if (!sample.converged) continue;
    facts.nominal_pressure = sample.pressure;
    facts.mean_contact_pressure = sample.pressure / sample.contact_area_fraction;
    all.premises[k] = premises_of(law, -sample.mean_gap, configuration.motion, facts);
    if (std::isnan(facts.friction_coefficient)) continue;
    LossWithSlip& loss = all.losses[k];
    loss = loss_with_slip(law, -sample.mean_gap, configuration.motion, facts.friction_coefficient,
                          facts.excursion);
    const double scale =
        damping[k].mean / closed_form::damping_constant(loss.full_stick_work, configuration.motion);
    for (double LossWithSlip::*work :
         {&LossWithSlip::work_per_cycle, &LossWithSlip::relaxation_work, &LossWithSlip::slip_work,
          &LossWithSlip::full_stick_work})
      loss.*work *= scale;
    all.damping_constant_with_slip[k] =
        closed_form::damping_constant(loss.work_per_cycle, configuration.motion);
  }
  return all;
}

std::string regimes(const StudyPremises& found, const std::vector<double>& pressures) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < pressures.size(); first = last) {
    const Regime regime = found.premises[first].regime;
    while (last < pressures.size() && found.premises[last].regime == regime) ++last;
    if (regime == Regime::unknown) continue;
    const auto at = [&](std::size_t k) {
      return format_quantity(pressures[k], Dimension::pressure);
    };
    text += (text.empty() ? "" : ", ") + std::string(word_of(regime)) + " at " + at(first);
    if (last - first > 1) text += " to " + at(last - 1);
  }
  return text;
}

}  // namespace salebra
