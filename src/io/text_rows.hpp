// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

#include "text_header.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {

/// The numbers of a text, and the lines around them.
struct TextRows {
  std::vector<double> values;  ///< all values, one row after the other
  Index columns = 0, rows = 0;
  std::vector<HeaderLine> lines;    ///< lines without numbers
  std::vector<HeaderLine> leading;  ///< lines with fewer numbers than the rows, before the rows
  /// Names a line between the rows, after which another matrix may begin; empty if there is none.
  std::string interruption;
  bool decimal_points = false, decimal_commas = false, comma_separates = false;

  double operator()(Index row, Index column) const {
    return values[static_cast<std::size_t>(row * columns + column)];
  }
  void remove_first_row();
  void remove_column(Index column);
};

/// Reads the rows of a text. Throws InvalidInput if rows differ in length or contain anything but
/// numbers, and if a decimal mark may be a thousands separator.
TextRows read_rows(const std::filesystem::path& file, const Text& text);

}  // namespace salebra::detail
