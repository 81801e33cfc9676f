// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/damping/premises.hpp>

namespace salebra::detail {

/// The verdict on a value by the two limits beside it; a value that is not known leaves it as it is.
inline void judge(Premise& premise, bool large_is_good = false) {
  const double value = premise.value;
  if (std::isnan(value)) return;
  const auto beyond = [&](double limit) { return large_is_good ? value < limit : value > limit; };
  premise.verdict = beyond(premise.limit_20_percent)  ? Verdict::broken
                    : beyond(premise.limit_5_percent) ? Verdict::doubtful
                                                      : Verdict::holds;
}

}  // namespace salebra::detail
