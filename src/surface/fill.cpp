// SPDX-License-Identifier: GPL-3.0-or-later
// Fills undefined points by a solution of the discrete Laplace equation.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/surface/fill.hpp>
#include <vector>

#include "shape.hpp"

namespace salebra {

Holes holes_of(const Surface& surface) {
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  Holes holes;
  // Side of the largest square of undefined points whose last corner is each point of a row: one
  // more than the minimum over the three neighbours that come before the point.
  std::vector<Index> sides(static_cast<std::size_t>(grid.ny) + 1, 0);
  Index widest = 0;
  for (Index ix = 0; ix < grid.nx; ++ix) {
    Index diagonal = 0;
    for (Index iy = 0; iy < grid.ny; ++iy) {
      Index& before = sides[static_cast<std::size_t>(iy)];
      Index& side = sides[static_cast<std::size_t>(iy) + 1];
      const Index above = side;
      const bool hole = std::isnan(surface.heights(ix, iy));
      side = hole ? 1 + std::min({before, above, diagonal}) : 0;
      diagonal = above;
      holes.points += hole;
      widest = std::max(widest, side);
    }
  }
  const auto points = static_cast<double>(widest);
  holes.fraction = static_cast<double>(holes.points) / static_cast<double>(grid.points());
  holes.width = points * std::max(grid.dx(), grid.dy());
  holes.widest_share = points / static_cast<double>(std::min(grid.nx, grid.ny));
  return holes;
}

Surface filled(Surface surface) {
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  const Index unknowns = surface.undefined_points();
  if (unknowns == 0) return surface;
  require(unknowns < grid.points(), "heights", "all points",
          "are undefined, so there is nothing to fill from");

  using Number = Eigen::Array<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Number number = Number::Constant(grid.nx, grid.ny, -1);
  int next = 0;
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy)
      if (std::isnan(surface.heights(ix, iy))) number(ix, iy) = next++;

  // Weights relative to each other avoid the overflow and underflow of 1/dx² for lengths in metres.
  const double ratio = grid.dx() / grid.dy();
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
  for (Index ix = 0; ix < grid.nx; ++ix) {
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const int row = number(ix, iy);
      if (row < 0) continue;
      double diagonal = 0;
      const auto couple = [&](Index jx, Index jy, double weight) {
        if (surface.periodic) {
          jx = (jx + grid.nx) % grid.nx;
          jy = (jy + grid.ny) % grid.ny;
        } else if (jx < 0 || jx >= grid.nx || jy < 0 || jy >= grid.ny) {
          return;
        }
        diagonal += weight;
        if (const int column = number(jx, jy); column >= 0)
          entries.emplace_back(row, column, -weight);
        else
          right(row) += weight * surface.heights(jx, jy);
      };
      couple(ix - 1, iy, 1);
      couple(ix + 1, iy, 1);
      couple(ix, iy - 1, ratio * ratio);
      couple(ix, iy + 1, ratio * ratio);
      entries.emplace_back(row, row, diagonal);
    }
  }
  Eigen::SparseMatrix<double> laplace(unknowns, unknowns);
  laplace.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(laplace);
  const Eigen::VectorXd heights = factors.solve(right);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy)
      if (number(ix, iy) >= 0) surface.heights(ix, iy) = heights(number(ix, iy));
  return surface;
}

}  // namespace salebra
