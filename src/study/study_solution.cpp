// SPDX-License-Identifier: GPL-3.0-or-later
// Solution of a study: the loss of the motion as the user described it, and its assumptions.
#include <algorithm>
#include <cmath>
#include <salebra/analysis/slip.hpp>
#include <salebra/base/error.hpp>
#include <salebra/study/study_solution.hpp>

#include "damping/judge.hpp"
#include "damping/phase_quadrature.hpp"
#include "damping/surface_law.hpp"

namespace salebra {
namespace {

ForceCurve mean_curve(const StudyResult& result) {
  const auto mean_gap = result.curve(&ForceSample::mean_gap);
  const auto normal = result.curve(&ForceSample::normal_stiffness);
  const auto tangential = result.curve(&ForceSample::tangential_stiffness);
  const auto area = result.curve(&ForceSample::contact_area_fraction);
  ForceCurve curve;
  curve.nominal_area = result.grid.area();
  double min_gap = HUGE_VAL;
  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    ForceSample& sample = curve.samples.emplace_back();
    sample.mean_gap = mean_gap[k].mean;
    sample.pressure = result.pressures[k];
    sample.force = sample.pressure * result.grid.area();
    sample.normal_stiffness = normal[k].mean;
    sample.tangential_stiffness = tangential[k].mean;
    sample.direction = result.direction();
    sample.contact_area_fraction = area[k].mean;
    // The mean gap should decrease with the pressure. It may not if some surfaces did not converge,
    // since then the means are over different surfaces; such a sample is dropped.
    sample.converged = sample.mean_gap < min_gap;
    if (sample.converged) min_gap = sample.mean_gap;
  }
  return curve;
}

/// The contact parameters of the configuration, completed by properties of the computed surfaces.
ContactParameters parameters_of(const StudyResult& result) {
  ContactParameters parameters = result.configuration.known;
  parameters.contact_modulus = result.configuration.material.contact_modulus;
  parameters.loaded_size = std::max(result.grid.lx, result.grid.ly);
  parameters.rms_slope =
      result.mean([](const Realisation& r) { return r.moments.rms_slope(); }).mean;
  for (const Realisation& realisation : result.realisations)
    if (realisation.first_loading.yielded())
      parameters.first_load =
          std::fmin(parameters.first_load, realisation.first_loading.pressure * result.grid.area());
  return parameters;
}

/// The largest force of the motion at a pressure, in units of the largest force that the first
/// loading of the same surface reached; the largest ratio of all surfaces. NaN without a first
/// loading that yielded.
double peak_over_first_load(const StudyResult& result, std::size_t k) {
  double largest = ForceSample::unknown;
  for (const Realisation& realisation : result.realisations)
    if (realisation.first_loading.yielded())
      largest = std::fmax(largest, realisation.of(ContactModel::bem).damping[k].max_force /
                                       (realisation.first_loading.pressure * result.grid.area()));
  return largest;
}

/// Sets the fractions of relaxation and of slip in the mean loss, if slip was computed.
void set_shares(StudySolution& solution, const StudyResult& result) {
  const auto relaxation = result.damping(&DampingPoint::relaxation_work);
  const auto slip = result.damping(&DampingPoint::slip_work);
  for (std::size_t k = 0; k < slip.size(); ++k) {
    if (std::isnan(solution.work_per_cycle[k].mean)) continue;
    solution.slip_share[k] = slip[k].mean / (relaxation[k].mean + slip[k].mean);
    solution.relaxation_share[k] = 1 - solution.slip_share[k];
  }
}

}  // namespace

StudySolution solution_of(const StudyResult& result) {
  const StudyConfiguration& configuration = result.configuration;
  const std::size_t count = result.pressures.size();
  StudySolution solution{
      .pressures = result.pressures,
      .damping_constant = result.stated("damping_constant"),
      .work_per_cycle = result.stated("work_per_cycle"),
      .damping_constant_without_slip = result.stated("damping_constant_without_slip"),
      .relaxation_share = std::vector<double>(count, ContactParameters::unknown),
      .slip_share = std::vector<double>(count, ContactParameters::unknown),
      .thermal_conductance = result.conductance(&Conductances::thermal_conductance),
      .electrical_conductance = result.conductance(&Conductances::electrical_conductance),
      .direction = result.direction(),
      .slip_followed = !std::isnan(configuration.known.friction_coefficient),
      .assumptions = std::vector<Assumptions>(count)};
  if (configuration.adhesion) return solution;
  solution.unknown = why_loss_unknown(motion_of(configuration.motion), configuration.known);
  if (solution.slips()) set_shares(solution, result);
  const ForceCurve curve = mean_curve(result);
  if (std::ranges::count(curve.samples, true, &ForceSample::converged) >= 4) {
    const TabulatedLaw law(curve, configuration.pressed().modulus_ratio());
    const ContactParameters known = parameters_of(result);
    const double amplitude = detail::normal_amplitude(configuration.motion);
    const auto possible = result.damping(&DampingPoint::possible_amplitude),
               peak = result.damping(&DampingPoint::max_force);
    for (std::size_t k = 0; k < count; ++k) {
      const ForceSample& sample = curve.samples[k];
      if (!sample.converged) continue;
      // Where the motion presses beyond full contact there is no loss whose assumptions could be
      // judged.
      if (!std::isnan(possible[k].mean)) {
        for (const AssumptionName& name : assumption_names())
          solution.assumptions[k].*name.assumption = {.verdict = Verdict::holds};
        continue;
      }
      const double mean =
          detail::mean_indentation(law, sample.force, amplitude, configuration.hold());
      ContactParameters parameters = at_state(known, law, &curve, mean, mean + amplitude);
      parameters.nominal_pressure = sample.pressure;
      parameters.loaded_size = known.loaded_size;
      // The mean contact pressure is at least the nominal pressure at the largest force.
      parameters.mean_contact_pressure =
          std::fmax(parameters.mean_contact_pressure, peak[k].mean / result.grid.area());
      solution.assumptions[k] = assumptions_of(law, mean, configuration.motion, parameters);
      // The mean curve ends at the largest pressure, but the motion may press further.
      if (const double over = peak_over_first_load(result, k); !std::isnan(over))
        solution.assumptions[k].plasticity =
            detail::plasticity_of(parameters, over * parameters.first_load);
    }
  }
  solution.verdicts = verdicts_of(solution.assumptions, solution.slips(), result.pressures);
  solution.validity = validity_of(solution.verdicts);
  return solution;
}

std::vector<double> surfaces_for(const StudyResult& result, double precision) {
  require_positive(precision, "precision");
  std::vector<double> counts;
  for (const StatedMean& constant : result.stated("damping_constant")) {
    const double excess = constant.relative_precision() / precision;
    counts.push_back(
        std::isnan(excess)
            ? ForceSample::unknown
            : std::max(2.0, std::ceil(double(result.realisations.size()) * excess * excess)));
  }
  return counts;
}

}  // namespace salebra
