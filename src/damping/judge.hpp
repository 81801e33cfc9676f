// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/damping/assumptions.hpp>

namespace salebra::detail {

/// The verdict on a value by the two limits beside it; a value that is not known leaves it as it is.
inline void judge(Assumption& assumption, bool large_is_good = false) {
  const double value = assumption.value;
  if (std::isnan(value)) return;
  const auto beyond = [&](double limit) { return large_is_good ? value < limit : value > limit; };
  assumption.verdict = beyond(assumption.limit_20_percent)  ? Verdict::broken
                    : beyond(assumption.limit_5_percent) ? Verdict::doubtful
                                                      : Verdict::holds;
}

}  // namespace salebra::detail
