// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/base/words.hpp>
#include <salebra/contact/half_space/half_space.hpp>
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
  /// Intervals between the indentations at which the contact is solved: 4, 8, 16 or 32.
  int levels = 8;
  /// Doubles the levels, up to 32, where the last doubling changed W by more than the scatter of
  /// whole cells.
  bool choose_levels = true;
  /// Halvings of the cells (refined(), surface/refine.hpp). 0: the error of the cells is not known,
  /// and no error is stated.
  int refinements = 1;
  /// Compares with cells of twice the size in place of a half: a quarter of the cost, for large
  /// grids. The error of the cells is then that of the coarser of the two and rather too large.
  /// Numbers of points must be even.
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
  Index most_refined =
      8;  ///< times as many points along each side, at the most, that relative_error may ask for
  Progress on_progress = {};
};

/// Damping of one surface at one load, with its error. All errors are of work_per_cycle, J; NaN
/// where not known.
struct SurfaceDamping {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double work_per_cycle = unknown;    ///< W, J
  double damping_constant = unknown;  ///< γ, N s/m
  /// All that follow together: the root of the sum of their squares.
  double error = unknown;
  double cell_error =
      unknown;  ///< of the cells: a third of the change of W by their last halving, beyond scatter
  double scatter =
      unknown;  ///< of the chance at which whole cells, and spots, touch; holds in 90 % of cases
  double level_error =
      unknown;  ///< a third of the change of W by the last doubling of the levels, beyond scatter
  double ratio_error = unknown;  ///< of K_t/((G*/E*)K) and its slope between the loads of the curve
  double seam_error = 0;  ///< change of W without the seam, beyond scatter; 0 where not asked for
  double solver_error = unknown;     ///< tolerance of the forces, as it enters W
  double stiffness_ratio = unknown;  ///< K_t/((G*/E*)K) at the load
  double window = unknown;  ///< half the range of indentations that were solved, m; at least u_z
  int levels = 0;
  Index points = 0;  ///< along x, of the grid that W belongs to
  bool converged =
      false;  ///< every contact did, and the cycle lies within the range of the contact

  double damping_constant_error() const { return error * damping_constant / work_per_cycle; }
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceDamping>) {
  using enum Dimension;
  using S = SurfaceDamping;
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::damping_constant, quantity::damping_constant);
  visit(&S::error,
        Kept{"error", "error of work_per_cycle: root of the sum of the squares of all that follow",
             energy});
  visit(&S::cell_error, Kept{"cell_error", "error by the size of the cells", energy});
  visit(&S::scatter,
        Kept{"scatter", "error by the chance at which whole cells, and spots, touch", energy});
  visit(&S::level_error, Kept{"level_error", "error by the number of levels", energy});
  visit(&S::ratio_error, Kept{"ratio_error", "error of K_t/((G*/E*)K)", energy});
  visit(
      &S::seam_error,
      Kept{"seam_error",
           "error by the edges of a surface that is not periodic; 0 where not asked for", energy});
  visit(&S::solver_error, Kept{"solver_error", "error by the solver's tolerance", energy});
  visit(&S::stiffness_ratio, Kept{"stiffness_ratio", "K_t/((G*/E*)K)"});
  visit(&S::window, Kept{"window", "half the range of indentations that were solved", length});
  visit(&S::levels, Kept{"levels", "intervals between contact levels"});
  visit(&S::points, Kept{"points", "points along x of the grid that work_per_cycle belongs to"});
  visit(&S::converged, Kept{"converged", "false: do not use work_per_cycle"});
  visit(&S::damping_constant_error,
        Quantity{"damping_constant_error", damping, "numerical error of the damping constant"});
}

/// Relaxation damping of one surface at each load of its curve, from contacts at indentations
/// inside the oscillation, and no interpolation between loads: W = ½∮ s² dK_t by parts
/// (docs/theory.md, section 7) with K_t = ρ(G*/E*)F'.
///     F   least-squares polynomial through the forces of the contacts at Chebyshev–Lobatto points
///         of δ. Forces are smooth: cells that enter change F at second order only, while K and K_t
///         jump. Half as many powers as intervals (3 for 4 intervals).
///     ρ   K_t/((G*/E*)K) of the curve: at the load, with its slope in ln F from the neighbouring
///         loads.
/// The range of δ is that of the oscillation; where too few cells enter within it (fewer than 100
/// on the finer grid), it is widened until they do, at most to F/(4K), over which F changes by
/// e^{±1/4}.
///
/// Errors. Of the levels: n against n/2 intervals, nested. Of the solver: its tolerance, relative
/// to F, times the weights of the forces in W. Of ρ: the difference of its slopes to both sides. Of
/// whole cells two parts. Scatter: cells that enter do so at chance indentations, and each raises K
/// by the same step. A number N of them, which is counted, has the variance N as long as N is
/// small, and no more than 2 × 0.0728 times the perimeter, in cells, where the perimeter moves by
/// more than a fifth of a cell: that of lattice points inside a smooth curve at a random place.
/// This makes a covariance of the forces, and W is linear in them. Where the residuals of the
/// polynomial are larger than in 95 % of cases by this covariance (rows of cells that touch
/// together), it is multiplied. A window wider than the oscillation adds the chance of the spots
/// that touch in between, about ln(H/(3u_z))/(πn) of n spots. 1.645 standard deviations are stated,
/// for 90 %. Bias: the surface is interpolated on cells of half the size, at the same pressure.
/// Forces converge at second order, so that a third of what W changes by, beyond the scatter of
/// both, is the error of the finer grid, and four thirds that of the coarser.
///
/// curve   of this surface and material, by sweep_pressures(); samples that did not converge are
///         left out (converged = false)
/// throws  InvalidInput for a curve without loads, levels that are none of the four, relative_error
///         outside [0, 1); Interrupted where on_progress says stop. A surface may be spread over
///         processes: the call is then collective, takes one load after the other, and all numbers
///         have the same bits as in one process
/// cost    for each load levels + 3 to 9 normal contacts on each grid, in parallel over loads; a
///         halving of the cells costs five times the grid before it
std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Material& material,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options = {});

}  // namespace salebra
