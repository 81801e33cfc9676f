// SPDX-License-Identifier: GPL-3.0-or-later
// Bearing (material ratio) curve, its core parameters and the height histogram.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/moments.hpp>

#include "base/memory.hpp"

namespace salebra {
namespace {

constexpr double core_width = 0.4;  ///< of the curve that the core line is fitted to, ISO 13565-2

struct Line {
  double at_zero = 0, at_one = 0;  ///< heights at p = 0 and p = 1
};

/// Least squares of height against p over the points first … first + count − 1, which are evenly
/// spaced.
Line fit_line(const std::vector<double>& heights, std::size_t first, std::size_t count) {
  const double n = static_cast<double>(count), points = static_cast<double>(heights.size());
  const double middle = static_cast<double>(first) + n / 2;
  double mean = 0, moment = 0;
  for (std::size_t k = first; k < first + count; ++k) mean += heights[k] / n;
  for (std::size_t k = first; k < first + count; ++k)
    moment += (static_cast<double>(k) + 0.5 - middle) * (heights[k] - mean);
  const double slope = count > 1 ? moment / (n * (n * n - 1) / 12) * points : 0;
  const double centre = middle / points;
  return {mean - slope * centre, mean + slope * (1 - centre)};
}

}  // namespace

BearingCurve::BearingCurve(const Surface& surface) {
  surface.require_whole("a bearing curve");
  require_memory(surface.grid, 16 * static_cast<double>(surface.grid.points()), "a bearing curve");
  const HeightStatistics statistics = height_statistics(surface);
  heights_.reserve(static_cast<std::size_t>(statistics.defined_points));
  for (const double height : surface.heights.reshaped<Eigen::RowMajor>())
    if (!std::isnan(height)) heights_.push_back(height);
  std::ranges::sort(heights_, std::greater{});
  sums_.reserve(heights_.size() + 1);
  sums_.push_back(0);
  for (const double height : heights_) sums_.push_back(sums_.back() + (height - heights_.front()));
}

double BearingCurve::height(double area_fraction) const {
  require(area_fraction >= 0 && area_fraction <= 1, "area_fraction", area_fraction,
          "must be from 0 to 1");
  const double last = static_cast<double>(heights_.size() - 1);
  const double place =
      std::clamp(area_fraction * static_cast<double>(heights_.size()) - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  if (part == 0) return heights_[below];
  return heights_[below] + part * (heights_[below + 1] - heights_[below]);
}

double BearingCurve::area_fraction(double height) const {
  const double points = static_cast<double>(heights_.size());
  if (height > heights_.front()) return 0;
  if (height < heights_.back()) return 1;
  // The first and the last of equal heights are found apart: the curve has a level piece, and its
  // middle stands for it.
  const auto first = std::ranges::lower_bound(heights_, height, std::greater{});
  const auto end = std::ranges::upper_bound(heights_, height, std::greater{});
  const double above = static_cast<double>(first - heights_.begin());
  if (first != end) {
    const double through = static_cast<double>(end - heights_.begin());
    return (above + through) / (2 * points);
  }
  const double part = (*(first - 1) - height) / (*(first - 1) - *first);
  return (above - 0.5 + part) / points;
}

double BearingCurve::integral(double from, double to) const {
  const double points = static_cast<double>(heights_.size());
  // Up to p, counted from the highest point: whole steps, less or more of the pieces that p cuts.
  const auto up_to = [&](double p) {
    const double place = p * points - 0.5;
    const double low = std::clamp(std::floor(place), -1.0, points - 1);
    const auto steps = static_cast<std::size_t>(low + 1);
    const double part = place - low;
    const double left = heights_[steps == 0 ? 0 : steps - 1] - heights_.front();
    const double right = height(p) - heights_.front();
    const double whole = steps == 0 ? 0 : sums_[steps] - left / 2;
    const double start = steps == 0 ? 0.5 : 0.0;
    return (whole + (part - start) * (left + right) / 2) / points;
  };
  return up_to(to) - up_to(from) + (to - from) * heights_.front();
}

CoreParameters core_parameters(const BearingCurve& curve) {
  const std::vector<double>& heights = curve.heights();
  const std::size_t points = heights.size();
  const auto count = static_cast<std::size_t>(std::round(core_width * static_cast<double>(points)));
  CoreParameters result;
  if (count < 2) return result;
  std::size_t flattest = 0;
  for (std::size_t k = 0; k + count <= points; ++k)
    if (heights[k] - heights[k + count - 1] < heights[flattest] - heights[flattest + count - 1])
      flattest = k;
  const Line core = fit_line(heights, flattest, count);
  result.core_height = core.at_zero - core.at_one;
  result.peak_fraction = curve.area_fraction(core.at_zero);
  result.core_fraction = curve.area_fraction(core.at_one);
  if (const double p = result.peak_fraction; p > 0)
    result.peak_height = std::max(0.0, 2 * (curve.integral(0, p) / p - core.at_zero));
  if (const double p = 1 - result.core_fraction; p > 0)
    result.valley_depth =
        std::max(0.0, 2 * (core.at_one - curve.integral(result.core_fraction, 1) / p));
  return result;
}

HeightHistogram height_histogram(const BearingCurve& curve, int bins) {
  require(bins >= 0, "bins", bins, "must be >= 0");
  const std::vector<double>& heights = curve.heights();
  const double points = static_cast<double>(heights.size());
  const double lowest = heights.back(), range = heights.front() - lowest;
  if (bins == 0) {
    const double wanted = 2 * (curve.height(0.25) - curve.height(0.75)) / std::cbrt(points);
    bins = wanted > 0 ? static_cast<int>(std::clamp(range / wanted, 10.0, 200.0)) : 10;
  }
  if (range == 0) bins = 1;
  const double width = range / bins;
  HeightHistogram histogram;
  histogram.width = width;
  histogram.points.assign(static_cast<std::size_t>(bins), 0);
  for (const double height : heights) {
    const auto bin = range > 0 ? static_cast<std::size_t>((height - lowest) / width) : 0;
    ++histogram.points[std::min(bin, histogram.points.size() - 1)];
  }
  for (std::size_t k = 0; k < histogram.points.size(); ++k) {
    histogram.height.push_back(lowest + (static_cast<double>(k) + 0.5) * width);
    histogram.height_density.push_back(static_cast<double>(histogram.points[k]) / (points * width));
  }
  return histogram;
}

}  // namespace salebra
