// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/axis.hpp>
#include <span>
#include <vector>

#include "base/memory.hpp"

namespace salebra::detail {

/// The profiles of a surface along an axis (its columns along x, its rows along y), distributed
/// over the processes.
inline RowPartition profiles_of(const Surface& surface, Axis axis) {
  return axis == Axis::x ? RowPartition(surface.communicator, surface.grid.ny)
                         : surface.partition();
}

/// Returns one Value for each block of profiles of this process. add(value of the block, heights of
/// a profile) is called for every profile, in order within a block, and may change the heights.
/// Collective.
template <class Value, class Add>
std::vector<Value> map_profiles(const Surface& surface, Axis axis, const Value& start,
                                const Add& add) {
  const RowPartition profiles = profiles_of(surface, axis);
  const Index size = parallel::block_rows(profiles.rows()), ny = surface.grid.ny,
              number = (profiles.count() + size - 1) / size;
  std::vector<Value> blocks(static_cast<std::size_t>(number), start);
  if (axis == Axis::x) {
    visit_columns<double>(
        surface.partition(), profiles,
        [&](Index row, Index first, Index count, double* to) {
          std::copy_n(surface.heights.data() + row * ny + first, count, to);
        },
        [&](Index profile, std::span<double> heights) {
          add(blocks[static_cast<std::size_t>((profile - profiles.begin()) / size)], heights);
        });
    return blocks;
  }
  collectively(surface.communicator, [&] {
    parallel::for_slabs(number, [&](Index begin, Index end) {
      const auto buffer = large_array<double>(static_cast<std::size_t>(ny));
      for (Index row = begin * size; row < std::min(profiles.count(), end * size); ++row) {
        std::copy_n(surface.heights.data() + row * ny, ny, buffer.get());
        add(blocks[static_cast<std::size_t>(row / size)],
            std::span(buffer.get(), static_cast<std::size_t>(ny)));
      }
    });
  });
  return blocks;
}

}  // namespace salebra::detail
