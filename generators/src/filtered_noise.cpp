// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian random surface: random amplitudes and phases for a spectrum.
#include <salebra/generators/filtered_noise.hpp>

#include "synthesis.hpp"

namespace salebra {

Surface filtered_noise(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                       const Progress& progress, const Communicator& ranks) {
  return {
      grid,
      detail::synthesise(grid, spectrum, seed, detail::Chance::gaussian_amplitude, progress, ranks),
      true, "filtered noise, seed " + std::to_string(seed) + ", " + spectrum.description(), ranks};
}

}  // namespace salebra
