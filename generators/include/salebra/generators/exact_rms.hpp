// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

enum class Rms { height, slope };

template <>
struct EnumNames<Rms> {
  static constexpr auto values = std::to_array<std::pair<Rms, std::string_view>>(
      {{Rms::height, "height"}, {Rms::slope, "slope"}});
};

/// The surface less its mean, times the factor that gives it this rms height (m) or rms slope
/// √⟨|∇h|²⟩ (by Fourier differentiation).
/// Throws InvalidInput if target is not > 0, points are undefined, the surface is flat, or a slope
/// is asked of a surface that is not periodic. A surface may be spread over processes, which call
/// this together; it then has the same bits for every number of them. Cost: a pass for the height,
/// a real FFT forward and one backward for the slope, in 10 bytes a point, 18 over several
/// processes.
Surface scale_to_rms(Surface surface, Rms which, double target);

/// A random-phase surface scaled so that its own rms height (or slope) is that of the continuum,
/// spectrum.moments(): what was asked holds exactly on every grid, and all mode powers are off by
/// one common factor, the same for every seed and for every resolution that carries the spectrum.
/// Its own rms slope before that is the sum over the modes, Spectrum::lattice_moments. Arguments,
/// errors, cost and independence of threads and processes as random_phase; a slope adds one
/// evaluation of C for each pair of modes.
Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                  Rms which = Rms::height, const Progress& progress = {},
                  const Communicator& ranks = {});

}  // namespace salebra
