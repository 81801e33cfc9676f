// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// Generates a periodic surface with a given spectrum in which only the phases are random:
///     const Surface surface = random_phase(grid, spectrum, 1);
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  |a(q)|² = C(q)·(2π)²/(lx ly) exactly,  a(0) = 0.
/// Every mode has exactly its target power, including modes that are their own conjugate (their
/// amplitude is real with a random sign), so rms height, slope and all moments equal
/// Spectrum::lattice_moments(grid) for each seed. The surface is only nearly Gaussian: the
/// distribution of heights becomes normal as the number of modes grows. The phases are those of
/// filtered_noise with the same seed. Arguments, errors and cost are those of filtered_noise, and
/// so is the independence of threads, processes and grid.
Surface random_phase(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                     const Progress& progress = {}, const Communicator& communicator = {});

}  // namespace salebra
