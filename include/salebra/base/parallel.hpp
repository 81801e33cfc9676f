// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/grid.hpp>

/// Loops over slabs of rows. Chunks are fixed by the number of rows alone and partial sums are added in their order, so a
/// result has the same bits for every thread count; a distributed build gives each rank whole chunks.
namespace salebra::parallel {

/// Threads that parallel loops and transforms use from now on; 0 means all that the process may run on.
void set_threads(int threads);
int threads();

/// Calls body(begin, end) for consecutive half-open slabs that cover [0, rows), in parallel.
/// body must not touch another slab's data. The first exception is rethrown after all slabs have ended.
void for_slabs(Index rows, const std::function<void(Index, Index)>& body);

/// Sum of body(begin, end) over the same slabs, added in slab order.
double sum_slabs(Index rows, const std::function<double(Index, Index)>& body);

/// Least value of body(begin, end) over the same slabs; +infinity for no rows.
double min_slabs(Index rows, const std::function<double(Index, Index)>& body);

}  // namespace salebra::parallel
