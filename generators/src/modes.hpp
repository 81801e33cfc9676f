// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstdint>
#include <salebra/generators/spectrum.hpp>
#include <span>

namespace salebra::detail {

/// Modes of a grid that a spectrum can fill: |i| <= i_max, 0 <= j <= j_max, the other half being conjugate.
struct CarriedModes {
  Index i_max = 0;
  Index j_max = 0;
};
CarriedModes carried_modes(const Grid2D& grid, const Spectrum& spectrum);

/// What chance decides: the whole complex amplitude, or its phase alone.
enum class Chance { gaussian_amplitude, phase };

/// Amplitudes a(i, j) of one surface, a real field's Fourier coefficients: h(x) = Σ a(q) e^{iq·x}.
class Modes {
 public:
  /// The spectrum must outlive the object. Throws as Spectrum::require_carried_by.
  Modes(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance);

  Index j_max() const { return carried_.j_max; }
  /// column[i mod nx] = a(i, j) for all i, zeros included; 0 <= j <= j_max, nx entries.
  void column(Index j, std::span<std::complex<double>> column) const;

 private:
  void draw(Index i, Index j, std::span<std::complex<double>> factors) const;
  double amplitude(Index i, Index j) const;
  std::complex<double> real_mode(Index i, Index j) const;

  Grid2D grid_;
  const Spectrum& spectrum_;
  CarriedModes carried_;
  std::uint64_t seed_;
  Chance chance_;
};

}  // namespace salebra::detail
