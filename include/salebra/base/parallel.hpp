// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <salebra/base/grid.hpp>
#include <vector>

/// Loops over slabs of rows, and sums over blocks of rows:
///     const double total = parallel::sum_blocks(rows, sum_of_rows);
/// The blocks depend only on the number of rows, and their sums are added in order, so results have
/// the same bits for every thread count.
namespace salebra::parallel {

/// Returns the maximum for set_threads(): four per processor available to the process, and 64 on
/// small machines. More threads only wait for each other, and many thousands end the process, since
/// the system refuses to create them.
int max_threads();

/// Sets the number of threads of parallel loops and transforms; 0 means all processors available to
/// the process. Throws InvalidInput below 0 and above max_threads().
void set_threads(int threads);
int threads();

/// Calls body(begin, end) in parallel for consecutive half-open slabs that cover [0, rows). body
/// must not touch data of another slab. A single thread takes all rows as one slab. The first
/// exception is rethrown after all slabs have ended. work: total number of points or operations, if
/// known to be small; waking a thread costs as much as about 20 000.
void for_slabs(Index rows, const std::function<void(Index, Index)>& body,
               Index work = std::numeric_limits<Index>::max());

/// Returns the rows of a block: 1, 2, 4, 8 or 16 up to 1024 rows (at most 64 blocks), and
/// 16·⌈rows/16384⌉ beyond (at most 1024 blocks). The last may have fewer. Sums over rows are first
/// added within a block, so that processes with whole blocks add the same numbers as one process.
/// Short blocks keep rounding errors small.
Index block_rows(Index rows);
Index block_count(Index rows);

/// Returns the values of body(begin, end) over blocks of `size` rows, in order.
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

/// Returns the values of body(begin, end) over the blocks, in order, for reductions of several
/// quantities at once.
template <class Value, class Body>
std::vector<Value> map_blocks(Index rows, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return map_blocks_of<Value>(block_rows(rows), rows, body, work);
}

/// Returns the sum of body(begin, end) over the blocks, added in order.
double sum_blocks(Index rows, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

}  // namespace salebra::parallel
