// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>

#include "modes.hpp"

namespace salebra::detail {

/// h(x) = Σ_q a(q) e^{iq·x} on the points of the grid. Same bits for every thread count.
Field synthesise(const Grid2D& grid, const Modes& modes);

}  // namespace salebra::detail
