// SPDX-License-Identifier: GPL-3.0-or-later
// Summits of a surface in 3 × 3 neighbourhoods, their curvatures and statistics.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/surface/summits.hpp>

#include "neighbour_rows.hpp"
#include "shape.hpp"

namespace salebra {
namespace {

/// Heights of 3 × 3 points; element [1 + i][1 + j] is i steps in x and j steps in y from the
/// centre.
using Neighbourhood = std::array<std::array<double, 3>, 3>;

bool is_defined(const Neighbourhood& h) {
  double sum = 0;
  for (const auto& row : h)
    for (const double height : row) sum += height;
  return std::isfinite(sum);
}

bool is_maximum(const Neighbourhood& h) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      const int order = 3 * a + b;
      if (order < 4 && h[a][b] > h[1][1]) return false;
      if (order > 4 && h[a][b] >= h[1][1]) return false;
    }
  }
  return true;
}

/// Least-squares fit of the paraboloid c + s_x x + s_y y − ½(k_xx x² + 2 k_xy xy + k_yy y²) to the
/// heights of 3 × 3 points, where x and y are −1, 0 and 1 times the steps of the grid.
struct Paraboloid {
  double height, slope_x, slope_y, k_xx, k_xy, k_yy;

  Paraboloid(const Neighbourhood& h, double dx, double dy) {
    double sum = 0, along_x = 0, along_y = 0, outer_x = 0, outer_y = 0, cross = 0;
    for (int a = -1; a <= 1; ++a) {
      for (int b = -1; b <= 1; ++b) {
        const double z = h[a + 1][b + 1] - h[1][1];
        sum += z;
        along_x += a * z;
        along_y += b * z;
        outer_x += a * a * z;
        outer_y += b * b * z;
        cross += a * b * z;
      }
    }
    const double second_x = outer_x - 2.0 / 3.0 * sum, second_y = outer_y - 2.0 / 3.0 * sum;
    height = h[1][1] + (sum - 3 * (second_x + second_y)) / 9;
    slope_x = along_x / (6 * dx);
    slope_y = along_y / (6 * dy);
    k_xx = -second_x / (dx * dx);
    k_yy = -second_y / (dy * dy);
    k_xy = -cross / (4 * dx * dy);
  }
};

Summit osculate(const Neighbourhood& h, double dx, double dy) {
  const Paraboloid fit(h, dx, dy);
  const double mean = (fit.k_xx + fit.k_yy) / 2;
  const double deviation = std::hypot((fit.k_xx - fit.k_yy) / 2, fit.k_xy);
  const double determinant = fit.k_xx * fit.k_yy - fit.k_xy * fit.k_xy;
  if (mean > deviation && determinant > 0) {
    const double x = (fit.k_yy * fit.slope_x - fit.k_xy * fit.slope_y) / determinant;
    const double y = (fit.k_xx * fit.slope_y - fit.k_xy * fit.slope_x) / determinant;
    if (std::abs(x) <= dx && std::abs(y) <= dy)
      return {x, y, fit.height + (fit.slope_x * x + fit.slope_y * y) / 2, mean + deviation,
              mean - deviation};
  }
  const double k_x = ((h[1][1] - h[0][1]) + (h[1][1] - h[2][1])) / (dx * dx);
  const double k_y = ((h[1][1] - h[1][0]) + (h[1][1] - h[1][2])) / (dy * dy);
  return {0, 0, h[1][1], std::max(k_x, k_y), std::min(k_x, k_y)};
}

}  // namespace

SummitList find_summits(const Surface& surface) {
  const Grid2D& grid = surface.grid;
  collectively(surface.communicator, [&] { detail::require_shape_of_rows(surface); });
  require(grid.nx >= 3, "nx", grid.nx, "must be >= 3 to have summits");
  require(grid.ny >= 3, "ny", grid.ny, "must be >= 3 to have summits");
  const Index border = surface.periodic ? 0 : 1;
  const detail::NeighbourRows rows(surface);
  const RowPartition partition = surface.partition();
  struct Found {
    std::vector<Summit> summits;
    Index searched = 0;
  };
  const auto search = [&](Index begin, Index end) {
    Found found;
    for (Index row = begin; row < end; ++row) {
      const std::array<const double*, 3> lines{rows[row - 1], rows[row], rows[row + 1]};
      if (!lines.front() || !lines.back()) continue;
      const Index ix = partition.begin() + row;
      for (Index iy = border; iy < grid.ny - border; ++iy) {
        const std::array<Index, 3> columns{iy > 0 ? iy - 1 : grid.ny - 1, iy,
                                           iy + 1 < grid.ny ? iy + 1 : 0};
        Neighbourhood h;
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t b = 0; b < 3; ++b) h[a][b] = lines[a][columns[b]];
        if (!is_defined(h)) continue;
        ++found.searched;
        if (!is_maximum(h)) continue;
        Summit summit = osculate(h, grid.dx(), grid.dy());
        if (!(summit.curvature1 > 0)) continue;
        summit.x += static_cast<double>(ix) * grid.dx();
        summit.y += static_cast<double>(iy) * grid.dy();
        found.summits.push_back(summit);
      }
    }
    return found;
  };
  SummitList list{{}, 0, surface.communicator, grid.nx};
  std::vector<Index> searched;
  for (const Found& found :
       parallel::map_blocks_of<Found>(parallel::block_rows(grid.nx), partition.count(), search)) {
    list.summits.insert(list.summits.end(), found.summits.begin(), found.summits.end());
    list.in_block.push_back(static_cast<Index>(found.summits.size()));
    searched.push_back(found.searched);
  }
  Index in_all = 0;
  for (const Index of_block : parallel::gather_blocks(partition, searched)) in_all += of_block;
  list.searched_area = static_cast<double>(in_all) * grid.cell_area();
  return list;
}

SummitStatistics summit_statistics(const SummitList& list) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const bool of_surface = list.rows > 0;
  const RowPartition rows =
      of_surface ? RowPartition(list.communicator, list.rows) : RowPartition(1);
  const std::vector<Index> in_block =
      of_surface ? list.in_block : std::vector<Index>{static_cast<Index>(list.summits.size())};
  // Sum of term(summit) over the summits of all processes.
  const auto sum = [&](const auto& term) {
    std::vector<double> blocks;
    auto summit = list.summits.begin();
    for (const Index count : in_block) {
      double of_block = 0;
      for (const auto end = summit + count; summit != end; ++summit) of_block += term(*summit);
      blocks.push_back(of_block);
    }
    double total = 0;
    for (const double of_block : parallel::gather_blocks(rows, blocks)) total += of_block;
    return total;
  };
  const double count = sum([](const Summit&) { return 1.0; });
  if (count == 0) return {0, none, none, none};
  const double height = sum([](const Summit& summit) { return summit.height; }) / count;
  const double curvature =
      sum([](const Summit& summit) { return summit.curvature1 + summit.curvature2; }) / (2 * count);
  const double variance = sum([height](const Summit& summit) {
                            return (summit.height - height) * (summit.height - height);
                          }) /
                          count;
  return {count / list.searched_area, height, std::sqrt(variance), 1 / curvature};
}

}  // namespace salebra
