// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

namespace salebra::detail {

/// Root mean square of the height differences between opposite edges of a surface, m; a periodic
/// continuation of the surface has cliffs of this height. Collective.
double seam_step(const Surface& surface);

}  // namespace salebra::detail
