// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/loop_progress.hpp"
#include "base/region_report.hpp"
#include "base/stop_check.hpp"

using namespace salebra;

TEST_CASE("Slabs cover every row once, and sums have the same bits for every thread count",
          "[parallel]") {
  const Index rows = GENERATE(1, 3, 64, 65, 1000);
  std::vector<int> visits(std::size_t(rows), 0);
  double first_sum = 0;
  for (const int threads : {1, 2, 5}) {
    parallel::set_threads(threads);
    parallel::for_slabs(rows, [&](Index begin, Index end) {
      for (Index row = begin; row < end; ++row) ++visits[std::size_t(row)];
    });
    const double sum = parallel::sum_blocks(rows, [](Index begin, Index end) {
      double part = 0;
      for (Index row = begin; row < end; ++row) part += 1 / std::sqrt(double(row) + 0.1);
      return part;
    });
    if (threads == 1) first_sum = sum;
    CHECK(sum == first_sum);
  }
  parallel::set_threads(0);
  CHECK(visits == std::vector<int>(std::size_t(rows), 3));
}

TEST_CASE("Blocks of rows cover all rows in order, and 16 rows or their multiples are whole blocks",
          "[parallel]") {
  // Processes with a multiple of 16 rows rely on whole blocks. There are at most 1024 blocks, and
  // the last may have fewer rows.
  for (const Index rows : {1, 15, 16, 17, 100, 1024, 1025, 16384, 16385, 65536, 100000}) {
    const Index size = parallel::block_rows(rows), blocks = parallel::block_count(rows);
    CHECK((16 % size == 0 || size % 16 == 0));
    CHECK(blocks <= 1024);
    const auto parts = parallel::map_blocks<std::pair<Index, Index>>(
        rows, [](Index begin, Index end) { return std::pair(begin, end); });
    REQUIRE(Index(parts.size()) == blocks);
    for (Index k = 0; k < blocks; ++k)
      CHECK(parts[std::size_t(k)] == std::pair(k * size, std::min(rows, (k + 1) * size)));
  }
}

TEST_CASE("More threads than any machine can use are refused before one is made", "[parallel]") {
  CHECK(parallel::max_threads() >= 64);
  CHECK_THROWS_WITH(parallel::set_threads(100000), "threads: 100000 must be from 0 (all) to " +
                                                       std::to_string(parallel::max_threads()));
  CHECK_THROWS_AS(parallel::set_threads(-1), InvalidInput);
  parallel::set_threads(parallel::max_threads());
  CHECK(parallel::sum_blocks(100, [](Index begin, Index end) { return double(end - begin); }) ==
        100);
  parallel::set_threads(0);
}

TEST_CASE("A report of regions holds the processor time of their slabs", "[parallel]") {
  static std::vector<double> heard;
  static double serial;
  heard.clear();
  parallel::set_threads(3);
  const auto work = [](Index begin, Index end) {
    const double start = detail::thread_seconds();
    while (detail::thread_seconds() - start < 1e-4 * static_cast<double>(end - begin)) {
    }
  };
  parallel::for_slabs(48, work);
  CHECK(heard.empty());
  detail::region_report = [](double begun, std::span<const double> parts, bool tasks) {
    if (tasks) return;
    serial = begun;
    heard.assign(parts.begin(), parts.end());
  };
  const double before = detail::thread_seconds();
  parallel::for_slabs(48, work);
  detail::region_report = nullptr;
  parallel::set_threads(0);
  CHECK(serial >= before);
  // Eight slabs per thread, each of two rows and 0.2 ms.
  REQUIRE(heard.size() == 24);
  for (const double part : heard) CHECK(part >= 2e-4);
}

TEST_CASE("An exception in a slab reaches the caller", "[parallel]") {
  CHECK_THROWS_AS(
      parallel::for_slabs(10, [](Index, Index) { throw InvalidInput("x", "is refused"); }),
      InvalidInput);
}

TEST_CASE("A parallel loop tells its progress from one thread and ends when that says stop",
          "[parallel]") {
  for (const int count : {1, 4}) {
    parallel::set_threads(count);
    const auto caller = std::this_thread::get_id();
    std::vector<double> fractions;
    const Progress all = [&](const ProgressReport& report) {
      CHECK(std::this_thread::get_id() == caller);
      CHECK(report.stage == "loop");
      fractions.push_back(report.fraction);
      return true;
    };
    LoopProgress whole(all, "loop", 1000, 0.5, 1);
    std::atomic<int> rows = 0;
    parallel::for_slabs(1000, [&](Index begin, Index end) {
      for (Index i = begin; i < end && whole.advance(); ++i) ++rows;
    });
    whole.finish();
    CHECK(rows == 1000);
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    CHECK(fractions.front() >= 0.5);
    CHECK(fractions.back() == 1);

    int asked = 0;
    const Progress stop = [&](const ProgressReport&) { return ++asked < 3; };
    LoopProgress stopped(stop, "loop", 1000);
    // Report first from the caller's thread: it might otherwise get no rows.
    for (int k = 0; k < 3; ++k) CHECK(stopped.advance() == (k < 2));
    parallel::for_slabs(1000, [&](Index begin, Index end) {
      for (Index i = begin; i < end && stopped.advance(); ++i) ++rows;
    });
    CHECK(rows == 1000);
    CHECK_THROWS_AS(stopped.finish(), Interrupted);
    CHECK(asked == 3);
    // Without a callback, the loop never stops.
    const Progress none;
    LoopProgress silent(none, "loop", 1);
    CHECK(silent.advance());
    silent.finish();
  }
  parallel::set_threads(0);
}

TEST_CASE("Loops end soon after their caller wants to stop, in every thread that takes part",
          "[parallel]") {
  for (const int threads : {1, 2}) {
    parallel::set_threads(threads);
    std::atomic<bool> stop = false;
    std::atomic<int> slabs = 0;
    const auto loop = [&] {
      parallel::for_slabs(1000, [&](Index, Index) {
        ++slabs;
        stop = true;
        // Longer than the 20 ms between two checks, so the next slab of the calling thread is the
        // last.
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
      });
    };
    {
      const salebra::detail::StopCheck check([&] { return stop.load(); });
      CHECK_THROWS_AS(loop(), Interrupted);
    }
    // Each thread begins one or two slabs before the calling thread checks.
    CHECK(slabs <= 3 * threads);
    CHECK_NOTHROW(salebra::detail::stop_if_asked());
  }
  parallel::set_threads(0);
}
