// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <salebra/surface/spectrum.hpp>
#include <span>

namespace salebra::detail {

/// A mean of powers over neighbouring wave numbers.
struct SpectrumBin {
  double wavenumber = 0;  ///< mean, rad/m
  double power = 0;       ///< mean
  double modes = 0;       ///< independent exponential powers in it
};

/// Power spectral density of a self-affine surface over its plateau, or that of its profiles, as
/// the window sees it.
using SelfAffineDensity = std::function<double(double q, double hurst, double q_rolloff)>;

/// The most likely law of a range of bins.
struct PowerLawRange {
  std::size_t begin = 0, end = 0;  ///< the bins; none where begin == end
  IntervalEstimate hurst;
  double q_rolloff = 0;       ///< rad/m; 0 without a plateau
  bool rolloff_seen = false;  ///< a law without a plateau is less likely by more than 5 % allow
  double amplitude = 0;       ///< of the density
  bool found() const { return end > begin; }
};

/// Fits, over the longest range of bins that it describes,
///     E(q) = A·density(q)·exp(−g q²) + floor,      g >= 0, floor >= 0.
/// The floor is what the points fold into the range from waves shorter than two cells, and noise; g
/// is what pixels, lenses and tips take away. Neither is known, hence neither is held: the interval
/// of H is that of a likelihood-ratio test at 5 % in which they are free, as is the roll-off, and
/// holds the most likely H of the range without its shortest half octave. A range counts if its deviance
/// is not above the 90 % point. An interval that holds all of 0 … 1 is none.
/// min_span: the least ratio of the wave numbers of a range.
PowerLawRange fit_power_law_range(std::span<const SpectrumBin> bins,
                                  const SelfAffineDensity& density, double min_span);

}  // namespace salebra::detail
