// SPDX-License-Identifier: GPL-3.0-or-later
// Processor time by stage of a computation, over all threads.
#include "stage_time.hpp"

#include <atomic>

#include "region_report.hpp"

namespace salebra::detail {
namespace {

std::array<std::atomic<double>, stage_names.size()> seconds_of_stage{};

struct Running {
  Stage stage = Stage::other;
  double since = 0;  // thread_seconds() when the stage began or went on
};
thread_local Running running;

void go_to(Stage stage) {
  const double now = thread_seconds();
  seconds_of_stage[static_cast<std::size_t>(running.stage)] += now - running.since;
  running = {stage, now};
}

}  // namespace

StageTime::StageTime(Stage stage) : before_(running.stage) { go_to(stage); }
StageTime::~StageTime() { go_to(before_); }
Stage StageTime::current() { return running.stage; }

std::array<double, stage_names.size()> stage_seconds() {
  go_to(running.stage);
  std::array<double, stage_names.size()> seconds{};
  for (std::size_t k = 0; k < seconds.size(); ++k) seconds[k] = seconds_of_stage[k];
  return seconds;
}

}  // namespace salebra::detail
