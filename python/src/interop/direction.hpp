// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/surface/lay.hpp>
#include <string>
#include <variant>

/// The argument `direction` of Python: an angle in rad, or a text that direction_choice() reads.
namespace salebra::python {

inline DirectionChoice direction_of(const std::variant<double, std::string>& direction) {
  if (const double* angle = std::get_if<double>(&direction)) return *angle;
  return direction_choice(std::get<std::string>(direction), "direction");
}

}  // namespace salebra::python
