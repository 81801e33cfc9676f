// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "surface_response.hpp"

namespace salebra::detail {

struct CgOutcome {
  int iterations = 0;  // steps taken
  // A direction with d·Ad <= 0 was found: round-off has used up the accuracy of the system.
  bool exhausted = false;
};

// Preconditioned conjugate gradients on A x = b for vectors of points; the matrix A is symmetric
// and positive definite.
//   apply(x, Ax)                  computes Ax
//   precondition(misfit, z)       computes z ≈ A⁻¹·misfit
//   stop(|misfit|², iterations)   called before each step; true ends the iteration
//   dot(a, b)                     Σ a_i b_i
//   x, misfit                     on entry the guess and b − Ax; x and misfit are current on return
// The factor β = −<z, Ad>/<d, Ad> of the last direction d makes the new direction conjugate to d
// even if precondition() is not linear. ActiveSetCg, gradient_projection and InteractingSummits
// have their own loops, for reasons given there.
template <class Apply, class Precondition, class Stop, class Dot>
CgOutcome conjugate_gradients(const Apply& apply, const Precondition& precondition,
                              const Stop& stop, const Dot& dot, std::vector<double>& x,
                              std::vector<double>& misfit) {
  const std::size_t unknowns = misfit.size();
  std::vector<double> preconditioned(unknowns), direction(unknowns, 0.0), image(unknowns);
  CgOutcome outcome;
  double curvature = 1;
  while (!stop(dot(misfit, misfit), outcome.iterations)) {
    precondition(misfit, preconditioned);
    const double weight = dot(misfit, preconditioned);
    const double beta = outcome.iterations > 0 ? -dot(preconditioned, image) / curvature : 0;
    for_each(unknowns, unknowns,
             [&](std::size_t i) { direction[i] = preconditioned[i] + beta * direction[i]; });
    apply(direction, image);
    curvature = dot(direction, image);
    if (!(curvature > 0)) {
      outcome.exhausted = true;
      break;
    }
    const double step = weight / curvature;
    for_each(unknowns, unknowns, [&](std::size_t i) {
      x[i] += step * direction[i];
      misfit[i] -= step * image[i];
    });
    ++outcome.iterations;
  }
  return outcome;
}

}  // namespace salebra::detail
