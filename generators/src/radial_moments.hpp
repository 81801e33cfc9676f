// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/spectral_moments.hpp>

namespace salebra::detail {

/// ∫_1^ratio t^{exponent−1} dt, without cancellation for exponents near 0.
inline double power_integral(double ratio, double exponent) {
  const double log_ratio = std::log(ratio);
  return exponent == 0 ? log_ratio : std::expm1(exponent * log_ratio) / exponent;
}

/// Checks that the square of an rms value neither underflows nor overflows in the spectrum.
inline void require_square(double rms, const char* field) {
  require_positive(rms, field);
  require(rms > 1e-140 && rms < 1e140, field, rms, "must lie in 1e-140 … 1e140; check the unit");
}

/// Spectral moments along x and y of an isotropic spectrum C, from integral(order) = ∫|q|^order C
/// d²q. The mean over directions is 1/2 for cos² (moment 2) and 3/8 for cos⁴ (moment 4).
template <class Integral>
SpectralMoments isotropic_moments(const Integral& integral) {
  const double moment2 = integral(2) / 2;
  const double moment4 = integral(4) * 3 / 8;
  return {integral(0), moment2, moment2, moment4, moment4};
}

}  // namespace salebra::detail
