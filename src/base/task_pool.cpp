// SPDX-License-Identifier: GPL-3.0-or-later
// Threads that share the tasks of a loop, of loops inside its tasks, and their slabs.
#include "task_pool.hpp"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

#include "region_report.hpp"

namespace salebra::detail {
namespace {

using Clock = std::chrono::steady_clock;

// Depth of slabs, larger than that of any loop, because slabs are inside all loops.
constexpr int depth_of_slabs = 1 << 20;

struct Here {
  TaskPool* pool = nullptr;
  TaskLoop* loop = nullptr;  // the last loop that this thread called
  int depth = 0;             // depth of the next loop that this thread calls
};
thread_local Here here;

class Within {
 public:
  explicit Within(const Here& now) : before_(here) { here = now; }
  ~Within() { here = before_; }
  Within(const Within&) = delete;
  Within& operator=(const Within&) = delete;

 private:
  const Here before_;
};

}  // namespace

/// The threads of an outermost loop; the pool is on the stack of the loop's caller. The threads are
/// those of OpenMP, which binds them as configured. One lock guards the assignment of tasks; tasks
/// run without it. The caller of a loop sees the results of a task because it takes the lock after
/// the task's thread has released it. A waiting thread is in free_, and whoever wakes it removes
/// it, so no wake-up is lost or goes to a thread that may not take the available task.
class TaskPool {
 public:
  TaskPool() {
    // A thread calls at most one loop at each of three depths. Reserve now: nothing below may
    // throw.
    const auto most = 4 * static_cast<std::size_t>(parallel::max_threads());
    open_.reserve(most);
    free_.reserve(most);
  }

  /// Lets a thread that has no task of its own take tasks of any loop, until end().
  void serve() {
    std::unique_lock lock(guard_);
    Waiter waiter{.min_depth = 0};
    while (!over_)
      if (TaskLoop* loop = pick(0))
        take_part(*loop, lock);
      else
        wait(waiter, lock, false);
  }

  void end() {
    const std::scoped_lock lock(guard_);
    over_ = true;
    for (Waiter* waiter : free_) awake(*waiter);
    free_.clear();
  }

  /// Runs a loop in the thread that called it.
  void run(TaskLoop& loop) {
    loop.tell();
    std::unique_lock lock(guard_);
    open_.push_back(&loop);
    Waiter waiter{.min_depth = loop.depth_ + 1, .own = &loop};
    // The calling thread takes the first task itself, and wakes free threads for the others.
    call(loop, loop.count_ - 1);
    for (;;) {
      if (loop.accepts_more()) {
        take_part(loop, lock);
      } else if (loop.running_ == 0) {
        break;
      } else if (TaskLoop* inner = pick(waiter.min_depth)) {
        take_part(*inner, lock);
      } else {
        wait(waiter, lock, true);
      }
      if (!loop.options_.talk) continue;
      lock.unlock();
      loop.tell();
      lock.lock();
    }
    std::erase(open_, &loop);
  }

  int free_threads() const { return free_count_; }

 private:
  struct Waiter {
    int min_depth = 0;  // minimum depth of the loops that this thread may join
    const TaskLoop* own = nullptr;
    bool woken = false;
    std::condition_variable changed = {};
  };

  /// The loop that the next free thread joins: inner loops before outer ones, slabs last, and among
  /// equals the loop that began first.
  TaskLoop* pick(int min_depth) const {
    const auto rank = [](const TaskLoop& loop) {
      return loop.depth_ == depth_of_slabs ? -1 : loop.depth_;
    };
    TaskLoop* best = nullptr;
    for (TaskLoop* loop : open_)
      if (loop->depth_ >= min_depth && loop->accepts_more() && (!best || rank(*loop) > rank(*best)))
        best = loop;
    return best;
  }

  void take_part(TaskLoop& loop, std::unique_lock<std::mutex>& lock) {
    const Index task = loop.next_++;
    ++loop.running_;
    lock.unlock();
    {
      // A thread that helps while its own loop waits still reports for its own loop.
      const Within the_task({here.pool, here.loop, loop.depth_ + 1});
      loop.perform(task);
    }
    lock.lock();
    --loop.running_;
    // The caller of the loop may need a wake-up to report or finish; otherwise call a thread for
    // the next task.
    for (std::size_t k = 0; k < free_.size(); ++k)
      if (free_[k]->own == &loop) return release(k);
    if (loop.accepts_more()) call(loop, 1);
  }

  /// Wakes up to `wanted` free threads so that they join a loop.
  void call(const TaskLoop& loop, Index wanted) {
    for (std::size_t k = free_.size(); k-- > 0 && wanted > 0;)
      if (free_[k]->min_depth <= loop.depth_) {
        release(k);
        --wanted;
      }
  }

