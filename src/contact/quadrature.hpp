// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

namespace salebra::detail {

struct Integral {
  double value = 0;
  double error = 0;  ///< estimate of |value − integral|
  bool converged = false;
};

/// ∫ f over [points.front(), points.back()] by adaptive Gauss–Kronrod with extrapolation; f may
/// have a jump, a kink or an integrable singularity at each of the points (increasing; equal
/// neighbours are allowed), and is not evaluated there. An exception of f is passed on.
Integral integrate(const std::function<double(double)>& f, std::span<const double> points,
                   double relative_tolerance, double absolute_tolerance = 0);

/// Zero of a continuous f in [low, high], where f must change sign, to the last bits of the
/// argument. Inverse quadratic interpolation safeguarded by bisection. Throws NotConverged where
/// there is no change of sign.
double find_root(const std::function<double(double)>& f, double low, double high);

}  // namespace salebra::detail
