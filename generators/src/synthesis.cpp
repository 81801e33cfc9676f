// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces of random Fourier modes by inverse transform: Gaussian modes, or modes of which only the
// phases are random.
#include "synthesis.hpp"

#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>

#include "base/column_fft.hpp"
#include "base/memory.hpp"

namespace salebra::detail {

Field synthesise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance,
                 const Progress& progress, const Communicator& communicator) {
  const CarriedModes carried(grid, spectrum);
  const RowPartition rows(communicator, grid.nx);
  require_memory(grid, double(column_fft_memory(grid.nx, grid.ny, rows)), "a surface",
                 communicator);
  const RandomModes modes(carried, seed, chance);
  return backward_by_columns(
      grid.nx, grid.ny, carried.j_max() + 1,
      [&modes](Index j, std::span<std::complex<double>> column) { modes.column(j, column); },
      progress, rows);
}

}  // namespace salebra::detail

namespace salebra {

Surface filtered_noise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                       const Progress& progress, const Communicator& communicator) {
  return {grid,
          detail::synthesise(grid, spectrum, seed, detail::Chance::gaussian_amplitude, progress,
                             communicator),
          true, "filtered noise, seed " + std::to_string(seed) + ", " + spectrum.description(),
          communicator};
}

Surface random_phase(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                     const Progress& progress, const Communicator& communicator) {
  return {grid,
          detail::synthesise(grid, spectrum, seed, detail::Chance::phase, progress, communicator),
          true, "random phase, seed " + std::to_string(seed) + ", " + spectrum.description(),
          communicator};
}

}  // namespace salebra
