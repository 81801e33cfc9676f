// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of a loop that several threads share: rate-limited reports, and interruption.
#include "loop_progress.hpp"

#include <salebra/base/error.hpp>
#include <string>

namespace salebra {

LoopProgress::LoopProgress(const Progress& progress, std::string_view stage, Index items,
                           double from, double to)
    : progress_(progress),
      stage_(stage),
      items_(static_cast<double>(items)),
      from_(from),
      to_(to) {}

bool LoopProgress::advance(Index items) {
  const Index done = done_ += items;
  if (std::this_thread::get_id() == caller_) tell(done);
  return !stopped_;
}

void LoopProgress::tell(Index done) {
  if (progress_ && !stopped_ &&
      !progress_({.stage = stage_,
                  .fraction =
                      items_ > 0 ? from_ + (to_ - from_) * static_cast<double>(done) / items_ : to_,
                  .step = static_cast<int>(done)}))
    stopped_ = true;
}

void LoopProgress::finish() {
  tell(done_);
  if (stopped_) throw Interrupted(std::string(stage_) + ": interrupted");
}

}  // namespace salebra
