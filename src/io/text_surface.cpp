// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from text: a matrix, points or a profile.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>
#include <span>

#include "loaded_surface.hpp"
#include "surface_importer.hpp"
#include "text_columns.hpp"
#include "text_header.hpp"
#include "text_numbers.hpp"
#include "text_rows.hpp"
#include "xyz.hpp"

namespace salebra::detail {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// The heights of a matrix with x along the rows of the text. Transposes in blocks: if the length
/// of a row is a power of two, the numbers of a column would share only few lines of the
/// processor's cache.
Field transposed(const TextRows& matrix) {
  const Eigen::Map<const Field> rows(matrix.values.data(), matrix.rows, matrix.columns);
  Field heights(matrix.columns, matrix.rows);
  constexpr Index block = 16;
  for (Index row = 0; row < matrix.rows; row += block)
    for (Index column = 0; column < matrix.columns; column += block) {
      const Index height = std::min(block, matrix.rows - row),
                  width = std::min(block, matrix.columns - column);
      heights.block(column, row, width, height) =
          rows.block(row, column, height, width).transpose();
    }
  return heights;
}

std::vector<double> column_of(const TextRows& rows, Index column) {
  std::vector<double> values(static_cast<std::size_t>(rows.rows));
  for (Index row = 0; row < rows.rows; ++row)
    values[static_cast<std::size_t>(row)] = rows(row, column);
  return values;
}

/// Replaces marks of undefined points by NaN: values that the header declares as marks, and values
/// that instruments use as marks and that lie farther from all other heights than these lie apart.
void remove_marks(const std::filesystem::path& file, const TextHeader& header,
                  LoadedSurface& surface) {
  const std::span<double> heights(surface.heights.data(),
                                  static_cast<std::size_t>(surface.heights.size()));
  const auto remove = [&](double mark) {
    Index count = 0;
    for (double& height : heights)
      if (height == mark || std::abs(height - mark) <= 1e-6 * std::abs(mark)) {
        height = undefined;
        ++count;
      }
    return count;
  };
  for (const double mark : header.missing)
    if (const Index count = remove(mark); mark == 0 && count > 0)
      surface.warnings.push_back(fmt::format(
          "{} heights of 0, which the file uses to mark undefined points, are undefined", count));
  for (;;) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double height : heights) {
      least = std::min(least, height == height ? height : least);
      most = std::max(most, height == height ? height : most);
    }
    if (!(most > least)) return;
    const auto is_mark = [](double value) {
      const double size = std::abs(value);
      for (const double mark : {999., 9999., 99999., 999999., 32767., 32768., 65535., 2147483647.,
                                2147483648., 999.9, 9999.99, 999.99, 99.99e3})
        if (size == mark) return true;
      return size >= 1e9 && size < 1e60;
    };
    const double mark = is_mark(least) ? least : is_mark(most) ? most : 0;
    if (mark == 0) return;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    Index others = 0;
    bool fractions = true;
    for (const double height : heights)
      if (height == height && height != mark) {
        low = std::min(low, height);
        high = std::max(high, height);
        fractions = fractions && height != std::floor(height);
        ++others;
      }
    const double gap = mark == least ? low - mark : mark - high;
    // Among heights with fractions, a whole number is a mark already at a quarter of this distance.
    const bool apart = gap > (mark == std::floor(mark) && fractions ? 0.25 : 1) * (high - low);
    if (!apart || others < 3) {
      if (gap > 0.25 * (high - low) && std::abs(mark) < 1e9)
        refuse(file, fmt::format("holds heights of '{}', which may mark undefined points; write "
                                 "nan for them, or correct them",
                                 mark));
      return;
    }
    const Index count = remove(mark);
    surface.warnings.push_back(
        fmt::format("{} of {}, far from all other heights, treated as undefined",
                    count == 1 ? "a height" : fmt::format("{} heights", count), mark));
  }
}

/// A stated length in metres. If it has no unit of its own, it is in `unit`, the unit of its axis.
std::optional<double> metres_of(const std::filesystem::path& file, const StatedLength& length,
                                const std::string& unit) {
  if (length.metres) return length.metres;
  if (unit.empty()) return {};
  return length.number * metres_per(file, unit);
}

/// The lengths that a text states for one axis of the surface.
struct Axis {
  const char* name;
  Index points;
  std::optional<StatedLength> size, pixel;
  std::string unit;
};

