// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/generators/spectrum.hpp>
#include <vector>

namespace salebra {

/// Isotropic spectrum given by a function C(|q|) between two wave numbers; outside it is 0:
///     const FunctionSpectrum cubic([](double q) { return 1e-2 / (q * q * q); }, 1e6, 1e8, "q^-3");
class FunctionSpectrum final : public IsotropicSpectrum {
 public:
  /// density   C(q) >= 0 in m⁴ for lowest <= q <= highest, rad/m; called from several threads at
  ///           once
  /// lowest    >= 0; 0 includes all long waves that fit into the surface
  /// name      for provenance
  /// Throws InvalidInput unless 0 <= lowest < highest, and if the density is negative or not finite
  /// at a wave number where it is evaluated. The constructor integrates the moments by adaptive
  /// Simpson's rule, with a relative error of about 1e-10 for a smooth function.
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

/// Isotropic spectrum given by a table: ln C is linear over ln q between the points of the table,
/// and C is 0 outside.
class TabulatedSpectrum final : public IsotropicSpectrum {
 public:
  /// wavenumbers   > 0, increasing, rad/m;   densities   > 0, m⁴
  /// Throws InvalidInput, whose message names the row, if these conditions are violated, and for
  /// fewer than two points.
  TabulatedSpectrum(std::vector<double> wavenumbers, std::vector<double> densities);

  double radial_density(double q) const override;
  double highest_wavenumber() const override { return wavenumbers_.back(); }
  SpectralMoments moments() const override;  ///< closed form
  std::string description() const override;

 private:
  std::vector<double> wavenumbers_, densities_;
};

/// Spectrum of a Gaussian correlation ⟨h(0)h(r)⟩ = rms_height² exp(−r²/ℓ²): C = rms_height² ℓ²/(4π)
/// exp(−q²ℓ²/4) with ℓ = correlation_length, m; C is cut off where it has fallen by a factor of
/// e³⁶.
FunctionSpectrum gaussian_correlation_spectrum(double rms_height, double correlation_length);

/// Spectrum of an exponential correlation ⟨h(0)h(r)⟩ = rms_height² exp(−r/ℓ): C ∝ (1 +
/// q²ℓ²)^{−3/2}, i.e. self-affine with Hurst exponent 1/2 and a smooth roll-off; ℓ =
/// correlation_length, m. Without a shortest wavelength the rms slope would be infinite, so
/// short_cutoff, m, is required; C is scaled so that the spectrum up to this cut-off has the
/// requested rms height.
FunctionSpectrum exponential_correlation_spectrum(double rms_height, double correlation_length,
                                                  double short_cutoff);

}  // namespace salebra
