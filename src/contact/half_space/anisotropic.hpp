// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <salebra/contact/half_space/body.hpp>
#include <vector>

namespace salebra::detail {

// q times the response of an anisotropic half-space to waves along (cos φ, sin φ), 1/Pa, as a Fourier
// series in 2φ: waves in opposite directions have one response. The coupling is not known (NaN).
class AngularResponse {
 public:
  // Throws InvalidInput unless the stiffness is symmetric and positive definite, and for a material
  // so close to instability that the series does not converge.
  explicit AngularResponse(const AnisotropicStiffness& stiffness);

  SurfaceCompliance mean() const;  // over all directions
  SurfaceCompliance along(double cosine, double sine) const;

 private:
  using Term = std::array<std::complex<double>, 4>;  // normal, in plane, across, mixed
  std::vector<Term> terms_;                          // the response is Re Σ term_k e^2ikφ
};

}  // namespace salebra::detail
