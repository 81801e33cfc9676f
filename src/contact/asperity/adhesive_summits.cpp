// SPDX-License-Identifier: GPL-3.0-or-later
// Fuller and Tabor's model of adhesive summits, with JKR and with DMT summits.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/adhesive_summits.hpp>

#include "base/numerics/quadrature.hpp"
#include "height_density.hpp"

namespace salebra {

using std::numbers::pi;

double AdhesiveSummits::Summit::indentation(double a) const {
  return a * a / radius - (jkr ? std::sqrt(2 * pi * work * a / modulus) : 0.0);
}

double AdhesiveSummits::Summit::slope(double a) const {
  return 2 * a / radius - (jkr ? std::sqrt(pi * work / (2 * modulus * a)) : 0.0);
}

double AdhesiveSummits::Summit::force(double a) const {
  return 4 * modulus * a * a * a / (3 * radius) -
         (jkr ? std::sqrt(8 * pi * work * modulus * a * a * a) : 2 * pi * work * radius);
}

/// The minimum contact radius a of a summit: when the surfaces approach, the radius at indentation
/// δ = 0; when they separate, the radius at which dδ/da = 0.
double AdhesiveSummits::min_radius(const Summit& summit, bool unloading) {
  if (!summit.jkr) return 0;
  const double at_touch = 2 * pi * summit.work * summit.radius * summit.radius / summit.modulus;
  return std::cbrt(unloading ? at_touch / 16 : at_touch);
}

AdhesiveSummits::AdhesiveSummits(const SummitEnsemble& ensemble, const Material& material,
                                 double nominal_area, SummitAdhesion adhesion, double work,
                                 bool unloading)
    : AdhesiveSummits(
          ensemble, material, nominal_area,
          {ensemble.radius, material.contact_modulus, work, adhesion == SummitAdhesion::jkr},
          unloading, std::make_unique<const detail::HeightDensity>(ensemble)) {}

AdhesiveSummits::AdhesiveSummits(const SummitEnsemble& ensemble, const Material& material,
                                 double nominal_area, const Summit& summit, bool unloading,
                                 std::unique_ptr<const detail::HeightDensity> heights)
    : AsperityModel(
          {.name = summit.jkr ? "greenwood-williamson-jkr" : "greenwood-williamson-dmt",
           .material = material,
           .nominal_area = nominal_area,
           .mean_height = ensemble.mean_height,
           .upper_separation = heights->highest() -
                               std::min(0.0, summit.indentation(min_radius(summit, unloading))),
           .height_scale = heights->scale(),
           .rms_height = ensemble.rms_height}),
      summit_(summit),
      count_(ensemble.summit_density * nominal_area),
      min_radius_(min_radius(summit, unloading)),
      min_indentation_(summit.indentation(min_radius_)),
      heights_(std::move(heights)) {
  require_positive(ensemble.summit_density, "summit_density");
  require_positive(ensemble.radius, "radius");
  require_positive(summit.work, "work_of_adhesion");
}

AdhesiveSummits::~AdhesiveSummits() = default;

/// ∫ of_radius(a) φ(s + δ(a)) dδ times the number of summits, where φ is the density of summit
/// heights, s the separation and δ(a) the indentation of a summit with contact radius a. It is
/// integrated over a, in which no integrand is singular. Summits that pull and summits that press
/// may cancel, so the tolerance refers to `scale`, the size of both contributions.
template <class Function>
double AdhesiveSummits::over_summits(double separation, double scale,
                                     const Function& of_radius) const {
  constexpr double tolerance = 1e-10, nothing = 1e-100;
  const double unit =
      std::cbrt(2 * pi * summit_.work * std::pow(summit_.radius, 2) / summit_.modulus);
  std::vector<double> radii;
  for (const double height : heights_->support(separation + min_indentation_)) {
    const double beyond = height - separation - min_indentation_;
    radii.push_back(
        beyond <= 0
            ? min_radius_
            : detail::find_root(
                  [&](double a) { return summit_.indentation(a) - min_indentation_ - beyond; },
                  min_radius_, min_radius_ + std::sqrt(summit_.radius * beyond) + unit));
  }
  if (radii.size() < 2) return 0;
  const double typical = min_radius_ + std::sqrt(summit_.radius * common().height_scale);
  const detail::Integral integral = detail::integrate(
      [&](double a) {
        return of_radius(a) * heights_->density(separation + summit_.indentation(a)) *
               summit_.slope(a);
      },
      radii, tolerance,
      tolerance * (scale + std::abs(of_radius(typical))) *
          std::max(nothing, heights_->moment(0, separation + min_indentation_)));
  if (!integral.converged) throw NotConverged("adhesive_summits: quadrature over heights");
  return count_ * integral.value;
}

double AdhesiveSummits::force(double separation) const {
  return over_summits(separation, pi * summit_.work * summit_.radius,
                      [this](double a) { return summit_.force(a); });
}

AsperityContact AdhesiveSummits::at(double separation) const {
  return {.contacts = count_ * heights_->moment(0, separation + min_indentation_),
          .contact_area = over_summits(separation, 0, [](double a) { return pi * a * a; }),
          .force = force(separation),
          .normal_stiffness =
              over_summits(separation, 0, [this](double a) { return 2 * summit_.modulus * a; }),
          .force_curvature = ForceSample::unknown};
}

double AdhesiveSummits::pull_off_pressure() const {
  // The force varies with the separation over the reach of one summit's adhesion if all summits
  // have the same height, otherwise over the spread of the heights.
  const double reach = std::cbrt(std::pow(summit_.work / summit_.modulus, 2) * summit_.radius);
  const double step = std::max(common().height_scale / 4, summit_.jkr ? reach / 16 : 0.0);
  double best = common().upper_separation, least = 0;
  for (double s = best;; s -= step) {
    const double now = force(s);
    if (now < least) least = now, best = s;
    // Beyond the maximum pull, the force only rises as the separation falls.
    if (now > 0 || (least < 0 && now > least / 2)) break;
    if (least == 0 && s < -common().upper_separation) return 0;
  }
  if (!(least < 0)) return 0;
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = best - step, high = best + step;
  while (high - low > 1e-6 * step) {
    const double first = high - golden * (high - low), second = low + golden * (high - low);
    (force(first) < force(second) ? high : low) = force(first) < force(second) ? second : first;
  }
  return -std::min(least, force((low + high) / 2)) / common().nominal_area;
}

}  // namespace salebra
