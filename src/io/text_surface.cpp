// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of a surface from text: a matrix, or points.
#include <algorithm>
#include <limits>
#include <optional>

#include "base/memory.hpp"
#include "loaded_surface.hpp"
#include "surface_importer.hpp"
#include "text_header.hpp"
#include "text_numbers.hpp"
#include "xyz.hpp"

namespace salebra::detail {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr Index enough_rows = 1024;  // to say how long all are

struct TextMatrix {
  std::vector<double> values;  ///< row after row
  Index columns = 0, rows = 0;

  /// For all values, of which there is a share: a vector that grows copies them, each time into
  /// pages that the system has to clear.
  void make_room(double share) {
    constexpr double longer = 1.02;
    const double wanted = longer * static_cast<double>(values.size()) / share;
    if (fits_into_memory(wanted * sizeof(double))) values.reserve(static_cast<std::size_t>(wanted));
  }

  /// One to the rows but for the last, which has it already and is not counted yet.
  void append_undefined_column() {
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
      *end_of(row, wider, columns) = undefined;
    }
    columns = wider;
  }
};

/// tabs: each separates two values, of which one may be empty; else any blanks do.
TextMatrix read_rows(const std::filesystem::path& file, const Text& text, TextHeader& header,
                     bool tabs = false) {
  TextMatrix matrix;
  NumberReader reader(file, tabs);
  bool all_open = false;  // every row so far ends with a separator
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view content = trimmed(line);
    if (content.empty()) continue;
    const bool comment = content.front() == '#' || content.front() == '%';
    if (comment || (matrix.rows == 0 && !starts_with_number(content))) {
      if (matrix.rows == 0) read_header_line(file, content, lines.number(), header);
      continue;
    }
    const std::size_t before = matrix.values.size();
    reader.append(line, lines.number(), matrix.values);
    auto columns = static_cast<Index>(matrix.values.size() - before);
    const bool open = reader.ends_with_separator(line);
    if (matrix.rows == 0) {
      matrix.columns = columns;
      all_open = open;
    }
    // A separator behind the last value of every row says nothing. Where other rows end without
    // one, it stands before a point that is undefined.
    if (all_open && !open && columns == matrix.columns + 1) {
      matrix.append_undefined_column();
    } else if (!all_open && open && columns == matrix.columns - 1) {
      matrix.values.push_back(undefined);
      ++columns;
    }
    all_open = all_open && open;
    if (columns != matrix.columns) {
      // Where tabs separate values, blanks hide those that are empty.
      if (!tabs && !reader.symbol() && text.holds('\t')) {
        header = {};
        return read_rows(file, text, header, true);
      }
      refuse_unknown(file, "line " + std::to_string(lines.number()) + " holds " +
                               std::to_string(columns) + " values where the first row holds " +
                               std::to_string(matrix.columns) +
                               "; the file is truncated or no matrix");
    }
    ++matrix.rows;
    if (matrix.rows == enough_rows) matrix.make_room(lines.share());
  }
  if (matrix.rows == 0)
    refuse_unknown(file, "holds no numbers and is in no format that is known; name a surface file");
  const auto check = [&](const std::optional<Index>& declared, Index found, const char* what) {
    if (declared && *declared != found)
      refuse(file, "declares " + std::to_string(*declared) + what + " but holds " +
                       std::to_string(found) + "; it is truncated or its header is wrong");
  };
  check(header.columns, matrix.columns, " columns");
  check(header.rows, matrix.rows, " rows");
  return matrix;
}

/// Whether the numbers are a line profile: heights alone, or behind positions that increase.
bool is_profile(const TextMatrix& matrix, const TextHeader& header) {
  constexpr Index least = 4;
  if (matrix.rows < least || matrix.columns > 2 || header.height) return false;
  if (matrix.columns == 1) return true;
  for (Index row = 1; row < matrix.rows; ++row)
    if (!(matrix.values[std::size_t(2 * row)] > matrix.values[std::size_t(2 * row - 2)]))
      return false;
  return !header.width && !header.pixel_x;
}

LoadedSurface profile_of_text(const std::filesystem::path& file, const TextMatrix& matrix,
                              const TextHeader& header) {
  LoadedSurface profile;
  if (matrix.columns == 1) {
    profile.is_profile = true;
    profile.heights = Eigen::Map<const Field>(matrix.values.data(), matrix.rows, 1);
    if (header.pixel_x) profile.size_x = *header.pixel_x * static_cast<double>(matrix.rows);
    if (header.width) profile.size_x = header.width;
  } else {
    std::vector<double> positions, heights;
    for (Index row = 0; row < matrix.rows; ++row) {
      positions.push_back(matrix.values[std::size_t(2 * row)]);
      heights.push_back(matrix.values[std::size_t(2 * row + 1)]);
    }
    profile = profile_of(file, positions, heights);
    profile.lateral_unit_open = header.x_unit.empty();
    if (!header.x_unit.empty()) *profile.size_x *= metres_per(file, header.x_unit);
  }
  return profile;
}

/// x along the rows. By blocks: where a row is a power of two long, the numbers of a column share
/// few lines of the cache.
Field transposed(const TextMatrix& matrix) {
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

LoadedSurface surface_of_text(const std::filesystem::path& file, const Text& text) {
  TextHeader header;
  const TextMatrix matrix = read_rows(file, text, header);
  const bool of_line = is_profile(matrix, header);
  const bool are_points = matrix.columns == 3 && !header.width && !header.pixel_x;
  if (const Index found = matrix.rows * (are_points ? 1 : matrix.columns);
      header.points && *header.points != found)
    refuse(file, "declares " + std::to_string(*header.points) + " points but holds " +
                     std::to_string(found) + "; it is truncated or its header is wrong");
  LoadedSurface surface;
  if (of_line) {
    surface = profile_of_text(file, matrix, header);
  } else if (are_points) {
    surface = grid_of_points(file, matrix.values);
    surface.lateral_unit_open = header.x_unit.empty() && header.y_unit.empty();
    if (!header.x_unit.empty()) *surface.size_x *= metres_per(file, header.x_unit);
    if (!header.y_unit.empty()) *surface.size_y *= metres_per(file, header.y_unit);
  } else {
    surface.heights = transposed(matrix);
  }
  if (header.height_factor)
    surface.heights *= *header.height_factor;
  else
    surface.unit = header.value_unit;
  if (!of_line && header.pixel_x)
    surface.size_x = *header.pixel_x * static_cast<double>(matrix.columns);
  if (!of_line && header.pixel_y)
    surface.size_y = *header.pixel_y * static_cast<double>(matrix.rows);
  if (header.width) surface.size_x = header.width;
  if (header.height) surface.size_y = header.height;
  if (const std::string remark = header.remark(); !remark.empty())
    surface.remarks.push_back(remark);
  return surface;
}

}  // namespace

LoadedSurface read_text(const std::filesystem::path& file, std::string_view content) {
  return surface_of_text(file, {require_text(file, content)});
}

LoadedSurface read_text(const InputFile& input) {
  return surface_of_text(input.path(), {{}, &input});
}

}  // namespace salebra::detail
