// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/base/progress.hpp>

#include "modes.hpp"

namespace salebra::detail {

/// h(x) = Σ_q a(q) e^{iq·x} on the points of the grid with the amplitudes of RandomModes. Same bits for every thread count.
/// progress as of filtered_noise.
Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance,
                 const Progress& progress);

}  // namespace salebra::detail
