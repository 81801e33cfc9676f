// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// Generates a periodic surface with a given spectrum in which only the phases are random:
///     const Surface surface = random_phase(grid, spectrum, 1);
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  |a(q)|² = C(q)·(2π)²/(lx ly) exactly,  a(0) = 0.
/// Every mode has its target power, including those that are their own conjugate (real, with random
/// sign), so rms height, slope and all moments equal Spectrum::lattice_moments(grid) for each seed.
/// The surface is only nearly Gaussian: heights become normal as the number of modes grows. Its
/// phases are those of filtered_noise with the same seed, and so are arguments, errors, cost and
/// independence of threads, processes and grid.
Surface random_phase(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                     const Progress& progress = {}, const Communicator& communicator = {});

}  // namespace salebra
