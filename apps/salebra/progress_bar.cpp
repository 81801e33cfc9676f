// SPDX-License-Identifier: GPL-3.0-or-later
// Progress line on stderr, redrawn in place.
#include "progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "terminal.hpp"

namespace salebra::cli {

void ProgressBar::draw(const ProgressReport& report) {
  if (!visible_) return;
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && now - last_ < std::chrono::milliseconds(100)) return;
  last_ = now;
  drawn_ = true;
  constexpr int width = 30;
  const double fraction = std::clamp(report.fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(fraction * width);
  print_to_stderr(fmt::format("\r\033[K{:<14} [{}{}] {:3.0f} %", report.stage,
                              std::string(filled, '#'), std::string(width - filled, '.'),
                              100 * fraction));
}

void ProgressBar::clear() {
  if (!drawn_) return;
  print_to_stderr("\r\033[K");
  drawn_ = false;
}

}  // namespace salebra::cli
