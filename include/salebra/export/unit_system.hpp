// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/units.hpp>
#include <string>
#include <string_view>

namespace salebra {

/// Base units of a program without units of its own, such as mm, t, s. Every other unit follows
/// from the exponents of its dimension: force is length·mass/time².
struct UnitSystem {
  std::string length = "m", mass = "kg", time = "s";

  /// Returns the SI value of one unit of a dimension: 1e6 Pa for mm, t, s. Throws InvalidInput for
  /// a dimension that is not mechanical, such as an angle in degrees.
  double in_si(Dimension dimension) const;
  /// "mm, t, s".
  std::string text() const { return length + ", " + mass + ", " + time; }
};

/// Parses a unit system, with the order length, mass, time:
///     const double pascals = parse_unit_system("mm,t,s").in_si(Dimension::pressure);
/// Lengths are m, cm, mm, um, nm; masses kg, g, mg, t; times s, ms, us. Throws InvalidInput for
/// anything else.
UnitSystem parse_unit_system(std::string_view text, std::string_view field = "units");

}  // namespace salebra
