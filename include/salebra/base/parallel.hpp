// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <salebra/base/grid.hpp>
#include <vector>

/// Loops over slabs of rows, and sums over blocks of rows:
///     const double total = parallel::sum_blocks(rows, sum_of_rows);
/// Blocks depend only on the number of rows, and the sums of the blocks are added in order, so
/// results have the same bits for every number of threads.
namespace salebra::parallel {

/// Returns the largest number that set_threads() accepts: four threads per processor available to
/// the process, but at least 64. More threads would only wait for each other, and with many
/// thousands the system would end the process.
int max_threads();

/// Sets the number of threads of parallel loops and transforms; 0 means all processors available to
/// the process. Throws InvalidInput for a number below 0 or above max_threads().
void set_threads(int threads);
/// Returns the number of threads in use.
int threads();

/// Calls body(begin, end) in parallel for consecutive half-open slabs that cover [0, rows). body
/// must not touch data of another slab. A single thread takes all rows as one slab. The first
/// exception is rethrown after all slabs have ended. work: total number of points or operations, if
/// known to be small: fewer threads are used then, because waking a thread costs as much as about
/// 20 000 operations.
void for_slabs(Index rows, const std::function<void(Index, Index)>& body,
               Index work = std::numeric_limits<Index>::max());

/// Returns the number of rows of a block. Up to 1024 rows in total it is 1, 2, 4, 8 or 16, so that
/// there are at most 64 blocks; above that it is 16·⌈rows/16384⌉, so that there are at most 1024
/// blocks. The last block may have fewer rows. Sums over rows are first added within a block, so
/// that processes with whole blocks add the same numbers as one process. Short blocks keep rounding
/// errors small.
Index block_rows(Index rows);
/// Returns the number of blocks.
Index block_count(Index rows);

/// Returns the values of body(begin, end) for all blocks of `size` rows, in order.
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

/// Returns the values of body(begin, end) for all blocks, in order, for example to reduce several
/// quantities at once.
template <class Value, class Body>
std::vector<Value> map_blocks(Index rows, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return map_blocks_of<Value>(block_rows(rows), rows, body, work);
}

/// Returns the sum of body(begin, end) over all blocks, added in order.
double sum_blocks(Index rows, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

}  // namespace salebra::parallel
