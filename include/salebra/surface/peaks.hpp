// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A peak as defined by ISO 25178-2: the highest point of a hill.
struct Peak {
  Index ix = 0, iy = 0;  ///< grid indices of the point
  double height = 0;     ///< m
  /// Height above the highest saddle on a path to a higher peak, m; infinite for the highest peak.
  double prominence = 0;
  /// Mean curvature −½(∂²h/∂x² + ∂²h/∂y²) by second differences, 1/m.
  double mean_curvature = 0;
};

constexpr void describe(auto&& visit, std::type_identity<Peak>) {
  using enum Dimension;
  using S = Peak;
  visit(&S::ix, Kept{"ix", "place along x"});
  visit(&S::iy, Kept{"iy", "place along y"});
  visit(&S::height, Kept{"height", "height", length});
  visit(&S::prominence,
        Kept{"prominence", "height above the highest saddle that leads to a higher peak", length});
  visit(&S::mean_curvature, Kept{"mean_curvature", "mean curvature", inverse_length});
}

/// Finds the peaks with a prominence of at least `min_prominence` (m, >= 0), by Wolf pruning: hills
/// are merged at their saddles, from the highest saddle down:
///     const std::vector<Peak> peaks = significant_peaks(surface, 1e-9);
/// A point has eight neighbours, across the border too if the surface is periodic. If it is not
/// periodic, peaks on the border take part in the merging but are not listed, because their
/// curvature is unknown; the same holds for peaks next to undefined points. Of two equal heights,
/// the index decides which counts as higher. Throws InvalidInput for fewer than 3 × 3 points. Cost:
/// three passes over the heights and one sort of the saddles; memory for half as many numbers as
/// heights, and 16 bytes per saddle.
std::vector<Peak> significant_peaks(const Surface& surface, double min_prominence);

}  // namespace salebra
