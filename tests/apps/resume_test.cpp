// SPDX-License-Identifier: GPL-3.0-or-later
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <fstream>
#include <salebra/io/result_file.hpp>
#include <salebra/report/report.hpp>
#include <thread>

#include "base/random.hpp"
#include "run_program.hpp"
#include "same_results.hpp"
#include "skipped.hpp"
#include "study_parts.hpp"

using namespace salebra;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// Starts the program and kills it a while after its next part has appeared, or without waiting for
/// one. False: it ended before.
bool run_and_kill(const ProgramTest& test, bool after_a_part, std::chrono::microseconds delay) {
  const fs::path parts = test.folder() / "result.h5.parts";
  const std::size_t before = parts_in(parts);
  const pid_t child = start_study(test, {"--no-report", "--resume", "--threads", "2"});
  int status = 0;
  while (after_a_part && parts_in(parts) <= before) {
    if (waitpid(child, &status, WNOHANG) == child) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::this_thread::sleep_for(delay);
  if (after_a_part) {
    std::string name;
    std::ifstream("/proc/" + std::to_string(child) + "/comm") >> name;
    CHECK(name == "salebra");
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  return WIFSIGNALED(status);
}

}  // namespace

TEST_CASE("A study killed at ten random moments ends as if nothing had happened", "[resume]") {
  const ProgramTest test;
  test.write("study.toml", study_of(18));
  int killed = 0;
  for (int moment = 0; moment < 10; ++moment) {
    const RandomPair chance = uniform_pair(20, moment, 0);
    killed += run_and_kill(test, chance.first < 0.7,
                           std::chrono::microseconds(int(30000 * chance.second)));
    if (fs::exists(test.folder() / "result.h5")) break;
  }
  // All ten unless the machine is so fast that it finished between them.
  CHECK(killed >= 5);
  const std::size_t kept = parts_in(test.folder() / "result.h5.parts");
  CHECK(kept >= 3);
  // A bit that turned on the disk, and a file cut short, cost their surfaces only.
  int spoilt = 0;
  for (const auto& entry : fs::directory_iterator(test.folder() / "result.h5.parts")) {
    if (entry.path().extension() != ".realisation" || spoilt == 2) continue;
    if (++spoilt == 1) {
      std::fstream file(entry.path(), std::ios::binary | std::ios::in | std::ios::out);
      file.seekp(1000);
      file.put('\x55');
    } else {
      fs::resize_file(entry.path(), 100);
    }
  }
  // As of a process that was killed while it wrote the result.
  const bool unfinished = !fs::exists(test.folder() / "result.h5");
  if (unfinished) test.write(".result.h5.99999-0.part", "half of it");
  if (unfinished) {
    const auto resumed = test.done("study study.toml -o result.h5 --no-report --resume --json");
    CHECK_THAT(resumed.err, Contains("2 damaged files of result.h5.parts"));
  }
  const auto whole = test.done("study study.toml -o whole.h5 --no-report --json --threads 1");
  CHECK(test.files() == "study.toml result.h5 whole.h5");
  const int compared = compare_groups(ResultReader(test.folder() / "result.h5"),
                                      ResultReader(test.folder() / "whole.h5"), "/");
  CHECK(compared > 200);
}

TEST_CASE("A study killed while it tidied up is complete, and says so", "[resume]") {
  const ProgramTest test;
  const std::string study = study_of(6);
  test.write("study.toml", study);
  const fs::path parts = test.folder() / "result.h5.parts", copy = test.folder() / "copy";
  while (parts_in(parts) < 2) REQUIRE(run_and_kill(test, true, std::chrono::microseconds(0)));
  fs::copy(parts, copy);
  test.done("study study.toml -o result.h5 --no-report --resume");
  // Parts beside a finished result: those that were not yet removed when the process died.
  fs::remove(copy / "lock");
  fs::rename(copy, parts);
  const auto written = fs::last_write_time(test.folder() / "result.h5");
  const auto again = test.answer("study study.toml -o result.h5 --no-report --resume");
  CHECK(again["files"]["results"] == "result.h5");
  CHECK(again["files"]["report"].is_null());
  CHECK(test.files() == "study.toml result.h5");
  CHECK(fs::last_write_time(test.folder() / "result.h5") == written);
  // Without --resume, or as the result of another study, the file is in the way.
  check_refused(test.run("study study.toml -o result.h5"), "exists");
  check_refused(test.run("study study.toml -o result.h5 --resume --target-precision 9%"), "exists");
  std::string other = study;
  other.replace(other.find("1e-8"), 4, "1e-9");
  test.write("study.toml", other);
  check_refused(test.run("study study.toml -o result.h5 --resume"), "exists");
  CHECK(test.files() == "study.toml result.h5");
}

TEST_CASE("A study killed between its result and its page gets the page when it is resumed",
          "[resume]") {
  if (testing::skipped(!can_report(), "no page can be made: this build carries no plotly.js"))
    return;
  const ProgramTest test;
  test.write("study.toml", study_of(2));
  test.done("study study.toml -o result.h5");
  const std::string page = test.read("result.html");
  const std::set<std::string> all{"study.toml", "result.h5", "result.html"};

  // Nothing but the page is missing, as the process left it that died before it; the half of one
  // may lie there.
  fs::remove(test.folder() / "result.html");
  test.write(".result.html.99999-0.part", "half of it");
  const auto resumed = test.answer("study study.toml -o result.h5 --resume --json");
  CHECK(resumed["files"]["report"] == "result.html");
  CHECK(test.read("result.html") == page);
  CHECK(test.files() == all);

  // A page of these results stays as it is, and one of older results is another's until
  // --overwrite.
  const auto made = fs::last_write_time(test.folder() / "result.html");
  const auto whole = test.run("study study.toml -o result.h5 --resume");
  CHECK_THAT(whole.out, Contains("complete already") && Contains("report:  result.html"));
  CHECK(fs::last_write_time(test.folder() / "result.html") == made);
  test.write("result.html", "of other results");
  fs::last_write_time(test.folder() / "result.html", made - std::chrono::hours(1));
  const auto kept = test.run("study study.toml -o result.h5 --resume --json");
  CHECK(kept.status == 0);
  CHECK(kept.json()["files"]["report"].is_null());
  CHECK_THAT(kept.err, Contains("no report was written") && Contains("result.html: exists"));
  test.done("study study.toml -o result.h5 --resume --overwrite");
  CHECK(test.read("result.html") == page);
  CHECK(test.files() == all);
}

TEST_CASE("A study that cannot write its next surface keeps the others", "[resume]") {
  const ProgramTest test;
  test.write("study.toml", study_of(2));
  // No file may grow beyond 8 blocks, which no realisation does without.
  const auto full = test.run("study study.toml -o result.h5", "ulimit -f 8;");
  CHECK(full.status == 1);
  CHECK_THAT(full.err, Contains("--resume"));
  CHECK(test.files() == "study.toml");
}
