// SPDX-License-Identifier: GPL-3.0-or-later
// Greenwood and Williamson's model, as a statistical ensemble and summit by summit: force curves
// and contact law.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

#include "base/numerics/quadrature.hpp"
#include "base/stop_check.hpp"
#include "given_summits.hpp"
#include "height_density.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

}  // namespace

SummitEnsemble summit_ensemble(double moment0, double moment2, double moment4) {
  require_positive(moment0, "moment0");
  require_positive(moment2, "moment2");
  require_positive(moment4, "moment4");
  const double nayak = moment0 * moment4 / (moment2 * moment2);
  require(nayak >= 1, "nayak", nayak,
          "must be >= 1, as for any surface; check that the moments belong together");
  return {.summit_density = moment4 / (6 * std::sqrt(3.0) * pi * moment2),
          .radius = 3.0 / 8 * std::sqrt(pi / moment4),
          .summit_rms = std::sqrt((1 - 0.8968 / nayak) * moment0),
          .mean_height = 4 * std::sqrt(moment0 / (pi * nayak)),
          .distribution = SummitDistribution::gaussian,
          .rms_height = std::sqrt(moment0)};
}

SummitEnsemble summit_ensemble(const SummitStatistics& statistics, double mean_plane) {
  return {.summit_density = statistics.summit_density,
          .radius = statistics.mean_radius,
          .summit_rms = statistics.rms_height,
          .mean_height = statistics.mean_height - mean_plane,
          .distribution = SummitDistribution::gaussian};
}

AsperityModel::AsperityModel(Common common) : common_(std::move(common)) {
  require_positive(common_.material.contact_modulus, "contact_modulus");
  require_positive(common_.nominal_area, "nominal_area");
}

AsperityModel::~AsperityModel() = default;

double AsperityModel::separation_of(double target) const {
  require_positive(target, "force");
  // The root is sought in ln F, which is nearly straight over the separation. The smallest positive
  // number replaces the force 0 before first touch.
  const auto excess = [&](double separation) {
    return std::log(std::max(force(separation), std::numeric_limits<double>::min()) / target);
  };
  const double high = common_.upper_separation;
  double step = common_.height_scale, low = high - step;
  while (excess(low) < 0) {
    step *= 2;
    low = high - step;
    require(std::isfinite(low), "force", target, "is more than the summits can carry");
  }
  return detail::find_root(excess, low, high);
}

StatisticalSummits::StatisticalSummits(const SummitEnsemble& ensemble, const Material& material,
                                       double nominal_area)
    : StatisticalSummits(ensemble, material, nominal_area,
                         std::make_unique<const detail::HeightDensity>(ensemble)) {}

StatisticalSummits::StatisticalSummits(const SummitEnsemble& ensemble, const Material& material,
                                       double nominal_area,
                                       std::unique_ptr<const detail::HeightDensity> heights)
    : AsperityModel({.name = "greenwood-williamson",
                     .material = material,
                     .nominal_area = nominal_area,
                     .mean_height = ensemble.mean_height,
                     .upper_separation = heights->highest(),
                     .height_scale = heights->scale(),
                     .rms_height = ensemble.rms_height}),
      count_(ensemble.summit_density * nominal_area),
      radius_(ensemble.radius),
      scale_(material.contact_modulus * std::sqrt(ensemble.radius) * count_),
      heights_(std::move(heights)) {
  require_positive(ensemble.summit_density, "summit_density");
  require_positive(ensemble.radius, "radius");
  require(std::isfinite(ensemble.mean_height), "mean_height", ensemble.mean_height,
          "must be finite");
}

StatisticalSummits::~StatisticalSummits() = default;

double StatisticalSummits::force(double separation) const {
  return 4.0 / 3 * scale_ * heights_->moment(1.5, separation);
}

double StatisticalSummits::normal_stiffness(double separation) const {
  return 2 * scale_ * heights_->moment(0.5, separation);
}

double StatisticalSummits::force_curvature(double separation) const {
  return scale_ * heights_->moment(-0.5, separation);
}

std::vector<double> StatisticalSummits::break_separations() const { return heights_->breaks(); }

AsperityContact StatisticalSummits::at(double separation) const {
  return {.contacts = count_ * heights_->moment(0, separation),
          .contact_area = pi * radius_ * count_ * heights_->moment(1, separation),
          .force = force(separation),
          .normal_stiffness = normal_stiffness(separation),
          .force_curvature = force_curvature(separation)};
}

