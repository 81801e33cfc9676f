// SPDX-License-Identifier: GPL-3.0-or-later
// How well the exponential law describes one curve, in words.
#include "law_words.hpp"

#include <fmt/format.h>

#include <limits>

namespace salebra::cli {

bool LawDescription::fair() const {
  return off_closest > -0.5 && off_closest < 1 && off_farthest > -0.5 && off_farthest < 1;
}

LawDescription describe_law(double decay_length, double closest, double farthest) {
  // Where the parabola turns, l has no local value: it is infinite or below 0, and the law is far
  // off.
  const auto off = [&](double local) {
    const double ratio = local / decay_length;
    return ratio > 0 ? ratio * ratio - 1 : std::numeric_limits<double>::infinity();
  };
  return {off(closest), off(farthest)};
}

std::string in_words(const LawDescription& law, const std::string& what) {
  const std::string range =
      fmt::format("F/l^2 is off F'' by {:+.0f} % (closest) and {:+.0f} % (farthest)",
                  100 * law.off_closest, 100 * law.off_farthest);
  if (law.fair())
    return fmt::format("F ~ exp(-gap/l) is a fair description of {}: {} at the ends of the window.",
                       what, range);
  return fmt::format(
      "F ~ exp(-gap/l) is a poor description of {}: {} at the ends of the window. Do not use Eq. "
      "(16) here.",
      what, range);
}

}  // namespace salebra::cli
