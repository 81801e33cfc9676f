// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace salebra::detail {

/// While an object of this class lives, stop_if_asked() in the thread that made it, and in the
/// threads that take slabs of its parallel loops, looks whether the caller wants the work to end.
/// This is for work whose incomplete result is of no use: what keeps one asks a Progress instead.
///
///     const StopCheck check([] { return interrupted(); });
///     return height_statistics(surface);  // throws Interrupted soon after interrupted() is true
class StopCheck {
 public:
  /// wants_to_stop: called by the thread that made the object alone, at most every 20 ms.
  explicit StopCheck(std::function<bool()> wants_to_stop);
  ~StopCheck();
  StopCheck(const StopCheck&) = delete;
  StopCheck& operator=(const StopCheck&) = delete;

  /// The one that this thread looks at; null where there is none.
  static StopCheck* current() { return current_; }
  void throw_if_stopped();

  /// Lets another thread look at the same object while it takes part in the work.
  class Shared {
   public:
    explicit Shared(StopCheck* check) : before_(current_) { current_ = check; }
    ~Shared() { current_ = before_; }
    Shared(const Shared&) = delete;
    Shared& operator=(const Shared&) = delete;

   private:
    StopCheck* before_;
  };

 private:
  static inline thread_local constinit StopCheck* current_ = nullptr;
  std::function<bool()> wants_to_stop_;
  StopCheck* before_;
  std::thread::id maker_ = std::this_thread::get_id();
  long long last_ = 0;  // ms, when it was asked
  std::atomic<bool> stopped_ = false;
};

/// Throws Interrupted where the caller wants the work to end. It costs a comparison where nobody
/// asks and a few nanoseconds elsewhere: every loop that may last for more than a second calls it.
inline void stop_if_asked() {
  if (StopCheck* check = StopCheck::current()) check->throw_if_stopped();
}

}  // namespace salebra::detail
