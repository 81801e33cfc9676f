// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace salebra::detail {

/// While an object of this class exists, stop_if_asked() checks whether the caller wants the work
/// to stop, in the thread that made the object and in threads that take slabs of its parallel
/// loops. Use it for work whose incomplete result is useless; work whose incomplete result is kept
/// uses Progress instead.
///
///     const StopCheck check([] { return interrupted(); });
///     return height_statistics(surface);  // throws Interrupted soon after interrupted() is true
class StopCheck {
 public:
  /// wants_to_stop: called only by the thread that made the object, at most every 20 ms.
  explicit StopCheck(std::function<bool()> wants_to_stop);
  ~StopCheck();
  StopCheck(const StopCheck&) = delete;
  StopCheck& operator=(const StopCheck&) = delete;

  /// The object that this thread checks; null if no StopCheck exists for this thread.
  static StopCheck* current() { return current_; }
  void throw_if_stopped();

  /// Lets another thread check the same object while it takes part in the work.
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
  long long last_ = 0;  // ms, time of the last check
  std::atomic<bool> stopped_ = false;
};

/// Throws Interrupted if the caller wants the work to stop. It costs one comparison if no StopCheck
/// exists and a few nanoseconds otherwise. Every loop that may take longer than a second calls it.
inline void stop_if_asked() {
  if (StopCheck* check = StopCheck::current()) check->throw_if_stopped();
}

}  // namespace salebra::detail
