// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/greenwood_williamson.hpp>

#include "quadrature.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

constexpr double relative_tolerance = 1e-12;
// exp(−exponent) is lost beside 1 in double precision, with room for the powers of z − s before it.
constexpr double negligible_exponent = 45;

/// ∫ (z−h)^n φ(z) dz over [max(h, low), high] for a smooth φ, as 2∫ t^{2n+1} φ(h + t²) dt: even at n = −1/2 nothing is singular.
double shifted_moment(double exponent, double h, double low, double high,
                      const std::function<double(double)>& density) {
  const double from = std::sqrt(std::max(0.0, low - h)), to = std::sqrt(std::max(0.0, high - h));
  const int power = static_cast<int>(std::lround(2 * exponent)) + 1;
  const auto integrand = [&](double t) {
    double weight = 2;
    for (int factor = 0; factor < power; ++factor) weight *= t;
    return weight * density(h + t * t);
  };
  const detail::Integral integral =
      detail::integrate(integrand, std::array{from, to}, relative_tolerance);
  if (!integral.converged) throw NotConverged("greenwood_williamson: quadrature over heights");
  return integral.value;
}

/// F_n(h) = ∫_h^∞ (z−h)^n φ(z) dz with σ = 1, GW's notation.
double gaussian_moment(double exponent, double h) {
  // φ(z) falls from φ(0), or from φ(h) if h > 0, by exp(−negligible_exponent) at z = high.
  const double reach = std::sqrt(2 * negligible_exponent + std::max(h, 0.0) * std::max(h, 0.0));
  // The factor φ(h) is taken out of the integrand, so that it does not underflow before the result does.
  const double offset = std::max(h, 0.0) * std::max(h, 0.0) / 2;
  const double scaled = shifted_moment(exponent, h, -reach, reach,
                                       [&](double z) { return std::exp(offset - z * z / 2); });
  return scaled * std::exp(-offset) / std::sqrt(2 * pi);
}

double exponential_moment(double exponent, double h) {
  if (h >= 0) return std::tgamma(exponent + 1) * std::exp(-h);
  return shifted_moment(exponent, h, 0, negligible_exponent, [](double z) { return std::exp(-z); });
}

}  // namespace

SummitEnsemble summit_ensemble(double moment0, double moment2, double moment4) {
  require_positive(moment0, "moment0");
  require_positive(moment2, "moment2");
  require_positive(moment4, "moment4");
  const double nayak = moment0 * moment4 / (moment2 * moment2);
  require(nayak >= 1, "nayak", nayak,
          "must be >= 1, as for any surface; check that the moments belong together");
  return {.density = moment4 / (6 * std::sqrt(3.0) * pi * moment2),
          .radius = 3.0 / 8 * std::sqrt(pi / moment4),
          .summit_rms = std::sqrt((1 - 0.8968 / nayak) * moment0),
          .mean_height = 4 * std::sqrt(moment0 / (pi * nayak)),
          .distribution = SummitDistribution::gaussian,
          .rms_height = std::sqrt(moment0)};
}

