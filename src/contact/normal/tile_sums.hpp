// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "tile_kernels.hpp"

namespace salebra::detail {

// Adds up the sums that kernels return for parts of the grid. These functions are not in
// tile_kernels.hpp, because that header must not have inline functions.

inline void add(PreconditionSums& total, const PreconditionSums& part) {
  total.z += part.z;
  total.zw += part.zw;
  total.zz += part.zz;
  total.t += part.t;
  total.w += part.w;
  total.r += part.r;
  total.zr += part.zr;
  total.tr += part.tr;
}
inline void add(CurvatureSums& total, const CurvatureSums& part) {
  total.tw += part.tw;
  total.w += part.w;
}
inline void add(StepSums& total, const StepSums& part) {
  total.outside += part.outside;
  total.wrong += part.wrong;
  total.clipped += part.clipped;
  total.pressure += part.pressure;
  total.misfit += part.misfit;
  total.signed_misfit += part.signed_misfit;
  total.saturated += part.saturated;
  total.least = std::min(total.least, part.least);
}
inline void add(SetSums& total, const SetSums& part) {
  total.count += part.count;
  total.g += part.g;
}
// Sums over the cells of a punch: its load, Σ(1 − displacement)², and the number of cells.
struct PunchSums {
  double load = 0, misfit = 0, cells = 0;
};
inline void add(PunchSums& total, const PunchSums& part) {
  total.load += part.load;
  total.misfit += part.misfit;
  total.cells += part.cells;
}
inline void add(GapSums& total, const GapSums& part) {
  total.pressure += part.pressure;
  total.count += part.count;
  total.g += part.g;
  total.misfit += part.misfit;
  total.distance += part.distance;
  total.saturated += part.saturated;
  total.least = std::min(total.least, part.least);
}

// Adds the sums of all parts in their order, so that the total has the same bits for every thread
// count.
template <class Sums>
Sums total_of(const std::vector<Sums>& parts) {
  Sums total = parts.front();
  for (std::size_t k = 1; k < parts.size(); ++k) add(total, parts[k]);
  return total;
}

// Adds the sums of this process's rows within each block of rows (parallel.hpp), and returns the
// sums of the blocks of all processes. Collective.
template <class Sums>
std::vector<Sums> by_blocks(const RowPartition& partition, const std::vector<Sums>& rows) {
  const auto size = static_cast<std::size_t>(parallel::block_rows(partition.rows()));
  std::vector<Sums> blocks;
  for (std::size_t row = 0; row < rows.size(); ++row)
    if (row % size == 0)
      blocks.push_back(rows[row]);
    else
      add(blocks.back(), rows[row]);
  return parallel::gather_blocks(partition, blocks);
}

}  // namespace salebra::detail
