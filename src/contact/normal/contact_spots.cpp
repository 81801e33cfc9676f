// SPDX-License-Identifier: GPL-3.0-or-later
// Contact spots of a pressure field: areas, forces, perimeter, and the area corrected for it.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <utility>
#include <vector>

namespace salebra {
namespace {

/// Disjoint sets of numbers 0, 1, …; the least number of a set is its root.
class Sets {
 public:
  void add() { parent_.push_back(static_cast<Index>(parent_.size())); }
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

  // Contact cells are numbered row by row. Each row is compared with the one before it, and the first with the last at the end; an edge
  // of the contact lies between unlike cells.
  using Row = std::vector<Index>;  // the number of each cell, or none
  constexpr Index none = -1;
  Sets sets;
  std::vector<double> loads;
  Index edges_across_x = 0, edges_across_y = 0;
  const auto numbered = [&](Index ix, Row& row) {
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double load = pressure(ix, iy);
      Index& number = row[static_cast<std::size_t>(iy)];
      number = none;
      if (!(load > 0)) continue;
      number = static_cast<Index>(loads.size());
      loads.push_back(load);
      sets.add();
    }
  };
  const auto compare = [&](Index first, Index second, Index& edges) {
    edges += (first == none) != (second == none);
    if (first != none && second != none) sets.join(first, second);
  };
  const auto compare_rows = [&](const Row& first, const Row& second) {
    for (std::size_t iy = 0; iy < first.size(); ++iy)
      compare(first[iy], second[iy], edges_across_x);
  };
  const auto compare_within = [&](const Row& row) {
    for (std::size_t iy = 1; iy < row.size(); ++iy) compare(row[iy - 1], row[iy], edges_across_y);
    compare(row.back(), periodic ? row.front() : none, edges_across_y);
    if (!periodic) compare(none, row.front(), edges_across_y);
  };
  const Row empty(static_cast<std::size_t>(grid.ny), none);
  Row first = empty, last = empty, row = empty;
  for (Index ix = 0; ix < grid.nx; ++ix) {
    numbered(ix, row);
    compare_within(row);
    if (ix == 0)
      first = row;
    else
      compare_rows(last, row);
    std::swap(last, row);
  }
  compare_rows(last, periodic ? first : empty);
  if (!periodic) compare_rows(empty, first);

  ContactSpots result;
  const Index cells = static_cast<Index>(loads.size());
  std::vector<Index> spot_of(loads.size(), none);
  for (Index cell = 0; cell < cells; ++cell) {
    Index& spot = spot_of[static_cast<std::size_t>(sets.root(cell))];
    if (spot == none) {
      spot = static_cast<Index>(result.spots.size());
      result.spots.emplace_back();
    }
    result.spots[static_cast<std::size_t>(spot)].area += grid.cell_area();
    result.spots[static_cast<std::size_t>(spot)].force +=
        loads[static_cast<std::size_t>(cell)] * grid.cell_area();
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
