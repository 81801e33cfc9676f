// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <random>
#include <salebra/base/grid.hpp>

/// A surface sampled from a function of x and y.
inline salebra::Surface sampled(const salebra::Grid2D& grid, bool periodic,
                                const std::function<double(double, double)>& height) {
  salebra::Surface surface{grid, salebra::Field(grid.nx, grid.ny), periodic, "test"};
  for (salebra::Index ix = 0; ix < grid.nx; ++ix)
    for (salebra::Index iy = 0; iy < grid.ny; ++iy)
      surface.heights(ix, iy) =
          height(static_cast<double>(ix) * grid.dx(), static_cast<double>(iy) * grid.dy());
  return surface;
}

/// Independent heights, uniform in (−1, 1) m, with power at every wave number, including the
/// Nyquist lines.
inline salebra::Surface white(const salebra::Grid2D& grid, bool periodic, unsigned seed = 1) {
  std::mt19937 engine(seed);
  return sampled(grid, periodic, [&](double, double) {
    return 2.0 * static_cast<double>(engine()) / static_cast<double>(std::mt19937::max()) - 1;
  });
}
