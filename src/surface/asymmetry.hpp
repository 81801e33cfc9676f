// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra::detail {

/// Wavelength up to which the peaks and valleys of a non-periodic surface differ, m. The tip of an
/// instrument makes them differ: it rounds peaks and leaves cusps in valleys. For self-affine
/// Gaussian heights h, positive and negative second differences h(x+s) − 2h(x) + h(x−s) are equally
/// frequent. The function tests the third moment of these differences at all distances s along x
/// and y. The moment is a mean over 36 parts of the surface, and its error comes from the scatter
/// between the parts, because nearby differences are correlated. The result is 4s for the longest s
/// at which the moment differs from zero (Student's t > 4), 0 if there is no such s, and infinity
/// if that s is the longest that fits twice into a part. Collective. Throws nothing of its own.
/// Cost: one pass over memory for each axis.
double asymmetric_wavelength(const Surface& surface);

}  // namespace salebra::detail
