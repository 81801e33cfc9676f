// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <salebra/base/progress.hpp>
#include <salebra/generators/spectrum.hpp>

namespace salebra {

enum class Rms { height, slope };

/// The surface less its mean, times the factor that gives it this rms height (m) or rms slope √⟨|∇h|²⟩ (by Fourier differentiation).
/// Throws InvalidInput if target is not > 0, points are undefined, the surface is flat, or a slope is asked of a surface that is
/// not periodic. Cost: a pass for the height, one real FFT for the slope.
Surface scale_to_rms(Surface surface, Rms which, double target);

/// A random-phase surface scaled so that its own rms height (or slope) is that of the continuum, spectrum.moments(): what was
/// asked holds exactly on every grid, and all mode powers are off by one common factor, the same for every seed and for every resolution
/// that carries the spectrum. Arguments and errors as random_phase; a stop waits for the one transform that a slope needs.
Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed,
                  Rms which = Rms::height, const Progress& progress = {});

}  // namespace salebra
