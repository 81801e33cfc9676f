// SPDX-License-Identifier: GPL-3.0-or-later
// Random surface with exact amplitudes and random phases for a spectrum.
#include <salebra/generators/random_phase.hpp>

#include "synthesis.hpp"

namespace salebra {

Surface random_phase(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                     const Progress& progress, const Communicator& ranks) {
  return {grid, detail::synthesise(grid, spectrum, seed, detail::Chance::phase, progress, ranks),
          true, "random phase, seed " + std::to_string(seed) + ", " + spectrum.description(),
          ranks};
}

}  // namespace salebra
