// SPDX-License-Identifier: GPL-3.0-or-later
// Loops over slabs and sums over blocks of rows, with the same bits for every number of threads.
#include <omp.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <string>
#include <vector>

#include "region_report.hpp"
#include "stage_time.hpp"
#include "stop_check.hpp"
#include "task_pool.hpp"

namespace salebra::parallel {
namespace {

// Number of slabs that a loop makes for each thread: enough to balance threads although contact is
// spread unevenly, and few enough that the work of a slab exceeds the cost of scheduling it.
constexpr Index slabs_per_thread = 8;

// Minimum points of a loop that is divided among threads: fewer points are finished before a second
// thread is awake.
constexpr Index min_parallel_work = 20000;

// Minimum points of a loop that sleeping threads of a task pool are woken for.
constexpr Index min_shared_work = 200000;

int chosen_threads = 0;

}  // namespace

int max_threads() { return std::max(64, 4 * omp_get_num_procs()); }

void set_threads(int count) {
  require(count >= 0 && count <= max_threads(), "threads", count,
          "must be from 0 (all) to " + std::to_string(max_threads()));
  chosen_threads = count;
}

int threads() { return chosen_threads > 0 ? chosen_threads : omp_get_num_procs(); }

Index block_rows(Index rows) {
  if (rows > 1024) return 16 * ((rows + 16383) / 16384);
  Index size = 1;
  while (64 * size < rows) size *= 2;
  return size;
}

Index block_count(Index rows) { return (rows + block_rows(rows) - 1) / block_rows(rows); }

void for_slabs(Index rows, const std::function<void(Index, Index)>& body, Index work) {
  if (rows == 0) return;
  detail::StopCheck* const check = detail::StopCheck::current();
  if (work < min_parallel_work || (threads() == 1 && !check)) return body(0, rows);
  if (threads() == 1) {
    // Split the rows to check regularly whether to stop.
    const Index slabs = std::min(rows, Index{64});
    for (Index slab = 0; slab < slabs; ++slab) {
      detail::stop_if_asked();
      body(rows * slab / slabs, rows * (slab + 1) / slabs);
    }
    return;
  }
  if (omp_in_parallel()) {
    if (work < min_shared_work || !detail::share_slabs(rows, slabs_per_thread, body)) body(0, rows);
    return;
  }
  const Index slabs = std::min(rows, slabs_per_thread * threads());
  std::exception_ptr failure;
  std::mutex failure_guard;
  const detail::RegionReport report = detail::region_report;
  std::vector<double> seconds(report ? static_cast<std::size_t>(slabs) : 0);
  const double begun = report ? detail::thread_seconds() : 0;
  const detail::Stage stage = detail::StageTime::current();
#pragma omp parallel for schedule(dynamic) num_threads(threads())
  for (Index slab = 0; slab < slabs; ++slab) {
    const double before = report ? detail::thread_seconds() : 0;
    try {
      const detail::StageTime time(stage);
      const detail::StopCheck::Shared shared(check);
      detail::stop_if_asked();
      body(rows * slab / slabs, rows * (slab + 1) / slabs);
    } catch (...) {  // an exception must not leave an OpenMP region
      const std::scoped_lock lock(failure_guard);
      if (!failure) failure = std::current_exception();
    }
    if (report) seconds[static_cast<std::size_t>(slab)] = detail::thread_seconds() - before;
  }
  if (report) report(begun, seconds, false);
  if (failure) std::rethrow_exception(failure);
}

double sum_blocks(Index rows, const std::function<double(Index, Index)>& body, Index work) {
  double sum = 0;
  for (const double value : map_blocks<double>(rows, body, work)) sum += value;
  return sum;
}

}  // namespace salebra::parallel