/// The size along an axis of a matrix, from the stated size and the stated distance of points. The
/// stated size may also be the distance from the first to the last point. Adds a question to
/// `loaded` if no unit is stated.
std::optional<double> size_of(const std::filesystem::path& file, const Axis& axis,
                              LoadedSurface& loaded) {
  const auto in_metres = [&](const std::optional<StatedLength>& length) -> std::optional<double> {
    if (!length) return {};
    if (const auto metres = metres_of(file, *length, axis.unit)) return metres;
    loaded.lateral_unit_open = true;
    loaded.questions.push_back(
        {length->quote + ", does not state a unit; give `lateral_unit`", true, false});
    return length->number;
  };
  const std::optional<double> size = in_metres(axis.size), pixel = in_metres(axis.pixel);
  if (!size || !pixel)
    return size ? size : pixel ? std::optional(*pixel * static_cast<double>(axis.points)) : pixel;
  const auto tolerance = [](const StatedLength& length, double metres) {
    constexpr double most = 0.01;
    return std::min(length.half_digit / std::abs(length.number), most) * std::abs(metres) *
               (1 + 1e-9) +
           1e-9 * std::abs(metres);
  };
  const auto fits = [&](double count) {
    return std::abs(*size - count * *pixel) <=
           tolerance(*axis.size, *size) + count * tolerance(*axis.pixel, *pixel);
  };
  const auto count = static_cast<double>(axis.points);
  if (fits(count)) {
    const bool by_pixel = axis.pixel->half_digit * std::abs(axis.size->number) <
                          axis.size->half_digit * std::abs(axis.pixel->number);
    return by_pixel ? *pixel * count : size;
  }
  if (fits(count - 1)) return *pixel * count;
  refuse(file, axis.size->quote + ", contradicts " + axis.pixel->quote +
                   fmt::format(" with {} points along {}; correct one, or remove it", axis.points,
                               axis.name));
}

/// Compares the size and the step of coordinates with those that the header states, and throws if
/// they differ. If only the header shows the unit of the coordinates, converts `size` to metres and
/// sets `closed`. open: the unit of the coordinates is not known.
void check_size(const std::filesystem::path& file, const Axis& axis, bool open, double& size,
                bool& closed) {
  const auto count = static_cast<double>(axis.points);
  for (const auto* stated : {&axis.size, &axis.pixel}) {
    if (!*stated) continue;
    const StatedLength& length = **stated;
    const double whole = stated == &axis.pixel ? size / count : size;
    const double span = stated == &axis.pixel ? whole : size * (count - 1) / count;
    const auto metres = metres_of(file, length, axis.unit);
    const double value = metres.value_or(length.number);
    const double tolerance =
        std::abs(value) * std::min(length.half_digit / std::abs(length.number) + 2e-3, 0.01);
    bool fits = false;
    for (const double unit : {1., 1e-3, 1e-6, 1e-9}) {
      if (unit != 1 && !(open && !closed && metres)) break;
      if (std::abs(whole * unit - value) > tolerance && std::abs(span * unit - value) > tolerance)
        continue;
      size *= unit;
      closed = closed || metres.has_value();
      fits = true;
      break;
    }
    if (!fits)
      refuse(file, length.quote +
                       fmt::format(", contradicts the {} in the columns; correct one, or remove it",
                                   axis.name));
  }
}

class TextReader {
 public:
  TextReader(const std::filesystem::path& file, const Text& text)
      : file_(file), rows_(read_rows(file, text)) {}

  LoadedSurface read() {
    const Margins margins = margins_of(rows_);
    header_ = read_header(
        file_, rows_.lines,
        {rows_.columns, rows_.rows, rows_.columns - margins.column, rows_.rows - margins.row,
         rows_.decimal_points, rows_.decimal_commas, rows_.comma_separates});
    remove_count();
    const std::optional<Columns> columns = columns_of(file_, rows_, header_);
    constexpr const char* not_understood =
        ", has a unit or a number that is not known; remove the line, or give the lengths and "
        "`height_unit`";
    try {
      if (columns)
        read_columns(*columns);
      else
        read_untitled(margins);
    } catch (const InvalidInput&) {
      // A line of the header that was not understood may explain the numbers, so the error names
      // it.
      if (header_.unaccounted.empty()) throw;
      refuse_unknown(file_, header_.unaccounted.front() + not_understood);
    }
    check_leading();
    for (const std::string& line : header_.unaccounted)
      loaded_.questions.push_back({line + not_understood, true, true});
    scale_heights();
    return std::move(loaded_);
  }