SummitEnsemble summit_ensemble(const SummitStatistics& statistics, double mean_plane) {
  return {.density = statistics.density,
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
  // ln F bends little; the least positive number stands for the force before first touch.
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
    : AsperityModel(
          {.name = "greenwood-williamson",
           .material = material,
           .nominal_area = nominal_area,
           .mean_height = ensemble.mean_height,
           // e^−700 is the last decade of double precision: exp(−h²/2) or exp(−h).
           .upper_separation = ensemble.summit_rms *
                               (ensemble.distribution == SummitDistribution::gaussian ? 37 : 700),
           .height_scale = ensemble.summit_rms,
           .rms_height = ensemble.rms_height}),
      ensemble_(ensemble) {
  require_positive(ensemble.density, "density");
  require_positive(ensemble.radius, "radius");
  require_positive(ensemble.summit_rms, "summit_rms");
  require(std::isfinite(ensemble.mean_height), "mean_height", ensemble.mean_height,
          "must be finite");
  scale_ = material.contact_modulus * std::sqrt(ensemble.radius) * ensemble.density * nominal_area;
}

double StatisticalSummits::moment(double exponent, double separation) const {
  const double h = separation / ensemble_.summit_rms;
  return std::pow(ensemble_.summit_rms, exponent) *
         (ensemble_.distribution == SummitDistribution::gaussian ? gaussian_moment(exponent, h)
                                                                 : exponential_moment(exponent, h));
}

double StatisticalSummits::force(double separation) const {
  return 4.0 / 3 * scale_ * moment(1.5, separation);
}

double StatisticalSummits::normal_stiffness(double separation) const {
  return 2 * scale_ * moment(0.5, separation);
}

double StatisticalSummits::curvature(double separation) const {
  return scale_ * moment(-0.5, separation);
}

AsperityContact StatisticalSummits::at(double separation) const {
  const double h = separation / ensemble_.summit_rms;
  const double summits = ensemble_.density * common().nominal_area;
  double touching, mean_excess;  // ∫φ and ∫(z−h)φ
  if (ensemble_.distribution == SummitDistribution::gaussian) {
    touching = std::erfc(h / std::numbers::sqrt2) / 2;
    mean_excess = gaussian_moment(1, h);
  } else {
    touching = h > 0 ? std::exp(-h) : 1;
    mean_excess = h > 0 ? touching : 1 - h;
  }
  return {.contacts = summits * touching,
          .contact_area = pi * ensemble_.radius * summits * ensemble_.summit_rms * mean_excess,
          .force = force(separation),
          .normal_stiffness = normal_stiffness(separation),
          .curvature = curvature(separation)};
}

namespace {

double mean_of_heights(const std::vector<Summit>& summits) {
  require(!summits.empty(), "summits", 0, "are too few; a contact needs at least one");
  double sum = 0;
  for (const Summit& summit : summits) {
    require(std::isfinite(summit.height), "summits.height", summit.height, "must be finite");
    require_positive(summit.curvature1 + summit.curvature2, "summits.curvature");
    sum += summit.height;
  }
  return sum / static_cast<double>(summits.size());
}

AsperityModel::Common common_of(const std::vector<Summit>& summits, const Material& material,
                                double nominal_area, double mean_plane, double rms_height) {
  const double mean = mean_of_heights(summits);
  const double highest = std::ranges::max(summits, {}, &Summit::height).height - mean;
  double square = 0;
  for (const Summit& summit : summits) square += (summit.height - mean) * (summit.height - mean);
  const double deviation = std::sqrt(square / static_cast<double>(summits.size()));
  return {.name = "greenwood-williamson-deterministic",
          .material = material,
          .nominal_area = nominal_area,
          .mean_height = mean - mean_plane,
          .first_touch = highest,
          .upper_separation = highest,
          .height_scale = deviation > 0 ? deviation : summits.front().mean_radius(),
          .rms_height = rms_height};
}

}  // namespace

DeterministicSummits::DeterministicSummits(const std::vector<Summit>& summits,
                                           const Material& material, double nominal_area,
                                           double mean_plane, double rms_height)
    : AsperityModel(common_of(summits, material, nominal_area, mean_plane, rms_height)) {
  const double mean = common().mean_height + mean_plane;
  for (const Summit& summit : summits)
    caps_.push_back({.height = summit.height - mean, .radius = summit.mean_radius()});
  std::ranges::sort(caps_, std::ranges::greater{}, &Cap::height);
}

AsperityContact DeterministicSummits::at(double separation) const {
  AsperityContact sum;
  const double modulus = common().material.contact_modulus;
  for (const Cap& cap : caps_) {
    const double indentation = cap.height - separation;
    if (!(indentation > 0)) break;
    const double contact_radius = std::sqrt(cap.radius * indentation);
    sum.contacts += 1;
    sum.contact_area += pi * contact_radius * contact_radius;
    sum.force += 4.0 / 3 * modulus * contact_radius * indentation;
    sum.normal_stiffness += 2 * modulus * contact_radius;
    sum.curvature += modulus * cap.radius / contact_radius;
  }
  return sum;
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
  for (const double separation : descending) {
    const AsperityContact contact = model.at(separation);
    curve.samples.push_back({.indentation = model.indentation(separation),
                             .mean_gap = model.mean_gap(separation),
                             .separation = separation,
                             .force = contact.force,
                             .pressure = contact.force / common.nominal_area,
                             .contact_area_fraction = contact.contact_area / common.nominal_area,
                             .normal_stiffness = contact.normal_stiffness,
                             // NaN where G* is.
                             .tangential_stiffness = common.material.tangential_modulus /
                                                     common.material.contact_modulus *
                                                     contact.normal_stiffness});
  }
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
  return model_->common().first_touch - indentation;
}

double GreenwoodWilliamsonLaw::force(double indentation) const {
  return model_->force(separation(indentation));
}

double GreenwoodWilliamsonLaw::normal_stiffness(double indentation) const {
  return model_->normal_stiffness(separation(indentation));
}

double GreenwoodWilliamsonLaw::curvature(double indentation) const {
  return model_->curvature(separation(indentation));
}

double GreenwoodWilliamsonLaw::indentation_of(double force) const {
  return model_->indentation(model_->separation_of(force));
}

}  // namespace salebra
