// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "text_header.hpp"
#include "text_rows.hpp"

/// Decides what the columns of a text contain: heights of a matrix, positions, coordinates or
/// numbers of lines.
namespace salebra::detail {

/// Whether the first row and the first column of a matrix contain labels instead of heights.
struct Margins {
  /// Whether the first row, the first column contains labels.
  bool row = false, column = false;
  /// Step of the coordinates in the labels; empty: the labels only count.
  std::optional<double> step_x, step_y;
  std::string fault;  ///< why the rows cannot be a matrix; empty if they can
};

/// Finds out from the numbers whether the first row and the first column are labels: they count the
/// columns and rows, or contain coordinates. Sets `fault` if an equally spaced row or column may be
/// labels or heights.
Margins margins_of(const TextRows& rows);

/// Whether the numbers of a column rise from each row to the next, or fall from each row to the
/// next.
bool is_monotone(const TextRows& rows, Index column);

/// Indices and units of the columns that contain a surface (x, y, z) or a profile (x, z).
struct Columns {
  std::optional<Index> x, y, z;  ///< a profile has only x and z
  std::string x_unit, y_unit, z_unit;
  std::vector<std::string> warnings;
};

/// Finds the columns by the titles in the header, which has one title for each column. Nothing if
/// the titles do not name the columns needed. Throws InvalidInput if they name a mask, several
/// columns of heights, or a column that is not understood.
std::optional<Columns> columns_of(const std::filesystem::path& file, const TextRows& rows,
                                  const TextHeader& header);

}  // namespace salebra::detail