DeterministicSummits::DeterministicSummits(const std::vector<Summit>& summits,
                                           const Material& material, double nominal_area,
                                           double mean_plane, double rms_height, SummitShape shape)
    : AsperityModel(detail::given_summits("greenwood-williamson-deterministic", summits, material,
                                          nominal_area, mean_plane, rms_height)) {
  for (const detail::HertzCap& cap : detail::hertz_caps(summits, shape))
    caps_.push_back({cap.height, cap.force_radius, cap.area_radius});
  std::ranges::sort(caps_, std::ranges::greater{}, &Cap::height);
}

std::vector<double> DeterministicSummits::break_separations() const {
  std::vector<double> heights;
  for (const Cap& cap : caps_) heights.push_back(cap.height);
  return heights;
}

AsperityContact DeterministicSummits::at(double separation) const {
  detail::stop_if_asked();
  AsperityContact sum;
  const double modulus = common().material.contact_modulus;
  for (const Cap& cap : caps_) {
    const double indentation = cap.height - separation;
    if (!(indentation > 0)) break;
    const double half_width = std::sqrt(cap.force_radius * indentation);
    sum.contacts += 1;
    sum.contact_area += pi * cap.area_radius * indentation;
    sum.force += 4.0 / 3 * modulus * half_width * indentation;
    sum.normal_stiffness += 2 * modulus * half_width;
    sum.force_curvature += modulus * cap.force_radius / half_width;
  }
  return sum;
}

ForceSample force_sample(const AsperityModel& model, double separation,
                         const AsperityContact& contact) {
  const AsperityModel::Common& common = model.common();
  return {.indentation = model.indentation(separation),
          .mean_gap = model.mean_gap(separation),
          .separation = separation,
          .force = contact.force,
          .pressure = contact.force / common.nominal_area,
          .contact_area_fraction = contact.contact_area / common.nominal_area,
          .normal_stiffness = contact.normal_stiffness,
          // NaN if G* is NaN
          .tangential_stiffness = common.material.tangential_modulus /
                                  common.material.contact_modulus * contact.normal_stiffness,
          .converged = contact.converged};
}

ForceCurve curve_at_separations(const AsperityModel& model,
                                const std::vector<double>& separations) {
  std::vector<double> descending = separations;
  for (const double separation : descending)
    require(std::isfinite(separation), "separations", separation, "must be finite");
  std::ranges::sort(descending, std::ranges::greater{});
  const AsperityModel::Common& common = model.common();
  ForceCurve curve{.model = common.name,
                   .nominal_area = common.nominal_area,
                   .rms_height = common.rms_height,
                   .samples = {}};
  for (const double separation : descending)
    curve.samples.push_back(force_sample(model, separation, model.at(separation)));
  return curve;
}

ForceCurve curve_at_pressures(const AsperityModel& model, const std::vector<double>& pressures) {
  std::vector<double> separations;
  for (const double pressure : pressures) {
    require_positive(pressure, "pressures");
    separations.push_back(model.separation_of(pressure * model.common().nominal_area));
  }
  return curve_at_separations(model, separations);
}

GreenwoodWilliamsonLaw::GreenwoodWilliamsonLaw(std::shared_ptr<const AsperityModel> model)
    : ContactLaw(model->common().material.modulus_ratio()), model_(std::move(model)) {}

GreenwoodWilliamsonLaw::GreenwoodWilliamsonLaw(const SummitEnsemble& ensemble,
                                               const Material& material, double nominal_area)
    : GreenwoodWilliamsonLaw(
          std::make_shared<StatisticalSummits>(ensemble, material, nominal_area)) {}

double GreenwoodWilliamsonLaw::separation(double indentation) const {
  detail::stop_if_asked();
  return model_->common().first_touch - indentation;
}

double GreenwoodWilliamsonLaw::force(double indentation) const {
  return model_->force(separation(indentation));
}

double GreenwoodWilliamsonLaw::normal_stiffness(double indentation) const {
  return model_->normal_stiffness(separation(indentation));
}

double GreenwoodWilliamsonLaw::force_curvature(double indentation) const {
  return model_->force_curvature(separation(indentation));
}

double GreenwoodWilliamsonLaw::first_touch() const {
  return model_->indentation(model_->common().upper_separation);
}

double GreenwoodWilliamsonLaw::indentation_of(double force) const {
  return model_->indentation(model_->separation_of(force));
}

std::vector<double> GreenwoodWilliamsonLaw::break_points() const {
  std::vector<double> points;
  for (const double break_separation : model_->break_separations())
    points.push_back(model_->indentation(break_separation));
  std::ranges::sort(points);
  return points;
}

}  // namespace salebra
