// SPDX-License-Identifier: GPL-3.0-or-later
// Points that stand alone, by robust deviations from their neighbours.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/spikes.hpp>
#include <span>

#include "shape.hpp"

namespace salebra {
namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr double deviation_per_median = 1.4826;  // of a Gaussian
constexpr std::size_t largest_spike = 4;         // points

/// Of up to eight values, whose order it may change.
double middle_of(std::span<double> values) {
  if (values.size() == 8) {
    // Batcher's network: no branch that a processor could guess wrong.
    constexpr std::array<std::uint8_t, 38> pairs{0, 1, 2, 3, 4, 5, 6, 7, 0, 2, 1, 3, 4,
                                                 6, 5, 7, 1, 2, 5, 6, 0, 4, 1, 5, 2, 6,
                                                 3, 7, 2, 4, 3, 5, 1, 2, 3, 4, 5, 6};
    std::array<double, 8> sorted;
    std::ranges::copy(values, sorted.begin());
#pragma GCC unroll 19
    for (std::size_t k = 0; k < pairs.size(); k += 2) {
      double &a = sorted[pairs[k]], &b = sorted[pairs[k + 1]];
      const double low = b < a ? b : a;
      b = b < a ? a : b;
      a = low;
    }
    return (sorted[3] + sorted[4]) / 2;
  }
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

struct GridPoint {
  Index ix, iy;
  bool operator==(const GridPoint&) const = default;
};

/// A surface with the neighbours of its points.
class Neighbourhoods {
 public:
  explicit Neighbourhoods(const Surface& surface) : surface_(surface) {}

  /// Calls visit(point) for each of up to eight defined neighbours.
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
  /// NaN where fewer than three neighbours are defined.
  Surroundings surroundings(GridPoint at, bool with_deviation) const {
    std::array<double, 8> room;
    std::size_t count = 0;
    around(at, [&](GridPoint point) { room[count++] = height(point); });
    if (count < 3) return {undefined, undefined};
    const std::span<double> values(room.data(), count);
    const double middle = middle_of(values);
    if (!with_deviation) return {middle, undefined};
    for (double& value : values) value = std::abs(value - middle);
    return {middle, deviation_per_median * middle_of(values)};
  }

  /// The points beside each other, `from` among them, that lie beyond half of its height; one more
  /// than a spike has where there are many.
  std::vector<GridPoint> beside(GridPoint from, double middle) const {
    const double half = (height(from) + middle) / 2;
    const bool above = height(from) > middle;
    std::vector<GridPoint> found{from};
    for (std::size_t k = 0; k < found.size() && found.size() <= largest_spike; ++k)
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

/// s_0 of find_spikes(). Where most points equal their neighbours, as in a surface of few digits,
/// the deviation that a hundredth exceeds takes its place.
double scale_of(const Field& deviations) {
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(deviations.size()));
  for (const double deviation : deviations.reshaped<Eigen::RowMajor>())
    if (!std::isnan(deviation)) sizes.push_back(std::abs(deviation));
  if (sizes.empty()) return 0;
  const auto quantile = [&](double share) {
    const auto at =
        sizes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sizes.size() - 1));
    std::ranges::nth_element(sizes, at);
    return *at;
  };
  const double middle = quantile(0.5);
  return middle > 0 ? deviation_per_median * middle : quantile(0.99);
}

}  // namespace

std::vector<Spike> find_spikes(const Surface& surface, double threshold) {
  surface.require_whole("a search for spikes");
  detail::require_shape(surface);
  require(threshold >= 3, "despike", threshold,
          "must be >= 3 robust standard deviations; 6 leaves every Gaussian surface as it is");
  const Grid2D& grid = surface.grid;
  const Neighbourhoods neighbours(surface);
  Field deviations(grid.nx, grid.ny);
  parallel::for_slabs(
      grid.nx,
      [&](Index begin, Index end) {
        for (Index ix = begin; ix < end; ++ix)
          for (Index iy = 0; iy < grid.ny; ++iy)
            deviations(ix, iy) =
                surface.heights(ix, iy) - neighbours.surroundings({ix, iy}, false).median;
      },
      grid.points());
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
      if (points.size() > largest_spike) continue;
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
