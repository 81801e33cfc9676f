// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/half_space/half_space.hpp"
#include "contact_residual.hpp"

namespace salebra::detail {

// Takes over if ActiveSetCg stalls: if cells at the bound hold most of the load, its set of free
// cells may change back and forth. Gradient projection finds the set, conjugate gradients solve on
// the free cells, and these two alternate (Moré and Toraldo 1991, doi:10.1137/0801008). Each step
// lowers the energy ½p·Gp − p·h of the pressures p at heights h with the normal compliance G, so
// the method converges from any start, in several times the iterations of ActiveSetCg. p: within
// its bounds on entry, the solution on return; g = Gp − h on return. Counters in `outcome` are
// increased.
struct ProjectionProblem {
  Convolution2D<double>& compliance;
  const Grid2D& grid;
  const RowPartition& rows;
  Boundary boundary;
  Heights heights;
  double rms_height;
  ScaledOperatingPoint target;
};
void gradient_projection(const ProjectionProblem& problem, const ActiveSetLimits& limits, double* p,
                         double* g, ActiveSetOutcome& outcome);

}  // namespace salebra::detail
