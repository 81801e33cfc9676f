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

/// ∫ f over [points.front(), points.back()] by adaptive Gauss–Kronrod quadrature with
/// extrapolation. At each of the points (increasing; equal neighbours are allowed) f may have a
/// jump, a kink or an integrable singularity; f is not evaluated there. Exceptions of f reach the
/// caller.
Integral integrate(const std::function<double(double)>& f, std::span<const double> points,
                   double relative_tolerance, double absolute_tolerance = 0);

/// Zero of a continuous f in [low, high], where f must change sign, to the last bits of the
/// argument, by inverse quadratic interpolation safeguarded by bisection. Throws NotConverged if f
/// does not change sign.
double find_root(const std::function<double(double)>& f, double low, double high);

}  // namespace salebra::detail
