// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <salebra/base/row_partition.hpp>
#include <utility>
#include <vector>

namespace salebra::detail {

/// Distributes the columns 0 … period_y/2 of the symbols of a Convolution2D whose fields are
/// distributed by `rows`. A process without rows has no columns.
inline RowPartition spectrum_columns(const RowPartition& rows, Index period_y) {
  const Index columns = period_y / 2 + 1;
  Index in_use = 0;
  for (int rank = 0; rank < rows.communicator().size(); ++rank)
    in_use += rows.end_of(rank) > rows.begin_of(rank);
  std::vector<Index> begins;
  for (Index rank = 0; rank <= rows.communicator().size(); ++rank)
    begins.push_back(std::min(rank, in_use) * columns / in_use);
  return {rows.communicator(), std::move(begins)};
}

}  // namespace salebra::detail
