// SPDX-License-Identifier: GPL-3.0-or-later
// Bearing (material ratio) curve, its core parameters and the height histogram.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/moments.hpp>
#include <span>
#include <utility>

#include "base/memory.hpp"

namespace salebra {
namespace {

constexpr double core_width = 0.4;  ///< material ratios under the core line, ISO 13565-2

struct Line {
  double at_zero = 0, at_one = 0;  ///< heights of the line at the material ratios p = 0 and p = 1
};

/// Least-squares line of height against the material ratio p, through `count` evenly spaced points
/// from point `first` on.
Line fit_line(const std::vector<double>& heights, std::size_t first, std::size_t count) {
  const double n = static_cast<double>(count), points = static_cast<double>(heights.size());
  const double middle = static_cast<double>(first) + n / 2;
  const auto sum = [&](const auto& term) {
    return parallel::sum_blocks(static_cast<Index>(count), [&](Index begin, Index end) {
      double of_block = 0;
      for (auto k = first + static_cast<std::size_t>(begin);
           k < first + static_cast<std::size_t>(end); ++k)
        of_block += term(static_cast<double>(k) + 0.5 - middle, heights[k]);
      return of_block;
    });
  };
  const double mean =
      heights[first] + sum([&](double, double z) { return z - heights[first]; }) / n;
  const double moment = sum([&](double position, double z) { return position * (z - mean); });
  const double slope = count > 1 ? moment / (n * (n * n - 1) / 12) * points : 0;
  const double centre = middle / points;
  return {mean - slope * centre, mean + slope * (1 - centre)};
}

/// Divides the numbers between a minimum and a maximum into intervals of equal width, counted from
/// the maximum.
struct Places {
  double greatest, per_unit;
  std::size_t count;

