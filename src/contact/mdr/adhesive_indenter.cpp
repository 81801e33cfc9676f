// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesion of axisymmetric indenters after JKR, DMT, and Maugis and Dugdale.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/adhesive_indenter.hpp>

namespace salebra {
namespace {

using std::numbers::pi;

void require_adhesive(double contact_modulus, double work) {
  require_positive(contact_modulus, "contact_modulus");
  require_positive(work, "work");
}

/// Decrease of the indentation by adhesion, √(2πwa/E*), at contact radius a and work of adhesion w.
double drawn_in(double contact_modulus, double work, double contact_radius) {
  return std::sqrt(2 * pi * work * contact_radius / contact_modulus);
}

/// The root, to the last bits, of a function that rises through 0 between low and high.
template <class Function>
double rising_root(double low, double high, const Function& function) {
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (function(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

AdhesivePoint jkr_contact(const IndenterProfile& profile, double contact_modulus, double work,
                          double contact_radius) {
  require_adhesive(contact_modulus, work);
  require_positive(contact_radius, "contact_radius");
  const double indentation =
      profile.image(contact_radius) - drawn_in(contact_modulus, work, contact_radius);
  return {
      contact_radius,
      2 * contact_modulus * (contact_radius * indentation - profile.image_integral(contact_radius)),
      indentation, contact_radius};
}

AdhesivePoint jkr_pull_off(const IndenterProfile& profile, double contact_modulus, double work) {
  require_adhesive(contact_modulus, work);
  // With the image g of the profile, contact radius a and work of adhesion w, dF/da = 2E*[a g'(a) −
  // (3/2)√(2πwa/E*)]. It is negative near a = 0 and at the rim of a flat end.
  const auto slope = [&](double a) {
    return a * profile.image_slope(a) - 1.5 * drawn_in(contact_modulus, work, a);
  };
  const double first = std::max(profile.flat_radius(), std::numeric_limits<double>::min() * 1e10);
  const double last = profile.max_radius();
  // If the profile reaches any radius, g' may grow so slowly that the minimum of the force lies
  // many decades away.
  double high = std::isfinite(last) ? last : std::max(first, 1e-12);
  if (!std::isfinite(last))
    while (high < 1e12 && !(slope(high) > 0)) high *= 2;
  if (!(slope(high) > 0)) {
    // On the side of a punch, the radius stays constant while the force rises to 0.
    if (profile.has_side()) return jkr_contact(profile, contact_modulus, work, last);
    throw NotConverged("pull-off: the contact still adheres at the largest radius of the profile");
  }
  double low = high;
  while (low > first && slope(low) > 0) low = std::max(first, low / 2);
  return jkr_contact(profile, contact_modulus, work, rising_root(low, high, slope));
}

AdhesivePoint dmt_contact(double radius, double contact_modulus, double work,
                          double contact_radius) {
  require_adhesive(contact_modulus, work);
  require_positive(radius, "radius");
  require(contact_radius >= 0, "contact_radius", contact_radius, "must be >= 0");
  return {contact_radius,
          4 * contact_modulus * std::pow(contact_radius, 3) / (3 * radius) - 2 * pi * work * radius,
          contact_radius * contact_radius / radius, std::numeric_limits<double>::infinity()};
}

MaugisDugdale::MaugisDugdale(double radius, double contact_modulus, double work, double range)
    : radius_(radius), work_(work) {
  require_adhesive(contact_modulus, work);
  require_positive(radius, "radius");
  require_positive(range, "range");
  const double stiffness = 4 * contact_modulus / 3;
  lambda_ = 2 * work / range * std::cbrt(radius / (pi * work * stiffness * stiffness));
  length_ = std::cbrt(pi * work * radius * radius / stiffness);
  depth_ = std::cbrt(std::pow(pi * work / stiffness, 2) * radius);
}

AdhesivePoint MaugisDugdale::contact(double contact_radius) const {
  require(contact_radius >= 0, "contact_radius", contact_radius, "must be >= 0");
  // With the contact radius A (in units of length_) and the ratio m of the outer to the inner
  // radius of the adhesive zone, the unknown is the width A√(m² − 1), which stays finite for A = 0.
  const double a = contact_radius / length_;
  struct Zone {
    double edge, angle;  // outer radius c = A m; arcsec m = atan √(m² − 1)
  };
  const auto zone_of = [&](double width) {
    return Zone{std::hypot(a, width), std::atan2(width, a)};
  };
  const double width = rising_root(0, 2 / std::sqrt(lambda_) + 2 / lambda_ + 4, [&](double w) {
    const auto [edge, angle] = zone_of(w);
    // The width c − A of the adhesive zone, without cancellation.
    const double beyond = w * w / (edge + a);
    return lambda_ / 2 * (a * w + (edge * edge - 2 * a * a) * angle) +
           4 * lambda_ * lambda_ / 3 * (w * angle - beyond) - 1;
  });
  const auto [edge, angle] = zone_of(width);
  return {contact_radius,
          pi * work_ * radius_ * (a * a * a - lambda_ * (a * width + edge * edge * angle)),
          depth_ * (a * a - 4 * lambda_ / 3 * width), edge * length_};
}

AdhesivePoint MaugisDugdale::pull_off() const {
  // In units of length_, a JKR contact comes off at the radius (3/2)^(1/3), a DMT contact at 0; the
  // force has a single minimum over the radii 0 … 2.
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double low = 0, high = 2 * length_;
  const auto force = [&](double a) { return contact(a).force; };
  double first = high - golden * (high - low), second = low + golden * (high - low);
  double of_first = force(first), of_second = force(second);
  while (high - low > 1e-9 * length_) {
    if (of_first < of_second) {
      high = second;
      second = first;
      of_second = of_first;
      of_first = force(first = high - golden * (high - low));
    } else {
      low = first;
      first = second;
      of_first = of_second;
      of_second = force(second = low + golden * (high - low));
    }
  }
  const AdhesivePoint inside = contact(0.5 * (low + high)), without_contact = contact(0);
  return inside.force < without_contact.force ? inside : without_contact;
}

AdhesivePoint adhesive_equilibrium(const std::function<AdhesivePoint(double)>& contact,
                                   const AdhesivePoint& pull_off, double AdhesivePoint::*quantity,
                                   double value) {
  const char* name = quantity == &AdhesivePoint::force ? "normal_force" : "indentation";
  require(value >= pull_off.*quantity, name, value,
          fmt::format("is below the value at pull-off, {}", pull_off.*quantity));
  const double low = pull_off.contact_radius;
  double high = std::max(2 * low, 1e-12);
  while (contact(high).*quantity < value) high *= 2;
  return contact(rising_root(low, high, [&](double a) { return contact(a).*quantity - value; }));
}

double tabor_parameter(double radius, double contact_modulus, double work, double range) {
  require_adhesive(contact_modulus, work);
  require_positive(radius, "radius");
  require_positive(range, "range");
  return std::cbrt(radius * work * work / (contact_modulus * contact_modulus)) / range;
}

AdhesionModel suggested_model(double tabor_parameter) {
  require(tabor_parameter >= 0, "tabor_parameter", tabor_parameter, "must be >= 0");
  return tabor_parameter < 0.1 ? AdhesionModel::dmt
         : tabor_parameter > 5 ? AdhesionModel::jkr
                               : AdhesionModel::maugis_dugdale;
}

}  // namespace salebra
