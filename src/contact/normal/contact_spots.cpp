// SPDX-License-Identifier: GPL-3.0-or-later
// Contact spots of a pressure field: areas, forces, perimeter, and the area corrected for it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/contact_spots.hpp>

namespace salebra {
namespace {

/// Disjoint sets of cells; the least index of a set is its root.
class Sets {
 public:
  explicit Sets(Index cells) : parent_(static_cast<std::size_t>(cells)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index root(Index cell) {
    while (at(cell) != cell) {
      at(cell) = at(at(cell));
      cell = at(cell);
    }
    return cell;
  }
  void join(Index first, Index second) {
    first = root(first);
    second = root(second);
    at(std::max(first, second)) = std::min(first, second);
  }

 private:
  Index& at(Index cell) { return parent_[static_cast<std::size_t>(cell)]; }
  std::vector<Index> parent_;
};

}  // namespace

ContactSpots contact_spots(const Field& pressure, const Grid2D& grid, Boundary boundary) {
  grid.validate();
  require(pressure.rows() == grid.nx && pressure.cols() == grid.ny, "pressure", pressure.rows(),
          "rows or the number of columns differ from those of the grid");
  const bool periodic = boundary == Boundary::periodic;
  const auto touches = [&](Index ix, Index iy) { return pressure(ix, iy) > 0; };
  Sets sets(grid.points());
  Index cells = 0, edges_across_x = 0, edges_across_y = 0;
  // Each cell looks at its next neighbour along x and along y; an edge of the contact lies between unlike cells.
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const bool here = touches(ix, iy);
      cells += here;
      const Index next_x = (ix + 1) % grid.nx, next_y = (iy + 1) % grid.ny;
      if (periodic || next_x > ix) {
        edges_across_x += here != touches(next_x, iy);
        if (here && touches(next_x, iy)) sets.join(ix * grid.ny + iy, next_x * grid.ny + iy);
      } else {
        edges_across_x += here;
        edges_across_x += touches(0, iy);
      }
      if (periodic || next_y > iy) {
        edges_across_y += here != touches(ix, next_y);
        if (here && touches(ix, next_y)) sets.join(ix * grid.ny + iy, ix * grid.ny + next_y);
      } else {
        edges_across_y += here;
        edges_across_y += touches(ix, 0);
      }
    }

  ContactSpots result;
  std::vector<Index> spot_of(static_cast<std::size_t>(grid.points()), -1);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      if (!touches(ix, iy)) continue;
      Index& spot = spot_of[static_cast<std::size_t>(sets.root(ix * grid.ny + iy))];
      if (spot < 0) {
        spot = static_cast<Index>(result.spots.size());
        result.spots.emplace_back();
      }
      result.spots[static_cast<std::size_t>(spot)].area += grid.cell_area();
      result.spots[static_cast<std::size_t>(spot)].force += pressure(ix, iy) * grid.cell_area();
    }
  std::ranges::stable_sort(result.spots, std::ranges::greater{}, &ContactSpot::area);

  const double points = static_cast<double>(grid.points());
  result.contact_area_fraction = static_cast<double>(cells) / points;
  result.perimeter = static_cast<double>(edges_across_x) * grid.dy() +
                     static_cast<double>(edges_across_y) * grid.dx();
  // Every edge takes its share of one cell.
  const double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24 *
                        static_cast<double>(edges_across_x + edges_across_y) / points;
  result.corrected_area_fraction = std::max(0.0, result.contact_area_fraction - excess);
  return result;
}

}  // namespace salebra
