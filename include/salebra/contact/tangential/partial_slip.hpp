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
  int fft_count = 0;   ///< forward-and-backward transforms of a scalar field
  /// Error of the solution, divided by the `scale` of solve(): the rms over the contact set of |τ −
  /// P(τ − κg)|/κ, with the displacement error g = Kτ − v, the stiffness κ of a cell, and the
  /// projection P that shortens each traction to its limit. It is the displacement error in
  /// sticking cells, and 0 only at the solution.
  double residual = 0;
  Index slipping = 0;  ///< number of cells that slip
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
/// Given v, the displacement that each cell would have if it stuck, and the limit μp of its
/// traction, the tractions τ satisfy
///     |τ| <= μp;   u = Kτ;   slip s = v − u = 0 where |τ| < μp;   τ = μp s/|s| where s is not 0,
/// where K is the response of StickSolver (displacements under tractions, by Cerruti's solution):
/// the body slides by s over the surface and drags it along. τ is the unique solution of
///     minimise ½ τ·Kτ − τ·v   subject to |τ_i| <= limit_i in each cell
/// where the condition confines each traction vector to a disc (or, with StickOptions::hold_lateral
/// off, to an interval along x). Cells with an infinite limit stick. Each Newton step solves for
/// the tractions of sticking cells and for the direction of traction in slipping cells, by
/// preconditioned conjugate gradients. Tractions beyond their limit are then shortened to it. The
/// step is accepted if the energy ½ τ·Kτ − τ·v falls; otherwise a gradient step with a line search
/// replaces it.
class PartialSlipSolver : public StickSolver {
 public:
  /// StickOptions::tolerance bounds PartialSlipReport::residual; max_iterations limits the
  /// conjugate gradient iterations of a solve.
  using StickSolver::StickSolver;

  /// Solves one step.
  /// limit         μp in each cell, (nx, ny), Pa, >= 0, may be infinite; cells with a limit > 0
  ///               form the contact set
  /// displacement  v on the contact set, m; values elsewhere are ignored
  /// scale         > 0, m: displacement by which the residual is divided before it is compared with
  ///               the tolerance
  /// traction      on entry a first guess (or empty fields), on return the tractions, Pa; 0 outside
  ///               the contact set
  /// slip          on return v − Kτ in cells that slip, m, and 0 in all other cells
  /// Throws InvalidInput if every cell of a periodic grid is in contact, because its stiffness is
  /// not finite. Cost: 4 to 8 Newton steps with, in total, 30 to 80 forward-and-backward transforms
  /// of a vector field; only a few transforms if no cell begins to slip.
  PartialSlipReport solve(const Field& limit, const TangentialField& displacement, double scale,
                          TangentialField& traction, TangentialField& slip);
};

}  // namespace salebra
