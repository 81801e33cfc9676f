// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/spectrum.hpp>
#include <utility>
#include <vector>

#include "surface/power_law_range.hpp"

namespace salebra::detail {

/// Spectrum of profiles under a window, which mixes the powers of neighbouring waves: pairs of a
/// displacement of the wave number, rad/m, and its share; the shares add up to 1.
using WaveMixing = std::vector<std::pair<double, double>>;

/// The law of the profiles of a self-affine surface, and its end.
struct ProfileLaw : PowerLawRange {
  static constexpr double endless = 1e300;
  double q_short = endless;  ///< wave number where the power ends, rad/m
  /// Limits of q_short by the width of the bins; NaN without an end.
  double q_short_low = IntervalEstimate::unknown, q_short_high = IntervalEstimate::unknown;
};

/// Powers of the profiles along a direction, rad from the x axis: C₁ in strips of wave vectors at
/// right angles to it, from `lowest` on, rad/m. modes: independent powers of a strip. Collective.
std::vector<SpectrumBin> profile_bins(const PowerSpectrum& spectrum, double direction,
                                      double lowest);

/// Fits A·C₁(q)·exp(−g q²) + floor, with C₁ of profile_density(), to the powers of profiles below
/// `highest`, rad/m. If the power ends within the bins, waves beyond that end are missing from C₁.
ProfileLaw fit_profile_law(const std::vector<SpectrumBin>& bins, double highest,
                           const WaveMixing& mixing);

}  // namespace salebra::detail
