// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Names of enumeration values, as written in study files, result files and Python; options use "-"
/// instead of "_". Each list follows its enumeration.
///     const std::string_view name = name_of(Boundary::periodic);
///     const std::optional<Boundary> boundary = parse_enum<Boundary>("free");
namespace salebra {

template <class Enum>
struct EnumNames;  ///< values: pairs (value, name)

/// Returns the name of a value.
template <class Enum>
std::string_view name_of(Enum value) {
  return std::ranges::find(EnumNames<Enum>::values, value,
                           &std::pair<Enum, std::string_view>::first)
      ->second;
}

/// Returns all names of an enumeration, in the order of its EnumNames.
template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> all;
  for (const auto& [value, word] : EnumNames<Enum>::values) all.emplace_back(word);
  return all;
}

/// Returns the value of an enumeration that has the given name ('-' and '_' count as equal); empty
/// if there is none.
template <class Enum>
std::optional<Enum> parse_enum(std::string word) {
  std::ranges::replace(word, '-', '_');
  for (const auto& [value, known] : EnumNames<Enum>::values)
    if (known == word) return value;
  return {};
}

}  // namespace salebra
