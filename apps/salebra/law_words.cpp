// SPDX-License-Identifier: GPL-3.0-or-later
// How well the exponential law describes one curve, in words.
#include "law_words.hpp"

#include <fmt/format.h>

namespace salebra::cli {

std::string in_words(const LawDescription& law, const std::string& what) {
  const std::string range =
      fmt::format("F/l^2 is off F'' by {:+.0f} % (closest) and {:+.0f} % (farthest)",
                  100 * law.law_off_closest, 100 * law.law_off_farthest);
  if (law.fair)
    return fmt::format("F ~ exp(-gap/l) is a fair description of {}: {} at the ends of the window.",
                       what, range);
  return fmt::format(
      "F ~ exp(-gap/l) is a poor description of {}: {} at the ends of the window. Do not use Eq. "
      "(16) here.",
      what, range);
}

}  // namespace salebra::cli
