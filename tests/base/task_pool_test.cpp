// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/task_pool.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <mutex>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "ranks_in_threads.hpp"

using namespace salebra;
using detail::TaskLoop;
using testing::run_ranks;
using namespace std::chrono_literals;

namespace {

struct Threads {
  explicit Threads(int count) { parallel::set_threads(count); }
  ~Threads() { parallel::set_threads(0); }
};

/// Waits for another thread; ten minutes count as never.
template <class Condition>
bool comes_true(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + 10min;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(100us);
  }
  return true;
}

double sum_of(Index rows) {
  return parallel::sum_blocks(rows, [](Index begin, Index end) {
    double part = 0;
    for (Index row = begin; row < end; ++row) part += 1 / std::sqrt(double(row) + 0.1);
    return part;
  });
}

/// A small study: surfaces with loads of different duration, and sums over rows before, within and
/// after them.
std::vector<double> nested(int surfaces, int loads) {
  std::vector<double> results(std::size_t(surfaces), 0.0);
  TaskLoop outer({});
  outer.run(surfaces, [&](Index s) {
    std::vector<double> values(std::size_t(loads), 0.0);
    TaskLoop inner({});
    inner.run(loads, [&](Index k) {
      values[std::size_t(k)] = sum_of(100 + 1000 * (s + 1) * (loads - k));
    });
    double sum = sum_of(3000 + s);
    for (const double value : values) sum = std::cos(sum) + value;
    results[std::size_t(s)] = sum;
  });
  return results;
}

}  // namespace

TEST_CASE("Loops of tasks within tasks give the same bits for every number of threads",
          "[task_pool]") {
  const auto [surfaces, loads] =
      GENERATE(std::pair(1, 5), std::pair(2, 3), std::pair(9, 4), std::pair(3, 1), std::pair(4, 0));
  std::vector<double> first;
  for (const int threads : {1, 2, 3, 7}) {
    const Threads chosen(threads);
    const std::vector<double> results = nested(surfaces, loads);
    if (threads == 1) first = results;
    CHECK(results == first);
  }
}

TEST_CASE("A thousand tiny tasks are each done once and begin in their order", "[task_pool]") {
  for (const int threads : {1, 2, 3, 7}) {
    const Threads chosen(threads);
    constexpr int count = 1000;
    std::vector<std::atomic<int>> times(count);
    std::atomic<int> side_by_side = 0, most = 0;
    Index last = -1, late = 0;  // for a single thread
    TaskLoop loop({});
    loop.run(count, [&](Index k) {
      if (threads == 1 && k != ++last) ++late;
      const int now = ++side_by_side;
      for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
      }
      ++times[std::size_t(k)];
      --side_by_side;
    });
    CHECK(std::ranges::all_of(times, [](const auto& n) { return n == 1; }));
    CHECK(loop.finished() == count);
    CHECK(most <= threads);
    CHECK(late == 0);
  }
}

TEST_CASE("No more tasks than allowed are side by side, and one at a time is the caller's",
          "[task_pool]") {
  const Threads chosen(7);
  for (const int at_once : {1, 2, 3}) {
    std::atomic<int> side_by_side = 0, too_many = 0;
    std::atomic<int> elsewhere = 0;
    const auto caller = std::this_thread::get_id();
    TaskLoop loop({.at_once = at_once, .communicator = {}, .talk = {}});
    loop.run(60, [&](Index) {
      if (++side_by_side > at_once) ++too_many;
      if (std::this_thread::get_id() != caller) ++elsewhere;
      std::this_thread::sleep_for(200us);
      --side_by_side;
    });
    CHECK(too_many == 0);
    if (at_once == 1) CHECK(elsewhere == 0);
  }
}

TEST_CASE("A failed task ends its loop, and its failure is thrown by the call", "[task_pool]") {
  for (const int threads : {1, 2, 3, 7}) {
    const Threads chosen(threads);
    std::atomic<int> begun = 0;
    TaskLoop loop({});
    CHECK_THROWS_WITH(loop.run(1000,
                               [&](Index k) {
                                 ++begun;
                                 if (k == 3) throw NotConverged("task 3");
                                 // The other tasks go on until they hear of the failure.
                                 if (k > 3) comes_true([&] { return !loop.going_on(); });
                               }),
                      "task 3");
    CHECK(loop.stopped());
    CHECK(begun < 4 + threads);
  }
}

TEST_CASE("The failure of a task of an inner loop is that of the outer task", "[task_pool]") {
  for (const int threads : {1, 2, 7}) {
    const Threads chosen(threads);
    TaskLoop outer({});
    CHECK_THROWS_WITH(outer.run(4,
                                [&](Index s) {
                                  TaskLoop inner({});
                                  inner.run(20, [&](Index k) {
                                    if (s == 1 && k == 13) throw NotConverged("surface 1");
                                  });
                                }),
                      "surface 1");
  }
}

