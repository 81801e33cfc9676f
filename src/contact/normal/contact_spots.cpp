// SPDX-License-Identifier: GPL-3.0-or-later
// Contact spots of a pressure field: areas, forces, perimeter, and the area corrected by means of
// the perimeter.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace salebra {
namespace {

/// Disjoint sets of the numbers 0, 1, 2 and so on; the smallest number of a set is its root.
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

constexpr Index none = -1;

/// A run of successive contact cells of a row, the columns begin … end − 1. All of them belong to
/// the same connected part of the contact.
struct Run {
  Index begin = 0, end = 0, part = 0;
};

/// What one process finds in its rows. Parts are sets of connected contact cells, in the order of
/// their first cells.
struct Found {
  Index parts = 0, edges_across_x = 0, edges_across_y = 0;
  std::vector<Run> first, last;    // runs of the process's first and last row
  std::vector<Index> part_of;      // part of each contact cell, row by row
  std::vector<double> loads;       // pressure of each contact cell
  std::vector<std::size_t> cells;  // number of contact cells before each block of rows; last: of
                                   // all
};

std::vector<Run> runs_of(const std::vector<Index>& row, const std::vector<Index>& part_of) {
  std::vector<Run> runs;
  for (Index iy = 0; iy < static_cast<Index>(row.size()); ++iy) {
    const Index cell = row[static_cast<std::size_t>(iy)];
    if (cell == none) continue;
    if (runs.empty() || runs.back().end < iy)
      runs.push_back({iy, iy, part_of[static_cast<std::size_t>(cell)]});
    runs.back().end = iy + 1;
  }
  return runs;
}

Found find_parts(const Field& pressure, bool periodic, Index block_rows) {
  // Contact cells are numbered row by row. Each row is compared with the previous one; an edge of
  // the contact lies between a contact cell and a cell out of contact.
  using Row = std::vector<Index>;  // the number of each cell, or none
  Found found;
  Sets sets;
  const auto numbered = [&](Index ix, Row& row) {
    for (Index iy = 0; iy < pressure.cols(); ++iy) {
      const double load = pressure(ix, iy);
      Index& number = row[static_cast<std::size_t>(iy)];
      number = none;
      if (!(load > 0)) continue;
      number = static_cast<Index>(found.loads.size());
      found.loads.push_back(load);
      sets.add();
    }
  };
  const auto compare = [&](Index first, Index second, Index& edges) {
    edges += (first == none) != (second == none);
    if (first != none && second != none) sets.join(first, second);
  };
  const auto compare_within = [&](const Row& row) {
    Index& edges = found.edges_across_y;
    for (std::size_t iy = 1; iy < row.size(); ++iy) compare(row[iy - 1], row[iy], edges);
    compare(row.back(), periodic ? row.front() : none, edges);
    if (!periodic) compare(none, row.front(), edges);
  };
  Row first, last, row(static_cast<std::size_t>(pressure.cols()));
  for (Index ix = 0; ix < pressure.rows(); ++ix) {
    if (ix % block_rows == 0) found.cells.push_back(found.loads.size());
    numbered(ix, row);
    compare_within(row);
    if (ix == 0)
      first = last = row;
    else
      for (std::size_t iy = 0; iy < row.size(); ++iy)
        compare(last[iy], row[iy], found.edges_across_x);
    std::swap(last, row);
  }
  found.cells.push_back(found.loads.size());

  // The root of a set is its first cell, so the part of the root is known before those of its other
  // cells.
  for (Index cell = 0; cell < static_cast<Index>(found.loads.size()); ++cell) {
    const Index root = sets.root(cell);
    found.part_of.push_back(root == cell ? found.parts++
                                         : found.part_of[static_cast<std::size_t>(root)]);
  }
  found.first = runs_of(first, found.part_of);
  found.last = runs_of(last, found.part_of);
  return found;
}

/// Gathers the lists of all processes, one list for each process.
template <class Item>
std::vector<std::vector<Item>> gathered(const Communicator& communicator,
                                        const std::vector<Item>& mine) {
  static_assert(std::is_trivially_copyable_v<Item>);
  std::vector<std::vector<Item>> all;
  for (const std::string& bytes : communicator.gather_all(
           std::string(reinterpret_cast<const char*>(mine.data()), mine.size() * sizeof(Item)))) {
    all.emplace_back(bytes.size() / sizeof(Item));
    if (!bytes.empty()) std::memcpy(all.back().data(), bytes.data(), bytes.size());
  }
  return all;
}

/// Counts the edges of the contact between two neighbouring rows, and calls join(first part, second
/// part) for parts that touch across the boundary of the rows.
template <class Join>
Index compare_runs(const std::vector<Run>& first, const std::vector<Run>& second,
                   const Join& join) {
  Index edges = 0;
  for (const auto* runs : {&first, &second})
    for (const Run& run : *runs) edges += run.end - run.begin;
  for (auto a = first.begin(), b = second.begin(); a != first.end() && b != second.end();) {
    if (const Index both = std::min(a->end, b->end) - std::max(a->begin, b->begin); both > 0) {
      edges -= 2 * both;
      join(a->part, b->part);
    }
    ++(a->end < b->end ? a : b);
  }
  return edges;
}

/// The parts of all processes, joined to spots in the order of their first cells.
struct Joined {
  Index edges_across_x = 0, edges_across_y = 0, spots = 0;
  std::vector<Index> spot_of;  // spot of each part of this process
};

/// Every process joins the parts of all processes to spots, by the runs of cells in the first and
/// last row of each process.
Joined join_parts(const Found& mine, const RowPartition& rows, bool periodic) {
  const Communicator& communicator = rows.communicator();
  struct Counts {
    Index parts = 0, edges_across_x = 0, edges_across_y = 0;
  };
  const auto counts =
      gathered<Counts>(communicator, {{mine.parts, mine.edges_across_x, mine.edges_across_y}});
  const auto first = gathered(communicator, mine.first), last = gathered(communicator, mine.last);
  Joined joined;
  Sets sets;
  std::vector<Index> before{0};  // number of parts in all earlier processes
  Index in_use = 0;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    const Counts& of_rank = counts[static_cast<std::size_t>(rank)].front();
    for (Index part = 0; part < of_rank.parts; ++part) sets.add();
    before.push_back(before.back() + of_rank.parts);
    joined.edges_across_x += of_rank.edges_across_x;
    joined.edges_across_y += of_rank.edges_across_y;
    in_use += rows.end_of(rank) > rows.begin_of(rank);  // processes without rows come last
  }
  const auto meet = [&](const std::vector<Run>& a, Index rank_of_a, const std::vector<Run>& b,
                        Index rank_of_b) {
    joined.edges_across_x += compare_runs(a, b, [&](Index part_of_a, Index part_of_b) {
      sets.join(before[static_cast<std::size_t>(rank_of_a)] + part_of_a,
                before[static_cast<std::size_t>(rank_of_b)] + part_of_b);
    });
  };
  for (Index rank = 1; rank < in_use; ++rank)
    meet(last[static_cast<std::size_t>(rank - 1)], rank - 1, first[static_cast<std::size_t>(rank)],
         rank);
  const auto& first_row = first.front();
  const auto& last_row = last[static_cast<std::size_t>(in_use - 1)];
  if (periodic) {
    meet(last_row, in_use - 1, first_row, 0);
  } else {
    meet(last_row, in_use - 1, {}, 0);
    meet({}, 0, first_row, 0);
  }
  std::vector<Index> spot_of(static_cast<std::size_t>(before.back()));
  for (Index part = 0; part < before.back(); ++part) {
    const Index root = sets.root(part);
    spot_of[static_cast<std::size_t>(part)] =
        root == part ? joined.spots++ : spot_of[static_cast<std::size_t>(root)];
  }
  const Index begin = before[static_cast<std::size_t>(communicator.rank())];
  joined.spot_of.assign(spot_of.begin() + begin, spot_of.begin() + begin + mine.parts);
  return joined;
}

