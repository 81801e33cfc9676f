// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <salebra/base/row_partition.hpp>
#include <utility>
#include <vector>

namespace salebra::detail {

/// The columns 0 … period_y/2 of a symbol that each process of a Convolution2D has, whose fields
/// are spread by `rows`. Processes without rows have no columns either.
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
