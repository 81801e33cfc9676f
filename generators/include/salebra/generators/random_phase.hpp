// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

/// A periodic surface with a given spectrum in which chance decides on phases only:
///     h(x) = Σ_q a(q) e^{iq·x},  a(−q) = a*(q),  |a(q)|² = C(q)·(2π)²/(lx ly) exactly,  a(0) = 0.
/// Every mode has its target power, including those that are their own conjugate (real, of random
/// sign), so that rms height, slope and all moments equal Spectrum::lattice_moments(grid) for each
/// seed. Only nearly Gaussian: heights become normal as the number of modes grows. Its phases are
/// those of filtered_noise of the same seed. Arguments, errors, cost and independence of threads,
/// processes and grid as filtered_noise.
Surface random_phase(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                     const Progress& progress = {}, const Communicator& ranks = {});

}  // namespace salebra
