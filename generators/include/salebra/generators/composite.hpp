// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// Combines two rough sides into one, e.g. `composite_surface(upper, lower)`: h = h₁ + h₂ at each
/// point, where each height is positive out of its own body. The result is periodic if the two
/// surfaces are periodic. The spectra of independent surfaces add, and so do the squares of rms
/// height and slope. Throws InvalidInput unless the grids are equal, and for surfaces distributed
/// over processes.
Surface composite_surface(const Surface& first, const Surface& second);

/// Cuts out nx × ny cells, starting at cell (first_x, first_y), as a non-periodic surface, e.g. to
/// make a generated surface resemble a measured one. On a periodic surface the part may extend
/// across the border. Throws InvalidInput if the part is larger than the surface or, for a
/// non-periodic surface, extends beyond it, or if the surface is distributed over processes.
Surface crop_surface(const Surface& surface, Index first_x, Index first_y, Index nx, Index ny);

}  // namespace salebra
