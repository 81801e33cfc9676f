// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from a text matrix, with the headers of Gwyddion and of instruments.
#include <charconv>
#include <cmath>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <utility>

#include "loaded_surface.hpp"
#include "text_numbers.hpp"
#include "xyz.hpp"

namespace salebra::detail {
namespace {

struct TextHeader {
  std::optional<double> width, height;  ///< of the scan, m
  std::optional<double> pixel_size;     ///< m
  std::optional<double> height_factor;  ///< metres per value
  std::optional<Index> columns, rows;   ///< as declared
  std::optional<Index>
      points;  ///< as declared; without it a text that was cut between lines is whole
  std::string value_unit;
  std::string lateral_unit;  ///< of x and y in XYZ points
};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& symbol : result)
    if (symbol >= 'A' && symbol <= 'Z') symbol = static_cast<char>(symbol - 'A' + 'a');
  return result;
}

/// The length that a header states, where it has a unit: a bare "width = 256" may well count
/// points.
std::optional<double> stated_length(std::string_view text) {
  double number;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (status != std::errc{} || end == text.data() + text.size()) return {};
  try {
    return parse_quantity(text, Dimension::length, "length");
  } catch (const InvalidInput&) {
    return {};
  }
}

std::optional<Index> stated_count(std::string_view text) {
  Index count = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (status != std::errc{} || end != text.data() + text.size()) return {};
  return count;
}

void read_entry(const std::filesystem::path& file, std::string_view key, std::string_view value,
                TextHeader& header) {
  const std::string name = lower(trimmed(key));
  value = trimmed(value);
  if (name == "width" || name == "breite") {
    header.width = stated_length(value);
  } else if (name == "height" || name == "höhe") {
    header.height = stated_length(value);
  } else if (name == "pixel size") {
    header.pixel_size = stated_length(value);
  } else if (name == "w") {
    header.columns = stated_count(value);
  } else if (name == "h") {
    header.rows = stated_count(value);
  } else if (name == "points") {
    header.points = stated_count(value);
  } else if (name == "value units" || name == "data unit") {
    header.value_unit = value;
  } else if (name == "lateral units") {
    header.lateral_unit = value;
  } else if (name.starts_with("height conversion factor")) {
    double factor;
    const auto [end, status] = std::from_chars(value.data(), value.data() + value.size(), factor);
    if (status != std::errc{} || end != value.data() + value.size() || !std::isfinite(factor) ||
        factor == 0)
      refuse(file, "has the height conversion factor '" + std::string(value) + "'; correct it");
    const auto arrow = name.find("-> "), close = name.find(')');
    if (arrow == std::string::npos || close == std::string::npos || close < arrow + 3)
      refuse(file, "does not say what its height conversion factor converts to; write '(-> m)'");
    header.height_factor =
        factor *
        metres_per(file, std::string(trimmed(key.substr(key.find("-> ") + 3, close - arrow - 3))));
  }
}

/// "# Key: value", "key=value" or several "key=value" separated by blanks.
void read_header_line(const std::filesystem::path& file, std::string_view line,
                      TextHeader& header) {
  const std::string decoded = utf8(line);
  std::string_view text = trimmed(decoded);
  while (!text.empty() && (text.front() == '#' || text.front() == '%')) text.remove_prefix(1);
  const auto separator = text.find_first_of(":=");
  if (separator == std::string_view::npos) return;
  const auto second = text.find('=', separator + 1);
  if (text[separator] != '=' || second == std::string_view::npos) {
    read_entry(file, text.substr(0, separator), text.substr(separator + 1), header);
    return;
  }
  while (!text.empty()) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(" \t"));
    text.remove_prefix(word.size());
    if (const auto equals = word.find('='); equals != std::string_view::npos)
      read_entry(file, word.substr(0, equals), word.substr(equals + 1), header);
  }
}

struct TextMatrix {
  std::vector<double> values;  ///< row after row
  Index columns = 0, rows = 0;
};

TextMatrix read_rows(const std::filesystem::path& file, std::string_view text, TextHeader& header) {
  TextMatrix matrix;
  std::optional<NumberFormat> format;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view content = trimmed(line);
    if (content.empty()) continue;
    const bool comment = content.front() == '#' || content.front() == '%';
    if (comment || (matrix.rows == 0 && !starts_with_number(content))) {
      if (matrix.rows == 0) read_header_line(file, content, header);
      continue;
    }
    settle_format(file, content, lines.number(), format);
    const std::size_t before = matrix.values.size();
    append_numbers(file, content, lines.number(), *format, matrix.values);
    const auto columns = static_cast<Index>(matrix.values.size() - before);
    if (matrix.rows == 0) matrix.columns = columns;
    if (columns != matrix.columns)
      refuse(file, "line " + std::to_string(lines.number()) + " holds " + std::to_string(columns) +
                       " values where the first row holds " + std::to_string(matrix.columns) +
                       "; the file is truncated or no matrix");
    ++matrix.rows;
  }
  if (matrix.rows == 0)
    refuse(file, "holds no numbers and is in no format that is known; name a surface file");
  const auto check = [&](const std::optional<Index>& declared, Index found, const char* what) {
    if (declared && *declared != found)
      refuse(file, "declares " + std::to_string(*declared) + what + " but holds " +
                       std::to_string(found) + "; it is truncated or its header is wrong");
  };
  check(header.columns, matrix.columns, " columns");
  check(header.rows, matrix.rows, " rows");
  return matrix;
}

}  // namespace

LoadedSurface read_text(const std::filesystem::path& file, std::string_view content) {
  TextHeader header;
  const TextMatrix matrix = read_rows(file, require_text(file, content), header);
  const bool are_points = matrix.columns == 3 && !header.width && !header.pixel_size;
  if (const Index found = matrix.rows * (are_points ? 1 : matrix.columns);
      header.points && *header.points != found)
    refuse(file, "declares " + std::to_string(*header.points) + " points but holds " +
                     std::to_string(found) + "; it is truncated or its header is wrong");
  LoadedSurface surface;
  if (are_points) {
    surface = grid_of_points(file, matrix.values);
    if (!header.lateral_unit.empty()) scale_plane(file, header.lateral_unit, surface);
  } else {
    surface.heights =
        Eigen::Map<const Field>(matrix.values.data(), matrix.rows, matrix.columns).transpose();
  }
  if (header.height_factor)
    surface.heights *= *header.height_factor;
  else
    surface.unit = header.value_unit;
  if (header.pixel_size) {
    surface.size_x = *header.pixel_size * static_cast<double>(matrix.columns);
    surface.size_y = *header.pixel_size * static_cast<double>(matrix.rows);
  }
  if (header.width) surface.size_x = header.width;
  if (header.height) surface.size_y = header.height;
  return surface;
}

}  // namespace salebra::detail
