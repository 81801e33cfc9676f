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

namespace salebra::detail {

class TaskPool;

/// A loop over tasks that take long: the contacts of a sweep, the surfaces of a study. Tasks begin
/// in their order, so the longest should be first. Each writes to a place of its own: results are in
/// order, with the same bits for every number of threads.
///
/// A task may run a loop of its own. Threads that have no task left take tasks of such loops, those
/// of the loop that began first, and where there are none, slabs of parallel::for_slabs(): few tasks
/// get teams of threads. The next task of the outer loop begins only when no task of an inner one
/// waits for a thread, so that no more of them are open than there are threads.
class TaskLoop {
 public:
  struct Options {
    int at_once = 0;  ///< most tasks side by side, 1: in the calling thread; 0: one for each thread
    /// The processes that make the loop together. Of several, each does a task at a time, and
    /// begins another only where all go on.
    Communicator communicator = {};
    /// Called by the calling thread alone: at the beginning, when a task on it asks going_on() and
    /// the last call is a millisecond ago, after each such task, every 20 ms while it waits for
    /// others, and at the end. False stops the loop, and so does what it throws, which run() throws
    /// on.
    std::function<bool()> talk = {};
  };

  explicit TaskLoop(Options options) : options_(std::move(options)) {}
  TaskLoop(const TaskLoop&) = delete;
  TaskLoop& operator=(const TaskLoop&) = delete;

  /// Calls body(k) for k = 0 … count − 1, and returns when all that began have ended. To be called
  /// once. A task that throws stops the loop, and run() throws on what was thrown first.
  void run(Index count, const std::function<void(Index)>& body);

  /// Whether a task should go on. A task that takes long asks now and then.
  bool going_on();
  /// No task begins any more, and those that run should not go on.
  void stop() { stopped_ = true; }
  bool stopped() const { return stopped_; }
  /// No task begins any more; those that run go on.
  void close() { closed_ = true; }
  /// How many tasks have ended, without those that threw.
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
  TaskLoop* around_ = nullptr;  // the loop in a task of which the calling thread began this one
  std::chrono::steady_clock::time_point told_ = {};

  // The pool's, under its lock.
  int depth_ = 0;  // so many loops are around it
  Index next_ = 0;
  int most_ = 1, running_ = 0;

  std::mutex failure_guard_;
  std::exception_ptr failure_;
};

/// parallel::for_slabs() with the help of threads that have no task. False where the calling thread
/// is in no pool, or no thread is free: nothing is done then.
bool share_slabs(Index rows, Index slabs_per_thread, const std::function<void(Index, Index)>& body);

}  // namespace salebra::detail
