// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace salebra::cli {

/// How well F ∝ exp(−ū/l) describes a curve. Residuals of a computed curve are the misfit of the
/// law, not scatter, so that no probability belongs to them: what counts is the local l at the two
/// ends of the window, and F'' = F/l² there, which Eqs (12) and (16) rest on.
struct LawDescription {
  double off_closest =
      0;  ///< (l_local/l)² − 1: how far F/l² is off the local F'', at the closest gap of the window
  double off_farthest = 0;  ///< at the farthest

  /// Within a factor of two at both ends.
  bool fair() const;
};

/// l of the fit, and the local l at the ends of its window, in any one unit.
LawDescription describe_law(double decay_length, double closest, double farthest);

/// One sentence: "F ~ exp(-gap/l) is a poor description of this surface: …". what: "this surface",
/// "this curve".
std::string in_words(const LawDescription& law, const std::string& what);

}  // namespace salebra::cli
