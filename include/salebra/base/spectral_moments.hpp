// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace salebra {

/// Profile moments along both axes and their means, which are those of any direction if the surface
/// is isotropic. Of a surface (measured from heights) or of a spectrum (expected).
struct SpectralMoments {
  double moment0 = 0;    ///< m0 = ⟨h²⟩ of the heights less their mean, m²
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

}  // namespace salebra
