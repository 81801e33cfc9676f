// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/surface/scan_spectrum.hpp>
#include <vector>

/// Bins of the spectrum of a scan in modes κ = qL/2π, with wave number q and side L of the scan.
/// Measured and expected spectra have the same bins.
namespace salebra::twin_detail {

constexpr double hann_from = 12;       ///< bins from this κ on use a Hann window
constexpr double response_below = 36;  ///< bins below this κ average the window's full response
constexpr Index drift_modes = 2;       ///< drift of lines spoils the modes with |k_x| up to this

/// Limits κ of all bins up to the Nyquist mode: 0.5 to 8.5 in steps of 1, then in the ratio 1.15.
std::vector<double> bin_limits(double nyquist);

/// tapered_bins(): number of bins that use the sine tapers. response_bins(): number of bins whose
/// expected power comes from the full response of the window.
std::size_t tapered_bins(const std::vector<double>& limits);
std::size_t response_bins(const std::vector<double>& limits);

/// The modes of a scan: mode (i, j) has κ² = (i·step_x)² + (j·step_y)².
struct ScanModes {
  explicit ScanModes(const Grid2D& grid);

  double side;            ///< length L for which κ = qL/2π, m
  double step_x, step_y;  ///< step_y is 0 for a profile
  double nyquist;         ///< κ of the Nyquist mode, the smaller of the two axes

  double wavenumber(double kappa) const;  ///< rad/m
};

/// Tapers at the centres ξ of n cells in −½ < ξ < ½: √2 sin(πk(ξ+½)) for k = 1 or 2, and √(8/3)
/// cos²(πξ).
std::vector<double> sine_taper(Index n, int k);
std::vector<double> hann_taper(Index n);

}  // namespace salebra::twin_detail
