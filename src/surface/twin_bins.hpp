// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/surface/scan_spectrum.hpp>
#include <vector>

/// Bins, in modes κ = qL/2π of a scan, that measured and expected periodograms share.
namespace salebra::twin_detail {

constexpr double hann_from = 12;       ///< lower limit of the bins that have a Hann window
constexpr double response_below = 36;  ///< bins whose mean over the window's response is computed
constexpr Index drift_modes = 2;       ///< |k_x| up to which drift of lines spoils the modes

/// κ of the limits of all bins up to the Nyquist mode: 0.5, 1.5, …, 8.5, then in the ratio 1.15.
std::vector<double> bin_limits(double nyquist);

/// Bins that use the tapers, and bins with the full response, of those limits.
std::size_t tapered_bins(const std::vector<double>& limits);
std::size_t response_bins(const std::vector<double>& limits);

/// A scan in modes: mode (i, j) has κ² = (i·step_x)² + (j·step_y)².
struct ScanModes {
  explicit ScanModes(const Grid2D& grid);

  double side;            ///< L, m
  double step_x, step_y;  ///< step_y is 0 for a profile
  double nyquist;         ///< the lower one

  double wavenumber(double kappa) const;  ///< rad/m
};

/// √2 sin(πk(ξ+½)), k = 1, 2, and √(8/3) cos²(πξ) at the centres of n cells in −½ < ξ < ½.
std::vector<double> sine_taper(Index n, int k);
std::vector<double> hann_taper(Index n);

}  // namespace salebra::twin_detail
