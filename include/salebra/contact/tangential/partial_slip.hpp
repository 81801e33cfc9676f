// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/tangential/stick.hpp>

namespace salebra {

/// Report on a partial-slip solve. Unless it converged, its results must not be used.
struct PartialSlipReport {
  int steps = 0;       ///< Newton steps: changes of the sticking and slipping parts
  int iterations = 0;  ///< conjugate gradient iterations in all steps
  int fft_count = 0;   ///< forward-and-backward pairs of scalar fields
  /// rms over the contact set of the projected gradient |τ − P(τ − κg)|/κ, in units of the scale,
  /// with g = Kτ − v, P the projection on the discs and κ the stiffness of a cell. It is the
  /// displacement error in sticking cells, and 0 only at the solution.
  double residual = 0;
  Index slipping = 0;  ///< cells that slip
  Termination termination = Termination::iteration_limit;

  bool converged() const { return termination == Termination::converged; }
};

constexpr void describe(auto&& visit, std::type_identity<PartialSlipReport>) {
  using S = PartialSlipReport;
  visit(&S::steps, Kept{"steps", "Newton steps"});
  visit(&S::iterations, Kept{"iterations", "iterations of conjugate gradients in all steps"});
  visit(&S::fft_count, Kept{"fft_count", "Fourier transforms of scalar fields, in pairs"});
  visit(&S::residual, Kept{"residual", "rms of the projected gradient over the set, relative"});
  visit(&S::slipping, Kept{"slipping", "cells that slip"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "false: do not use the tractions"});
}

/// Coulomb friction on a contact set, for one time step: computes the tractions after the body
/// moves.
///     PartialSlipSolver solver(grid, material);
///     const PartialSlipReport report = solver.solve(limit, displacement, 1e-9, traction, slip);
/// Given v, the displacement that each cell would have if it stuck, and the limit μp, they satisfy
///     |τ| <= μp;   u = Kτ;   slip s = v − u = 0 where |τ| < μp;   τ = μp s/|s| where s is not 0,
/// with Cerruti's response K of StickSolver: the body slides by s over the surface and drags it
/// along. This is the unique solution of
///     minimise ½ τ·Kτ − τ·v   subject to |τ_i| <= limit_i in each cell
/// (a disc; an interval with hold_lateral off). An infinite limit sticks. Newton steps act on the
/// free part (sticking cells, and the direction of traction in slipping ones, with the curvature of
/// their circles), with preconditioned conjugate gradients inside. Each step is projected on the
/// discs and accepted if the energy falls; otherwise a projected gradient step with a line search
/// replaces it.
class PartialSlipSolver : public StickSolver {
 public:
  /// StickOptions::tolerance bounds PartialSlipReport::residual; max_iterations limits the
  /// conjugate gradient iterations of a solve.
  using StickSolver::StickSolver;

  /// Solves one step.
  /// limit         (nx, ny), Pa, >= 0, may be infinite: μp; the contact set is where it is > 0
  /// displacement  v on the contact set, m; values elsewhere are ignored
  /// scale         > 0, m: the displacement that the tolerance refers to
  /// traction      first guess (an empty field: none), overwritten; 0 off the contact
  /// slip          overwritten with v − Kτ in cells that slip, m, and 0 in the others
  /// Throws InvalidInput if every cell of a periodic grid is in contact, because its stiffness is
  /// not finite. Cost: 4 to 8 Newton steps, 30 to 80 pairs of vector fields; a handful if no cell
  /// begins to slip.
  PartialSlipReport solve(const Field& limit, const TangentialField& displacement, double scale,
                          TangentialField& traction, TangentialField& slip);
};

}  // namespace salebra
