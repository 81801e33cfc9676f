// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Words of enumerations, each listed below its enumeration: in study files, files and Python as
/// they are there, in options with "-" for "_".
namespace salebra {

template <class Enum>
struct EnumNames;  ///< values: pairs of a value and its word

/// The word of a value.
template <class Enum>
std::string_view name_of(Enum value) {
  return std::ranges::find(EnumNames<Enum>::values, value, &std::pair<Enum, std::string_view>::first)
      ->second;
}

/// The words of an enumeration, in its order.
template <class Enum>
std::vector<std::string> names_of() {
  std::vector<std::string> all;
  for (const auto& [value, word] : EnumNames<Enum>::values) all.emplace_back(word);
  return all;
}

/// The value of a word, of which '-' and '_' are the same; nothing where no value has it.
template <class Enum>
std::optional<Enum> parse_enum(std::string word) {
  std::ranges::replace(word, '-', '_');
  for (const auto& [value, known] : EnumNames<Enum>::values)
    if (known == word) return value;
  return {};
}

}  // namespace salebra
