// SPDX-License-Identifier: GPL-3.0-or-later
// Heights from random modes by inverse transform, after a check of the memory.
#include "synthesis.hpp"

#include <salebra/base/column_fft.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <sstream>
#include <string>

namespace salebra::detail {

void require_memory(const Grid2D& grid, std::size_t bytes) {
  const double gigabytes = 1e-9 * static_cast<double>(bytes);
  const double available = 1e-9 * static_cast<double>(available_memory());
  std::ostringstream constraint;
  constraint.precision(3);
  constraint << "needs " << gigabytes << " GB of memory and " << available
             << " GB are available; use fewer points";
  require(available == 0 || gigabytes <= available, "points",
          std::to_string(grid.nx) + " x " + std::to_string(grid.ny), constraint.str());
}

Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance,
                 const Progress& progress) {
  const CarriedModes carried(grid, spectrum);
  require_memory(grid, column_fft_memory(grid.nx, grid.ny));
  const RandomModes modes(carried, seed, chance);
  return backward_by_columns(
      grid.nx, grid.ny, carried.j_max() + 1,
      [&modes](Index j, std::span<std::complex<double>> column) { modes.column(j, column); },
      progress);
}

}  // namespace salebra::detail
