// SPDX-License-Identifier: GPL-3.0-or-later
// Heights from random modes by inverse transform, after a check of the memory.
#include "synthesis.hpp"

#include "base/column_fft.hpp"
#include "base/memory.hpp"

namespace salebra::detail {

Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance,
                 const Progress& progress, const Communicator& ranks) {
  const CarriedModes carried(grid, spectrum);
  const Share rows(ranks, grid.nx);
  require_memory(grid, double(column_fft_memory(grid.nx, grid.ny, rows)), "a surface", ranks);
  const RandomModes modes(carried, seed, chance);
  return backward_by_columns(
      grid.nx, grid.ny, carried.j_max() + 1,
      [&modes](Index j, std::span<std::complex<double>> column) { modes.column(j, column); },
      progress, rows);
}

}  // namespace salebra::detail
