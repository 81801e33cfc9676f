// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/dissipation.hpp>
#include <variant>

namespace salebra::python {

inline Oscillation oscillation(const std::variant<EqualFrequency, Drag>& motion) {
  return std::visit([](const auto& one) { return Oscillation(one); }, motion);
}

inline Trajectory trajectory(const std::variant<EqualFrequency, Drag>& motion,
                             double mean_indentation) {
  return trajectory_of(oscillation(motion), mean_indentation);
}

/// function(Oscillation) or function(TwoFrequencies).
template <class Function>
auto with_motion(const Motion& motion, const Function& function) {
  if (const auto one = oscillation_of(motion)) return function(*one);
  return function(std::get<TwoFrequencies>(motion));
}

/// Where the contact stands: exactly one of the two keywords.
inline Position position_of(std::optional<double> indentation, std::optional<double> force) {
  require_one(indentation.has_value(), "indentation", force.has_value(), "force");
  if (force) return AtForce{*force};
  return AtIndentation{*indentation};
}

}  // namespace salebra::python
