// SPDX-License-Identifier: GPL-3.0-or-later
// Consistent unit systems: the units of all dimensions follow from those of length, mass and time.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/export/unit_system.hpp>
#include <utility>
#include <vector>

namespace salebra {
namespace {

using BaseUnit = std::pair<std::string_view, double>;

constexpr std::array<BaseUnit, 5> lengths{
    {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"nm", 1e-9}}};
constexpr std::array<BaseUnit, 4> masses{{{"kg", 1}, {"g", 1e-3}, {"mg", 1e-6}, {"t", 1e3}}};
constexpr std::array<BaseUnit, 3> times{{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}}};

template <std::size_t N>
double base(const std::array<BaseUnit, N>& units, std::string_view name, std::string_view field,
            std::string_view what) {
  const auto* found = std::ranges::find(units, name, &BaseUnit::first);
  if (found != units.end()) return found->second;
  std::string known;
  for (const BaseUnit& unit : units) known += (known.empty() ? "" : ", ") + std::string(unit.first);
  throw InvalidInput(field, std::string(name),
                     fmt::format("is not a unit of {}; known are {}, as in mm,t,s", what, known));
}

struct Exponents {
  int length, mass, time;
};

Exponents exponents_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::dimensionless:
      return {0, 0, 0};
    case Dimension::length:
      return {1, 0, 0};
    case Dimension::length_squared:
      return {2, 0, 0};
    case Dimension::pressure:
      return {-1, 1, -2};
    case Dimension::force:
      return {1, 1, -2};
    case Dimension::stiffness:
      return {0, 1, -2};
    case Dimension::stiffness_per_area:
      return {-2, 1, -2};
    case Dimension::energy:
      return {2, 1, -2};
    case Dimension::thermal_conductance:
      return {0, 1, -3};
    default:
      throw InvalidInput("dimension", si_unit(dimension), "has no unit in a deck");
  }
}

}  // namespace

double UnitSystem::in_si(Dimension dimension) const {
  const Exponents powers = exponents_of(dimension);
  return std::pow(base(lengths, length, "length", "length"), powers.length) *
         std::pow(base(masses, mass, "mass", "mass"), powers.mass) *
         std::pow(base(times, time, "time", "time"), powers.time);
}

UnitSystem parse_unit_system(std::string_view text, std::string_view field) {
  std::vector<std::string> parts(1);
  for (const char symbol : text)
    if (symbol == ',')
      parts.emplace_back();
    else if (symbol != ' ')
      parts.back() += symbol;
  require(parts.size() == 3, field, text, "must be a length, a mass and a time, as in mm,t,s");
  base(lengths, parts[0], field, "length");
  base(masses, parts[1], field, "mass");
  base(times, parts[2], field, "time");
  return {parts[0], parts[1], parts[2]};
}

}  // namespace salebra
