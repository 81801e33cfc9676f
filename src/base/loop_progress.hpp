// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <string_view>
#include <thread>

namespace salebra {

/// Tells a Progress of a parallel loop, from the thread that made this object alone, and lets every
/// thread know that it said stop. A loop leaves its results incomplete then, and finish() after it
/// throws.
class LoopProgress {
 public:
  /// items: of the whole loop. from, to: the fractions of the stage at its beginning and end.
  /// progress must outlive the object.
  LoopProgress(const Progress& progress, std::string_view stage, Index items, double from = 0,
               double to = 1);

  /// False once it was stopped: slabs that begin afterwards have nothing to do.
  bool running() const { return !stopped_; }
  /// So many more items are done, by any thread. False: leave the loop.
  bool advance(Index items = 1);
  /// Tells that all is done, which a loop may be before the thread that tells has had a part in it.
  /// Throws Interrupted "<stage>: interrupted" where the answer, or one before it, was stop.
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
