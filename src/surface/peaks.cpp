// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks by ISO 25178-2: Wolf's pruning of hills by prominence.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/surface/peaks.hpp>

#include "base/memory.hpp"
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

/// The water falls from the highest point to the lowest; where two hills meet, the lower one ends.
class PeakSearch {
 public:
  PeakSearch(const Surface& surface, double min_prominence)
      : surface_(surface),
        grid_(surface.grid),
        heights_(surface.heights.data()),
        min_prominence_(min_prominence),
        hills_(static_cast<std::size_t>(grid_.points())) {}

  std::vector<Peak> found() {
    const std::vector<std::int32_t> order = points_from_the_highest();
    for (const std::int32_t place : order) uncover(static_cast<std::size_t>(place));
    for (const std::int32_t place : order)
      if (const auto point = static_cast<std::size_t>(place); hills_.summit_of(point) == point)
        keep(point, std::numeric_limits<double>::infinity());
    return std::move(peaks_);
  }

 private:
  bool is_higher(std::size_t a, std::size_t b) const {
    return heights_[a] > heights_[b] || (heights_[a] == heights_[b] && a < b);
  }

  std::vector<std::int32_t> points_from_the_highest() const {
    std::vector<std::int32_t> order;
    order.reserve(static_cast<std::size_t>(grid_.points()));
    for (Index k = 0; k < grid_.points(); ++k)
      if (!std::isnan(heights_[k])) order.push_back(static_cast<std::int32_t>(k));
    std::ranges::sort(order, [this](std::int32_t a, std::int32_t b) {
      return is_higher(static_cast<std::size_t>(a), static_cast<std::size_t>(b));
    });
    return order;
  }

  template <class Visit>
  void visit_neighbours(Index ix, Index iy, const Visit& visit) const {
    for (Index a = -1; a <= 1; ++a) {
      for (Index b = -1; b <= 1; ++b) {
        Index jx = ix + a, jy = iy + b;
        if (a == 0 && b == 0) continue;
        if (surface_.periodic) {
          jx = (jx + grid_.nx) % grid_.nx;
          jy = (jy + grid_.ny) % grid_.ny;
        } else if (jx < 0 || jx >= grid_.nx || jy < 0 || jy >= grid_.ny) {
          continue;
        }
        visit(static_cast<std::size_t>(jx * grid_.ny + jy));
      }
    }
  }

  void uncover(std::size_t point) {
    std::size_t own = point;
    hills_.rise(point);
    const auto place = static_cast<Index>(point);
    visit_neighbours(place / grid_.ny, place % grid_.ny, [&](std::size_t next) {
      if (!hills_.uncovered(next)) return;
      std::size_t other = hills_.summit_of(next);
      if (other == own) return;
      // The lower of two hills ends at this saddle. A point that is no summit joins the hill it
      // lies on.
      if (is_higher(own, other)) std::swap(own, other);
      if (own != point) keep(own, heights_[own] - heights_[point]);
      hills_.join(own, other);
      own = other;
    });
  }

  void keep(std::size_t point, double prominence) {
    if (prominence < min_prominence_) return;
    const Index ix = static_cast<Index>(point) / grid_.ny,
                iy = static_cast<Index>(point) % grid_.ny;
    Index defined = 0;
    visit_neighbours(ix, iy, [&](std::size_t next) { defined += !std::isnan(heights_[next]); });
    if (defined < 8) return;
    const auto at = [&](Index jx, Index jy) {
      return surface_.heights((jx + grid_.nx) % grid_.nx, (jy + grid_.ny) % grid_.ny) -
             heights_[point];
    };
    const double second_x = (at(ix + 1, iy) + at(ix - 1, iy)) / (grid_.dx() * grid_.dx());
    const double second_y = (at(ix, iy + 1) + at(ix, iy - 1)) / (grid_.dy() * grid_.dy());
    peaks_.push_back({ix, iy, heights_[point], prominence, -(second_x + second_y) / 2});
  }

  const Surface& surface_;
  const Grid2D& grid_;
  const double* heights_;
  const double min_prominence_;
  Hills hills_;
  std::vector<Peak> peaks_;
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
  require_memory(grid, 16 * static_cast<double>(grid.points()), "a list of peaks");
  return PeakSearch(surface, min_prominence).found();
}

}  // namespace salebra
