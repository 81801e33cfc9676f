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
struct Words;  ///< values: pairs of a value and its word

/// The word of a value.
template <class Enum>
std::string_view word_of(Enum value) {
  return std::ranges::find(Words<Enum>::values, value, &std::pair<Enum, std::string_view>::first)
      ->second;
}

/// The words of an enumeration, in its order.
template <class Enum>
std::vector<std::string> words_of() {
  std::vector<std::string> all;
  for (const auto& [value, word] : Words<Enum>::values) all.emplace_back(word);
  return all;
}

/// The value of a word, of which '-' and '_' are the same; nothing where no value has it.
template <class Enum>
std::optional<Enum> value_of(std::string word) {
  std::ranges::replace(word, '-', '_');
  for (const auto& [value, known] : Words<Enum>::values)
    if (known == word) return value;
  return {};
}

}  // namespace salebra
