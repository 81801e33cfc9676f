// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis.hpp"

#include <salebra/base/column_fft.hpp>

namespace salebra::detail {

Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance) {
  const CarriedModes carried(grid, spectrum);
  const RandomModes modes(carried, seed, chance);
  return backward_by_columns(
      grid.nx, grid.ny, carried.j_max() + 1,
      [&modes](Index j, std::span<std::complex<double>> column) { modes.column(j, column); });
}

}  // namespace salebra::detail
