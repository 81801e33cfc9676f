// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// Properties of a generated surface, known before it is made.
struct Forecast {
  SpectralMoments target;   ///< moments of the spectrum without a grid, as requested
  SpectralMoments lattice;  ///< mean moments of surfaces on this grid
  /// Relative standard deviation of the rms height of surfaces of filtered_noise(), ½√(2ΣP²)/ΣP
  /// with the powers P of all modes. (The rms height of random_phase() surfaces does not scatter.)
  double rms_height_scatter = 0;
  std::size_t memory = 0;             ///< peak memory of the generation, bytes, heights included
  std::vector<std::string> warnings;  ///< sentences for the user; may be empty
};

constexpr void describe(auto&& visit, std::type_identity<Forecast>) {
  using S = Forecast;
  visit(&S::target, Kept{"target", "moments of the continuum, which were asked for"});
  visit(&S::lattice, Kept{"lattice", "what surfaces on this grid have in the mean"});
  visit(&S::rms_height_scatter,
        Kept{"rms_height_scatter",
             "relative standard deviation of the rms height of filtered noise"});
  visit(&S::memory, Kept{"memory", "peak memory of the generation in bytes"});
  visit(&S::warnings, Kept{"warnings", "sentences for the user"});
}

/// Predicts moments, scatter, memory and warnings, e.g. `forecast(grid, spectrum).warnings`. It
/// warns if the shortest wavelength has fewer than eight cells (contact areas are then too large,
/// docs/theory.md, section 7), if the rms height on the grid differs by more than 5 % from the
/// target, and if rms_height_scatter exceeds 5 % (which happens if the roll-off wavelength is
/// longer than about an eighth of the side of the surface). Throws wherever
/// Spectrum::require_carried_by does. progress has the stages "moments" and "scatter"; a stop
/// throws Interrupted. Cost: three sums over all modes.
Forecast forecast(const Grid2D& grid, const Spectrum& spectrum, const Progress& progress = {});

/// Returns the peak memory of filtered_noise and random_phase on this grid in this process, bytes,
/// including the heights. These functions throw InvalidInput if it exceeds the available memory of
/// the system.
std::size_t generation_memory(const Grid2D& grid, const Communicator& communicator = {});

}  // namespace salebra
