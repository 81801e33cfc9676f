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

/// Calls function(EqualFrequency or Drag as Oscillation) or function(TwoFrequencies).
template <class Function>
auto with_motion(const Motion& motion, const Function& function) {
  if (const auto one = oscillation_of(motion)) return function(*one);
  return function(std::get<TwoFrequencies>(motion));
}

/// The operating point on a contact law, of which the user must give exactly one of the two
/// quantities.
inline OperatingPoint operating_point_of(std::optional<double> indentation,
                                         std::optional<double> force) {
  require_one(indentation.has_value(), "indentation", force.has_value(), "force");
  if (force) return at_force(*force);
  return at_indentation(*indentation);
}

/// The operating point of a surface, of which the user must give exactly one of the four
/// quantities.
inline OperatingPoint operating_point_of(std::optional<double> pressure,
                                         std::optional<double> mean_gap,
                                         std::optional<double> indentation,
                                         std::optional<double> force) {
  require_that(
      pressure.has_value() + mean_gap.has_value() + indentation.has_value() + force.has_value() ==
          1,
      "operating point",
      "exactly one of `pressure`, `mean_gap`, `indentation` and `force` must be given");
  if (pressure) return at_pressure(*pressure);
  if (mean_gap) return at_mean_gap(*mean_gap);
  if (indentation) return at_indentation(*indentation);
  return at_force(*force);
}

}  // namespace salebra::python
