// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/spectral_moments.hpp>
#include <span>
#include <string>

namespace salebra {

/// Power spectral density of a random surface,
///     C(q) = (2π)⁻² ∫⟨h(0)h(x)⟩ e^{−iq·x} d²x,   so that h_rms² = ∫C d²q.
/// On a grid of size lx × ly, the mode of wave vector (i, j), q = 2π(i/lx, j/ly), has the mean
/// power C(q)·(2π)²/(lx ly).
class Spectrum {
 public:
  virtual ~Spectrum() = default;

  /// C(q), m⁴; q_x, q_y in rad/m. C must be even, C(−q) = C(q). It is never evaluated at q = 0,
  /// because a generated surface has zero mean.
  virtual double density(double qx, double qy) const = 0;
  /// Sets densities[k] = density((first + k)·step_x, qy) for all k, i.e. for a row of wave vectors;
  /// the value at wave vector 0 is arbitrary. Generators call this function; an override may be
  /// faster, but must agree with density() within rounding.
  virtual void density_row(Index first, double step_x, double qy,
                           std::span<double> densities) const;
  /// Wave number |q|, rad/m, above which C is 0.
  virtual double highest_wavenumber() const = 0;
  /// Moments of the spectrum without a grid: m0 = ∫C d²q, m2_x = ∫q_x²C d²q, m4_x = ∫q_x⁴C d²q.
  virtual SpectralMoments moments() const = 0;
  /// One line for provenance.
  virtual std::string description() const = 0;

  /// Returns the mean moments of surfaces on this grid: the integrals of moments() as sums over the
  /// modes of the grid, without the zero mode; a mode on a Nyquist line is counted once. progress
  /// has the stage "moments"; a stop throws Interrupted. communicator: processes that compute the
  /// sum collectively; the bits are the same for any number of processes. Throws wherever
  /// require_carried_by does. Cost: one evaluation of C for each pair of modes within
  /// highest_wavenumber.
  SpectralMoments lattice_moments(const Grid2D& grid, const Progress& progress = {},
                                  const Communicator& communicator = {}) const;

  /// Throws InvalidInput if the grid cannot represent the spectrum: if its cells are larger than
  /// half the shortest wavelength, so that short waves would be aliased, or if the shortest
  /// wavelength is longer than the surface.
  void require_carried_by(const Grid2D& grid) const;
};

/// A spectrum that depends only on |q|.
class IsotropicSpectrum : public Spectrum {
 public:
  /// C(|q|), m⁴, for |q| > 0 in rad/m.
  virtual double radial_density(double q) const = 0;
  double density(double qx, double qy) const final;
};

/// Parameters of a self-affine spectrum. Wavelengths are λ = 2π/q, m.
struct SelfAffineParameters {
  double hurst = 0.8;  ///< H, 0 < H <= 1
  /// Longest wavelength λ_L; empty: no limit, every wave that fits into the surface.
  std::optional<double> long_cutoff = {};
  std::optional<double> rolloff = {};     ///< λ_r <= λ_L; empty: λ_L, that is, no plateau
  double short_cutoff = 0;                ///< λ_s, 0 < λ_s <= λ_r
  std::optional<double> rms_height = {};  ///< m; give either rms_height or rms_slope
  std::optional<double> rms_slope = {};   ///< √⟨|∇h|²⟩
};

constexpr void describe(auto&& visit, std::type_identity<SelfAffineParameters>) {
  using enum Dimension;
  using S = SelfAffineParameters;
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::long_cutoff, Quantity{"long_cutoff", length, "longest wavelength"});
  visit(&S::rolloff, Quantity{"rolloff", length, "roll-off wavelength"});
  visit(&S::short_cutoff, Quantity{"short_cutoff", length, "shortest wavelength"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
}

/// Self-affine spectrum with a plateau:
///     const SelfAffineSpectrum spectrum({.hurst = 0.8, .rolloff = 2e-5, .short_cutoff = 1e-6,
///                                        .rms_height = 1e-7});
///     C = C0                        q_L <= q < q_r
///     C = C0 (q/q_r)^{−2(1+H)}      q_r <= q <= q_s
///     C = 0                         elsewhere.
/// with the wave numbers q = 2π/λ of SelfAffineParameters. C0 is chosen so that moments(), i.e. the
/// integrals over the spectrum *without a grid*, have the requested rms height (or slope). C0 does
/// not depend on the grid, so long waves are the same at every resolution. lattice_moments(grid)
/// gives the moments on a particular grid, on which some of the longest waves are missing or
/// counted in full. A wave exactly at a limit belongs to the spectrum, within a relative tolerance
/// of 1e-9 for the rounding of 2π/λ.
class SelfAffineSpectrum final : public IsotropicSpectrum {
 public:
  /// Throws InvalidInput, whose message names the parameter, unless 0 < H <= 1, λ_L >= λ_r >= λ_s >
  /// 0, λ_L or λ_r is given, and exactly one of rms_height and rms_slope is given and > 0. Also
  /// requires λ_L > λ_s or a plateau, because a spectrum of zero width has no power.
  explicit SelfAffineSpectrum(const SelfAffineParameters& parameters);

  double radial_density(double q) const override;
  void density_row(Index first, double step_x, double qy,
                   std::span<double> densities) const override;
  double highest_wavenumber() const override { return q_short_; }
  /// Moments in closed form, valid for all H up to and including H = 1.
  SpectralMoments moments() const override;
  std::string description() const override;

  const SelfAffineParameters& parameters() const { return parameters_; }
  double plateau() const { return plateau_; }  ///< C0, m⁴

 private:
  /// Returns ∫ q^order C/C0 d²q in closed form.
  double unscaled_integral(int order) const;

  SelfAffineParameters parameters_;
  double q_long_ = 0, q_rolloff_ = 0, q_short_ = 0;  // rad/m
  double plateau_ = 0;
};

}  // namespace salebra
