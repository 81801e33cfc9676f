// SPDX-License-Identifier: GPL-3.0-or-later
// Method of dimensionality reduction: transform, inverse, and the law of an axisymmetric indenter.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <sstream>

#include "base/numerics/quadrature.hpp"
#include "base/special_values.hpp"
#include "base/stop_check.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

using detail::infinity;

// Returns low, f(b) for those break points b with low < f(b) < high, and high, for increasing f.
template <class Function>
std::vector<double> with_breaks(double low, double high, std::span<const double> breaks,
                                const Function& f) {
  std::vector<double> points{low};
  for (const double point : breaks) {
    const double mapped = f(point);
    if (mapped > points.back() && mapped < high) points.push_back(mapped);
  }
  points.push_back(high);
  return points;
}

}  // namespace

Estimate mdr_transform(const std::function<double(double)>& slope, double x,
                       std::span<const double> breaks) {
  x = std::abs(x);
  if (x == 0) return {};
  const auto points =
      with_breaks(0, pi / 2, breaks, [&](double r) { return r < x ? std::asin(r / x) : infinity; });
  const auto integral =
      detail::integrate([&](double angle) { return slope(x * std::sin(angle)); }, points, 1e-12);
  return {x * integral.value, x * integral.error};
}

Estimate mdr_inverse(const std::function<double(double)>& image, double r,
                     std::span<const double> breaks) {
  r = std::abs(r);
  if (r == 0) return {};
  const auto points =
      with_breaks(0, pi / 2, breaks, [&](double x) { return x < r ? std::asin(x / r) : infinity; });
  const auto integral =
      detail::integrate([&](double angle) { return image(r * std::sin(angle)); }, points, 1e-12);
  return {2 / pi * integral.value, 2 / pi * integral.error};
}

Estimate line_load_stress(const std::function<double(double)>& slope, double edge_value,
                          double edge, double r, std::span<const double> breaks) {
  if (!(r < edge)) return {};
  // Integrates over s with x² = r² + s², because dx/√(x² − r²) = ds/x is not singular.
  const double reach = std::sqrt((edge - r) * (edge + r));
  const auto points = with_breaks(
      0, reach, breaks, [&](double x) { return x > r ? std::sqrt((x - r) * (x + r)) : -infinity; });
  const auto integral = detail::integrate(
      [&](double s) {
        const double x = std::hypot(r, s);
        return slope(x) / x;
      },
      points, 1e-11);
  return {(edge_value / reach - integral.value) / pi, integral.error / pi};
}

double IndenterProfile::contact_radius(double indentation) const {
  require_positive(indentation, "indentation");
  const double largest = max_radius();
  if (std::isfinite(largest) && indentation >= image(largest)) {
    if (has_side() || indentation <= image(largest) * (1 + 1e-12)) return largest;
    std::ostringstream constraint;
    constraint.precision(9);
    constraint << "m is deeper than the profile reaches, " << image(largest)
               << " m; reduce it, or give a profile that reaches further";
    require(false, "indentation", indentation, constraint.str());
  }
  double high = std::isfinite(largest) ? largest : std::max(2 * flat_radius(), 1e-9);
  while (image(high) < indentation) high *= 4;
  return detail::find_root([&](double x) { return image(x) - indentation; }, flat_radius(), high);
}

IndenterLaw::IndenterLaw(std::shared_ptr<const IndenterProfile> profile, const Material& material)
    : ContactLaw(material.modulus_ratio()),
      profile_(std::move(profile)),
      contact_modulus_(material.contact_modulus) {
  if (!profile_) throw InvalidInput("profile", "not given; choose a shape or a table");
}

double IndenterLaw::contact_radius(double indentation) const {
  detail::stop_if_asked();
  return indentation > 0 ? profile_->contact_radius(indentation) : 0;
}

double IndenterLaw::force(double indentation) const {
  if (!(indentation > 0)) return 0;
  const double edge = contact_radius(indentation);
  return 2 * contact_modulus_ * (indentation * edge - profile_->image_integral(edge));
}

double IndenterLaw::normal_stiffness(double indentation) const {
  return 2 * contact_modulus_ * contact_radius(indentation);
}

double IndenterLaw::force_curvature(double indentation) const {
  if (!(indentation > 0)) return 0;
  const double edge = contact_radius(indentation);
  if (edge >= profile_->max_radius() && profile_->has_side()) return 0;
  return 2 * contact_modulus_ / profile_->image_slope(edge);
}

double IndenterLaw::highest_indentation() const {
  const double largest = profile_->max_radius();
  return std::isfinite(largest) && !profile_->has_side() ? profile_->image(largest) : infinity;
}

std::vector<double> IndenterLaw::break_points() const {
  std::vector<double> points{0};
  for (const double radius : profile_->breaks()) {
    const double level = profile_->image(radius);
    if (level > points.back()) points.push_back(level);
  }
  return points;
}

double IndenterLaw::indentation_of(double wanted) const {
  require_positive(wanted, "force");
  const double highest = highest_indentation();
  // With contact radius a, F <= 2E*aδ always and F >= E*aδ for profiles that rise at least in
  // proportion to r, so a few multiplications by 4 find an interval that contains the root.
  double high = std::isfinite(highest) ? highest : 1e-9;
  if (std::isfinite(highest) && force(highest) < wanted) {
    std::ostringstream constraint;
    constraint.precision(9);
    constraint << "N is more than the profile's " << force(highest)
               << " N; reduce it, or give a profile that reaches further";
    require(false, "force", wanted, constraint.str());
  }
  while (force(high) < wanted) high *= 4;
  double low = high;
  while (force(low) > wanted) low /= 4;
  if (low == high) return high;
  return detail::find_root([&](double indentation) { return force(indentation) - wanted; }, low,
                           high);
}

double IndenterLaw::pressure(double indentation, double r) const {
  require(r >= 0, "radius", r, "must be >= 0");
  if (!(indentation > 0)) return 0;
  const double edge = contact_radius(indentation);
  if (r >= edge) return 0;
  const double jump = contact_modulus_ * (indentation - profile_->image(edge));
  return line_load_stress([&](double x) { return -contact_modulus_ * profile_->image_slope(x); },
                          jump, edge, r, profile_->breaks())
      .value;
}

double IndenterLaw::surface_displacement(double indentation, double r) const {
  require(r >= 0, "radius", r, "must be >= 0");
  if (!(indentation > 0)) return 0;
  const double edge = contact_radius(indentation);
  if (r <= edge) return indentation - profile_->height(r);
  // The substitution x = r sin φ removes the singularity of the integrand at x = r.
  std::vector<double> angles = {0};
  for (const double at : profile_->breaks())
    if (at > 0 && at < edge) angles.push_back(std::asin(at / r));
  angles.push_back(std::asin(edge / r));
  return 2 / std::numbers::pi *
         detail::integrate(
             [&](double angle) { return indentation - profile_->image(r * std::sin(angle)); },
             angles, 1e-10)
             .value;
}

}  // namespace salebra
