// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/generators/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// A periodic line of n heights: point k, counted from 0, is at x = k·length/n.
struct Profile {
  double length = 0;            ///< m
  std::vector<double> heights;  ///< m
  std::string origin;           ///< for provenance

  double dx() const { return length / static_cast<double>(heights.size()); }
};

constexpr void describe(auto&& visit, std::type_identity<Profile>) {
  using S = Profile;
  visit(&S::length, Kept{"length", "period", Dimension::length});
  visit(&S::heights, Kept{"heights", "height, positive out of the material", Dimension::length});
  visit(&S::origin, Kept{"origin", "generator with its seed"});
  visit(&S::dx, Kept{"dx", "from one point to the next", Dimension::length});
}

/// Power spectral density of a random profile, C₁(q) = (2π)⁻¹ ∫⟨h(0)h(x)⟩ e^{−iqx} dx for −∞ < q <
/// ∞, so that h_rms² = ∫C₁ dq. On a periodic line, the mode with i waves, q = 2πi/length, has the
/// mean power C₁(q)·2π/length.
class ProfileSpectrum {
 public:
  virtual ~ProfileSpectrum() = default;
  /// C₁(|q|), m³, for q > 0 in rad/m.
  virtual double density(double q) const = 0;
  /// Wave number, rad/m, above which C₁ is 0.
  virtual double highest_wavenumber() const = 0;
  /// Returns ∫C₁ dq, ∫q²C₁ dq and ∫q⁴C₁ dq as moment0, moment2_x and moment4_x; the moments along y
  /// are 0, so that rms_slope() is √⟨h'²⟩ of the profile.
  virtual SpectralMoments moments() const = 0;
  /// One line for provenance.
  virtual std::string description() const = 0;

  /// Returns the moments as sums over the modes of a periodic line with this number of points and
  /// this length, m.
  SpectralMoments lattice_moments(Index points, double length) const;
  /// Throws InvalidInput if the shortest wavelength of the spectrum is below two point spacings or
  /// above the length of the line.
  void require_carried_by(Index points, double length) const;
};

/// Self-affine profile: C₁ = C0 for q_L <= q < q_r, and C₁ = C0 (q/q_r)^{−(1+2H)} for q_r <= q <=
/// q_s, with the wave numbers q = 2π/λ of SelfAffineParameters. A cut through an isotropic
/// self-affine surface of the same Hurst exponent H follows this law between q_r and q_s, but not
/// near these limits. Parameters, limits and errors are those of SelfAffineSpectrum; rms_slope is
/// √⟨h'²⟩ of the profile.
class SelfAffineProfileSpectrum final : public ProfileSpectrum {
 public:
  explicit SelfAffineProfileSpectrum(const SelfAffineParameters& parameters);
  double density(double q) const override;
  double highest_wavenumber() const override { return q_short_; }
  SpectralMoments moments() const override;
  std::string description() const override;

 private:
  double unscaled_integral(int order) const;

  SelfAffineParameters parameters_;
  double q_long_, q_rolloff_, q_short_;
  double plateau_;
};

/// Generates a Gaussian random profile, e.g. `filtered_noise_profile(4096, 1e-3, spectrum, 1)`. As
/// in filtered_noise, the amplitude of a mode depends only on the seed and the wave number;
/// profiles use other random numbers than surfaces.
Profile filtered_noise_profile(Index points, double length, const ProfileSpectrum& spectrum,
                               std::uint64_t seed);

/// Generates a profile in which every mode has exactly its target power, like random_phase.
Profile random_phase_profile(Index points, double length, const ProfileSpectrum& spectrum,
                             std::uint64_t seed);

}  // namespace salebra
