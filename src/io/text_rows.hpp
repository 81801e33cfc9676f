// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <salebra/base/grid.hpp>
#include <string>
#include <vector>

#include "text_header.hpp"
#include "text_numbers.hpp"

namespace salebra::detail {

/// The numbers of a text, and the lines beside them.
struct TextRows {
  std::vector<double> values;  ///< row after row
  Index columns = 0, rows = 0;
  std::vector<HeaderLine> lines;    ///< without numbers
  std::vector<HeaderLine> leading;  ///< numbers before the rows, of another length than these
  std::string interruption;  ///< of the rows, by a line without numbers; empty where there is none
  bool decimal_points = false, decimal_commas = false, comma_separates = false;

  double operator()(Index row, Index column) const {
    return values[static_cast<std::size_t>(row * columns + column)];
  }
  void remove_first_row();
  void remove_column(Index column);
};

/// Throws InvalidInput where rows differ in length or hold something else than numbers, and where
/// their marks may be those of thousands.
TextRows read_rows(const std::filesystem::path& file, const Text& text);

}  // namespace salebra::detail
