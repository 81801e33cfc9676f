// SPDX-License-Identifier: GPL-3.0-or-later
// JSON answers as aligned text with units.
#include "text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "result_tables.hpp"
#include "terminal.hpp"

namespace salebra::cli {
namespace {

std::string cell(const Json& value, Dimension dimension) {
  if (value.is_null()) return "n/a";
  if (value.is_boolean()) return value.truth() ? "yes" : "no";
  if (value.is_number_float()) return format_quantity(value.number(), dimension);
  if (value.is_string()) return value.text();
  return value.dump();
}

/// Columns of equal length of a table; the first entry of each is its heading.
using Columns = std::vector<std::vector<std::string>>;

std::string columns_to_table(const Columns& columns, int indent) {
  std::vector<std::vector<std::string>> rows(columns.front().size());
  for (const auto& column : columns)
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row].push_back(column[row]);
  return to_table(rows, indent);
}

/// Table of a list of JSON objects with the same keys, one row for each object.
std::string rows_to_table(const Json& list, const std::string& object, int indent) {
  Columns columns;
  for (const auto& [key, first] : list[0].items()) {
    std::vector<std::string>& column = columns.emplace_back(1, key);
    for (const Json& row : list.elements())
      column.push_back(cell(row[key], quantity_of(key, object).dimension));
  }
  return columns_to_table(columns, indent);
}

/// Whether a value is printed on one line: any value except an object or a list of numbers.
bool is_line(const Json& value) {
  return !value.is_structured() || (value.is_array() && !value.empty() && value[0].is_string());
}

void append(std::string& text, const Json& object, const std::string& name, int indent) {
  std::size_t key_width = 0;
  for (const auto& [key, value] : object.items())
    if (is_line(value)) key_width = std::max(key_width, key.size());
  // Lists of different lengths go into different tables.
  std::vector<Columns> tables;
  for (const auto& [key, value] : object.items()) {
    const Dimension dimension = quantity_of(key, name).dimension;
    if (is_line(value)) {
      std::string words;
      if (value.is_array())
        for (const Json& word : value.elements())
          words += (words.empty() ? "" : ", ") + word.text();
      else
        words = cell(value, dimension);
      text += fmt::format("{:{}}{:<{}}  {}\n", "", indent, key, key_width, words);
    } else if (value.is_object()) {
      text += fmt::format("{:{}}{}\n", "", indent, key);
      append(text, value, key, indent + 2);
    } else if (!value.empty() && value[0].is_object()) {
      text += fmt::format("{:{}}{}\n{}", "", indent, key, rows_to_table(value, key, indent + 2));
    } else {
      std::vector<std::string> column{key};
      for (const Json& item : value.elements()) column.push_back(cell(item, dimension));
      const auto alike = std::ranges::find_if(
          tables, [&](const Columns& table) { return table[0].size() == column.size(); });
      (alike == tables.end() ? tables.emplace_back() : *alike).push_back(std::move(column));
    }
  }
  for (const Columns& table : tables) text += columns_to_table(table, indent);
}

/// Divides the columns of a table into parts that fit the width of the text. Each part begins with
/// the first column.
std::vector<std::vector<std::size_t>> parts_of(const std::vector<std::size_t>& widths,
                                               std::size_t indent) {
  const std::size_t line_width = text_width();
  std::vector<std::vector<std::size_t>> parts(1);
  std::size_t used = indent;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    if (parts.back().size() > (parts.size() > 1 ? 1 : 0) && used + 2 + widths[i] > line_width) {
      parts.push_back({0});
      used = indent + widths[0];
    }
    used += widths[i] + (parts.back().empty() ? 0 : 2);
    parts.back().push_back(i);
  }
  return parts;
}

}  // namespace

std::string to_table(const std::vector<std::vector<std::string>>& rows, int indent,
                     bool names_first) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i)
      widths[i] = std::max(widths[i], columns_of(row[i]));
  }
  std::string text;
  for (const std::vector<std::size_t>& part : parts_of(widths, std::size_t(indent))) {
    if (!text.empty()) text += "\n";
    for (const auto& row : rows) {
      std::string line(std::size_t(indent), ' ');
      for (const std::size_t i : part) {
        if (i >= row.size()) break;
        const std::string padding(widths[i] - columns_of(row[i]), ' ');
        // Names are left-aligned, numbers right-aligned.
        line += i == 0 && names_first ? row[i] + padding : padding + row[i];
        if (i != part.back()) line += "  ";
      }
      text += line + "\n";
    }
  }
  return text;
}

std::string to_text(const Json& object) {
  std::string text;
  append(text, object, "", 0);
  return text;
}

}  // namespace salebra::cli