TEST_CASE("What a caller says stops a loop, from the caller's thread alone", "[task_pool]") {
  for (const int threads : {1, 2, 3, 7}) {
    const Threads chosen(threads);
    const auto caller = std::this_thread::get_id();
    std::atomic<int> elsewhere = 0, begun = 0;
    int calls = 0;
    TaskLoop loop({.at_once = 0, .communicator = {}, .talk = [&] {
                     if (std::this_thread::get_id() != caller) ++elsewhere;
                     return ++calls < 5;
                   }});
    loop.run(1000, [&](Index) {
      ++begun;
      comes_true([&] { return !loop.going_on(); });
    });
    CHECK(calls == 5);
    CHECK(elsewhere == 0);
    CHECK(loop.stopped());
    CHECK(begun <= threads);
  }
}

TEST_CASE("A caller that says stop before the first task has none begun", "[task_pool]") {
  for (const int threads : {1, 3}) {
    const Threads chosen(threads);
    int begun = 0;
    TaskLoop loop({.at_once = 0, .communicator = {}, .talk = [] { return false; }});
    loop.run(5, [&](Index) { ++begun; });
    CHECK(begun == 0);
  }
}

TEST_CASE("What talk throws ends the loop and is thrown by the call", "[task_pool]") {
  for (const int threads : {1, 2, 7}) {
    const Threads chosen(threads);
    int calls = 0;
    TaskLoop loop({.at_once = 0, .communicator = {}, .talk = [&]() -> bool {
                     if (++calls == 3) throw InvalidInput("word", "one", "too many");
                     return true;
                   }});
    CHECK_THROWS_AS(loop.run(100, [&](Index) { comes_true([&] { return !loop.going_on(); }); }),
                    InvalidInput);
  }
}

TEST_CASE("A caller is heard while its own tasks are done and while it helps in those of others",
          "[task_pool]") {
  const Threads chosen(2);
  // The caller's task is short. The other task has an inner loop whose tasks end once the caller,
  // which waits or helps in one of them, has stopped the outer loop.
  std::atomic<bool> other_begun = false;
  std::atomic<int> calls = 0;
  TaskLoop outer(
      {.at_once = 0, .communicator = {}, .talk = [&] { return !other_begun || ++calls < 10; }});
  outer.run(2, [&](Index s) {
    if (s == 0) return void(comes_true([&] { return other_begun.load(); }));
    TaskLoop inner({.at_once = 0, .communicator = {}, .talk = [&] { return outer.going_on(); }});
    inner.run(2, [&](Index) {
      other_begun = true;
      comes_true([&] { return !inner.going_on(); });
    });
  });
  CHECK(outer.stopped());
  CHECK(calls == 10);
}

TEST_CASE("Threads without a task take those of a giant one, and its slabs", "[task_pool]") {
  const Threads chosen(3);
  std::set<std::thread::id> of_tasks;
  std::mutex guard;
  // Each thread waits in its task until all threads are in one.
  const auto all_are_here = [&] {
    const std::scoped_lock lock(guard);
    of_tasks.insert(std::this_thread::get_id());
    return of_tasks.size() == 3;
  };
  std::atomic<bool> helped = false;
  std::atomic<int> alone = 0;
  TaskLoop outer({});
  outer.run(2, [&](Index s) {
    if (s == 0) return;  // the other task is giant
    TaskLoop inner({});
    inner.run(3, [&](Index) {
      if (!comes_true(all_are_here)) ++alone;
    });
    // The threads are free again once they sleep, which can only be found by waiting.
    const auto self = std::this_thread::get_id();
    comes_true([&] {
      parallel::for_slabs(64, [&](Index, Index) {
        if (std::this_thread::get_id() != self) helped = true;
        std::this_thread::sleep_for(1ms);
      });
      return helped.load();
    });
  });
  CHECK(helped);
  CHECK(alone == 0);
}

TEST_CASE("A slab that throws inside a task throws there", "[task_pool]") {
  for (const int threads : {1, 2, 5}) {
    const Threads chosen(threads);
    std::atomic<int> caught = 0;
    TaskLoop loop({});
    loop.run(2, [&](Index k) {
      if (k == 0) return;
      for (int repeat = 0; repeat < 50; ++repeat) try {
          parallel::for_slabs(100, [](Index begin, Index end) {
            if (begin <= 50 && 50 < end) throw NotConverged("row 50");
          });
        } catch (const NotConverged&) {
          ++caught;
        }
    });
    CHECK(caught == 50);
  }
}

TEST_CASE("Processes of a loop stop together, before the same task", "[task_pool]") {
  std::atomic<int> as_wanted = 0;
  run_ranks(3, [&](const Communicator& ranks) {
    int done = 0;
    TaskLoop loop({.at_once = 0, .communicator = ranks, .talk = [&] {
                     return ranks.rank() != 1 || done < 2;
                   }});
    loop.run(10, [&](Index) { ++done; });
    as_wanted += done == 2 && loop.stopped();
  });
  CHECK(as_wanted == 3);
}
