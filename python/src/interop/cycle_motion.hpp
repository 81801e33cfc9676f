// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/cycle.hpp>
#include <variant>

namespace salebra::python {

inline Oscillation oscillation(const std::variant<EqualFrequency, Drag>& motion) {
  return std::visit([](const auto& one) { return Oscillation(one); }, motion);
}

inline Trajectory trajectory(const std::variant<EqualFrequency, Drag>& motion,
                             double mean_indentation) {
  return trajectory_of(oscillation(motion), mean_indentation);
}

}  // namespace salebra::python
