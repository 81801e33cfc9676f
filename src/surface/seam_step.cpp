// SPDX-License-Identifier: GPL-3.0-or-later
// Implements seam_step.hpp: steps between opposite edges of a surface.
#include "seam_step.hpp"

#include <cmath>
#include <cstddef>
#include <salebra/base/row_partition.hpp>
#include <vector>

namespace salebra {

double detail::seam_step(const Surface& surface) {
  const Field& h = surface.heights;
  const Index nx = surface.grid.nx, ny = surface.grid.ny;
  const RowPartition rows = surface.partition();
  const auto square = [](double step) { return step * step; };
  const double along_y = parallel::sum_blocks(rows, [&](Index begin, Index end) {
    double sum = 0;
    for (Index row = begin; row < end; ++row) sum += square(h(row, 0) - h(row, ny - 1));
    return sum;
  });
  std::vector<std::byte> first_buffer, last_buffer;
  const auto row = [&](Index at, std::vector<std::byte>& buffer) {
    const auto bytes = static_cast<std::size_t>(ny) * sizeof(double);
    const RowExchange to_all(
        rows, [at](int) { return RowExchange::Window{at, 1}; }, RowExchange::Edge::none);
    return static_cast<const double*>(to_all.fetch(h.data(), bytes, bytes, buffer).front());
  };
  const double *first = row(0, first_buffer), *last = row(nx - 1, last_buffer);
  double along_x = 0;
  for (Index iy = 0; iy < ny; ++iy) along_x += square(first[iy] - last[iy]);
  return std::sqrt((along_x / double(ny) + along_y / double(nx)) / 2);
}

}  // namespace salebra
