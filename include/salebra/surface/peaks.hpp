// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A peak as defined by ISO 25178-2: the highest point of a hill.
struct Peak {
  Index ix = 0, iy = 0;
  double height = 0;  ///< m
  double prominence =
      0;  ///< height above the highest saddle that leads to a higher peak, m; infinite for the
          ///< highest peak
  /// −½(∂²h/∂x² + ∂²h/∂y²) by second differences, 1/m.
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

/// Finds the peaks that rise at least `min_prominence` (m, >= 0) above the saddle to a higher one,
/// by Wolf pruning of hills in the order of falling saddles:
///     const std::vector<Peak> peaks = significant_peaks(surface, 1e-9);
/// A point has eight neighbours, with wrap if the surface is periodic. Otherwise border points can
/// be hills but are not listed, because they have no curvature; the same holds for points next to
/// undefined ones. Ties between equal heights are broken by index. Throws InvalidInput for fewer
/// than 3 × 3 points. Cost: three passes and one sort of the saddles; memory for half the heights
/// and 16 bytes per saddle.
std::vector<Peak> significant_peaks(const Surface& surface, double min_prominence);

}  // namespace salebra
