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

/// Greatest κ along an axis of the modes whose powers under the sine tapers a scan keeps: enough for
/// the tapered bins of a lay of 10 to 1.
constexpr double max_tapered_mode = 42;

/// Number of modes > 0 along an axis with so many points whose powers under the sine tapers a scan
/// keeps; step: κ of one mode.
Index tapered_modes(Index points, double step);

/// Limits κ of all bins up to the Nyquist mode: 0.5 to 8.5 in steps of 1, then in the ratio 1.15.
std::vector<double> bin_limits(double nyquist);

/// tapered_bins(): number of bins that use the sine tapers. response_bins(): number of bins whose
/// expected power comes from the full response of the window.
std::size_t tapered_bins(const std::vector<double>& limits);
std::size_t response_bins(const std::vector<double>& limits);

/// Elliptic wave numbers (u_across, u_along) = (q_across/√s, √s q_along) of a surface with a lay,
/// of the same area as wave numbers q, so that the modes of a scan are as dense.
struct Lay {
  double stretch = 1;  ///< s >= 1
  double angle = 0;    ///< from the x axis to the lay, rad

  struct Vector {
    double across, along;
  };
  Vector elliptic(double x, double y) const;
  /// ln of the mean of exp(−v q²) over the directions of the elliptic wave number u, and its
  /// derivative with respect to ln v.
  double log_blur(double v, double u_square) const;
  double log_blur_slope(double v, double u_square) const;
};

/// The modes of a scan: mode (i, j) has κ² = (i·step_x)² + (j·step_y)².
struct ScanModes {
  explicit ScanModes(const Grid2D& grid, const Lay& lay = {});

  double side;            ///< length L for which κ = qL/2π, m
  double step_x, step_y;  ///< step_y is 0 for a profile
  /// κ of the Nyquist mode, the smaller of the two axes; with a lay, of the greatest elliptic ring
  /// between the Nyquist modes.
  double nyquist;

  double wavenumber(double kappa) const;  ///< rad/m
};

/// Tapers at the centres ξ of n cells in −½ < ξ < ½: √2 sin(πk(ξ+½)) for k = 1 or 2, and √(8/3)
/// cos²(πξ).
std::vector<double> sine_taper(Index n, int k);
std::vector<double> hann_taper(Index n);

}  // namespace salebra::twin_detail
