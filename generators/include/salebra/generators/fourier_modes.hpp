// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A wave with i periods along x and j periods along y; i and j may be negative.
struct FourierMode {
  Index i = 0, j = 0;
  std::complex<double> amplitude;  ///< ĥ, m
};

/// Generates a surface from Fourier modes:
///     const Surface wave = surface_of_modes(grid, {{3, 0, 1e-9}});
///     h(x, y) = Σ ĥ exp(2π√−1 (i x/lx + j y/ly))
/// The sum includes, for each mode, the opposite wave (−i, −j) with the conjugate amplitude, which
/// need not be listed. Throws InvalidInput for a wave with fewer than two points per period, and if
/// a wave and its opposite are listed with amplitudes that are not conjugate.
Surface surface_of_modes(const Grid2D& grid, const std::vector<FourierMode>& modes);

}  // namespace salebra
