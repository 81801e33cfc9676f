// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/units.hpp>
#include <string>
#include <string_view>

namespace salebra {

/// Base units of length, mass and time for a program without a unit system of its own, such as mm,
/// t, s. All other units follow from these, e.g. force = length·mass/time².
struct UnitSystem {
  std::string length = "m", mass = "kg", time = "s";

  /// Returns the SI value of the unit of a dimension, e.g. 1e6 (Pa) for a pressure in mm, t, s.
  /// The unit of temperature is 1 K. Throws InvalidInput for a dimension that no deck has, such as an
  /// angle in degrees.
  double in_si(Dimension dimension) const;
  /// Returns the three units as text, e.g. "mm, t, s".
  std::string text() const { return length + ", " + mass + ", " + time; }
};

/// Parses a unit system, with the order length, mass, time:
///     const double pascals = parse_unit_system("mm,t,s").in_si(Dimension::pressure);
/// Lengths are m, cm, mm, um, nm; masses kg, g, mg, t; times s, ms, us. Throws InvalidInput for
/// anything else.
UnitSystem parse_unit_system(std::string_view text, std::string_view field = "units");

}  // namespace salebra
