// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <limits>
#include <salebra/base/grid.hpp>
#include <vector>

/// Loops over slabs of rows. Chunks are fixed by the number of rows alone and partial sums are added in their order, so a
/// result has the same bits for every thread count; a distributed build gives each rank whole chunks.
namespace salebra::parallel {

/// The largest number that set_threads() takes: four for each processor that the process may run on, and 64 on small machines. More
/// threads only wait for each other, and many thousands end the process, since the system refuses to create them.
int most_threads();

/// Threads that parallel loops and transforms use from now on; 0 means all that the process may run on.
/// Throws InvalidInput below 0 and above most_threads().
void set_threads(int threads);
int threads();

/// Calls body(begin, end) for consecutive half-open slabs that cover [0, rows), in parallel.
/// body must not touch another slab's data. The first exception is rethrown after all slabs have ended.
/// work: points or operations in all, where that is known to be small; waking a thread costs as much as about 20 000.
void for_slabs(Index rows, const std::function<void(Index, Index)>& body,
               Index work = std::numeric_limits<Index>::max());

/// The slabs of [0, rows): their number, and the one that begins at row begin.
Index slab_count(Index rows);
Index slab_of(Index rows, Index begin);

/// The values of body(begin, end) over the slabs, in slab order, for reductions of several quantities at once.
template <class Value, class Body>
std::vector<Value> map_slabs(Index rows, const Body& body,
                             Index work = std::numeric_limits<Index>::max()) {
  std::vector<Value> values(static_cast<std::size_t>(slab_count(rows)));
  for_slabs(
      rows,
      [&](Index begin, Index end) {
        values[static_cast<std::size_t>(slab_of(rows, begin))] = body(begin, end);
      },
      work);
  return values;
}

/// Sum of body(begin, end) over the same slabs, added in slab order.
double sum_slabs(Index rows, const std::function<double(Index, Index)>& body,
                 Index work = std::numeric_limits<Index>::max());

/// Least value of body(begin, end) over the same slabs; +infinity for no rows.
double min_slabs(Index rows, const std::function<double(Index, Index)>& body,
                 Index work = std::numeric_limits<Index>::max());

}  // namespace salebra::parallel
