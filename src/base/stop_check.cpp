// SPDX-License-Identifier: GPL-3.0-or-later
// Checks inside long loops whether the caller wants the work to stop.
#include "stop_check.hpp"

#include <ctime>
#include <salebra/base/error.hpp>
#include <utility>

namespace salebra::detail {
namespace {

/// A clock that ticks every few milliseconds and costs only a few nanoseconds.
long long milliseconds() {
  std::timespec now = {};
  clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  return 1000LL * now.tv_sec + now.tv_nsec / 1000000;
}

}  // namespace

StopCheck::StopCheck(std::function<bool()> wants_to_stop)
    : wants_to_stop_(std::move(wants_to_stop)), before_(current_), last_(milliseconds()) {
  current_ = this;
}

StopCheck::~StopCheck() { current_ = before_; }

void StopCheck::throw_if_stopped() {
  constexpr long long interval = 20;
  if (std::this_thread::get_id() == maker_)
    if (const long long now = milliseconds(); now - last_ >= interval) {
      last_ = now;
      if (wants_to_stop_()) stopped_ = true;
    }
  if (stopped_) throw Interrupted("interrupted; nothing was written");
}

}  // namespace salebra::detail
