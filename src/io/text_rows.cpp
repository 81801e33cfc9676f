// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the rows of numbers of a text, and the other lines before, between and after them.
#include "text_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/memory.hpp"
#include "loaded_surface.hpp"
#include "surface_importer.hpp"

namespace salebra::detail {
namespace {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();
// Number of rows from which the memory for all rows is estimated.
constexpr Index enough_rows = 1024;

/// Reserves memory for the values of the whole text, if the fraction `share` of the text has been
/// read. A vector that grows step by step would copy its values each time.
void reserve_rows(TextRows& matrix, double share) {
  constexpr double longer = 1.02;
  const double wanted = longer * static_cast<double>(matrix.values.size()) / share;
  if (fits_into_memory(wanted * sizeof(double)))
    matrix.values.reserve(static_cast<std::size_t>(wanted));
}

/// Adds a column with an undefined value to all rows but the last, which already has the value and
/// is not counted yet.
void append_undefined_column(TextRows& matrix) {
  std::vector<double>& values = matrix.values;
  const Index columns = matrix.columns, rows = matrix.rows;
  const Index wider = columns + 1;
  const auto end_of = [&](Index row, Index width, Index count) {
    return values.begin() + row * width + count;
  };
  values.resize(static_cast<std::size_t>((rows + 1) * wider));
  std::copy_backward(end_of(rows, columns, 0), end_of(rows, columns, wider),
                     end_of(rows, wider, wider));
  for (Index row = rows - 1; row >= 0; --row) {
    std::copy_backward(end_of(row, columns, 0), end_of(row, columns, columns),
                       end_of(row, wider, columns));
    *end_of(row, wider, columns) = no_height;
  }
  matrix.columns = wider;
}

/// Whether values between tabs contain blanks, such as "1 234".
bool has_blanks_between_tabs(std::string_view row) {
  if (row.find('\t') == row.npos) return false;
  for (auto at = row.find(' '); at != row.npos; at = row.find(' ', at + 1)) {
    const bool begins = at == 0 || row[at - 1] == '\t' || row[at - 1] == ' ';
    const auto next = row.find_first_not_of(' ', at);
    if (!begins && next != row.npos && row[next] != '\t') return true;
  }
  return false;
}

/// Whether the numbers may be whole numbers whose supposed decimal mark is a thousands separator:
/// each has at most three digits before the mark and three after it. Some numbers must have the
/// mark, and some not.
bool look_like_thousands(const TextRows& matrix) {
  if (!matrix.decimal_points && !matrix.decimal_commas) return false;
  bool whole = false, marked = false;
  for (const double value : matrix.values) {
    if (std::isnan(value)) continue;
    const double size = std::abs(value);
    const double thousandths = 1000 * size;
    if (size >= 1000 || std::abs(thousandths - std::round(thousandths)) > 1e-9 * thousandths)
      return false;
    if (size == std::floor(size))
      whole = true;
    else if (size < 1)
      return false;
    else
      marked = true;
  }
  return whole && marked;
}

/// Answers the same question as look_like_thousands() from the text itself, in which "5.000" has a
/// mark and "5" has none.
bool are_thousands(const Text& text, char mark) {
  bool whole = false, marked = false;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.empty() || line.front() == '#' || line.front() == '%' || !starts_with_number(line))
      continue;
    const auto is_digit = [](char symbol) { return symbol >= '0' && symbol <= '9'; };
    for (std::size_t i = 0; i < line.size();) {
      if (!is_digit(line[i])) {
        ++i;
        continue;
      }
      std::size_t digits = 0, behind = 0;
      const bool zero = line[i] == '0';
      for (; i < line.size() && is_digit(line[i]); ++i) ++digits;
      if (i < line.size() && line[i] == mark)
        for (++i; i < line.size() && is_digit(line[i]); ++i) ++behind;
      if (behind == 0 && digits <= 3)
        whole = true;
      else if (behind == 3 && digits <= 3 && !zero)
        marked = true;
      else
        return false;
    }
  }
  return whole && marked;
}

/// Collects the lines between the rows, after which another matrix may begin.
class Interruptions {
 public:
  void line(const TextRows& matrix, int number, std::string_view content) {
    if (matrix.rows == 0) return;
    empty_ = empty_ || content.empty();
    if (!content.empty() && comment_.empty())
      comment_ =
          "line " + std::to_string(number) + ", '" + std::string(content.substr(0, 60)) + "'";
  }
  /// Must be called before each row is added to the matrix.
  void row(TextRows& matrix) {
    if (!comment_.empty() && matrix.interruption.empty()) matrix.interruption = comment_;
    if (empty_ && block_ == 0) block_ = matrix.rows;
    if (empty_) regular_ = regular_ && matrix.rows % block_ == 0;
    empty_ = false;
  }
  /// Must be called after the last row. Empty lines are taken to separate blocks of rows, unless an
  /// empty line follows every single row.
  void end(TextRows& matrix) const {
    if (matrix.interruption.empty() && block_ > 1 && regular_ && matrix.rows % block_ == 0)
      matrix.interruption = "the empty line after row " + std::to_string(block_);
  }

