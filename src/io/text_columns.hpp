// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "text_header.hpp"
#include "text_rows.hpp"

/// What the columns of a text are: heights of a matrix, positions, coordinates, line numbers.
namespace salebra::detail {

/// Rows and columns beside the heights of a matrix, by their numbers.
struct Margins {
  bool row = false, column = false;      ///< the first ones are no heights
  std::optional<double> step_x, step_y;  ///< of coordinates in them; nothing where they count
  std::string fault;                     ///< why the rows are no matrix; empty where they may be
};

/// Numbers that count the rows and columns, or coordinates in the first row and column. It is a
/// fault where one of them is equally spaced and may be either.
Margins margins_of(const TextRows& rows);

/// Whether a column rises from row to row, or falls.
bool is_monotone(const TextRows& rows, Index column);

/// The columns that hold what a surface or a profile needs, by the titles.
struct Columns {
  std::optional<Index> x, y, z;  ///< of a profile x and z
  std::string x_unit, y_unit, z_unit;
  std::vector<std::string> warnings;
};

/// By titles, which there are as many as columns. Nothing where they say nothing of the columns.
/// Throws InvalidInput where they name a mask, several columns of heights or a column that is not
/// understood.
std::optional<Columns> columns_of(const std::filesystem::path& file, const TextRows& rows,
                                  const TextHeader& header);

}  // namespace salebra::detail
