// SPDX-License-Identifier: GPL-3.0-or-later
#include "synthesis.hpp"

#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

namespace salebra::detail {

Field synthesise(const Grid2D& grid, const Modes& modes) {
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> half(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  parallel::for_slabs(modes.j_max() + 1, [&](Index begin, Index end) {
    std::vector<std::complex<double>> column(static_cast<std::size_t>(grid.nx));
    for (Index j = begin; j < end; ++j) {
      modes.column(j, column);
      for (Index i = 0; i < grid.nx; ++i)
        half[static_cast<std::size_t>(i * fft.modes_y() + j)] = column[static_cast<std::size_t>(i)];
    }
  });
  Field heights(grid.nx, grid.ny);
  fft.backward(half.data(), heights.data());
  return heights;
}

}  // namespace salebra::detail
