// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/base/row_partition.hpp>
#include <vector>

namespace salebra::detail {

/// The rows of a surface that this process holds, and one row before and one after these, which may
/// come from other processes. Collective.
class NeighbourRows {
 public:
  explicit NeighbourRows(const Surface& surface) {
    const RowPartition partition = surface.partition();
    const RowExchange exchange(
        partition,
        [&](int rank) -> RowExchange::Window {
          const Index begin = partition.begin_of(rank), count = partition.end_of(rank) - begin;
          if (count == 0) return {};
          return {begin - 1, count + 2};
        },
        surface.periodic ? RowExchange::Edge::repeat : RowExchange::Edge::none);
    const std::size_t bytes = static_cast<std::size_t>(surface.grid.ny) * sizeof(double);
    rows_ = exchange.fetch(surface.heights.data(), bytes, bytes, room_);
  }
  /// Returns a row; `row` is −1 … number of rows of this process. The result is nullptr beyond the
  /// edge of a surface that is not periodic.
  const double* operator[](Index row) const {
    return static_cast<const double*>(rows_[static_cast<std::size_t>(row + 1)]);
  }

 private:
  std::vector<std::byte> room_;
  std::vector<const void*> rows_;
};

}  // namespace salebra::detail
