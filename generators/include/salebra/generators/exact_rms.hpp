// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

enum class Rms { height, slope };

template <>
struct EnumNames<Rms> {
  static constexpr auto values = std::to_array<std::pair<Rms, std::string_view>>(
      {{Rms::height, "height"}, {Rms::slope, "slope"}});
};

/// Subtracts the mean and scales the surface to an rms height (m) or rms slope √⟨|∇h|²⟩ (by Fourier
/// differentiation), e.g. `scale_to_rms(std::move(surface), Rms::height, 1e-7)`. Throws
/// InvalidInput if target is not > 0, points are undefined, the surface is flat, or a slope is
/// requested for a surface that is not periodic. Collective if the surface is distributed, with the
/// same bits for any number of processes. Cost: for the height one pass; for the slope one real FFT
/// forward and one backward, with 10 bytes per point, or 18 over several processes.
Surface scale_to_rms(Surface surface, Rms which, double target);

/// Generates a random-phase surface, scaled so that its rms height (or rms slope) equals that of
/// the spectrum without a grid, spectrum.moments():
///     const Surface surface = exact_rms(grid, spectrum, 1, Rms::slope);
/// The value is exact on every grid. The powers of all modes deviate from the spectrum by one
/// common factor, which is the same for every seed and every resolution that can represent the
/// spectrum. (The rms slope before scaling is that of Spectrum::lattice_moments().) Arguments,
/// errors and cost are those of random_phase, and so is the independence of the number of threads
/// and processes; Rms::slope adds one evaluation of C per pair of modes.
Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                  Rms which = Rms::height, const Progress& progress = {},
                  const Communicator& communicator = {});

}  // namespace salebra
