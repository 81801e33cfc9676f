// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// The undefined points of a surface.
struct Holes {
  Index points = 0;     ///< number of undefined points
  double fraction = 0;  ///< fraction of all points
  double width = 0;     ///< m, side of the largest square in which no point is defined
  /// `width` over the side of the surface, along the axis where this ratio is larger.
  double widest_share = 0;

  /// True if at most 5 % of the points are undefined and no hole is wider than a tenth of the
  /// surface: filled() then hardly changes how the surface carries load.
  bool few() const { return fraction <= 0.05 && widest_share <= 0.1; }
};

/// Measures the undefined points, e.g. to check `holes_of(surface).few()` before filling them.
/// Cost: one pass over the heights.
Holes holes_of(const Surface& surface);

/// Fills undefined points with the smoothest heights that fit, e.g. `filled(std::move(surface))`.
/// The filled heights h solve the discrete Laplace equation, summed over the neighbours that exist,
/// with the defined heights fixed:
///     Σ (h_neighbour − h)/dx² + Σ (h_neighbour − h)/dy² = 0.
/// Inside a plane, holes are filled exactly; no filled point is higher or lower than all points
/// around its hole; at the border of the surface the slope across the border is zero. Filled
/// regions are too smooth: they have no summits and reduce the power of short waves, so check the
/// number of undefined points first. A complete surface is returned unchanged. Throws InvalidInput
/// if no height is defined. Cost: one sparse Cholesky factorisation for the undefined points.
Surface filled(Surface surface);

}  // namespace salebra
