// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>
#include <string>
#include <vector>

namespace salebra {

/// What can be said of a generated surface before it is made.
struct Forecast {
  SpectralMoments target;   ///< of the continuum: what was asked
  SpectralMoments lattice;  ///< what surfaces on this grid have in the mean
  /// Standard deviation of the rms height of filtered noise over its mean, ½√(2ΣP²)/ΣP over the
  /// powers P of all modes; 0 for random phase.
  double rms_height_scatter = 0;
  std::size_t memory = 0;             ///< peak memory of the generation, bytes, heights included
  std::vector<std::string> warnings;  ///< sentences for the user; empty if there is nothing to say
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

/// Warns of fewer than eight cells in the shortest wavelength (contact areas come out too large,
/// docs/theory.md, section 7), of a lattice rms height more than 5 % from the target, and of an
/// rms_height_scatter above 5 % (a roll-off longer than about an eighth of the cell). Throws as
/// Spectrum::require_carried_by. progress: "moments" and "scatter"; a stop throws Interrupted.
/// Cost: three sums over all modes.
Forecast forecast(const Grid2D& grid, const Spectrum& spectrum, const Progress& progress = {});

/// Peak memory of filtered_noise and random_phase on this grid in this one of the processes, bytes,
/// heights included. They refuse with InvalidInput what exceeds the memory that the system says is
/// available.
std::size_t generation_memory(const Grid2D& grid, const Communicator& ranks = {});

}  // namespace salebra