 private:
  std::string comment_;
  bool empty_ = false, regular_ = true;
  Index block_ = 0;  ///< number of rows before the first empty line
};

TextRows read_rows(const std::filesystem::path& file, const Text& text, bool tabs) {
  TextRows matrix;
  NumberReader reader(file, tabs);
  bool all_open = false;  // every row so far ends with a separator
  Lines lines(text);
  std::vector<HeaderLine> first_rows;
  Interruptions interruptions;
  // No header has more lines than this.
  constexpr std::size_t max_lines = 5000;
  for (std::string_view line; lines.next(line);) {
    const std::string_view content = trimmed(line);
    const bool comment = content.starts_with('#') || content.starts_with('%');
    if (content.empty() || comment) interruptions.line(matrix, lines.number(), content);
    if (content.empty()) continue;
    if (comment || (matrix.rows == 0 && !starts_with_number(content))) {
      if (matrix.lines.size() < max_lines)
        matrix.lines.push_back({lines.number(), std::string(without_spaces(line).substr(0, 4000))});
      else if (matrix.lines.size() == max_lines)
        matrix.lines.push_back({lines.number(), "more lines [m]"});
      continue;
    }
    if (matrix.rows == 0 && !tabs && has_blanks_between_tabs(content))
      return read_rows(file, text, true);
    interruptions.row(matrix);
    const std::size_t before = matrix.values.size();
    reader.append(line, lines.number(), matrix.values);
    auto columns = static_cast<Index>(matrix.values.size() - before);
    const bool open = reader.ends_with_separator(line);
    if (matrix.rows == 0) {
      matrix.columns = columns;
      all_open = open;
    }
    // A separator after the last value of every row has no meaning. If some rows end without it,
    // the others have an undefined value after it.
    if (all_open && !open && columns == matrix.columns + 1) {
      append_undefined_column(matrix);
    } else if (!all_open && open && columns == matrix.columns - 1) {
      matrix.values.push_back(no_height);
      ++columns;
    }
    all_open = all_open && open;
    if (columns != matrix.columns) {
      // If tabs separate the values, empty values were lost, since blanks and tabs were taken for
      // one separator. Reads the text again with a value between any two tabs.
      if (!tabs && !reader.symbol() && text.holds('\t')) return read_rows(file, text, true);
      // The short rows so far may state numbers of columns and rows that precede the matrix.
      constexpr Index max_counts = 3;
      if (matrix.rows <= max_counts && matrix.columns <= max_counts && columns > matrix.columns &&
          matrix.leading.empty() && static_cast<Index>(first_rows.size()) == matrix.rows) {
        matrix.leading = std::move(first_rows);
        matrix.values.erase(matrix.values.begin(),
                            matrix.values.begin() + static_cast<std::ptrdiff_t>(before));
        matrix.columns = columns;
        matrix.rows = 1;
        all_open = open;
        continue;
      }
      refuse_unknown(file, "line " + std::to_string(lines.number()) + " holds " +
                               std::to_string(columns) + " values where the first row holds " +
                               std::to_string(matrix.columns) +
                               "; the file is truncated or not a matrix");
    }
    if (matrix.rows < 4)
      first_rows.push_back({lines.number(), std::string(content.substr(0, 100))});
    ++matrix.rows;
    if (matrix.rows == enough_rows) reserve_rows(matrix, lines.share());
  }
  if (matrix.rows == 0)
    refuse_unknown(file, "holds no numbers and is not in a known format; name a surface file");
  interruptions.end(matrix);
  matrix.decimal_commas = reader.has_decimal_commas();
  matrix.decimal_points = reader.has_decimal_points();
  matrix.comma_separates = reader.symbol() == ',';
  if (look_like_thousands(matrix) && are_thousands(text, matrix.decimal_commas ? ',' : '.'))
    refuse(file, std::string("has a '") + (matrix.decimal_commas ? ',' : '.') +
                     "' followed by three digits in every number that has one, which may be a "
                     "thousands separator; write the numbers without it");
  return matrix;
}

}  // namespace

void TextRows::remove_first_row() {
  values.erase(values.begin(), values.begin() + columns);
  --rows;
}

void TextRows::remove_column(Index column) {
  std::size_t to = 0;
  for (Index row = 0; row < rows; ++row)
    for (Index at = 0; at < columns; ++at)
      if (at != column) values[to++] = (*this)(row, at);
  values.resize(to);
  --columns;
}

TextRows read_rows(const std::filesystem::path& file, const Text& text) {
  return read_rows(file, text, false);
}

}  // namespace salebra::detail