 private:
  std::string unit_or_common(const std::string& of_title, const std::string& of_axis) const {
    if (!of_title.empty() && !of_axis.empty() && of_title != of_axis &&
        metres_in(of_title).value_or(-1) != metres_in(of_axis).value_or(-2))
      refuse(file_, header_.titles_quote + ", contradicts the unit '" + of_axis +
                        "' of another line; correct one");
    return !of_title.empty() ? of_title : !of_axis.empty() ? of_axis : header_.common_unit;
  }

  /// Removes the first number of a single column if it is the number of values after it.
  void remove_count() {
    constexpr Index least = 5;
    if (rows_.columns != 1 || rows_.rows < least) return;
    const double first = rows_(0, 0), second = rows_(1, 0);
    if (first != std::floor(first)) return;
    const auto [low, high] = std::ranges::minmax(std::span(rows_.values).subspan(1));
    const bool apart = first < low || first > high;
    const double behind = static_cast<double>(rows_.rows - 1);
    if (first == behind) {
      if (!apart)
        refuse(file_, "begins with the number of its lines, which may be a height; remove it");
      loaded_.warnings.emplace_back(
          "its first line is the number of lines that follow, not a height");
      rows_.remove_first_row();
    } else if ((first >= 2 && second == std::floor(second) && first * second == behind - 1) ||
               (apart && first > 4 &&
                (first == behind - 1 || first == behind - 2 || first == behind + 1))) {
      refuse(file_, fmt::format("begins with {}, which seems to count the lines that follow; "
                                "remove it if it is not a height",
                                first));
    }
  }

  void read_columns(const Columns& columns) {
    loaded_.warnings.insert(loaded_.warnings.end(), columns.warnings.begin(),
                            columns.warnings.end());
    z_unit_ = columns.z_unit;
    if (!columns.x) {
      read_heights(column_of(rows_, *columns.z));
    } else if (!columns.y) {
      read_profile(column_of(rows_, *columns.x), column_of(rows_, *columns.z),
                   unit_or_common(columns.x_unit, header_.x_unit));
    } else {
      std::vector<double> xyz;
      xyz.reserve(3 * static_cast<std::size_t>(rows_.rows));
      for (Index row = 0; row < rows_.rows; ++row)
        for (const Index column : {*columns.x, *columns.y, *columns.z})
          xyz.push_back(rows_(row, column));
      read_points(grid_of_points(file_, xyz), unit_or_common(columns.x_unit, header_.x_unit),
                  unit_or_common(columns.y_unit, header_.y_unit));
    }
  }

  void read_untitled(const Margins& margins) {
    const std::string x_unit = unit_or_common("", header_.x_unit),
                      y_unit = unit_or_common("", header_.y_unit);
    if (rows_.columns == 2 && rows_.rows >= 4 && !header_.height && !header_.width &&
        !header_.pixel_x) {
      if (is_monotone(rows_, 0)) {
        read_profile(column_of(rows_, 0), column_of(rows_, 1), x_unit);
        return;
      }
    }
    if (rows_.columns == 1 && rows_.rows >= 4 && !header_.height) {
      read_heights(column_of(rows_, 0));
      return;
    }
    const bool sized = header_.width || header_.pixel_x;
    if (rows_.columns == 3 && !margins.column) {
      if (!sized) {
        read_points(grid_of_points(file_, rows_.values), x_unit, y_unit);
        return;
      }
      if (auto grid = points_of(rows_.values)) {
        read_points(std::move(*grid), x_unit, y_unit);
        return;
      }
    }
    if (!margins.fault.empty()) {
      require_one_block();
      refuse(file_, margins.fault);
    }
    if (margins.row) rows_.remove_first_row();
    if (margins.column) rows_.remove_column(0);
    if ((margins.row || margins.column) && !margins.step_x)
      loaded_.warnings.emplace_back(fmt::format("its first {} is a count and holds no heights",
                                                !margins.column ? "row"
                                                : margins.row   ? "row and column"
                                                                : "column"));
    // The columns may be x, y, z and further quantities of each point.
    constexpr Index max_columns = 8;
    if (rows_.columns >= 3 && rows_.columns <= max_columns && rows_.rows >= 4 &&
        !(rows_.columns == 3 && !margins.column)) {
      std::vector<double> xyz;
      for (Index row = 0; row < rows_.rows; ++row)
        for (Index column = 0; column < 3; ++column) xyz.push_back(rows_(row, column));
      if (auto grid = points_of(xyz)) {
        if (rows_.columns > 3)
          loaded_.warnings.emplace_back(fmt::format(
              "columns x, y and z were read; {} after them were not used", rows_.columns - 3));
        read_points(std::move(*grid), x_unit, y_unit);
        return;
      }
      if (rows_.columns == 3 && !sized)
        refuse(file_, "has numbered lines whose columns are not known; name them");
    }
    if (margins.column && rows_.columns == 2) {
      if (!is_monotone(rows_, 0))
        refuse(file_, "has numbered lines whose columns are not known; name them");
      read_profile(column_of(rows_, 0), column_of(rows_, 1), x_unit);
      return;
    }
    read_matrix(margins, x_unit, y_unit);
  }

