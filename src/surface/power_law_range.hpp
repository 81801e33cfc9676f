// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <salebra/surface/spectrum.hpp>
#include <span>

namespace salebra::detail {

/// Mean of the powers of modes of neighbouring wave numbers.
struct SpectrumBin {
  double wavenumber = 0;  ///< mean wave number of the modes, rad/m
  double power = 0;       ///< mean power of the modes
  double modes = 0;       ///< number of independent exponentially distributed powers in the mean
};

/// Power spectral density of a self-affine surface, or of its profiles, at wave number q, relative
/// to its amplitude and smoothed like a spectrum with a window.
using SelfAffineDensity = std::function<double(double q, double hurst, double q_rolloff)>;

/// The most likely power law and the range of bins in which it holds.
struct PowerLawRange {
  std::size_t begin = 0, end = 0;  ///< numbers of the bins; begin == end if no range was found
  IntervalEstimate hurst;
  double q_rolloff = 0;                          ///< rad/m; 0 without a plateau
  double q_rolloff_low = 0, q_rolloff_high = 0;  ///< 95 % limits of q_rolloff, rad/m, if it is seen
  bool rolloff_seen = false;  ///< a likelihood-ratio test at 5 % rejects the law without a plateau
  double amplitude = 0;       ///< factor A of the density
  bool pure = false;          ///< neither floor nor attenuation is significant
  double attenuation = 0;     ///< g q² at the last wave number of the range
  bool found() const { return end > begin; }
  IntervalEstimate rolloff() const;  ///< wavelength, m; NaN unless the roll-off is seen
};

/// Finds the longest range of bins in which the mean power E follows the law
///     E(q) = A·density(q)·exp(−g q²) + floor,      g >= 0, floor >= 0,
/// with an amplitude A. The floor is noise and the power that sampling folds into the range from
/// waves shorter than two cells; g is the attenuation by pixels, lenses and tips. Floor and g are
/// not known, so both are fitted, as is the roll-off. The interval of the Hurst exponent comes from
/// a likelihood-ratio test at 5 % with these parameters free; it also contains the most likely
/// exponent of the range without its shortest half octave. A range counts if its deviance does not
/// exceed the 90 % point of χ². An interval that covers all of 0 … 1 counts as no result.
/// min_span: minimum ratio of the largest to the smallest wave number of a range.
PowerLawRange fit_power_law_range(std::span<const SpectrumBin> bins,
                                  const SelfAffineDensity& density, double min_span);

}  // namespace salebra::detail
