// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// Generates a periodic Gaussian random surface with a given spectrum by filtering white noise:
///     const Surface surface = filtered_noise(grid, spectrum, 1);
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  ⟨|a(q)|²⟩ = C(q)·(2π)²/(lx ly),  a(0) = 0.
/// Real and imaginary part of a(q) are independent normal variables; if a wave is its own conjugate
/// on the grid (i = nx/2 or 0 and j = ny/2 or 0), a is real with the same power. The process is
/// exactly Gaussian: rms height and slope fluctuate from seed to seed. a(q) is keyed by (seed, i,
/// j): the bits are the same for every thread count, and two grids on the same cell have the same
/// heights at common points if the shortest wavelength exceeds two cells.
/// seed      any value; 0 and 1 are different surfaces
/// progress  stage "surface", many times a second; a stop throws Interrupted
/// ranks     processes that make the surface collectively: each has the rows of Surface::share(),
///           with the same bits for any number of processes. A stop or failure of one is thrown on
///           all
/// throws    InvalidInput if the grid does not carry the spectrum (Spectrum::require_carried_by)
/// cost      less than one real FFT of the grid; memory as generation_memory(grid, ranks)
Surface filtered_noise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                       const Progress& progress = {}, const Communicator& communicator = {});

}  // namespace salebra
