// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz contact of an elliptic paraboloid by complete elliptic integrals.
#include "hertz_ellipse.hpp"

#include <gsl/gsl_sf_ellint.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace salebra::detail {
namespace {

/// The complete elliptic integrals K(e) (`first`) and D(e) = (K − E)/e² (`difference`) of the
/// eccentricity e of a contact ellipse with semi-axes a >= b, by Carlson's integrals, which do not
/// cancel for a circle; complement = 1 − e² = (b/a)².
struct Integrals {
  double complement, first, difference;

  explicit Integrals(double one_minus_square)
      : complement(one_minus_square),
        first(gsl_sf_ellint_RF(0, complement, 1, GSL_PREC_DOUBLE)),
        difference(gsl_sf_ellint_RD(0, complement, 1, GSL_PREC_DOUBLE) / 3) {}

  /// Ratio κ2/κ1 <= 1 of the curvatures of the paraboloid whose contact ellipse has these
  /// semi-axes.
  double curvature_ratio() const { return complement * difference / (first - difference); }
};

}  // namespace

// Hertz contact of a paraboloid with curvatures κ1 >= κ2: the contact is an ellipse with semi-axes
// a >= b under the pressure p0√(1 − x²/a² − y²/b²) (Johnson, Contact Mechanics, 4.26–4.32). With
// the elliptic integrals K and D above and the eccentricity e,
//     δ = p0 b K/E*,  κ2/2 = p0 b D/(E* a²),  F = (2/3)p0πab,
// hence a² = 2δD/(Kκ2), F = (2π/3)E* a δ/K, and b² = (1 − e²)a².
HertzEllipse hertz_ellipse(double curvature1, double curvature2) {
  const double ratio = std::clamp(curvature2 / curvature1, 1e-3, 1.0);
  const double smaller = ratio * curvature1;
  // ln(κ2/κ1) is nearly a straight line over ln(1 − e²), of slope 3/4: secant steps that start from
  // this line converge.
  const double target = std::log(ratio);
  auto miss = [&](double log_complement) {
    return std::log(Integrals(std::exp(log_complement)).curvature_ratio()) - target;
  };
  double last = 0, last_miss = -target, log_complement = std::min(4.0 / 3 * target, 0.0);
  for (int step = 0; step < 50 && log_complement != last; ++step) {
    const double here = miss(log_complement);
    if (std::abs(here) < 1e-15 || here == last_miss) break;
    const double next =
        std::min(0.0, log_complement - here * (log_complement - last) / (here - last_miss));
    last = log_complement;
    last_miss = here;
    log_complement = next;
  }
  const Integrals integrals(std::exp(log_complement));
  const double axis =
      2 * integrals.difference / (integrals.first * smaller);  // a²/δ of the contact ellipse
  const double slope = std::numbers::pi / (2 * integrals.first);
  return {.force_radius = slope * slope * axis,
          .area_radius = axis * std::sqrt(integrals.complement)};
}

}  // namespace salebra::detail
