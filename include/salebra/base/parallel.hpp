// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <salebra/base/grid.hpp>
#include <vector>

/// Loops over slabs of rows, and sums over blocks of rows. Blocks are fixed by the number of rows
/// alone, and their sums are added in their order, so that a result has the same bits for every
/// thread count.
namespace salebra::parallel {

/// The largest number that set_threads() takes: four for each processor that the process may run
/// on, and 64 on small machines. More threads only wait for each other, and many thousands end the
/// process, since the system refuses to create them.
int most_threads();

/// Threads that parallel loops and transforms use from now on; 0 means all that the process may run
/// on.
/// Throws InvalidInput below 0 and above most_threads().
void set_threads(int threads);
int threads();

/// Calls body(begin, end) for consecutive half-open slabs that cover [0, rows), in parallel.
/// body must not touch another slab's data. A single thread takes all rows as one slab. The first
/// exception is rethrown after all slabs have ended. work: points or operations in all, where that
/// is known to be small; waking a thread costs as much as about 20 000.
void for_slabs(Index rows, const std::function<void(Index, Index)>& body,
               Index work = std::numeric_limits<Index>::max());

/// Rows of a block: 1, 2, 4, 8 or 16 up to 1024 rows, which makes 64 blocks at most, and
/// 16·⌈rows/16384⌉ beyond, 1024 blocks at most. The last may have fewer. Sums over rows are added
/// within a block first, so that processes which hold whole blocks add the same numbers as one
/// process does. Short blocks keep the rounding of sums small.
Index block_rows(Index rows);
Index block_count(Index rows);

/// The values of body(begin, end) over blocks of `size` rows, in their order.
template <class Value, class Body>
std::vector<Value> map_blocks_of(Index size, Index rows, const Body& body,
                                 Index work = std::numeric_limits<Index>::max()) {
  const Index blocks = (rows + size - 1) / size;
  std::vector<Value> values(static_cast<std::size_t>(blocks));
  for_slabs(
      blocks,
      [&](Index first, Index last) {
        for (Index block = first; block < last; ++block)
          values[static_cast<std::size_t>(block)] =
              body(block * size, std::min(rows, (block + 1) * size));
      },
      work);
  return values;
}

/// The values of body(begin, end) over the blocks, in their order, for reductions of several
/// quantities at once.
template <class Value, class Body>
std::vector<Value> map_blocks(Index rows, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return map_blocks_of<Value>(block_rows(rows), rows, body, work);
}

/// Sum of body(begin, end) over the blocks, added in their order.
double sum_blocks(Index rows, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

}  // namespace salebra::parallel
