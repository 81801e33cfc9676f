// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/units.hpp>
#include <string>
#include <string_view>

namespace salebra {

/// The base units of a program that has none of its own, such as mm, t, s. Every other unit follows
/// from them by the exponents of its dimension: force is length·mass/time².
struct UnitSystem {
  std::string length = "m", mass = "kg", time = "s";

  /// One of its units of a dimension in SI: 1e6 Pa for mm, t, s. Throws InvalidInput for a dimension
  /// that is not of mechanics, such as an angle in degrees.
  double in_si(Dimension dimension) const;
  /// "mm, t, s".
  std::string text() const { return length + ", " + mass + ", " + time; }
};

/// From "m,kg,s": a length of m, cm, mm, um, nm, a mass of kg, g, mg, t, and a time of s, ms, us, in
/// this order. Throws InvalidInput for anything else.
UnitSystem parse_unit_system(std::string_view text, std::string_view field = "units");

}  // namespace salebra
