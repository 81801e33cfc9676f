// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/twin.hpp>
#include <vector>

#include "surface/twin_bins.hpp"

namespace salebra::twin_detail {

/// Skewness and kurtosis of the heights of a surface.
struct HeightShape {
  double skewness = 0, kurtosis = 3;
};

struct FoundHeights {
  bool gaussian = true;            ///< whether Gaussian heights explain the scans (99 %)
  HeightShape best;                ///< of Johnson's distribution that explains the scans
  std::vector<HeightShape> draws;  ///< from the distribution of their errors
};

/// Finds the skewness and kurtosis of a surface of a known spectrum by those of its largest scans.
/// A scan lacks the waves longer than itself, which are levelled, and shows few hills, so that its
/// own numbers are both wrong and uncertain. What scans of a surface with given numbers show is
/// therefore simulated: patches of Gaussian fields z of the spectrum, with waves longer than the
/// patch, are transformed by Johnson's g(z) and levelled. The numbers at which patches have, in the
/// mean, the third and fourth moments of the scans are the estimate, and the scatter of as many
/// patches as there are scans gives its errors.
/// spectrum   of the heights across the lay
/// lay        of the surface
/// Cost: about a second.
FoundHeights heights_of(const std::vector<ScanSpectrum>& scans, const std::vector<bool>& left_out,
                        const SpectrumTable& spectrum, const Lay& lay, Index draws,
                        std::uint64_t seed);

}  // namespace salebra::twin_detail
