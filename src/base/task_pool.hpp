// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <mutex>
#include <salebra/base/communicator.hpp>
#include <salebra/base/grid.hpp>
#include <utility>

#include "stage_time.hpp"

namespace salebra::detail {

class TaskPool;

/// A loop over long tasks: the contacts of a sweep, the surfaces of a study. Tasks begin in their
/// order, so the longest should come first. Each task writes to its own index; results are in order
/// and have the same bits for every number of threads.
///
/// A task may run a loop of its own. Threads without a task take tasks of such inner loops,
/// beginning with the loop that began first; if there are none, they take slabs of
/// parallel::for_slabs(). A few tasks thus get several threads each. The next task of the outer
/// loop begins only when no task of an inner loop waits for a thread, so at most as many outer
/// tasks are open as there are threads.
class TaskLoop {
 public:
  struct Options {
    int at_once = 0;  ///< maximum number of parallel tasks; 1: in the calling thread; 0: one per
                      ///< thread
    /// The processes that run the loop together. If there are several, each runs one task at a time
    /// and begins the next only if all of them go on.
    Communicator communicator = {};
    /// Called only by the thread that called run(): at the beginning; when a task on this thread
    /// asks going_on() and the last call of `talk` is at least a millisecond ago; after each task
    /// of this thread; every 20 ms while the thread waits for others; and at the end. The loop
    /// stops if `talk` returns false or throws; run() rethrows its exception.
    std::function<bool()> talk = {};
  };

  explicit TaskLoop(Options options) : options_(std::move(options)) {}
  TaskLoop(const TaskLoop&) = delete;
  TaskLoop& operator=(const TaskLoop&) = delete;

  /// Calls body(k) for k = 0 … count − 1 and returns when all tasks that began have ended. Call
  /// run() once per object. A task that throws stops the loop, and run() rethrows the first
  /// exception.
  void run(Index count, const std::function<void(Index)>& body);

  /// Whether a task should go on. Long tasks should ask regularly.
  bool going_on();
  /// Begins no more tasks and asks running tasks to end.
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }
  /// Begins no more tasks; running tasks go on.
  void close() { closed_ = true; }
  /// Number of tasks that have ended without an exception.
  int finished() const { return finished_; }

 private:
  friend class TaskPool;

  bool accepts_more() const { return next_ < count_ && running_ < most_ && !stopped_ && !closed_; }
  void one_by_one();
  void perform(Index task);
  void keep_failure();
  void tell();

  const Options options_;
  std::atomic<bool> stopped_ = false, closed_ = false;
  std::atomic<int> finished_ = 0;
  const std::function<void(Index)>* body_ = nullptr;
  Index count_ = 0;
  Stage stage_ = Stage::other;  // of the thread that called the loop
  TaskLoop* around_ = nullptr;  // the loop whose task began this loop
  std::chrono::steady_clock::time_point told_ = {};

  // The pool that runs the loop owns these members; its lock guards them.
  int depth_ = 0;  // number of enclosing loops
  Index next_ = 0;
  int most_ = 1, running_ = 0;

  std::mutex failure_guard_;
  std::exception_ptr failure_;
};

/// parallel::for_slabs() with the help of threads that have no task. Returns false and does nothing
/// if the calling thread is in no pool or no thread is free.
bool share_slabs(Index rows, Index slabs_per_thread, const std::function<void(Index, Index)>& body);

}  // namespace salebra::detail
