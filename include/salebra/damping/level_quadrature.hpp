// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/cycle.hpp>

namespace salebra {

struct LevelQuadratureOptions {
  int levels = 0;        ///< 0: 16 for equal frequencies, 32 for drag; otherwise >= 4
  double direction = 0;  ///< of the tangential motion against x, rad
  StickOptions stick = {.tolerance = 1e-5};
  Progress on_progress = {};
};

/// The loss of a cycle from a few contact sets.
struct LevelQuadratureResult {
  /// W with K_t = ρ(δ)(G*/E*)F'(δ): F and K of the levels give F', ρ = K_t/((G*/E*)K) of each level
  /// the tangential part; J. Both stiffnesses of a level see the same cells, so that the resolution
  /// of the contact's edge drops out of ρ.
  double work_per_cycle = 0;
  double error_estimate =
      0;  ///< of work_per_cycle, J: scatter of ρ, and F' against K of the levels as they are
  double work_by_levels = 0;  ///< W by the by-parts form from the K_t of the levels as they are, J
  double work_by_force = 0;   ///< W with K_t = (G*/E*)F', normal contacts alone, J
  double small_amplitude_work = 0;  ///< Eq. (12) or (15) with F'' of the same fit, J
  double force = 0;                 ///< F at the mean indentation, N
  double force_curvature = 0;       ///< F'' there, N/m²
  double stiffness_ratio = 0;       ///< work_per_cycle / work_by_force
  ForceCurve curve;                 ///< the levels; K_t is that along the motion
  long iterations = 0;              ///< of all linear solves on contact sets
  long fft_count = 0;
  bool converged = false;  ///< every level did; otherwise do not use the numbers
  bool interrupted = false;
};

/// Relaxation damping of a contact without stepping through the cycle, W = ½∮ s² dK_t by parts
/// (docs/theory.md, section 7):
///     (a) W = 2u_x² sin²φ0 ∫_0^π K_t(δ(θ)) sin2θ dθ        (b) W = 4(v/ω)² ∫_0^π θ [K_t(δ(θ)) − K_t(δ0 − u_z)] dθ
/// on Gauss–Legendre nodes of θ, δ(θ) = δ0 + u_z cosθ, with a normal contact, a stick and a punch
/// solve at each.
/// cost  levels + 2 normal contacts, and for each but one a stick and a punch solve
LevelQuadratureResult level_quadrature(const ContactLevels& levels, const Grid2D& grid,
                                       const Material& material, const Oscillation& motion,
                                       double mean_indentation,
                                       const LevelQuadratureOptions& options = {});

}  // namespace salebra
