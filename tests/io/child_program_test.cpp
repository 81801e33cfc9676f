// SPDX-License-Identifier: GPL-3.0-or-later
#include "../../src/io/child_program.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <salebra/base/error.hpp>

using namespace salebra;
using namespace std::chrono_literals;

TEST_CASE("A child ends with its time, by the stop flag, and within its memory", "[io]") {
  const auto start = std::chrono::steady_clock::now();
  const detail::ChildRun late = detail::run_child({"sleep", "20"}, "", {.time = 0s});
  CHECK(late.late);
  CHECK(late.signal == 9);
  CHECK_THROWS_AS(detail::run_child({"sleep", "20"}, "", {.stopped = [] { return true; }}),
                  Interrupted);
  // The child is checked every 20 ms; the rest of the time is for starting a program.
  CHECK(std::chrono::steady_clock::now() - start < 5s);

  // tail keeps all of its input in memory. The limit is set before the sleep ends.
  const std::vector<std::string> words{"sh", "-c",
                                       "sleep 0.1; head -c 200000000 /dev/zero | tail -c 200000000"
                                       " | wc -c"};
  CHECK(detail::run_child(words).output == "200000000\n");
  CHECK(detail::run_child(words, "", {.memory = 50'000'000}).output == "0\n");

  const detail::ChildRun quick = detail::run_child({"cat"}, "text");
  CHECK(quick.output == "text");
  CHECK_FALSE(quick.late);
  CHECK(detail::run_child({"salebra-no-such-program"}).start_error == ENOENT);
}
