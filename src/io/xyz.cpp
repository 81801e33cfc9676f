// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the regular grid on which points (x, y, z) lie, and writes a surface as such points.
#include "xyz.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <salebra/base/error.hpp>

#include "atomic_file.hpp"
#include "surface_importer.hpp"
#include "surface_writers.hpp"

namespace salebra::detail {
namespace {

struct XyzAxis {
  double first = 0;
  double step = 0;
  Index points = 0;
};

/// Whether every value differs from the first by a whole number of steps. Since coordinates are
/// rounded to few digits, a deviation of a tenth of a step is allowed.
bool on_grid(const std::vector<double>& sorted, double step) {
  return std::ranges::all_of(sorted, [&](double value) {
    const double index = (value - sorted.front()) / step;
    return std::abs(index - std::round(index)) <= 0.1;
  });
}

/// The distinct values of one coordinate, in increasing order. It is every third number of `xyz`
/// from index `first` on. The search is fast for points listed in the order of a grid, where a
/// coordinate usually equals that of the point before, or the next larger value already known.
std::vector<double> different(const std::filesystem::path& file, const std::vector<double>& xyz,
                              std::size_t first) {
  constexpr std::size_t min_batch = 65536;
  std::vector<double> values;  // increasing up to the index `sorted`
  std::size_t sorted = 0, at = 0;
  const auto sort = [&] {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    sorted = values.size();
  };
  for (std::size_t k = first; k < xyz.size(); k += 3) {
    const double value = xyz[k];
    const auto is_at = [&](std::size_t index) {
      if (index >= values.size() || values[index] != value) return false;
      at = index;
      return true;
    };
    if (is_at(at) || is_at(at + 1) || is_at(0)) continue;
    if (std::isnan(value)) refuse(file, "has an XYZ point without coordinates; remove it");
    values.push_back(value);
    if (values.size() - sorted >= std::max(min_batch, sorted)) sort();
  }
  sort();
  return values;
}

/// The axis of coordinates that scatter about the lines of a grid. Nothing unless gaps within a
/// line are less than a quarter of those between lines, and no line is missing.
std::optional<XyzAxis> axis_of_clusters(const std::vector<double>& coordinates) {
  double widest = 0;
  for (std::size_t i = 1; i < coordinates.size(); ++i)
    widest = std::max(widest, coordinates[i] - coordinates[i - 1]);
  // Fits a straight line to the coordinates over the indices of their grid lines; its slope is the
  // step.
  double line = 0, sum_line = 0, sum = 0, squares = 0, products = 0;
  std::vector<double> lines;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i > 0 && coordinates[i] - coordinates[i - 1] > widest / 2) ++line;
    lines.push_back(line);
    sum_line += line;
    sum += coordinates[i];
  }
  if (line < 1) return {};
  const auto count = static_cast<double>(coordinates.size());
  const double mean_line = sum_line / count, mean = sum / count;
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    squares += (lines[i] - mean_line) * (lines[i] - mean_line);
    products += (lines[i] - mean_line) * (coordinates[i] - mean);
  }
  const double step = products / squares, first = mean - step * mean_line;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    if (!(std::abs(coordinates[i] - first - lines[i] * step) <= 0.1 * step)) return {};
  return XyzAxis{first, step, static_cast<Index>(line) + 1};
}

