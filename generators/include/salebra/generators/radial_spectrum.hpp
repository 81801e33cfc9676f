// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/generators/spectrum.hpp>
#include <vector>

namespace salebra {

/// Any function C(|q|) between two wave numbers, and 0 outside of them.
class FunctionSpectrum final : public IsotropicSpectrum {
 public:
  /// density   C(q) >= 0 in m⁴ for lowest <= q <= highest, rad/m; called from several threads at
  ///           once
  /// lowest    >= 0; 0 for all long waves of a cell
  /// name      for provenance
  /// Throws InvalidInput unless 0 <= lowest < highest, and where the density is negative or not
  /// finite at a point where it is asked for the moments, which are integrated here: adaptive
  /// Simpson's rule, relative error about 1e-10 for a smooth function.
  FunctionSpectrum(std::function<double(double q)> density, double lowest, double highest,
                   std::string name);

  double radial_density(double q) const override;
  double highest_wavenumber() const override { return highest_; }
  SpectralMoments moments() const override { return moments_; }
  std::string description() const override { return name_; }

 private:
  std::function<double(double)> density_;
  double lowest_, highest_;
  std::string name_;
  SpectralMoments moments_;
};

/// A spectrum from a table, straight in ln C against ln q between its points and 0 outside of them.
class TabulatedSpectrum final : public IsotropicSpectrum {
 public:
  /// wavenumbers   > 0, increasing, rad/m;   densities   > 0, m⁴
  /// Throws InvalidInput for fewer than two points or if they are not as said, naming the row.
  TabulatedSpectrum(std::vector<double> wavenumbers, std::vector<double> densities);

  double radial_density(double q) const override;
  double highest_wavenumber() const override { return wavenumbers_.back(); }
  SpectralMoments moments() const override;  ///< closed form
  std::string description() const override;

 private:
  std::vector<double> wavenumbers_, densities_;
};

/// ⟨h(0)h(r)⟩ = rms_height² exp(−r²/ℓ²): C = rms_height² ℓ²/(4π) exp(−q²ℓ²/4), cut off where it has
/// fallen by e³⁶.
FunctionSpectrum gaussian_correlation_spectrum(double rms_height, double correlation_length);

/// ⟨h(0)h(r)⟩ = rms_height² exp(−r/ℓ): C ∝ (1 + q²ℓ²)^{−3/2}, a self-affine spectrum of Hurst
/// exponent 1/2 with a smooth roll-off. Its slope grows without limit with the shortest wavelength,
/// hence short_cutoff, and C is scaled so that what is left has the rms height asked.
FunctionSpectrum exponential_correlation_spectrum(double rms_height, double correlation_length,
                                                  double short_cutoff);

}  // namespace salebra
