// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// Generates a periodic Gaussian random surface with a given spectrum by filtering white noise:
///     const Surface surface = filtered_noise(grid, spectrum, 1);
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  ⟨|a(q)|²⟩ = C(q)·(2π)²/(lx ly),  a(0) = 0.
/// Real and imaginary part of the amplitude a(q) are independent normal variables; if a wave (i, j)
/// is its own conjugate on the grid (i = nx/2 or 0 and j = ny/2 or 0), a is real with the same
/// power. The process is exactly Gaussian: rms height and slope fluctuate from seed to seed. a(q)
/// depends only on (seed, i, j). The bits are therefore the same for every number of threads, and
/// two grids of the same size lx × ly have the same heights at common points if the shortest
/// wavelength exceeds two cells of either grid.
/// seed      any value; 0 and 1 are different surfaces
/// progress  called many times a second with the stage "surface"; a stop throws Interrupted
/// communicator     processes that make the surface collectively: each has the rows of
///                  Surface::partition(), with the same bits for any number of processes. A stop or
///                  failure of one process is thrown in all processes
/// throws    InvalidInput if the grid cannot represent the spectrum (Spectrum::require_carried_by)
/// cost      less than one real FFT of the grid; memory: generation_memory(grid, communicator)
Surface filtered_noise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                       const Progress& progress = {}, const Communicator& communicator = {});

}  // namespace salebra
