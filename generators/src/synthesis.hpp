// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/base/progress.hpp>

#include "modes.hpp"

namespace salebra::detail {

/// Heights h(x) = Σ_q a(q) e^{iq·x} on the points x of the grid, with the amplitudes a(q) of
/// RandomModes. Returns the rows of this process, with the same bits for every number of threads
/// and processes. progress: reports like filtered_noise().
Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance,
                 const Progress& progress, const Communicator& communicator);

}  // namespace salebra::detail
