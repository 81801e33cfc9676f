// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <salebra/base/units.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace salebra {

/// What a column of a table holds.
struct TableColumn {
  std::string_view name;
  Dimension dimension;
  std::vector<std::string_view> also = {};  ///< other titles of it, in lower case
};

struct NumberTable {
  std::vector<std::vector<double>> columns;  ///< in the order that was asked for, in SI units
  bool has_units = false;                    ///< the titles name them
};

/// Reads the columns of a text table of numbers: profiles (r, f), trajectories (t, δ, x). Values
/// are separated by blanks, ',' or ';'; empty lines are passed over. One line of titles may come
/// first, behind a '#' or not: it names each column, in any order, with its unit or all without,
/// which is SI.
/// columns   what there must be in each line
/// least     so many of them are enough; 0: all
/// throws    InvalidInput naming file and line; for a title that is none of the columns, a unit
///           that is none of its quantity, and a comment with a unit that is not used
NumberTable read_number_table(const std::filesystem::path& file,
                              const std::vector<TableColumn>& columns, std::size_t least = 0);

/// Columns of a table with a power spectral density.
inline std::vector<TableColumn> spectrum_columns(Dimension density) {
  return {{"wavenumber", Dimension::wavenumber, {"q", "wavevector", "wave number", "wave vector"}},
          {"psd", density, {"c", "spectral density", "power spectral density"}}};
}

namespace detail {

/// A title of a column: "time [ms]", "time (ms)", "time/ms" or "time".
struct ColumnTitle {
  std::string_view name;
  std::string_view unit;  ///< empty: none
};
/// Throws InvalidInput for a bracket that does not close.
ColumnTitle column_title(const std::filesystem::path& file, std::string_view title);

/// Splits a line of titles at commas or semicolons, or else at tabs, or else at blanks that are not
/// before or within brackets. Cost: one pass.
std::vector<std::string_view> titles_of(std::string_view line);

/// SI value of the unit of a column; 1 where it has none. Throws InvalidInput where the unit is
/// none of the dimension.
double factor_of(const std::filesystem::path& file, const ColumnTitle& title, Dimension dimension);

/// Refuses titles of which some with a dimension have a unit and some have none.
class UnitsOfTitles {
 public:
  explicit UnitsOfTitles(std::filesystem::path file) : file_(std::move(file)) {}
  void add(const ColumnTitle& title, Dimension dimension);
  bool has_units() const { return !with_.empty(); }

 private:
  std::filesystem::path file_;
  std::string with_, without_;  ///< names of columns
};

}  // namespace detail
}  // namespace salebra
