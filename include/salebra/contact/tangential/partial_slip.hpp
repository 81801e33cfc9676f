// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/tangential/stick.hpp>

namespace salebra {

/// How a partial-slip solve ended. Unless converged, what it computed must not be used as the
/// answer.
struct PartialSlipReport {
  int steps = 0;       ///< Newton steps: changes of the sticking and slipping parts
  int iterations = 0;  ///< of conjugate gradients, in all steps
  int fft_count = 0;   ///< forward-and-backward pairs of scalar fields
  /// rms over the contact set of the projected gradient |τ − P(τ − κg)|/κ, in units of the scale: g
  /// = Kτ − v, P the projection on the discs, κ the stiffness of a cell. It is the displacement
  /// error where a cell sticks, and 0 only at the solution.
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

/// Coulomb friction on a contact set, one step in time: which tractions does a move of the body
/// leave? Given v, the displacement that each cell would have if it stuck, and the limit μp, the
/// tractions obey
///     |τ| <= μp;    u = Kτ;    slip s = v − u = 0 where |τ| < μp;    τ = μp s/|s| where s is not 0,
/// with Cerruti's response K of StickSolver: the body, sliding by s over the surface, drags it
/// along. This is the solution of
///     minimise ½ τ·Kτ − τ·v   subject to |τ_i| <= limit_i in each cell (a disc; an interval with hold_lateral off),
/// which is unique. An infinite limit sticks. Solved by Newton steps on the part that is free
/// (sticking cells, and the direction of traction in slipping ones, with the curvature of their
/// circles) with preconditioned conjugate gradients inside, each followed by a projection on the
/// discs and accepted if the energy falls; a projected gradient step with a line search where it
/// does not. All else is StickSolver's.
class PartialSlipSolver : public StickSolver {
 public:
  /// StickOptions::tolerance bounds PartialSlipReport::residual; max_iterations those of conjugate
  /// gradients in a solve.
  using StickSolver::StickSolver;

  /// limit         (nx, ny), Pa, >= 0, may be infinite: μp; the contact set is where it is > 0
  /// displacement  v on the contact set, m; its values elsewhere are not read
  /// scale         > 0, m: the displacement that the tolerance refers to
  /// traction      holds a first guess (an empty field: none) and is overwritten, 0 off the contact
  /// slip          is overwritten: v − Kτ in cells that slip, m, 0 in the others
  /// Throws InvalidInput if every cell of a periodic grid is in contact: it has no finite
  /// stiffness. Cost: 4 to 8 Newton steps, 30 to 80 pairs of vector fields; a handful where nothing
  /// begins to slip.
  PartialSlipReport solve(const Field& limit, const TangentialField& displacement, double scale,
                          TangentialField& traction, TangentialField& slip);
};

}  // namespace salebra
