// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <salebra/damping/assumptions.hpp>

namespace salebra::detail {

/// Sets the verdict from the value and the limits for 5 % and 20 % of the assumption. An unknown
/// value leaves the verdict as it is. large_is_good: the assumption holds above its limits, not
/// below.
inline void judge(Assumption& assumption, bool large_is_good = false) {
  const double value = assumption.value;
  if (std::isnan(value)) return;
  const auto beyond = [&](double limit) { return large_is_good ? value < limit : value > limit; };
  assumption.verdict = beyond(assumption.limit_20_percent)  ? Verdict::broken
                       : beyond(assumption.limit_5_percent) ? Verdict::doubtful
                                                            : Verdict::holds;
}

/// The assumption on plasticity for the largest force of a motion. First loadings and motions give
/// this force with a relative accuracy of 0.02.
Assumption plasticity_of(const ContactParameters& parameters, double peak_force);

}  // namespace salebra::detail
