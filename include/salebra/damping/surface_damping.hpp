// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

namespace salebra {

/// What shows the share of the seam, where a surface that is not periodic is continued as if it
/// were.
enum class SeamCheck {
  window,  ///< the outermost sixteenth along each edge goes smoothly to the mean height, so that
           ///< nothing is left to step
  free     ///< the surface by itself on an infinite half-space: for light loads; at high ones its
           ///< edges press harder
};

template <>
struct Words<SeamCheck> {
  static constexpr auto values = std::to_array<std::pair<SeamCheck, std::string_view>>(
      {{SeamCheck::window, "window"}, {SeamCheck::free, "free"}});
};

/// Whether an oscillation may be divided into so many intervals: 4, 8, 16 or 32.
constexpr bool allowed_levels(double levels) {
  return levels == 4 || levels == 8 || levels == 16 || levels == 32;
}

struct SurfaceDampingOptions {
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  Boundary boundary = Boundary::periodic;
  /// Intervals between the indentations at which the contact is solved: 4, 8, 16 or 32. Half as
  /// many on all grids but the first, and where neither an error is stated nor levels are chosen.
  int levels = 4;
  /// Doubles the levels, up to 32, where the last doubling changed W by more than its standard
  /// deviation.
  bool choose_levels = true;
  /// Halvings of the cells (refined(), surface/refine.hpp). 0: the error of the cells is not known,
  /// and no error is stated.
  int refinements = 1;
  /// Compares with cells of twice the size in place of a half: a quarter of the cost, for large
  /// grids. The error of the cells is then that of the coarser of the two and rather too large.
  bool coarsen = false;
  /// W on the cells as they are, to which the refinements only give the error; false: on the
  /// finest.
  bool keep_cells = false;
  /// Halves the cells on, beyond `refinements`, for the loads whose error is not yet below this
  /// part of W; 0: does not.
  double relative_error = 0;
  /// Solves once more, on the cells as they are, and takes the change of W for the error of the
  /// seam.
  std::optional<SeamCheck> seam = {};
  /// μ, with which the loss has slip; NaN: infinite, no slip.
  double friction_coefficient = std::numeric_limits<double>::quiet_NaN();
  /// Between the turning points of a drag, m. Without it the loss of a drag with friction is NaN.
  double excursion = std::numeric_limits<double>::quiet_NaN();
  Index most_refined =
      8;  ///< times as many points along each side, at the most, that relative_error may ask for
  Progress on_progress = {};
};

/// The loss of one surface at one load, with its error.
struct SurfaceDamping : Loss {
  double stiffness_ratio = unknown;  ///< K_t/((G*/E*)K) at the load
  double window = unknown;  ///< half the range of indentations that were solved, m; at least u_z
  int levels = 0;           ///< intervals of the oscillation
  Index points = 0;         ///< along x, of the grid that the loss belongs to
  bool converged =
      false;  ///< every contact did, the cycle lies within the range of the contact, and W >= 0
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceDamping>) {
  using enum Dimension;
  using S = SurfaceDamping;
  describe(visit, std::type_identity<Loss>{});
  visit(&S::stiffness_ratio, Kept{"stiffness_ratio", "K_t/((G*/E*)K)"});
  visit(&S::window, Kept{"window", "half the range of indentations that were solved", length});
  visit(&S::levels, Kept{"levels", "intervals between contact levels"});
  visit(&S::points, Kept{"points", "points along x of the grid that work_per_cycle belongs to"});
  visit(&S::converged, Kept{"converged", "false: do not use work_per_cycle"});
}

/// Relaxation damping of one surface at each load of its curve, from contacts at indentations
/// inside the oscillation, and no interpolation between loads: W = ½∮ s² dK_t by parts
/// (docs/theory.md, section 7) with K_t = ρ(G*/E*)K.
///     K   by universal kriging from the forces and stiffnesses of the contacts at
///         Chebyshev–Lobatto points of δ, with the covariances of spots that touch at chance, and
///         of cells that enter at chance (docs/surface_damping.md)
///     ρ   K_t/((G*/E*)K): by stick solves on the first grid at the load and both ends, where an
///         error is stated and the curve has not K_t = (G*/E*)K; otherwise of the curve at the
///         load and its neighbours. A parabola in ln F
/// The range of δ is that of the oscillation; where too few cells enter within it (fewer than 100
/// on the finer grid), it is widened until they do, at most to F/(4K), over which F changes by
/// e^{±1/4}.
///
/// Errors. W is linear in the forces and stiffnesses, so that the kriging gives its standard
/// deviation, with the variances that the contacts of all grids so far show; 1.8 of them are
/// stated. Of the cells: the surface is interpolated on cells of half the size, at the same
/// pressure. Forces converge at second order, so that a third of what W changes by is the error of
/// the finer grid, and four thirds that of the coarser. Of the levels: what W changes by between
/// n/2 and n, nested, on the first grid. Of ρ: what W changes by where ρ is a straight line. Of the
/// solver: what each force was corrected by for the gaps left in its contact, as it enters W.
///
/// With a coefficient of friction: the loss of the same springs with slip, as loss_with_slip() of a
/// law, W = −∫K_t w' dζ with the loss w of one spring at each level, which
/// slips at μ/(ρG*/E*) times its depth, so that a contact that slides as a whole carries μF. Where
/// levels slip that stay closed, about X/2 of stretch below δ0 − u_z in a drag or down to first
/// touch, further contacts give K, in pieces over which F falls by e^1.5. The loss is that at finite
/// amplitude.
/// Its error has the same parts; ρ below the oscillation follows the curve, and counts as an error
/// there. W without slip has the same bits as without friction.
///
/// curve   of this surface and material, by sweep_pressures(); samples that did not converge are
///         left out (converged = false)
/// throws  InvalidInput for a curve without loads, levels that are none of the four, relative_error
///         outside [0, 1); Interrupted where on_progress says stop. A surface may be spread over
///         processes: the call is then collective, takes one load after the other, and all numbers
///         have the same bits as in one process, but for those of isolated surfaces, as K of
///         sweep_pressures()
/// cost    for each load levels + 1 to 5 normal contacts and stiffnesses on the first grid, three
///         on others, in parallel over loads; with slip up to 4 levels more on the first grid, half
///         as many on others; a halving of the cells costs five times the grid
///         before it
std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Material& material,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options = {});

}  // namespace salebra
