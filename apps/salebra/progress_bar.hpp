// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <salebra/base/progress.hpp>

namespace salebra::cli {

/// A line on standard error that shows the progress and is redrawn in place, at most ten times a
/// second.
class ProgressBar {
 public:
  explicit ProgressBar(bool visible) : visible_(visible) {}
  void draw(const ProgressReport& report);
  /// Removes the line from the screen, so that other text can be printed.
  void clear();

 private:
  bool visible_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point last_ = {};
};

}  // namespace salebra::cli
