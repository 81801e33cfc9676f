// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "contact/half_space/half_space.hpp"
#include "contact_residual.hpp"

namespace salebra::detail {

// Fallback where ActiveSetCg stalls (bounds that hold most of the load make its set of free cells
// flutter): gradient projection, which finds the set, and conjugate gradients on the free cells, in
// turns (Moré and Toraldo 1991, doi:10.1137/0801008). Each step lowers ½p·Gp − p·h, so it converges
// from any start; several times the iterations of ActiveSetCg. p: within its bounds on entry, the
// solution on return; g = Gp − h on return. Counters in outcome are accumulated.
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
