// SPDX-License-Identifier: GPL-3.0-or-later
// Finds isolated points whose heights deviate from those of their neighbours, by medians.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/spikes.hpp>
#include <span>

#include "neighbour_rows.hpp"
#include "shape.hpp"

namespace salebra {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
// Standard deviation of a Gaussian variable, relative to the median of its absolute deviation.
constexpr double deviation_per_median = 1.4826;
constexpr std::size_t max_spike = 4;  // maximum number of points in a spike

/// Returns the median of some values, whose order it may change.
double middle_of(std::span<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Adjacent points of a row that one pass handles together.
using Points = Eigen::Array<double, 4, 1>;

/// Medians of the heights of the eight neighbours of each of some points in a row. `rows` points to
/// the heights of these points in the second of three rows, and to the same columns of the rows
/// before and after it. NaN if a neighbour is undefined.
Points medians_of_neighbours(const std::array<const double*, 3>& rows) {
  const auto at = [](const double* first) { return Points(Eigen::Map<const Points>(first)); };
  const auto [before, here, behind] = rows;
  std::array<Points, 8> sorted{at(before - 1), at(before),     at(before + 1), at(here - 1),
                               at(here + 1),   at(behind - 1), at(behind),     at(behind + 1)};
  Points undefined_if_one_is = Points::Zero();
  for (const Points& heights : sorted) undefined_if_one_is += 0 * heights;
  // Batcher's sorting network, which has no branches that a processor could mispredict.
  constexpr std::array<std::uint8_t, 38> pairs{0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4,
                                               6, 5, 7, 1, 2, 5, 6, 0, 4, 1, 5, 2, 6,
                                               3, 7, 2, 4, 3, 5, 1, 2, 3, 4, 5, 6};
#pragma GCC unroll 19
  for (std::size_t k = 0; k < pairs.size(); k += 2) {
    Points &low = sorted[pairs[k]], &high = sorted[pairs[k + 1]];
    const Points least = low.min(high);
    high = low.max(high);
    low = least;
  }
  return (sorted[3] + sorted[4]) / 2 + undefined_if_one_is;
}

struct GridPoint {
  Index ix, iy;
  bool operator==(const GridPoint&) const = default;
};

/// A surface with access to the neighbours of its points.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const Surface& surface) : surface_(surface) {}

  /// Calls visit(point) for each of the up to eight defined neighbours of the point `of`.
  template <class Visit>
  void around(GridPoint of, const Visit& visit) const {
    const Grid2D& grid = surface_.grid;
    for (Index ix = of.ix - 1; ix <= of.ix + 1; ++ix)
      for (Index iy = of.iy - 1; iy <= of.iy + 1; ++iy) {
        GridPoint point{ix, iy};
        if (point == of) continue;
        if (surface_.periodic) {
          point = {(ix + grid.nx) % grid.nx, (iy + grid.ny) % grid.ny};
        } else if (ix < 0 || ix >= grid.nx || iy < 0 || iy >= grid.ny) {
          continue;
        }
        if (!std::isnan(height(point))) visit(point);
      }
  }

  double height(GridPoint at) const { return surface_.heights(at.ix, at.iy); }

  struct Surroundings {
    double median, deviation;
  };
  /// Median and, if wanted, robust deviation of the neighbours of a point; NaN if fewer than three
  /// neighbours are defined.
  Surroundings surroundings(GridPoint at, bool with_deviation) const {
    std::array<double, 8> buffer;
    std::size_t count = 0;
    around(at, [&](GridPoint point) { buffer[count++] = height(point); });
    if (count < 3) return {undefined, undefined};
    const std::span<double> values(buffer.data(), count);
    const double middle = middle_of(values);
    if (!with_deviation) return {middle, undefined};
    for (double& value : values) value = std::abs(value - middle);
    return {middle, deviation_per_median * middle_of(values)};
  }

  /// The points connected to `from` that are higher (or lower, like `from` itself) than half way
  /// between `middle` and the height of `from`. The search stops when it has one point more than a
  /// spike can have.
  std::vector<GridPoint> beside(GridPoint from, double middle) const {
    const double half = (height(from) + middle) / 2;
    const bool above = height(from) > middle;
    std::vector<GridPoint> found{from};
    for (std::size_t k = 0; k < found.size() && found.size() <= max_spike; ++k)
      around(found[k], [&](GridPoint point) {
        if ((height(point) > half) == above && height(point) != half &&
            std::ranges::find(found, point) == found.end())
          found.push_back(point);
      });
    return found;
  }

 private:
  const Surface& surface_;
};

/// Height of each point minus the median of its neighbours' heights; NaN if either is undefined.
Field deviations_from_neighbours(const Surface& surface, const Neighbourhoods& neighbours) {
  constexpr Index pass = Points::SizeAtCompileTime;
  const Grid2D& grid = surface.grid;
  const detail::NeighbourRows rows(surface);
  Field deviations(grid.nx, grid.ny);
  parallel::for_slabs(
      grid.nx,
      [&](Index begin, Index end) {
        for (Index ix = begin; ix < end; ++ix) {
          const double *before = rows[ix - 1], *here = rows[ix], *behind = rows[ix + 1];
          double* const row = &deviations(ix, 0);
          std::fill_n(row, grid.ny, undefined);
          if (before && behind)
            for (Index iy = 1; iy + pass < grid.ny; iy += pass)
              Eigen::Map<Points>(row + iy) =
                  Eigen::Map<const Points>(here + iy) -
                  medians_of_neighbours({before + iy, here + iy, behind + iy});
          // Points at the edges of the surface and next to undefined points have fewer neighbours
          // and need the general median.
          for (Index iy = 0; iy < grid.ny; ++iy)
            if (std::isnan(row[iy]) && !std::isnan(here[iy]))
              row[iy] = here[iy] - neighbours.surroundings({ix, iy}, false).median;
        }
      },
      grid.points());
  return deviations;
}

/// The absolute value that a fraction `share` of the deviations does not exceed; 0 if all are
/// undefined. Absolute values are first counted by their leading bits, which sort like the numbers;
/// then only the values with the leading bits of the result are examined.
double quantile_of_sizes(const Field& deviations, double share) {
  constexpr int dropped = 47;  // bits; 32 intervals in each octave
  const auto interval = [](double size) { return std::bit_cast<std::uint64_t>(size) >> dropped; };
  std::vector<std::size_t> counts(interval(std::numeric_limits<double>::infinity()) + 1);
  std::size_t defined = 0;
  for (const double deviation : deviations.reshaped<Eigen::RowMajor>())
    if (!std::isnan(deviation)) {
      ++counts[interval(std::abs(deviation))];
      ++defined;
    }
  if (defined == 0) return 0;
  auto below = static_cast<std::size_t>(share * static_cast<double>(defined - 1));
  std::size_t sought = 0;
  while (below >= counts[sought]) below -= counts[sought++];
  std::vector<double> sizes;
  sizes.reserve(counts[sought]);
  for (const double deviation : deviations.reshaped<Eigen::RowMajor>())
    if (const double size = std::abs(deviation); !std::isnan(size) && interval(size) == sought)
      sizes.push_back(size);
  const auto at = sizes.begin() + static_cast<std::ptrdiff_t>(below);
  std::ranges::nth_element(sizes, at);
  return *at;
}

/// The typical deviation s_0 of find_spikes(), from the median of the absolute deviations. If this
/// median is 0 because most points equal their neighbours, as in surfaces stored with few digits,
/// it is the deviation that a hundredth of the points exceeds.
double scale_of(const Field& deviations) {
  const double middle = quantile_of_sizes(deviations, 0.5);
  return middle > 0 ? deviation_per_median * middle : quantile_of_sizes(deviations, 0.99);
}

}  // namespace

