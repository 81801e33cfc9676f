// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <salebra/base/units.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// A column that a table may have.
struct TableColumn {
  std::string_view name;
  Dimension dimension;
  std::vector<std::string_view> also = {};  ///< other allowed titles of the column, in lower case
};

struct NumberTable {
  /// In the order in which the columns were requested, in SI units.
  std::vector<std::vector<double>> columns;
  bool has_units = false;  ///< whether the titles state units
};

/// Reads the columns of a text table of numbers, such as profiles (r, f) and trajectories (t, δ,
/// x). Values are separated by blanks, ',' or ';'; empty lines are skipped. The first line may
/// contain titles, with or without '#' before them. Titles name each column, in any order, and
/// state a unit for every column or for none; without units all values are in SI units.
/// columns   the possible columns, in the order of the result
/// least     the first `least` columns are required, the others optional; 0: all are required
/// throws    InvalidInput naming file and line; also for a title of no such column, a unit of
///           another quantity, and a comment that seems to state units, which would be ignored
NumberTable read_number_table(const std::filesystem::path& file,
                              const std::vector<TableColumn>& columns, std::size_t least = 0);

/// Columns of a table with a power spectral density.
inline std::vector<TableColumn> spectrum_columns(Dimension density) {
  return {{"wavenumber", Dimension::wavenumber, {"q", "wavevector", "wave number", "wave vector"}},
          {"psd", density, {"c", "spectral density", "power spectral density"}}};
}

namespace detail {

/// The title of a column, from "time [ms]", "time (ms)", "time/ms" or "time".
struct ColumnTitle {
  std::string_view name;
  std::string_view unit;  ///< empty: the title states none
};
/// Splits a title into name and unit. Throws InvalidInput for a bracket that does not close.
ColumnTitle column_title(const std::filesystem::path& file, std::string_view title);

/// Splits a line of titles at commas or semicolons; if it has none, at tabs; if it has no tabs
/// either, at blanks that are not before or within brackets. Cost: one pass.
std::vector<std::string_view> titles_of(std::string_view line);

/// The unit of a column in SI units; 1 if the title states none. Throws InvalidInput if the unit is
/// not of this dimension.
double factor_of(const std::filesystem::path& file, const ColumnTitle& title, Dimension dimension);

/// Throws InvalidInput for titles of which some state a unit and others, of columns with a
/// dimension, do not.
class UnitsOfTitles {
 public:
  explicit UnitsOfTitles(std::filesystem::path file) : file_(std::move(file)) {}
  void add(const ColumnTitle& title, Dimension dimension);
  bool has_units() const { return !with_.empty(); }

 private:
  std::filesystem::path file_;
  std::string with_, without_;  ///< titles of columns with and without a unit
};

}  // namespace detail
}  // namespace salebra
