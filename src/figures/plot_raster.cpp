// SPDX-License-Identifier: GPL-3.0-or-later
// Resampling of an image to cells of equal size, as a picture draws them.
#include "plot_raster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>

namespace salebra::figures {
namespace {

constexpr Index max_cells = 1200;

// How the drawn cells along one axis follow from the cells of the image. Drawn cell k is the mean
// of the image cells first … last, or it is interpolated between these two at `fraction` of their
// distance.
struct Sampling {
  struct Cell {
    Index first = 0, last = 0;
    double fraction = 0;
  };
  double start = 0, step = 1;
  bool averages = true;
  std::vector<Cell> cells;
};

Sampling sample_axis(const std::vector<double>& coordinate, const DisplayAxis& axis) {
  const auto count = static_cast<Index>(coordinate.size());
  std::vector<double> at;
  for (const double value : coordinate) at.push_back(axis.display(value));
  const double mean_step =
      count > 1 ? (at.back() - at.front()) / static_cast<double>(count - 1) : 1;
  bool equal = true;
  for (Index i = 0; i < count; ++i)
    equal = equal && std::abs(at[static_cast<std::size_t>(i)] - at.front() -
                              static_cast<double>(i) * mean_step) < 1e-3 * mean_step;
  Sampling out;
  out.averages = equal;
  if (equal) {
    const Index cells = std::min(count, max_cells);
    const double width = static_cast<double>(count) / static_cast<double>(cells) * mean_step;
    out.step = width;
    out.start = at.front() + 0.5 * (width - mean_step);
    for (Index k = 0; k < cells; ++k)
      out.cells.push_back({k * count / cells, (k + 1) * count / cells - 1, 0});
    return out;
  }
  const Index cells = std::clamp<Index>(4 * count, 200, max_cells);
  out.start = at.front();
  out.step = (at.back() - at.front()) / static_cast<double>(cells - 1);
  for (Index k = 0; k < cells; ++k) {
    const double here = out.start + static_cast<double>(k) * out.step;
    const auto above = std::ranges::upper_bound(at, here);
    const Index right = std::clamp<Index>(above - at.begin(), 1, count - 1);
    const double from = at[static_cast<std::size_t>(right - 1)],
                 to = at[static_cast<std::size_t>(right)];
    out.cells.push_back({right - 1, right, std::clamp((here - from) / (to - from), 0.0, 1.0)});
  }
  return out;
}

// Resamples an image along its first axis.
Field resample(const Field& values, const Sampling& sampling) {
  const auto cells = static_cast<Index>(sampling.cells.size());
  Field out(cells, values.cols());
  for (Index k = 0; k < cells; ++k) {
    const auto& [first, last, fraction] = sampling.cells[static_cast<std::size_t>(k)];
    for (Index j = 0; j < values.cols(); ++j) {
      if (!sampling.averages) {
        // At a cell of the image, (1 − f)a + f b would be NaN if the neighbouring cell is NaN.
        out(k, j) = fraction == 0 ? values(first, j)
                    : fraction == 1
                        ? values(last, j)
                        : (1 - fraction) * values(first, j) + fraction * values(last, j);
        continue;
      }
      double sum = 0;
      int number = 0;
      for (Index i = first; i <= last; ++i) {
        if (!std::isfinite(values(i, j))) continue;
        sum += values(i, j);
        ++number;
      }
      out(k, j) = number > 0 ? sum / number : std::numeric_limits<double>::quiet_NaN();
    }
  }
  return out;
}

void check_coordinate(const std::vector<double>& coordinate, Index cells, std::string_view field) {
  require(static_cast<Index>(coordinate.size()) == cells && cells > 0, field, coordinate.size(),
          fmt::format("coordinates for {} cells; give one for each", cells));
  for (std::size_t i = 1; i < coordinate.size(); ++i)
    require(coordinate[i] > coordinate[i - 1], field, coordinate[i],
            "does not increase; sort the cells");
}

}  // namespace

void check_raster(const Image& image) {
  check_coordinate(image.x, image.values.rows(), "image x");
  check_coordinate(image.y, image.values.cols(), "image y");
}

std::pair<double, double> finite_range(const Field& values) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (Index i = 0; i < values.rows(); ++i) {
    for (Index j = 0; j < values.cols(); ++j) {
      if (!std::isfinite(values(i, j))) continue;
      least = std::min(least, values(i, j));
      most = std::max(most, values(i, j));
    }
  }
  return {least, most};
}

Raster rasterise(const Image& image, const DisplayAxis& x, const DisplayAxis& y) {
  const Sampling along_x = sample_axis(image.x, x), along_y = sample_axis(image.y, y);
  Raster out;
  out.x0 = along_x.start;
  out.dx = along_x.step;
  out.y0 = along_y.start;
  out.dy = along_y.step;
  const Field half = resample(image.values, along_x).transpose();
  out.values = resample(half, along_y).transpose();

  const std::span<const double> data(out.values.data(),
                                     static_cast<std::size_t>(out.values.size()));
  Axis scale = image.scale;
  out.scale = display_axis(scale, {data});
  for (Index i = 0; i < out.values.rows(); ++i)
    for (Index j = 0; j < out.values.cols(); ++j)
      out.values(i, j) = out.scale.display(out.values(i, j));
  const auto [least, most] = finite_range(out.values);
  const bool symmetric =
      image.palette == Palette::diverging && !image.scale.low && !image.scale.high;
  const double reach = std::max(std::abs(least), std::abs(most));
  if (!image.scale.low) out.scale.low = symmetric ? -reach : least;
  if (!image.scale.high) out.scale.high = symmetric ? reach : most;
  // If all values are equal, the colour scale still needs two different limits.
  if (!(*out.scale.high > *out.scale.low)) {
    const double padding = reach > 0 ? 0.1 * reach : 1;
    *out.scale.low -= padding;
    *out.scale.high += padding;
  }
  return out;
}

}  // namespace salebra::figures
