// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about implausible heights.
#include "plausibility.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <utility>

#include "neighbour_rows.hpp"

namespace salebra {
namespace {

/// Sum and sum of squares of the height differences of neighbouring points; undefined heights are
/// ignored.
struct Differences {
  double sum = 0, squares = 0, count = 0;

  /// Adds the differences values[i] − others[i].
  void add(const double* values, const double* others, Index size) {
    // Few rows have undefined heights, and the sums of a row show it: they are then not finite.
    if (!add<false>(values, others, size)) add<true>(values, others, size);
  }
  void add(const Differences& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
  }
  /// Variance of the slope, for points at the distance `step`; NaN if there is no pair of points.
  double variance(double step) const {
    const double mean = sum / count;
    return (squares / count - mean * mean) / (step * step);
  }

 private:
  /// Returns false, and adds nothing, if without the mask the sums are not finite. Eight sums in
  /// parallel: a single chain of additions would take longer than reading the heights from the
  /// disk's cache.
  template <bool masked>
  bool add(const double* values, const double* others, Index size) {
    double differences = 0, their_squares = 0, defined = 0;
#pragma omp simd simdlen(8) reduction(+ : differences, their_squares, defined)
    for (Index i = 0; i < size; ++i) {
      const double difference = values[i] - others[i];
      const double one = !masked || difference == difference ? 1 : 0;
      const double known = one > 0 ? difference : 0;
      differences += known;
      their_squares += known * known;
      defined += one;
    }
    if (!masked && !std::isfinite(their_squares)) return false;
    sum += differences;
    squares += their_squares;
    count += defined;
    return true;
  }
};

/// The minimum of some values, how often it occurs, and the range of all other values. Given
/// negated values, it finds the maximum.
struct Extreme {
  double value = infinity, low = infinity, high = -infinity;
  Index count = 0;

  void add(double height) {
    if (height > value) {
      low = std::min(low, height);
      high = std::max(high, height);
    } else if (height == value) {
      ++count;
    } else if (height < value) {
      if (count > 0) {
        low = value;
        high = std::max(high, value);
      }
      value = height;
      count = 1;
    }
  }
  bool is_apart() const { return count > 1 && high > low && low - value > high - low; }

  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

}  // namespace

std::vector<std::string> warnings_of_values(const Field& heights, std::optional<double> unit) {
  constexpr Index least = 64;  // fewer values may look like this by chance
  std::vector<std::string> warnings;
  if (heights.size() < least) return warnings;
  Extreme lowest, highest;
  bool whole = unit.has_value();
  const double per_metre = 1 / unit.value_or(1);
  for (const double height : heights.reshaped<Eigen::RowMajor>()) {
    lowest.add(height);
    highest.add(-height);
    const double number = height * per_metre;
    // Multiplication by a unit and division by it leave rounding errors in a whole number.
    whole = whole && !(std::abs(number - std::round(number)) > 1e-12 * std::abs(number));
  }
  if (lowest.count == 0 || !(lowest.high > lowest.value)) return warnings;
  if (whole)
    warnings.emplace_back(
        "all heights are whole numbers, like counts of a converter; check their unit");
  const auto constant = [&](const auto& line) { return (line == line(0)).all(); };
  constexpr Index shortest = 8;
  const Index rows = heights.rows(), columns = heights.cols();
  if (unit && rows >= shortest && columns >= shortest) {
    if (constant(heights.row(0)) && !constant(heights.row(1)))
      warnings.emplace_back("the first column of points holds one value; is it one of heights?");
    if (constant(heights.col(0)) && !constant(heights.col(1)))
      warnings.emplace_back("the first row of points holds one value; is it one of heights?");
  }
  const auto mark = [&](const Extreme& extreme, double sign) {
    warnings.push_back(
        fmt::format("{} heights of {:.6g} are farther from the others than the range of the "
                    "others; if they mark undefined points, write nan there",
                    extreme.count, sign * extreme.value * per_metre));
  };
  if (lowest.is_apart()) mark(lowest, 1);
  if (highest.is_apart()) mark(highest, -1);
  return warnings;
}

std::optional<std::string> warning_of_slope(double rms_slope, double unit) {
  constexpr double most = 1;
  if (!(rms_slope > most)) return {};
  // A slope that is too large by less than min_error comes from a steep surface or from spikes: any
  // other unit would make it far too small. Slopes from `least` to 1, down to those of polished
  // surfaces, count as plausible.
  constexpr double min_error = 10, least = 1e-3;
  if (rms_slope >= min_error)
    for (const auto& [name, metres] : {std::pair("mm", 1e-3), {"\u00b5m", 1e-6}, {"nm", 1e-9}})
      if (const double slope = rms_slope * metres / unit; slope >= least && slope <= most)
        return fmt::format(
            "rms slope {:.3g} is above 1; are the heights in {}? Then the rms slope would be "
            "{:.2g}",
            rms_slope, name, slope);
  return fmt::format(
      "rms slope {:.3g} is above 1, beyond linear elasticity; check the unit of the heights, and "
      "single points far from their neighbours",
      rms_slope);
}

std::optional<std::string> warning_of_heights(const Surface& surface, double unit) {
  const Grid2D& grid = surface.grid;
  const detail::NeighbourRows rows(surface);
  struct Both {
    Differences x, y;
  };
  Both total;
  for (const Both& block : parallel::map_blocks<Both>(
           surface.partition(),
           [&](Index begin, Index end) {
             Both sums;
             for (Index ix = begin; ix < end; ++ix) {
               const double *here = rows[ix], *next = rows[ix + 1];
               if (next) sums.x.add(next, here, grid.ny);
               sums.y.add(here + 1, here, grid.ny - 1);
             }
             return sums;
           },
           grid.points())) {
    total.x.add(block.x);
    total.y.add(block.y);
  }
  // A line profile has neighbours along one axis only.
  const auto variance = [](const Differences& differences, double step) {
    return differences.count > 0 ? differences.variance(step) : 0;
  };
  const bool profile = grid.nx == 1 || grid.ny == 1;
  return warning_of_slope(
      profile ? std::sqrt(variance(total.x, grid.dx()) + variance(total.y, grid.dy()))
              : std::sqrt(total.x.variance(grid.dx()) + total.y.variance(grid.dy())),
      unit);
}

}  // namespace salebra
