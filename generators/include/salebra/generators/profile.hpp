// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/generators/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// A periodic line of heights: point k is at x = k·length/n.
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
/// ∞, so that h_rms² = ∫C₁ dq. The mode of wave number i has the mean power C₁(q)·2π/length.
class ProfileSpectrum {
 public:
  virtual ~ProfileSpectrum() = default;
  /// C₁(|q|), m³, for q > 0 in rad/m.
  virtual double density(double q) const = 0;
  /// C₁ vanishes beyond this, rad/m.
  virtual double highest_wavenumber() const = 0;
  /// Returns ∫C₁ dq, ∫q²C₁ dq, ∫q⁴C₁ dq as moments along x; those along y are 0, so rms_slope() is
  /// √⟨h'²⟩.
  virtual SpectralMoments moments() const = 0;
  virtual std::string description() const = 0;

  /// Returns the moments as sums over the modes of a periodic line with this number of points.
  SpectralMoments lattice_moments(Index points, double length) const;
  /// Throws InvalidInput for a shortest wavelength below two steps or above the length.
  void require_carried_by(Index points, double length) const;
};

/// Self-affine profile: C₁ = C0 from q_L to q_r, C0 (q/q_r)^{−(1+2H)} up to q_s. A cut through an
/// isotropic self-affine surface of the same H follows this law between its cut-offs, but not near
/// them. Parameters, limits and errors are those of SelfAffineSpectrum; rms_slope is √⟨h'²⟩.
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

/// Generates a Gaussian random profile, e.g. `filtered_noise_profile(4096, 1e-3, spectrum, 1)`. It
/// is keyed by seed and wave number like filtered_noise, with its own stream of random numbers.
Profile filtered_noise_profile(Index points, double length, const ProfileSpectrum& spectrum,
                               std::uint64_t seed);

/// Generates a profile in which every mode has exactly its target power, like random_phase.
Profile random_phase_profile(Index points, double length, const ProfileSpectrum& spectrum,
                             std::uint64_t seed);

}  // namespace salebra
