// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <span>

namespace salebra::detail {

/// Processor time of the calling thread, s. Cost: a call of the system, about 0.3 µs.
inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Hears of each parallel region as it ends, in the thread that began it.
/// begun    thread_seconds() of that thread at the begin
/// parts    processor seconds of the slabs, in the order in which threads took them, or of the
///          threads of a loop over tasks
/// tasks    whether it was such a loop
using RegionReport = void (*)(double begun, std::span<const double> parts, bool tasks);

/// Null, as at the start: nothing is measured, which costs a comparison for each region. Set by
/// bench/scaling/threads.cpp alone, while no region runs.
inline RegionReport region_report = nullptr;

}  // namespace salebra::detail
