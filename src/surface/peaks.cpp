// SPDX-License-Identifier: GPL-3.0-or-later
// Peaks by ISO 25178-2: Wolf's pruning of hills by prominence.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/peaks.hpp>

#include "base/memory.hpp"
#include "shape.hpp"

namespace salebra {
namespace {

/// A point in the order in which falling water uncovers points.
struct Uncovered {
  double height;
  std::int32_t point;
  bool operator<(const Uncovered& other) const {
    return height > other.height || (height == other.height && point < other.point);
  }
};

/// Finds peaks as falling water would uncover them, from the highest point to the lowest; where two
/// hills meet, the hill with the lower peak ends. The steepest path upward assigns each point to a
/// hill. Two hills can meet only at a point that has higher neighbours on both hills, so the search
/// visits only such points.
class PeakSearch {
 public:
  PeakSearch(const Surface& surface, double min_prominence)
      : surface_(surface),
        grid_(surface.grid),
        heights_(surface.heights.data()),
        min_prominence_(min_prominence),
        ahead_{-grid_.ny - 1, -grid_.ny, -grid_.ny + 1, -1, 1,
               grid_.ny - 1,  grid_.ny,  grid_.ny + 1},
        towards_(large_array<std::int32_t>(static_cast<std::size_t>(grid_.points()))) {}

  std::vector<Peak> found() {
    for_points([this](Index point) { look_up(point); });
    for_points([this](Index point) { (void)climb(point); });
    const std::vector<Uncovered> saddles =
        from_the_highest([this](Index point) { return hills_meet(point); });
    for (const Uncovered& saddle : saddles) uncover(saddle.point);
    for (const Uncovered& summit : from_the_highest(
             [this](Index point) { return !std::isnan(heights_[point]) && is_summit(point); }))
      keep(summit.point, std::numeric_limits<double>::infinity());
    return std::move(peaks_);
  }

 private:
  template <class Body>
  void for_points(const Body& body) const {
    parallel::for_slabs(
        grid_.nx,
        [&](Index begin, Index end) {
          for (Index point = begin * grid_.ny; point < end * grid_.ny; ++point) body(point);
        },
        grid_.points());
  }

  template <class Wanted>
  std::vector<Uncovered> from_the_highest(const Wanted& wanted) const {
    std::vector<Uncovered> all;
    for (const auto& block : parallel::map_blocks<std::vector<Uncovered>>(
             grid_.nx,
             [&](Index begin, Index end) {
               std::vector<Uncovered> found;
               for (Index point = begin * grid_.ny; point < end * grid_.ny; ++point)
                 if (wanted(point))
                   found.push_back({heights_[point], static_cast<std::int32_t>(point)});
               return found;
             },
             grid_.points()))
      all.insert(all.end(), block.begin(), block.end());
    std::ranges::sort(all, std::less{});
    return all;
  }

  /// Whether point a is higher than point b; false if either height is undefined.
  bool is_higher(Index a, Index b) const {
    return heights_[a] > heights_[b] || (heights_[a] == heights_[b] && a < b);
  }

  template <class Visit>
  void visit_neighbours(Index point, const Visit& visit) const {
    // Numbers of points fit into 32 bits; 64-bit divisions would take a third of the time of the
    // search.
    const Index ix = static_cast<std::uint32_t>(point) / static_cast<std::uint32_t>(grid_.ny),
                iy = point - ix * grid_.ny;
    if (ix > 0 && ix + 1 < grid_.nx && iy > 0 && iy + 1 < grid_.ny) {
      for (const Index step : ahead_) visit(point + step);
      return;
    }
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
        visit(jx * grid_.ny + jy);
      }
    }
  }

  void look_up(Index point) {
    Index highest = point;
    visit_neighbours(point, [&](Index next) {
      if (is_higher(next, highest)) highest = next;
    });
    towards_[static_cast<std::size_t>(point)] = static_cast<std::int32_t>(highest);
  }

  // The next point on the way up from a point. Threads shorten such paths while others climb them;
  // every value that a thread may read leads to the same summit.
  std::atomic_ref<std::int32_t> towards(Index point) const {
    return std::atomic_ref(towards_[static_cast<std::size_t>(point)]);
  }
  Index next_of(Index point) const { return towards(point).load(std::memory_order_relaxed); }
  bool is_summit(Index point) const { return next_of(point) == point; }

  /// Returns the summit at the end of the path upward from a point, and makes the path lead to it
  /// directly.
  Index climb(Index point) const {
    Index summit = next_of(point);
    for (Index next = next_of(summit); next != summit; next = next_of(summit)) summit = next;
    for (Index next = next_of(point); next != summit; next = next_of(point)) {
      towards(point).store(static_cast<std::int32_t>(summit), std::memory_order_relaxed);
      point = next;
    }
    return summit;
  }

  /// Whether the higher neighbours of a point belong to several hills of which no two have been
  /// joined at one of these neighbours.
  bool hills_meet(Index point) const {
    const Index own = next_of(point);
    bool inside = true;
    visit_neighbours(point, [&](Index next) { inside &= next_of(next) == own; });
    if (inside) return false;
    const Slopes meeting = slopes_at(point);
    if (meeting.count < 2) return false;
    bool joined = false;
    visit_neighbours(point, [&](Index next) {
      joined = joined || (is_higher(next, point) && slopes_at(next).hold(meeting));
    });
    return !joined;
  }

  /// The hills that the higher neighbours of a point belong to.
  struct Slopes {
    std::array<Index, 8> hills;
    std::size_t count = 0;

    bool has(Index hill) const {
      return std::find(hills.begin(), hills.begin() + count, hill) != hills.begin() + count;
    }
    bool hold(const Slopes& others) const {
      return std::all_of(others.hills.begin(), others.hills.begin() + others.count,
                         [this](Index hill) { return has(hill); });
    }
  };
  Slopes slopes_at(Index point) const {
    Slopes slopes;
    visit_neighbours(point, [&](Index next) {
      if (is_higher(next, point) && !slopes.has(next_of(next)))
        slopes.hills[slopes.count++] = next_of(next);
    });
    return slopes;
  }

  void uncover(Index point) {
    Index own = point;
    visit_neighbours(point, [&](Index next) {
      if (!is_higher(next, point)) return;
      Index other = climb(next);
      if (other == own) return;
      // The hill with the lower peak ends at this saddle.
      if (is_higher(own, other)) std::swap(own, other);
      if (own != point) {
        keep(own, heights_[own] - heights_[point]);
        towards(own) = static_cast<std::int32_t>(other);
      }
      own = other;
    });
  }

  void keep(Index point, double prominence) {
    if (prominence < min_prominence_) return;
    const Index ix = point / grid_.ny, iy = point % grid_.ny;
    Index defined = 0;
    visit_neighbours(point, [&](Index next) { defined += !std::isnan(heights_[next]); });
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
  const std::array<Index, 8> ahead_;  ///< index offsets from an inner point to its neighbours
  LargeArray<std::int32_t> towards_;  ///< the highest neighbour, later the summit
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
  require_memory(grid, 12 * static_cast<double>(grid.points()), "a list of peaks");
  return PeakSearch(surface, min_prominence).found();
}

}  // namespace salebra
