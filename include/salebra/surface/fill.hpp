// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// The undefined points of a surface.
struct Holes {
  Index points = 0;
  double fraction = 0;      ///< of all points
  double width = 0;         ///< m, side of the largest square in which no point is defined
  double widest_share = 0;  ///< of that side in the surface, along the axis where it is larger

  /// At most a twentieth of the points, and no hole wider than a tenth of the surface: then what
  /// filled() makes of them hardly changes how the surface carries load.
  bool few() const { return fraction <= 0.05 && widest_share <= 0.1; }
};

/// Cost: one pass.
Holes holes_of(const Surface& surface);

/// The surface with its undefined points filled by the smoothest heights that fit: the discrete
/// Laplace equation
///     Σ (h_neighbour − h)/dx² + Σ (h_neighbour − h)/dy² = 0,
/// over the neighbours that exist, with the defined heights held. Planes are continued exactly, no
/// filled point lies above or below all that surround it, and a hole at the border ends there
/// without slope across it. What is filled is smoother than the surface: it has no summits and
/// takes power from short waves, so count the points first. A complete surface comes back as it is.
/// Throws InvalidInput if no height is defined. Cost: one sparse Cholesky factorisation for the
/// undefined points.
Surface filled(Surface surface);

}  // namespace salebra