/// Cells and load of a spot within one block of rows.
struct Piece {
  Index spot = 0, cells = 0;
  double load = 0;
};

std::vector<Piece> pieces_of(const Found& mine, const Joined& joined) {
  std::vector<Piece> pieces;
  std::vector<std::size_t> piece_of(static_cast<std::size_t>(joined.spots));
  for (std::size_t block = 0; block + 1 < mine.cells.size(); ++block) {
    const std::size_t of_earlier_blocks = pieces.size();
    for (std::size_t cell = mine.cells[block]; cell < mine.cells[block + 1]; ++cell) {
      const Index spot = joined.spot_of[static_cast<std::size_t>(mine.part_of[cell])];
      std::size_t& piece = piece_of[static_cast<std::size_t>(spot)];
      if (piece < of_earlier_blocks || piece >= pieces.size() || pieces[piece].spot != spot) {
        piece = pieces.size();
        pieces.push_back({spot});
      }
      ++pieces[piece].cells;
      pieces[piece].load += mine.loads[cell];
    }
  }
  return pieces;
}

}  // namespace

ContactSpots contact_spots(const Field& pressure, const Grid2D& grid, Boundary boundary,
                           const Communicator& communicator) {
  const RowPartition rows(communicator, grid.nx);
  const bool periodic = boundary == Boundary::periodic;
  const Index block_rows = parallel::block_rows(grid.nx);
  Found mine;
  collectively(communicator, [&] {
    grid.validate();
    require(pressure.rows() == rows.count() && pressure.cols() == grid.ny, "pressure",
            pressure.rows(), "rows or the number of columns differ from those of the grid");
    mine = find_parts(pressure, periodic, block_rows);
  });

  const Joined joined = join_parts(mine, rows, periodic);
  // Forces are added within each block of rows, then over the blocks, so that their bits do not
  // depend on the number of processes.
  ContactSpots result;
  result.spots.resize(static_cast<std::size_t>(joined.spots));
  std::vector<Index> cells_of(result.spots.size(), 0);
  Index cells = 0;
  for (const auto& of_rank : gathered(communicator, pieces_of(mine, joined))) {
    for (const Piece& piece : of_rank) {
      cells += piece.cells;
      cells_of[static_cast<std::size_t>(piece.spot)] += piece.cells;
      result.spots[static_cast<std::size_t>(piece.spot)].force += piece.load;
    }
  }
  for (std::size_t spot = 0; spot < cells_of.size(); ++spot) {
    result.spots[spot].area = static_cast<double>(cells_of[spot]) * grid.cell_area();
    result.spots[spot].force *= grid.cell_area();
  }
  std::ranges::stable_sort(result.spots, std::ranges::greater{}, &ContactSpot::area);

  const double points = static_cast<double>(grid.points());
  result.contact_area_fraction = static_cast<double>(cells) / points;
  result.perimeter_along_x = static_cast<double>(joined.edges_across_y) * grid.dx();
  result.perimeter =
      static_cast<double>(joined.edges_across_x) * grid.dy() + result.perimeter_along_x;
  // Every edge reduces the area by the same fraction of a cell.
  const double excess = (std::numbers::pi - 1 + std::numbers::ln2) / 24 *
                        static_cast<double>(joined.edges_across_x + joined.edges_across_y) / points;
  result.corrected_area_fraction = std::max(0.0, result.contact_area_fraction - excess);
  return result;
}

}  // namespace salebra
