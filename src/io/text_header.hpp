// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "header_words.hpp"

namespace salebra::detail {

/// A line of text that holds no numbers of the surface.
struct HeaderLine {
  int number;
  std::string text;
};

/// What the numbers show that a header is read by.
struct NumberLayout {
  Index titled_columns = 0, lines = 0;                  ///< in the file
  Index columns = 0, rows = 0;                          ///< without such that number them
  bool decimal_points = false, decimal_commas = false;  ///< whether numbers have shown them
  bool comma_separates = false;
};

/// The name of a column and its unit.
struct HeaderTitle {
  Meaning meaning = 0;    ///< 0 where the column has no name
  std::string unit = {};  ///< as written; empty where there is none
  std::string text = {};
};

/// A length that a header states.
struct StatedLength {
  double number = 0;                  ///< as written
  double half_digit = 0;              ///< half a unit of its last digit
  std::optional<double> metres = {};  ///< in its unit; nothing where it has none
  std::string quote = {};             ///< the line
};

/// A number of points that a header states.
struct StatedCount {
  Index count;
  std::string quote;
};

/// What the lines beside the numbers say.
struct TextHeader {
  std::optional<StatedLength> width, height;     ///< of the scan
  std::optional<StatedLength> pixel_x, pixel_y;  ///< distance of the points
  std::optional<StatedLength> length;            ///< of a profile
  std::optional<double> height_factor;           ///< metres per value
  std::vector<StatedCount> columns, rows;
  std::vector<StatedCount> points;  ///< in all, or along each axis of a square
  std::vector<double> missing;      ///< values that mark undefined points
  std::string x_unit, y_unit, value_unit;
  std::string common_unit;          ///< of the axes that have none of their own
  std::vector<HeaderTitle> titles;  ///< one for each column; empty where no line names them
  std::string titles_quote;
  /// Lines with a unit or a number that is not understood, quoted.
  std::vector<std::string> unaccounted;
};

/// Reads the lines beside the numbers:
///     # Key: value      key=value key=value      Key;value      names of columns with units
/// Each token that bears a unit or a number is used, known to say nothing about the numbers (dates,
/// serial numbers, magnifications), or its line is one of TextHeader::unaccounted.
/// Throws InvalidInput where lines contradict each other.
TextHeader read_header(const std::filesystem::path& file, const std::vector<HeaderLine>& lines,
                       const NumberLayout& layout);

}  // namespace salebra::detail
