// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks by ISO 25178-2: Wolf's pruning of hills by prominence.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/surface/peaks.hpp>

#include "shape.hpp"

namespace salebra {
namespace {

constexpr std::int32_t dry = -1;  ///< a point that the falling water has not uncovered yet

/// Hills that grow together as the water falls. Each is known by its highest point.
class Hills {
 public:
  explicit Hills(std::size_t points) : parent_(points, dry) {}

  bool uncovered(std::size_t point) const { return parent_[point] != dry; }
  void rise(std::size_t point) { parent_[point] = static_cast<std::int32_t>(point); }
  std::size_t summit_of(std::size_t point) {
    while (parent_[point] != static_cast<std::int32_t>(point)) {
      parent_[point] = parent_[static_cast<std::size_t>(parent_[point])];
      point = static_cast<std::size_t>(parent_[point]);
    }
    return point;
  }
  void join(std::size_t lower, std::size_t higher) {
    parent_[lower] = static_cast<std::int32_t>(higher);
  }

 private:
  std::vector<std::int32_t> parent_;
};

}  // namespace

std::vector<Peak> significant_peaks(const Surface& surface, double min_prominence) {
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  require(grid.nx >= 3, "nx", grid.nx, "must be >= 3 to have peaks");
  require(grid.ny >= 3, "ny", grid.ny, "must be >= 3 to have peaks");
  require(grid.points() <= std::numeric_limits<std::int32_t>::max(), "nx*ny", grid.points(),
          "must be below 2^31 points; crop the surface");
  require(min_prominence >= 0, "min_prominence", min_prominence, "must be >= 0");

  const double* heights = surface.heights.data();
  const auto points = static_cast<std::size_t>(grid.points());
  std::vector<std::int32_t> order;
  require_memory(grid, 16 * static_cast<double>(points), "a list of peaks");
  order.reserve(points);
  for (std::size_t k = 0; k < points; ++k)
    if (!std::isnan(heights[k])) order.push_back(static_cast<std::int32_t>(k));
  const auto is_higher = [&](std::int32_t a, std::int32_t b) {
    return heights[a] > heights[b] || (heights[a] == heights[b] && a < b);
  };
  std::ranges::sort(order, is_higher);

  const auto neighbours = [&](Index ix, Index iy, const auto& visit) {
    for (Index a = -1; a <= 1; ++a) {
      for (Index b = -1; b <= 1; ++b) {
        Index jx = ix + a, jy = iy + b;
        if (a == 0 && b == 0) continue;
        if (surface.periodic) {
          jx = (jx + grid.nx) % grid.nx;
          jy = (jy + grid.ny) % grid.ny;
        } else if (jx < 0 || jx >= grid.nx || jy < 0 || jy >= grid.ny) {
          continue;
        }
        visit(static_cast<std::size_t>(jx * grid.ny + jy));
      }
    }
  };

  std::vector<Peak> peaks;
  const auto keep = [&](std::size_t point, double prominence) {
    if (prominence < min_prominence) return;
    const Index ix = static_cast<Index>(point) / grid.ny, iy = static_cast<Index>(point) % grid.ny;
    Index defined = 0;
    neighbours(ix, iy, [&](std::size_t next) { defined += !std::isnan(heights[next]); });
    if (defined < 8) return;
    const auto at = [&](Index jx, Index jy) {
      return surface.heights((jx + grid.nx) % grid.nx, (jy + grid.ny) % grid.ny) - heights[point];
    };
    const double second_x = (at(ix + 1, iy) + at(ix - 1, iy)) / (grid.dx() * grid.dx());
    const double second_y = (at(ix, iy + 1) + at(ix, iy - 1)) / (grid.dy() * grid.dy());
    peaks.push_back({ix, iy, heights[point], prominence, -(second_x + second_y) / 2});
  };

  Hills hills(points);
  for (const std::int32_t place : order) {
    const auto point = static_cast<std::size_t>(place);
    std::size_t own = point;
    hills.rise(point);
    neighbours(place / grid.ny, place % grid.ny, [&](std::size_t next) {
      if (!hills.uncovered(next)) return;
      std::size_t other = hills.summit_of(next);
      if (other == own) return;
      // The lower of two hills ends at this saddle. A point that is no summit joins the hill it
      // lies on.
      if (is_higher(static_cast<std::int32_t>(own), static_cast<std::int32_t>(other)))
        std::swap(own, other);
      if (own != point) keep(own, heights[own] - heights[point]);
      hills.join(own, other);
      own = other;
    });
  }
  for (const std::int32_t place : order)
    if (const auto point = static_cast<std::size_t>(place); hills.summit_of(point) == point)
      keep(point, std::numeric_limits<double>::infinity());
  return peaks;
}

}  // namespace salebra
