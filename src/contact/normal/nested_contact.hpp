// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "active_set_cg.hpp"

namespace salebra::detail {

// One grid of the hierarchy, in units of the finest cell's size.
struct MultigridLevel {
  Grid2D grid;
  RowPartition rows;            // that each process holds: fewer processes on coarse grids
  Field coarse_heights;  // empty on the finest level, which reads the caller's
  Heights heights;
};

// Halves the grid while it has more than 64² cells, by point sampling where it divides and by
// interpolation where it does not. levels.front() is the finest; there are at most `most`.
// Collective.
std::vector<MultigridLevel> multigrid_levels(const Grid2D& grid, const RowPartition& rows,
                                             const Heights& heights, Boundary boundary, int most);

// A start for the finer level: bilinear pressure, then one pointwise step towards the gap that the
// cubic displacement predicts,
//     p = max(p_c − step·(u_c − h), 0),   u_c = g_c + h_c − level.
// Fields hold the rows of this process. Collective.
struct CoarseSolution {
  const MultigridLevel& grid;
  const Field &pressure, &gap;
  double plane_height;
};
void prolong(const CoarseSolution& coarse, const MultigridLevel& fine, Boundary boundary,
             double step, double* pressure);

}  // namespace salebra::detail
