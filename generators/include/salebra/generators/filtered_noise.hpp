// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// A periodic Gaussian random surface with a given spectrum, by filtering white noise:
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  ⟨|a(q)|²⟩ = C(q)·(2π)²/(lx ly),  a(0) = 0,
/// with real and imaginary part of a(q) independent normal variables; where a wave is its own
/// conjugate on the grid (i = nx/2 or 0 and j = ny/2 or 0), a is real and has the same power. An
/// exact Gaussian process: rms height and slope fluctuate from seed to seed. a(q) is keyed by
/// (seed, i, j), so that a surface has the same bits for every thread count, and, as long as the
/// shortest wavelength exceeds two cells, the same heights at the common points of two grids on the
/// same cell.
/// seed      any value; 0 and 1 are different surfaces
/// progress  "surface", many times a second; a stop throws Interrupted
/// ranks     the processes that make the surface together, collectively: each has the rows of
///           Surface::share(), with the same bits for every number of them. A stop or a failure of
///           one process is thrown on all
/// throws    InvalidInput if the grid does not carry the spectrum (Spectrum::require_carried_by)
/// cost      less than one real FFT of the grid; memory as generation_memory(grid, ranks)
Surface filtered_noise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                       const Progress& progress = {}, const Communicator& ranks = {});

}  // namespace salebra
