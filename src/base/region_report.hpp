// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <span>

namespace salebra::detail {

/// Processor time of the calling thread, s. Cost: a system call, about 0.3 µs.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Callback at the end of each parallel region, in the thread that began it.
/// begun  thread_seconds() of that thread at the beginning
/// parts  processor seconds of each slab, in the order in which threads took them, or of each
///        thread of a loop over tasks
/// tasks  whether the region was a loop over tasks
using RegionReport = void (*)(double begun, std::span<const double> parts, bool tasks);

/// Null by default: nothing is measured, at the cost of a comparison per region. Only
/// bench/scaling/threads.cpp sets it, while no region runs.
inline RegionReport region_report = nullptr;

}  // namespace salebra::detail
