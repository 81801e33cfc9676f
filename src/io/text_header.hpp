// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <salebra/base/grid.hpp>
#include <string>
#include <string_view>

namespace salebra::detail {

/// What the lines before the numbers of a text say.
struct TextHeader {
  std::optional<double> width, height;     ///< of the scan, m
  std::optional<double> pixel_x, pixel_y;  ///< distance of the points, m
  std::optional<double> height_factor;     ///< metres per value
  std::optional<Index> columns, rows;      ///< as declared
  std::optional<Index>
      points;              ///< as declared; without it a text that was cut between lines is whole
  std::string value_unit;  ///< of the heights
  std::string x_unit, y_unit;  ///< of x and y in XYZ points

  int unused = 0;             ///< lines that name a length of which nothing was taken
  int first_unused = 0;       ///< number of the first of them
  std::string unused_line{};  ///< its text

  /// One line on the unused; empty where there are none.
  std::string remark() const;
};

/// Takes in one line of the header:
///     # Key: value      key=value key=value      Key;value      names of columns with units
/// Keys are those of Gwyddion and of instruments, in English and German: sizes, distances of points
/// and units, of x, y and z or of all. Units beside the names of columns: "X [µm]", "z (nm)",
/// "z/nm", "Z µm", "x in mm", or in a line of their own below the names. `number` is the line's.
/// Throws InvalidInput for a unit of the heights that is no length.
void read_header_line(const std::filesystem::path& file, std::string_view line, int number,
                      TextHeader& header);

}  // namespace salebra::detail
