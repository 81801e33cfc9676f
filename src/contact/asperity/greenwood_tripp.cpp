// SPDX-License-Identifier: GPL-3.0-or-later
// Greenwood and Tripp: two rough sides as one ensemble of summit pairs.
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>

#include "height_density.hpp"

namespace salebra {
namespace {

/// The ensemble whose heights are sums of a summit height of the first side and one of the second.
SummitEnsemble sum_of_sides(const SummitEnsemble& first, const SummitEnsemble& second) {
  for (const SummitEnsemble& side : {first, second}) {
    require_positive(side.summit_density, "summit_density");
    require_positive(side.radius, "radius");
    require_positive(side.summit_rms, "summit_rms");
    require(side.distribution == SummitDistribution::gaussian, "distribution",
            side.distribution == SummitDistribution::exponential ? "exponential" : "tabulated",
            "is not available for two rough sides, which need Gaussian heights");
  }
  return {.summit_density = first.summit_density * second.summit_density,
          .radius = first.radius * second.radius / (first.radius + second.radius),
          .summit_rms = std::hypot(first.summit_rms, second.summit_rms),
          .mean_height = first.mean_height + second.mean_height,
          .rms_height = std::hypot(first.rms_height, second.rms_height)};
}

}  // namespace

GreenwoodTripp::GreenwoodTripp(const SummitEnsemble& first, const SummitEnsemble& second,
                               const Material& material, double nominal_area)
    : AsperityModel([&] {
        const SummitEnsemble sum = sum_of_sides(first, second);
        const detail::HeightDensity heights(sum);
        return Common{.name = "greenwood-tripp",
                      .material = material,
                      .nominal_area = nominal_area,
                      .mean_height = sum.mean_height,
                      .upper_separation = heights.highest(),
                      .height_scale = heights.scale(),
                      .rms_height = sum.rms_height};
      }()),
      heights_(std::make_unique<const detail::HeightDensity>(sum_of_sides(first, second))) {
  const double radii = first.radius + second.radius;
  const double radius = first.radius * second.radius / radii;
  pairs_ =
      2 * std::numbers::pi * radii * first.summit_density * second.summit_density * nominal_area;
  // A pair of summits with effective radius R whose heights overlap by w has the contact area πRw;
  // ∫_0^{z−s} w dw = (z−s)²/2 with the sum z of the two heights and the separation s.
  area_ = pairs_ * std::numbers::pi * radius / 2;
  // The force of such a pair is (4/3)E*√R w^{3/2}; ∫_0^{z−s} w^{3/2} dw = (2/5)(z−s)^{5/2}.
  scale_ = pairs_ * 4.0 / 3 * material.contact_modulus * std::sqrt(radius) * 2 / 5;
}

GreenwoodTripp::~GreenwoodTripp() = default;

double GreenwoodTripp::force(double separation) const {
  return scale_ * heights_->moment(2.5, separation);
}

double GreenwoodTripp::normal_stiffness(double separation) const {
  return scale_ * 5 / 2 * heights_->moment(1.5, separation);
}

double GreenwoodTripp::force_curvature(double separation) const {
  return scale_ * 15 / 4 * heights_->moment(0.5, separation);
}

AsperityContact GreenwoodTripp::at(double separation) const {
  return {.contacts = pairs_ * heights_->moment(1, separation),
          .contact_area = area_ * heights_->moment(2, separation),
          .force = force(separation),
          .normal_stiffness = normal_stiffness(separation),
          .force_curvature = force_curvature(separation)};
}

}  // namespace salebra