  /// The surface on the grid of these points. Nothing if the points do not lie on a regular grid.
  std::optional<LoadedSurface> points_of(const std::vector<double>& xyz) const {
    try {
      LoadedSurface grid = grid_of_points(file_, xyz);
      if (rows_.rows >= 4 && static_cast<Index>(xyz.size() / 3) == grid.heights.size()) return grid;
    } catch (const InvalidInput&) {
    }
    return {};
  }

  /// Throws InvalidInput for a matrix or a list of heights if a line separates blocks of rows.
  void require_one_block() const {
    if (!rows_.interruption.empty())
      refuse(file_, rows_.interruption +
                        ", lies between rows, which may belong to two channels; keep one of them");
  }

  void read_matrix(const Margins& margins, const std::string& x_unit, const std::string& y_unit) {
    require_one_block();
    check_counts(rows_.columns, rows_.rows, rows_.columns * rows_.rows);
    loaded_.heights = transposed(rows_);
    const Axis x{"x", rows_.columns, header_.width, header_.pixel_x, x_unit},
        y{"y", rows_.rows, header_.height, header_.pixel_y, y_unit};
    if (margins.step_x) {
      loaded_.warnings.emplace_back("its first row and column are coordinates");
      read_coordinates(x, *margins.step_x * static_cast<double>(x.points), y,
                       *margins.step_y * static_cast<double>(y.points));
      return;
    }
    if (header_.length && !header_.width)
      question(header_.length->quote + ", is a length without an axis");
    loaded_.size_x = size_of(file_, x, loaded_);
    loaded_.size_y = size_of(file_, y, loaded_);
  }

  void read_coordinates(const Axis& x, double size_x, const Axis& y, double size_y) {
    const bool open_x = x.unit.empty(), open_y = y.unit.empty();
    bool closed_x = !open_x, closed_y = !open_y;
    if (!open_x) size_x *= metres_per(file_, x.unit);
    if (!open_y) size_y *= metres_per(file_, y.unit);
    check_size(file_, x, open_x, size_x, closed_x);
    check_size(file_, y, open_y, size_y, closed_y);
    if (closed_x != closed_y) refuse(file_, "states the unit of only one of x and y; state both");
    loaded_.size_x = size_x;
    loaded_.size_y = size_y;
    loaded_.lateral_unit_open = !closed_x;
    require_both_units(closed_x);
  }

  void require_both_units(bool lateral) {
    const std::string titles = header_.titles_quote.empty() ? "" : ", " + header_.titles_quote;
    const bool of_heights =
        header_.height_factor || !unit_or_common(z_unit_, header_.value_unit).empty();
    if (lateral && !of_heights)
      loaded_.questions.push_back({"states the unit of its positions but not of its heights" +
                                       titles + "; give `height_unit`",
                                   false, true});
    if (!lateral && of_heights && !header_.height_factor)
      loaded_.questions.push_back({"states the unit of its heights but not of its positions" +
                                       titles + "; give `lateral_unit`",
                                   true, false});
  }

  void read_points(LoadedSurface grid, const std::string& x_unit, const std::string& y_unit) {
    grid.warnings.insert(grid.warnings.begin(), loaded_.warnings.begin(), loaded_.warnings.end());
    grid.questions = std::move(loaded_.questions);
    loaded_ = std::move(grid);
    check_counts(loaded_.heights.rows(), loaded_.heights.cols(), rows_.rows);
    read_coordinates(
        {"x", loaded_.heights.rows(), header_.width, header_.pixel_x, x_unit}, *loaded_.size_x,
        {"y", loaded_.heights.cols(), header_.height, header_.pixel_y, y_unit}, *loaded_.size_y);
  }

  void read_heights(const std::vector<double>& heights) {
    require_one_block();
    check_counts(rows_.rows, rows_.rows, rows_.rows);
    loaded_.is_profile = true;
    loaded_.heights = Eigen::Map<const Field>(heights.data(), rows_.rows, 1);
    if (header_.width && header_.length)
      question(header_.length->quote + ", is stated together with a size");
    loaded_.size_x = size_of(file_,
                             {"x", rows_.rows, header_.width ? header_.width : header_.length,
                              header_.pixel_x, unit_or_common("", header_.x_unit)},
                             loaded_);
  }

