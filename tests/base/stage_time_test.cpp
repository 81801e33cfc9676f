// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time by stage: inner stages interrupt outer ones, and threads of a loop count for the
// stage of its caller.
#include "base/stage_time.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/parallel.hpp>

#include "base/region_report.hpp"
#include "base/task_pool.hpp"

using namespace salebra;
using detail::Stage;
using detail::StageTime;

namespace {

/// Keeps the processor busy for some seconds of processor time of the calling thread.
void work(double seconds) {
  const double begun = detail::thread_seconds();
  while (detail::thread_seconds() - begun < seconds) {
  }
}

double seconds_of(Stage stage) { return detail::stage_seconds()[std::size_t(stage)]; }

}  // namespace

TEST_CASE("Processor time counts for the innermost stage, in all threads of its loops",
          "[stage_time]") {
  parallel::set_threads(4);
  const double contacts = seconds_of(Stage::contacts), stick = seconds_of(Stage::stick);
  {
    const StageTime outer(Stage::contacts);
    work(0.02);
    {
      const StageTime inner(Stage::stick);
      parallel::for_slabs(4, [](Index begin, Index end) { work(0.02 * double(end - begin)); });
    }
    detail::TaskLoop({}).run(4, [](Index) { work(0.02); });
  }
  parallel::set_threads(0);
  CHECK(std::abs(seconds_of(Stage::stick) - stick - 0.08) < 0.01);
  CHECK(std::abs(seconds_of(Stage::contacts) - contacts - 0.10) < 0.01);
  CHECK(StageTime::current() == Stage::other);
}
