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
/// same bits for any number of processes. Cost: one pass for the height; a real FFT forward and one
/// backward for the slope, in 10 bytes per point, 18 over several processes.
Surface scale_to_rms(Surface surface, Rms which, double target);

/// Generates a random-phase surface scaled so that its own rms height (or slope) equals that of the
/// continuum, spectrum.moments():
///     const Surface surface = exact_rms(grid, spectrum, 1, Rms::slope);
/// The requested value is exact on every grid, and all mode powers deviate by one common factor,
/// the same for every seed and every resolution that carries the spectrum. The unscaled rms slope
/// is the sum over the modes, Spectrum::lattice_moments. Arguments, errors, cost and independence
/// of threads and processes are those of random_phase; a slope adds one evaluation of C per pair of
/// modes.
Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                  Rms which = Rms::height, const Progress& progress = {},
                  const Communicator& communicator = {});

}  // namespace salebra