/// The axis of a grid whose lines have these coordinates (distinct and sorted). name: of the
/// coordinate, for messages.
XyzAxis find_axis(const std::filesystem::path& file, const std::vector<double>& coordinates,
                  const char* name) {
  const double span = coordinates.back() - coordinates.front();
  if (!std::isfinite(span))
    refuse(file, std::string("has points whose ") + name + " is not a number; remove them");
  // Values closer than 1e-6 of the whole span belong to one line of the grid, so a grid can have at
  // most a million lines.
  std::size_t lines = 1;
  double line = coordinates.front(), min_gap = span;
  for (const double value : coordinates) {
    if (value - line > 1e-6 * span) {
      ++lines;
      min_gap = std::min(min_gap, value - line);
      line = value;
    }
  }
  if (lines < 2)
    refuse(file, std::string("has three columns whose ") + name +
                     " does not vary, so they are not XYZ points of a surface; a matrix must state "
                     "its size in the header");
  double intervals = static_cast<double>(lines - 1);
  // Even if a few whole lines are missing, the smallest gap is the step.
  constexpr double max_missing = 0.1;
  if (!on_grid(coordinates, span / intervals) &&
      std::round(span / min_gap) * (1 - max_missing) <= intervals)
    intervals = std::round(span / min_gap);
  if (!on_grid(coordinates, span / intervals)) {
    if (const auto axis = axis_of_clusters(coordinates)) return *axis;
    refuse_unknown(file, std::string("has three columns, but as XYZ points their ") + name +
                             " is not equally spaced; resample them on a regular grid");
  }
  return {coordinates.front(), span / intervals, static_cast<Index>(intervals) + 1};
}

/// Throws InvalidInput for a surface that cannot be recovered from its points: a single line of
/// points does not show the step across it, and a grid with less than half of its points is not
/// recognised.
void require_points(const std::filesystem::path& file, const Surface& surface) {
  const Grid2D& grid = surface.grid;
  if (grid.nx < 2 || grid.ny < 2)
    throw InvalidInput(
        file.string(),
        "would hold a single line of points, whose width is not known then; write .h5 or .npy");
  if (2 * surface.undefined_points() > grid.points())
    throw InvalidInput(file.string(),
                       "would hold points on less than half of the grid, which could not be "
                       "recognised; write .h5 or .npy");
}

}  // namespace

LoadedSurface grid_of_points(const std::filesystem::path& file, const std::vector<double>& xyz) {
  const std::size_t count = xyz.size() / 3;
  const std::vector<double> x = different(file, xyz, 0), y = different(file, xyz, 1);
  const XyzAxis along_x = find_axis(file, x, "x"), along_y = find_axis(file, y, "y");
  if (static_cast<std::size_t>(along_x.points) >
      2 * count / static_cast<std::size_t>(along_y.points))
    refuse_unknown(
        file,
        "has three columns, but as XYZ points they fill less than half of a regular grid; "
        "resample them on one");
  LoadedSurface surface;
  surface.heights =
      Field::Constant(along_x.points, along_y.points, std::numeric_limits<double>::quiet_NaN());
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> taken =
      Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>::Constant(along_x.points, along_y.points,
                                                                   false);
  for (std::size_t i = 0; i < count; ++i) {
    const Index ix = static_cast<Index>((xyz[3 * i] - along_x.first) / along_x.step + 0.5);
    const Index iy = static_cast<Index>((xyz[3 * i + 1] - along_y.first) / along_y.step + 0.5);
    if (taken(ix, iy)) refuse(file, "gives an XYZ point twice; remove one of them");
    taken(ix, iy) = true;
    surface.heights(ix, iy) = xyz[3 * i + 2];
  }
  surface.size_x = along_x.step * static_cast<double>(along_x.points);
  surface.size_y = along_y.step * static_cast<double>(along_y.points);
  return surface;
}

void write_xyz(const std::filesystem::path& file, const Surface& surface, const Provenance&,
               const WriteOptions& options) {
  require_points(file, surface);
  const Grid2D& grid = surface.grid;
  AtomicFile output(file, options);
  std::string text = "# Channel: heights\n# Lateral units: m\n# Value units: m\n# Points: " +
                     std::to_string(grid.points()) + "\n";
  for (Index ix = 0; ix < grid.nx; ++ix) {
    for (Index iy = 0; iy < grid.ny; ++iy) {
      append_number(text, static_cast<double>(ix) * grid.dx());
      text += '\t';
      append_number(text, static_cast<double>(iy) * grid.dy());
      text += '\t';
      append_number(text, surface.heights(ix, iy));
      text += '\n';
    }
    output.write(text);
    text.clear();
  }
  output.commit();
}

}  // namespace salebra::detail
