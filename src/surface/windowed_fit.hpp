// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/spectrum.hpp>

#include "surface/power_law_range.hpp"

namespace salebra::detail {

/// The law of a surface that is not periodic.
struct WindowedFit {
  HurstEstimate hurst;
  IntervalEstimate rolloff;  ///< wavelength, m; NaN unless a plateau is seen
};

/// Fits the law that estimate_hurst() describes to a spectrum with a window. Collective.
WindowedFit fit_windowed(const PowerSpectrum& spectrum, double shortest_wavelength);

}  // namespace salebra::detail
