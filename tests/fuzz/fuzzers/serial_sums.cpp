// SPDX-License-Identifier: GPL-3.0-or-later
// What readers share with the rest of sums and loops over slabs, without OpenMP, for which clang
// would need a library of its own.
#include <salebra/base/parallel.hpp>

namespace salebra::parallel {

Index block_rows(Index rows) { return rows > 0 ? rows : 1; }

Index block_count(Index rows) { return rows > 0 ? 1 : 0; }

double sum_blocks(Index rows, const std::function<double(Index, Index)>& slab, Index) {
  return rows > 0 ? slab(0, rows) : 0;
}

void for_slabs(Index rows, const std::function<void(Index, Index)>& body, Index) {
  if (rows > 0) body(0, rows);
}

}  // namespace salebra::parallel
