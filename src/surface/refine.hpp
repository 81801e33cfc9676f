// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// Gives the surface on `factor` times as many points along x and y; every point of the coarse grid
/// keeps its place and height. A periodic surface: the trigonometric polynomial through its heights
/// (Fourier interpolation), which adds no waves. Any other, which the contact solver continues
/// periodically: the periodic bicubic spline through its heights. Its overshoot beside the step at
/// the seam is 0.27 of itself one point farther, where that of Fourier interpolation reaches over
/// the whole surface.
/// throws  InvalidInput for factor < 1, undefined points, or more points than memory holds
/// cost    two transforms of the fine grid. A surface may be spread over processes: the first one
///         refines it whole, and each gets its rows
Surface refined(const Surface& surface, Index factor);

}  // namespace salebra
