// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "active_set_cg.hpp"

namespace salebra::detail {

// One grid of a sequence of coarser and coarser grids; lengths are in cells of the finest grid.
struct MultigridLevel {
  Grid2D grid;
  RowPartition rows;     // rows of each process; coarse grids have fewer processes
  Field coarse_heights;  // empty on the finest grid, which reads the caller's heights
  Heights heights;
};

// Grids of which each has half the points of the previous one along each axis, until a grid has at
// most 64² points: every second point if the number of points is even, interpolation otherwise.
// levels.front() is the finest; there are at most `most` grids. Collective.
std::vector<MultigridLevel> multigrid_levels(const Grid2D& grid, const RowPartition& rows,
                                             const Heights& heights, Boundary boundary, int most);

// Computes the pressures from which the finer grid starts: the coarse pressure p_c, interpolated
// bilinearly, and one step in each point towards the gap that the cubically interpolated coarse
// displacement u_c predicts at the heights h of the finer grid,
//     p = max(p_c − step·(u_c − h), 0),   u_c = g_c + h_c − plane_height,
// with the coarse heights h_c and the coarse gap g_c, not relative to the plane. Fields hold the
// rows of this process. Collective.
struct CoarseSolution {
  const MultigridLevel& grid;
  const Field &pressure, &gap;
  double plane_height;
};
void prolong(const CoarseSolution& coarse, const MultigridLevel& fine, Boundary boundary,
             double step, double* pressure);

}  // namespace salebra::detail
