// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>

namespace salebra {

/// Spectral moments of profiles along x and along y, and the means of the two axes, which hold for
/// any direction if the surface is isotropic. They are measured from the heights of a surface or
/// expected values of a spectrum:
///     const double slope = surface_moments(surface).rms_slope();
struct SpectralMoments {
  double moment0 = 0;    ///< m0 = ⟨h²⟩, h measured from the mean height, m²
  double moment2_x = 0;  ///< ⟨(∂h/∂x)²⟩
  double moment2_y = 0;  ///< ⟨(∂h/∂y)²⟩
  double moment4_x = 0;  ///< ⟨(∂²h/∂x²)²⟩, 1/m²
  double moment4_y = 0;  ///< ⟨(∂²h/∂y²)²⟩, 1/m²

  double moment2() const { return (moment2_x + moment2_y) / 2; }  ///< m2
  double moment4() const { return (moment4_x + moment4_y) / 2; }  ///< m4, 1/m²
  double rms_height() const;                                      ///< h_rms = √m0, m
  double rms_slope() const;  ///< h' = √⟨|∇h|²⟩ = √(2 m2), exact for an anisotropic surface too
  double nayak() const;  ///< α = m0 m4/m2²; at least 1.5 for a Gaussian isotropic surface
};

constexpr void describe(auto&& visit, std::type_identity<SpectralMoments>) {
  using enum Dimension;
  using S = SpectralMoments;
  visit(&S::moment0, Quantity{"moment0", length_squared, "spectral moment m0"});
  visit(&S::moment2_x, Kept{"moment2_x", "mean square slope along x"});
  visit(&S::moment2_y, Kept{"moment2_y", "mean square slope along y"});
  visit(&S::moment4_x, Kept{"moment4_x", "mean square curvature along x", inverse_length_squared});
  visit(&S::moment4_y, Kept{"moment4_y", "mean square curvature along y", inverse_length_squared});
  visit(&S::moment2, Quantity{"moment2", dimensionless, "spectral moment m2 of a profile"});
  visit(&S::moment4,
        Quantity{"moment4", inverse_length_squared, "spectral moment m4 of a profile"});
  visit(&S::rms_height, Kept{"rms_height", "root mean square height", length});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
  visit(&S::nayak, Quantity{"nayak", dimensionless, "Nayak parameter m0 m4 / m2^2"});
}

}  // namespace salebra
