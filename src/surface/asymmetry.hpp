// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra::detail {

/// Wavelength up to which peaks and valleys of a surface that is not periodic differ, m. A tip makes
/// them differ, since it rounds peaks and leaves cusps in valleys, whereas self-affine Gaussian
/// heights have second differences h(x+s) − 2h(x) + h(x−s) as often of one sign as of the other.
/// The third moment of these differences is tested at all distances s along x and y; its error is
/// that of a mean over 36 parts of the surface, because differences nearby are correlated. The
/// result is 4s for the longest s at which the moment is not zero (t > 4), 0 where there is none,
/// and infinity where that s is the longest that the parts can hold twice.
/// Collective. Throws nothing of its own. Cost: one pass over memory for each axis.
double asymmetric_wavelength(const Surface& surface);

}  // namespace salebra::detail
