// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra {

/// Returns the surface on `factor` times as many points along x and y; every point of the coarse
/// grid keeps its position and height. A periodic surface is interpolated by the trigonometric
/// polynomial through its heights (Fourier interpolation), which adds no waves. For any other
/// surface, which the contact solver continues periodically, the periodic bicubic spline is used.
/// The overshoot of the spline at the step between opposite edges shrinks by the factor 0.27 from
/// each point to the next; the overshoot of Fourier interpolation would reach over the whole
/// surface.
/// throws  InvalidInput for factor < 1, undefined points, or more points than memory holds
/// cost    two transforms of the fine grid. If the surface is spread over processes, the first
///         process refines all of it and sends each process its rows
Surface refined(const Surface& surface, Index factor);

}  // namespace salebra