  void read_profile(std::vector<double> positions, std::vector<double> heights,
                    const std::string& unit) {
    check_counts(rows_.rows, rows_.rows, rows_.rows);
    if (header_.height)
      question(header_.height->quote + ", states a size that a profile does not have");
    if (positions.size() > 1 && positions.back() < positions.front()) {
      std::ranges::reverse(positions);
      std::ranges::reverse(heights);
    }
    LoadedSurface profile = profile_of(file_, positions, heights);
    profile.warnings.insert(profile.warnings.begin(), loaded_.warnings.begin(),
                            loaded_.warnings.end());
    profile.questions = std::move(loaded_.questions);
    loaded_ = std::move(profile);
    double size = *loaded_.size_x;
    bool closed = !unit.empty();
    if (closed) size *= metres_per(file_, unit);
    for (const auto& stated : {header_.width, header_.length})
      check_size(file_, {"positions", rows_.rows, stated, header_.pixel_x, unit}, unit.empty(),
                 size, closed);
    loaded_.size_x = size;
    loaded_.lateral_unit_open = !closed;
    require_both_units(closed);
  }

  void question(const std::string& what) {
    loaded_.questions.push_back(
        {what + "; remove it, or give the sizes and `height_unit`", true, true});
  }

  void check_counts(Index columns, Index rows, Index points) {
    const auto check = [&](const std::vector<StatedCount>& declared, const char* what, Index found,
                           bool more, Index other) {
      for (const StatedCount& count : declared)
        if (count.count != found && !(more && count.count == other))
          refuse(file_,
                 fmt::format(
                     "declares {} {} but holds {} ({}); it is truncated or its header is wrong",
                     count.count, what, found, count.quote));
    };
    const bool of_points = points != columns * rows || columns == rows;
    check(header_.columns, "columns", columns, of_points, rows_.columns);
    check(header_.rows, "rows", rows, of_points, rows_.rows);
    check(header_.points, "points", points, columns == rows, columns);
  }

  /// Throws InvalidInput unless the numbers before the rows are the numbers of columns, rows or
  /// points.
  void check_leading() {
    for (const HeaderLine& line : rows_.leading) {
      std::vector<double> counts;
      NumberReader reader(file_);
      reader.append(line.text, line.number, counts);
      const auto columns = static_cast<double>(rows_.columns),
                 rows = static_cast<double>(rows_.rows);
      const auto nx = static_cast<double>(loaded_.heights.rows()),
                 ny = static_cast<double>(loaded_.heights.cols());
      const auto is = [](double count, std::initializer_list<double> found) {
        return std::ranges::find(found, count) != found.end();
      };
      const bool known = counts.size() == 1 ? is(counts[0], {columns, rows, nx, ny, rows * columns})
                         : counts.size() == 2
                             ? (is(counts[0], {nx, columns}) && is(counts[1], {ny, rows})) ||
                                   (is(counts[1], {nx, columns}) && is(counts[0], {ny, rows}))
                             : false;
      if (!known)
        refuse_unknown(file_, fmt::format("line {} holds {} values but the rows hold {}; the file "
                                          "is truncated or not a matrix",
                                          line.number, counts.size(), rows_.columns));
    }
  }

  void scale_heights() {
    remove_marks(file_, header_, loaded_);
    const std::string unit = unit_or_common(z_unit_, header_.value_unit);
    if (header_.height_factor) {
      if (const auto metres = unit.empty() ? std::nullopt : metres_in(unit);
          metres && std::abs(*metres / *header_.height_factor - 1) > 1e-6)
        refuse(file_, "states a height conversion factor and the unit '" + unit +
                          "', which differ; remove one");
      loaded_.heights *= *header_.height_factor;
      loaded_.unit = "m";
    } else {
      loaded_.unit = unit;
    }
  }

  const std::filesystem::path& file_;
  TextRows rows_;
  TextHeader header_;
  LoadedSurface loaded_;
  std::string z_unit_;
};

}  // namespace

LoadedSurface read_text(const std::filesystem::path& file, std::string_view content,
                        const std::string&) {
  return TextReader(file, {require_text(file, content)}).read();
}

LoadedSurface read_text(const InputFile& input) {
  return TextReader(input.path(), {{}, &input}).read();
}

}  // namespace salebra::detail
