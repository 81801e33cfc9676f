// SPDX-License-Identifier: GPL-3.0-or-later
// JSON answers as aligned text with units.
#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <salebra/base/quantity.hpp>

namespace salebra::cli {
namespace {

/// Characters, not bytes: "µ" takes two bytes and one column.
std::size_t width_of(std::string_view text) {
  return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string cell(const std::string& key, const Json& value) {
  if (value.is_null()) return "n/a";
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_integer()) return fmt::format("{}", value.get<long long>());
  if (value.is_number()) return format_quantity(value.get<double>(), find_quantity(key).dimension);
  if (value.is_string()) return value.get<std::string>();
  return value.dump();
}

void append(std::string& text, const Json& object, int indent) {
  std::size_t key_width = 0;
  for (const auto& [key, value] : object.items()) {
    if (!value.is_structured()) key_width = std::max(key_width, key.size());
  }
  std::vector<std::vector<std::string>> table;
  for (const auto& [key, value] : object.items()) {
    if (value.is_object()) {
      text += fmt::format("{:{}}{}\n", "", indent, key);
      append(text, value, indent + 2);
    } else if (value.is_array()) {
      table.resize(std::max(table.size(), value.size() + 1));
      for (std::size_t row = 0; row < table.size(); ++row) {
        const bool blank = row > value.size();
        table[row].push_back(row == 0 ? key : blank ? "" : cell(key, value[row - 1]));
      }
    } else {
      text += fmt::format("{:{}}{:<{}}  {}\n", "", indent, key, key_width, cell(key, value));
    }
  }
  text += to_table(table, indent);
}

}  // namespace

std::string to_table(const std::vector<std::vector<std::string>>& rows, int indent,
                     bool names_first) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line(std::size_t(indent), ' ');
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width_of(row[i]), ' ');
      // Names on the left, numbers on the right.
      line += i == 0 && names_first ? row[i] + padding : padding + row[i];
      if (i + 1 < row.size()) line += "  ";
    }
    text += line + "\n";
  }
  return text;
}

std::string to_text(const Json& object) {
  std::string text;
  append(text, object, 0);
  return text;
}

}  // namespace salebra::cli