  Places(double least, double most, std::size_t ranges)
      : greatest(most),
        per_unit(most > least ? static_cast<double>(ranges) / (most - least) : 0),
        count(per_unit > 0 && std::isfinite(per_unit) ? ranges : 1) {}
  std::size_t of(double value) const {
    return count == 1
               ? 0
               : std::min(count - 1, static_cast<std::size_t>((greatest - value) * per_unit));
  }
};

/// Sorts numbers into falling order: first into intervals between maximum and minimum, then
/// recursively within each interval. This takes a third of the time of std::sort.
void sort_falling(std::span<double> values, std::vector<double>& buffer, int depth = 0) {
  constexpr std::size_t few = 32, max_places = 2048;
  constexpr int deepest = 4;  // if deeper, a few numbers exceed all others by far
  const auto [least, greatest] = std::ranges::minmax(values);
  if (least == greatest) return;
  if (values.size() <= few || depth == deepest) {
    std::ranges::sort(values, std::greater{});
    return;
  }
  const Places positions(least, greatest, std::min(max_places, values.size() / 4));
  std::vector<std::size_t> ends(positions.count + 1, 0);
  for (const double value : values) ++ends[positions.of(value) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  buffer.assign(values.begin(), values.end());
  for (const double value : buffer) values[ends[positions.of(value)]++] = value;
  std::size_t begin = 0;
  for (std::size_t position = 0; position < positions.count; begin = ends[position++])
    if (ends[position] - begin > 1)
      sort_falling(values.subspan(begin, ends[position] - begin), buffer, depth + 1);
}

/// The defined heights in falling order; −0 becomes 0.
std::vector<double> heights_from_the_highest(const Surface& surface,
                                             const HeightStatistics& statistics) {
  const auto defined = static_cast<std::size_t>(statistics.defined_points);
  const Places positions(statistics.minimum, statistics.maximum,
                         std::clamp<std::size_t>(defined / 4, 1, 4096));
  // For each block of rows, the position of its next height in each interval.
  const Index rows = surface.grid.nx, size = (rows + 63) / 64;
  auto next = parallel::map_blocks_of<std::vector<std::size_t>>(size, rows, [&](Index a, Index b) {
    std::vector<std::size_t> count(positions.count, 0);
    for (Index k = a * surface.grid.ny; k < b * surface.grid.ny; ++k)
      if (const double height = surface.heights.data()[k]; !std::isnan(height))
        ++count[positions.of(height)];
    return count;
  });
  std::size_t sum = 0;
  for (std::size_t position = 0; position < positions.count; ++position)
    for (auto& of_block : next) sum += std::exchange(of_block[position], sum);
  std::vector<double> heights(defined);
  parallel::map_blocks_of<int>(size, rows, [&](Index a, Index b) {
    std::vector<std::size_t>& to = next[static_cast<std::size_t>(a / size)];
    for (Index k = a * surface.grid.ny; k < b * surface.grid.ny; ++k)
      if (const double height = surface.heights.data()[k]; !std::isnan(height))
        heights[to[positions.of(height)]++] = height + 0.0;
    return 0;
  });
  const std::vector<std::size_t>& ends = next.back();
  parallel::for_slabs(static_cast<Index>(positions.count), [&](Index a, Index b) {
    std::vector<double> buffer;
    for (auto position = static_cast<std::size_t>(a); position < static_cast<std::size_t>(b);
         ++position) {
      const std::size_t begin = position == 0 ? 0 : ends[position - 1];
      if (ends[position] > begin)
        sort_falling(std::span(heights).subspan(begin, ends[position] - begin), buffer);
    }
  });
  return heights;
}

}  // namespace

BearingCurve::BearingCurve(const Surface& surface) {
  surface.require_whole("a bearing curve");
  require_memory(surface.grid, 8 * static_cast<double>(surface.grid.points()), "a bearing curve");
  heights_ = heights_from_the_highest(surface, height_statistics(surface));
  const auto count = static_cast<Index>(heights_.size());
  sums_.push_back(0);
  for (const double sum : parallel::map_blocks_of<double>(stride, count, [&](Index begin, Index) {
         return sum_of(begin, std::min(begin + stride, count));
       }))
    sums_.push_back(sums_.back() + sum);
}

double BearingCurve::sum_of(Index begin, Index end) const {
  double sum = 0;
  for (Index k = begin; k < end; ++k)
    sum += heights_[static_cast<std::size_t>(k)] - heights_.front();
  return sum;
}

double BearingCurve::height(double area_fraction) const {
  require(area_fraction >= 0 && area_fraction <= 1, "area_fraction", area_fraction,
          "must be from 0 to 1");
  const double last = static_cast<double>(heights_.size() - 1);
  const double position =
      std::clamp(area_fraction * static_cast<double>(heights_.size()) - 0.5, 0.0, last);
  const auto below = static_cast<std::size_t>(position);
  const double part = position - static_cast<double>(below);
  if (part == 0) return heights_[below];
  return heights_[below] + part * (heights_[below + 1] - heights_[below]);
}

double BearingCurve::area_fraction(double height) const {
  const double points = static_cast<double>(heights_.size());
  if (height > heights_.front()) return 0;
  if (height < heights_.back()) return 1;
  // The curve is level where several points have equal heights; return the middle of that piece.
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
  // Integral of the curve from the highest point to the material ratio p: whole steps, corrected
  // for the step that p cuts.
  const auto up_to = [&](double p) {
    const double position = p * points - 0.5;
    const double low = std::clamp(std::floor(position), -1.0, points - 1);
    const auto steps = static_cast<std::size_t>(low + 1);
    const double part = position - low;
    const double left = heights_[steps == 0 ? 0 : steps - 1] - heights_.front();
    const double right = height(p) - heights_.front();
    const auto count = static_cast<Index>(steps), stored = count / stride;
    const double sum = sums_[static_cast<std::size_t>(stored)] + sum_of(stored * stride, count);
    const double whole = steps == 0 ? 0 : sum - left / 2;
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
  const auto first_flattest = [&](std::size_t begin, std::size_t end, const auto& at) {
    std::size_t flattest = at(begin);
    for (std::size_t k = begin; k < end; ++k)
      if (const std::size_t here = at(k); heights[here] - heights[here + count - 1] <
                                          heights[flattest] - heights[flattest + count - 1])
        flattest = here;
    return flattest;
  };
  const auto of_blocks = parallel::map_blocks<std::size_t>(
      static_cast<Index>(points - count + 1), [&](Index begin, Index end) {
        return first_flattest(static_cast<std::size_t>(begin), static_cast<std::size_t>(end),
                              std::identity{});
      });
  const std::size_t flattest =
      first_flattest(0, of_blocks.size(), [&](std::size_t k) { return of_blocks[k]; });
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
  auto end = heights.end();
  for (int k = 0; k < bins; ++k) {
    // The heights are sorted, so the heights within a bin are contiguous.
    const auto begin =
        k + 1 == bins ? heights.begin() : std::partition_point(heights.begin(), end, [&](double z) {
          return (z - lowest) / width >= k + 1;
        });
    histogram.points.push_back(end - begin);
    end = begin;
  }
  for (std::size_t k = 0; k < histogram.points.size(); ++k) {
    histogram.height.push_back(lowest + (static_cast<double>(k) + 0.5) * width);
    histogram.height_density.push_back(static_cast<double>(histogram.points[k]) / (points * width));
  }
  return histogram;
}

}  // namespace salebra
