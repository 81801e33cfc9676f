// SPDX-License-Identifier: GPL-3.0-or-later
// The one sum that readers share with the rest, without OpenMP, for which clang would need a library of its own.
#include <salebra/base/parallel.hpp>

namespace salebra::parallel {

double sum_slabs(Index rows, const std::function<double(Index, Index)>& slab, Index) {
  return rows > 0 ? slab(0, rows) : 0;
}

}  // namespace salebra::parallel