std::vector<Spike> find_spikes(const Surface& surface, double threshold) {
  surface.require_whole("a search for spikes");
  detail::require_shape(surface);
  require(threshold >= 3, "despike", threshold,
          "must be >= 3 robust standard deviations; 6 does not change a Gaussian surface");
  const Grid2D& grid = surface.grid;
  const Neighbourhoods neighbours(surface);
  const Field deviations = deviations_from_neighbours(surface, neighbours);
  const double scale = scale_of(deviations);
  std::vector<Spike> spikes;
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> known =
      Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>::Constant(grid.nx, grid.ny, false);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double deviation = std::abs(deviations(ix, iy));
      if (!(deviation > threshold * scale) || known(ix, iy)) continue;
      const auto around = neighbours.surroundings({ix, iy}, true);
      if (!(deviation > threshold * around.deviation)) continue;
      const std::vector<GridPoint> points = neighbours.beside({ix, iy}, around.median);
      if (points.size() > max_spike) continue;
      for (const GridPoint& point : points) {
        if (known(point.ix, point.iy)) continue;
        known(point.ix, point.iy) = true;
        spikes.push_back({point.ix, point.iy, neighbours.height(point) - around.median});
      }
    }
  std::ranges::sort(spikes, {}, [](const Spike& spike) { return std::pair(spike.ix, spike.iy); });
  return spikes;
}

void remove_spikes(Surface& surface, const std::vector<Spike>& spikes) {
  for (const Spike& spike : spikes) surface.heights(spike.ix, spike.iy) = undefined;
}

Surface despiked(Surface surface, double threshold) {
  remove_spikes(surface, find_spikes(surface, threshold));
  return surface;
}

}  // namespace salebra
