// SPDX-License-Identifier: GPL-3.0-or-later
#include <omp.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

namespace salebra::parallel {
namespace {

// Enough slabs to balance any machine of today, few enough that a slab outweighs its scheduling.
constexpr Index largest_slab_count = 64;

Index slab_count(Index rows) { return std::min(rows, largest_slab_count); }
Index slab_begin(Index rows, Index slab) { return rows * slab / slab_count(rows); }

int chosen_threads = 0;

}  // namespace

void set_threads(int count) {
  require(count >= 0, "threads", count, "must be >= 0 (0: all)");
  chosen_threads = count;
}

int threads() { return chosen_threads > 0 ? chosen_threads : omp_get_num_procs(); }

void for_slabs(Index rows, const std::function<void(Index, Index)>& body) {
  const Index slabs = slab_count(rows);
  std::exception_ptr failure;
  std::mutex failure_guard;
#pragma omp parallel for schedule(dynamic) num_threads(threads()) if (threads() > 1 && !omp_in_parallel())
  for (Index slab = 0; slab < slabs; ++slab) {
    try {
      body(slab_begin(rows, slab), slab_begin(rows, slab + 1));
    } catch (...) {  // an exception must not leave an OpenMP region
      const std::scoped_lock lock(failure_guard);
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

namespace {

std::vector<double> slab_values(Index rows, const std::function<double(Index, Index)>& body) {
  std::vector<double> values(static_cast<std::size_t>(slab_count(rows)));
  // The slab is found again from its first row, so that for_slabs needs no third argument.
  for_slabs(rows, [&](Index begin, Index end) {
    Index slab = begin * slab_count(rows) / rows;
    while (slab_begin(rows, slab) < begin) ++slab;
    values[static_cast<std::size_t>(slab)] = body(begin, end);
  });
  return values;
}

}  // namespace

double sum_slabs(Index rows, const std::function<double(Index, Index)>& body) {
  double sum = 0;
  for (const double value : slab_values(rows, body)) sum += value;
  return sum;
}

double min_slabs(Index rows, const std::function<double(Index, Index)>& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const double value : slab_values(rows, body)) least = std::min(least, value);
  return least;
}

}  // namespace salebra::parallel