  void release(std::size_t k) {
    awake(*free_[k]);
    free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(k));
    free_count_ = static_cast<int>(free_.size());
  }

  static void awake(Waiter& waiter) {
    waiter.woken = true;
    waiter.changed.notify_one();
  }

  void wait(Waiter& waiter, std::unique_lock<std::mutex>& lock, bool talks) {
    waiter.woken = false;
    free_.push_back(&waiter);
    free_count_ = static_cast<int>(free_.size());
    const auto woken = [&] { return waiter.woken; };
    if (!talks)
      waiter.changed.wait(lock, woken);
    else if (!waiter.changed.wait_for(lock, std::chrono::milliseconds(20), woken))
      std::erase(free_, &waiter);
    free_count_ = static_cast<int>(free_.size());
  }

  std::mutex guard_;
  std::vector<TaskLoop*> open_;  // in the order in which they began
  std::vector<Waiter*> free_;    // the last to wait is woken first
  std::atomic<int> free_count_ = 0;
  bool over_ = false;
};

void TaskLoop::run(Index count, const std::function<void(Index)>& body) {
  const int threads = parallel::threads();
  count_ = count;
  body_ = &body;
  stage_ = StageTime::current();
  around_ = here.loop;
  depth_ = here.depth;
  most_ = options_.at_once > 0 ? std::min(options_.at_once, threads) : threads;
  const bool single = count <= 1 || most_ <= 1 || !options_.communicator.alone();
  if (single || (!here.pool && omp_in_parallel())) {
    const Within this_loop({here.pool, this, here.depth});
    tell();
    one_by_one();
  } else if (here.pool) {
    const Within this_loop({here.pool, this, here.depth});
    here.pool->run(*this);
  } else {
    TaskPool pool;
    const Here caller{&pool, this, depth_};
    const RegionReport report = region_report;
    std::vector<double> seconds(report ? static_cast<std::size_t>(threads) : 0);
    const double begun = report ? thread_seconds() : 0;
#pragma omp parallel num_threads(threads)
    {
      const double before = report ? thread_seconds() : 0;
      if (omp_get_thread_num() == 0) {
        const Within this_loop(caller);
        pool.run(*this);
        pool.end();
      } else {
        const Within no_loop({&pool, nullptr, 0});
        pool.serve();
      }
      if (report)
        seconds[static_cast<std::size_t>(omp_get_thread_num())] = thread_seconds() - before;
    }
    if (report) report(begun, seconds, true);
  }
  if (failure_) std::rethrow_exception(failure_);
}

bool TaskLoop::going_on() {
  TaskLoop* loop = here.loop;
  while (loop && !loop->options_.talk) loop = loop->around_;
  if (loop && Clock::now() - loop->told_ >= std::chrono::milliseconds(1)) loop->tell();
  return !stopped_;
}

void TaskLoop::one_by_one() {
  for (Index task = 0; task < count_; ++task) {
    // One process may have been stopped while the others were not. A process that failed agrees on
    // nothing more.
    if (failure_ || !options_.communicator.all_agree(!stopped_)) stopped_ = true;
    if (stopped_ || closed_) return;
    perform(task);
    tell();
  }
}

void TaskLoop::perform(Index task) {
  try {
    const StageTime time(stage_);
    (*body_)(task);
    ++finished_;
  } catch (...) {
    keep_failure();
  }
}

void TaskLoop::keep_failure() {
  const std::scoped_lock lock(failure_guard_);
  if (!failure_) failure_ = std::current_exception();
  stopped_ = true;
}

void TaskLoop::tell() {
  if (stopped_ || !options_.talk) return;
  const Within outside({here.pool, around_, here.depth});
  try {
    if (!options_.talk()) stop();
  } catch (...) {
    keep_failure();
  }
  told_ = Clock::now();
}

bool share_slabs(Index rows, Index slabs_per_thread,
                 const std::function<void(Index, Index)>& body) {
  if (!here.pool || here.depth > depth_of_slabs) return false;
  const Index threads = 1 + here.pool->free_threads(),
              slabs = std::min(rows, slabs_per_thread * threads);
  if (threads == 1) return false;
  std::atomic<Index> next = 0;
  const Within behind_tasks({here.pool, here.loop, depth_of_slabs});
  TaskLoop loop({});
  loop.run(threads, [&](Index) {
    for (Index slab = next++; slab < slabs; slab = next++)
      body(rows * slab / slabs, rows * (slab + 1) / slabs);
    loop.close();  // threads that wake from now on find no task
  });
  return true;
}

}  // namespace salebra::detail
