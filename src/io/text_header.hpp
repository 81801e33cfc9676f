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

/// A line of a text file that contains no numbers of the surface.
struct HeaderLine {
  int number;
  std::string text;
};

/// Properties of the numbers of a text file that help to understand its header.
struct NumberLayout {
  /// Number of all columns, and of all lines of numbers.
  Index titled_columns = 0, lines = 0;
  /// Numbers of columns and rows without those that only count.
  Index columns = 0, rows = 0;
  /// Whether some number of the file has a decimal point, a decimal comma.
  bool decimal_points = false, decimal_commas = false;
  bool comma_separates = false;
};

/// The name of a column, and its unit.
struct HeaderTitle {
  Meaning meaning = 0;    ///< meanings of the name; 0 if the column has none
  std::string unit = {};  ///< as written; empty if there is none
  std::string text = {};
};

/// A length that the header states.
struct StatedLength {
  double number = 0;                  ///< the number as the file states it
  double half_digit = 0;              ///< half of the place value of its last digit
  std::optional<double> metres = {};  ///< the length, m; nothing if it has no unit
  std::string quote = {};             ///< the line that states it, for messages
};

/// A number of points that the header states.
struct StatedCount {
  Index count;
  std::string quote;
};

/// What the lines around the numbers state.
struct TextHeader {
  std::optional<StatedLength> width, height;     ///< size of the scan along x and along y
  std::optional<StatedLength> pixel_x, pixel_y;  ///< distance of the points along x and along y
  std::optional<StatedLength> length;            ///< length of a profile
  std::optional<double> height_factor;           ///< metres per value
  std::vector<StatedCount> columns, rows;
  std::vector<StatedCount> points;  ///< number of all points, or along each axis of a square
  std::vector<double> missing;      ///< values that mark undefined points
  std::string x_unit, y_unit, value_unit;
  std::string common_unit;          ///< unit of those axes for which no unit of their own is stated
  std::vector<HeaderTitle> titles;  ///< one for each column; empty if no line names them
  std::string titles_quote;
  /// Quotes of the lines that contain a unit or a number and were not understood.
  std::vector<std::string> unaccounted;
};

/// Reads the lines around the numbers of a text file. Forms of lines:
///     # Key: value      key=value key=value      Key;value      names of columns with units
/// A unit or number in these lines is used, or is known to be irrelevant (dates, serial numbers,
/// magnifications), or its line is added to TextHeader::unaccounted. Throws InvalidInput if lines
/// contradict each other.
TextHeader read_header(const std::filesystem::path& file, const std::vector<HeaderLine>& lines,
                       const NumberLayout& layout);

}  // namespace salebra::detail
