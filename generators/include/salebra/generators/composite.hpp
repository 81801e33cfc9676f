// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// The one rough side that stands for two: h = h₁ + h₂, each height counted out of its own body, on
/// common points. Periodic if both are. Two independent surfaces add their spectra, hence their
/// squares of rms height and slope.
/// Throws InvalidInput unless the grids are the same, and for surfaces that are spread over
/// processes.
Surface composite_surface(const Surface& first, const Surface& second);

/// The part of nx × ny cells from (first_x, first_y) on, as a surface that is not periodic: a
/// generated surface without the periodicity that no measured one has. Of a periodic surface the
/// part may reach over its edge. Throws InvalidInput if the part is larger than the surface or,
/// where it is not periodic, reaches beyond it, or if the surface is spread over processes.
Surface crop_surface(const Surface& surface, Index first_x, Index first_y, Index nx, Index ny);

}  // namespace salebra
