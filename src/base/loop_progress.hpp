// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <string_view>
#include <thread>

namespace salebra {

/// Reports the progress of a parallel loop, only from the thread that made this object, and tells
/// every thread when the callback asks to stop. The loop then leaves its results incomplete, and
/// finish() throws.
class LoopProgress {
 public:
  /// items     number of items of the whole loop
  /// from, to  fractions of the stage at the beginning and end of the loop
  /// progress  must outlive this object
  LoopProgress(const Progress& progress, std::string_view stage, Index items, double from = 0,
               double to = 1);

  /// False after the callback has asked to stop: slabs that have not begun need not do anything.
  bool running() const { return !stopped_; }
  /// Counts `items` more finished items; any thread may call it. Returns false if the loop should
  /// end.
  bool advance(Index items = 1);
  /// Reports the end of the loop, which other threads may have reached before this thread reported
  /// anything. Throws Interrupted "<stage>: interrupted" if the callback has asked to stop.
  void finish();

 private:
  void tell(Index done);

  const Progress& progress_;
  std::string_view stage_;
  double items_, from_, to_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::atomic<Index> done_ = 0;
  std::atomic<bool> stopped_ = false;
};

}  // namespace salebra
