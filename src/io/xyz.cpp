// SPDX-License-Identifier: GPL-3.0-or-later
#include "xyz.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace salebra::detail {
namespace {

struct Axis {
  double first = 0;
  double step = 0;
  Index points = 0;
};

/// Equally spaced values among the coordinates, from the least to the greatest.
/// Coordinates are written with few digits: they may lie up to a tenth of a step from the grid.
Axis find_axis(const std::filesystem::path& file, std::vector<double> coordinates,
               const char* name) {
  std::ranges::sort(coordinates);
  const double span = coordinates.back() - coordinates.front();
  if (!std::isfinite(span))
    refuse(file, std::string("has points whose ") + name + " is not a number; remove them");
  // Values closer than 1e-6 of the span are one line of the grid, hence at most a million lines are told apart.
  std::size_t lines = 1;
  double line = coordinates.front();
  for (const double value : coordinates) {
    if (value - line > 1e-6 * span) {
      ++lines;
      line = value;
    }
  }
  if (lines < 2)
    refuse(file, std::string("has three columns whose ") + name +
                     " does not vary; as XYZ points it is no surface, as a matrix it lacks its "
                     "size in the header");
  const double step = span / static_cast<double>(lines - 1);
  for (const double value : coordinates) {
    const double place = (value - coordinates.front()) / step;
    if (std::abs(place - std::round(place)) > 0.1)
      refuse(file, std::string("has three columns, but as XYZ points their ") + name +
                       " is not equally spaced; resample them on a regular grid");
  }
  return {coordinates.front(), step, static_cast<Index>(lines)};
}

}  // namespace

LoadedSurface grid_of_points(const std::filesystem::path& file, const std::vector<double>& xyz) {
  const std::size_t count = xyz.size() / 3;
  std::vector<double> x(count), y(count);
  for (std::size_t i = 0; i < count; ++i) {
    x[i] = xyz[3 * i];
    y[i] = xyz[3 * i + 1];
    if (std::isnan(x[i]) || std::isnan(y[i]))
      refuse(file, "has an XYZ point without coordinates; remove it");
  }
  const Axis along_x = find_axis(file, x, "x"), along_y = find_axis(file, y, "y");
  if (static_cast<std::size_t>(along_x.points) >
      2 * count / static_cast<std::size_t>(along_y.points))
    refuse(file,
           "has three columns, but as XYZ points they fill less than half of a regular grid; "
           "resample them on one");
  LoadedSurface surface;
  surface.heights =
      Field::Constant(along_x.points, along_y.points, std::numeric_limits<double>::quiet_NaN());
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> taken =
      Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>::Constant(along_x.points, along_y.points,
                                                                   false);
  for (std::size_t i = 0; i < count; ++i) {
    const Index ix = std::lround((x[i] - along_x.first) / along_x.step);
    const Index iy = std::lround((y[i] - along_y.first) / along_y.step);
    if (taken(ix, iy)) refuse(file, "gives an XYZ point twice; remove one of them");
    taken(ix, iy) = true;
    surface.heights(ix, iy) = xyz[3 * i + 2];
  }
  surface.size_x = along_x.step * static_cast<double>(along_x.points);
  surface.size_y = along_y.step * static_cast<double>(along_y.points);
  return surface;
}

}  // namespace salebra::detail
