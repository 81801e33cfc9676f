// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A wave of i periods along x and j along y, which may be negative.
struct FourierMode {
  Index i = 0, j = 0;
  std::complex<double> amplitude;  ///< ĥ, m
};

/// h(x, y) = Σ ĥ exp(2πi(ix/lx + jy/ly)) over the modes and, of each, the opposite wave (−i, −j),
/// whose amplitude is the conjugate and which need not be among them. Throws InvalidInput for a wave
/// of fewer than two points, and for opposite waves that contradict each other.
Surface surface_of_modes(const Grid2D& grid, const std::vector<FourierMode>& modes);

}  // namespace salebra
