// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/damping/oscillation.hpp>
#include <salebra/damping/quantities.hpp>
#include <vector>

namespace salebra {

/// How to estimate the error of continuing a non-periodic scan periodically.
enum class SeamCheck {
  window,  ///< the outermost sixteenth along each edge fades smoothly to the mean height, so that
           ///< no step is left
  free     ///< the surface is alone on an infinite half-space: for light loads; at high loads its
           ///< edges press harder
};

template <>
struct EnumNames<SeamCheck> {
  static constexpr auto values = std::to_array<std::pair<SeamCheck, std::string_view>>(
      {{SeamCheck::window, "window"}, {SeamCheck::free, "free"}});
};

/// Whether an oscillation may be divided into this number of intervals: 4, 8, 16 or 32.
constexpr bool allowed_intervals(double intervals) {
  return intervals == 4 || intervals == 8 || intervals == 16 || intervals == 32;
}

struct SurfaceDampingOptions {
  Hold hold = Hold::indentation;
  Amplitude amplitude = Amplitude::finite;
  Boundary boundary = Boundary::periodic;
  /// Intervals between the indentations at which the contact is solved: 4, 8, 16 or 32. Half as
  /// many are used on the other grids, and on the first one too where neither an error is stated
  /// nor intervals are chosen.
  int intervals = 4;
  /// Doubles the intervals, up to 32, where the last doubling changed W by more than its standard
  /// deviation.
  bool choose_intervals = true;
  /// Number of times that the cells are halved (refined(), surface/refine.hpp). With 0 the
  /// discretisation error is unknown, and no error is stated.
  int refinements = 1;
  /// Compares with cells of twice the size instead of half, at a quarter of the cost, for large
  /// grids. The error of the cells is then that of the coarser grid and rather too large.
  bool coarsen = false;
  /// Returns W on the given cells and uses the refinements for its error only; false: W on the
  /// finest.
  bool keep_cells = false;
  /// Goes on halving the cells, beyond `refinements`, for the loads whose error is not yet below
  /// this fraction of W; 0 does not.
  double relative_error = 0;
  /// Solves once more on the given cells; the change of W is the error of the seam.
  std::optional<SeamCheck> seam = {};
  /// μ, to include slip; NaN: infinite friction, no slip.
  double friction_coefficient = std::numeric_limits<double>::quiet_NaN();
  /// X, distance between the turning points of a drag, m. Without it the loss of a drag with
  /// friction is NaN.
  double excursion = std::numeric_limits<double>::quiet_NaN();
  Index max_refined =
      8;  ///< limit for relative_error: at most so many times the points along each side
  Progress on_progress = {};
};

/// The loss of one surface at one load, with its numerical error.
struct SurfaceDamping : Loss {
  double stiffness_ratio = unknown;  ///< K_t/((G*/E*)K) at the load
  double window = unknown;           ///< half the range of indentations solved, m; at least u_z
  int intervals = 0;                    ///< intervals of the oscillation
  Index points = 0;                  ///< along x, of the grid on which the loss was computed
  bool converged =
      false;  ///< every contact converged, the cycle lies within the range of the contact, and
              ///< W >= 0
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceDamping>) {
  using enum Dimension;
  using S = SurfaceDamping;
  describe(visit, std::type_identity<Loss>{});
  visit(&S::stiffness_ratio, Kept{"stiffness_ratio", "K_t/((G*/E*)K)"});
  visit(&S::window, Kept{"window", "half the range of indentations that were solved", length});
  visit(&S::intervals, Kept{"intervals", "intervals between contact levels"});
  visit(&S::points, Kept{"points", "points along x of the grid that work_per_cycle belongs to"});
  visit(&S::converged, Kept{"converged", "false: do not use work_per_cycle"});
}

/// Computes the damping of one surface at each load of its curve from contacts solved inside the
/// oscillation, without interpolation between loads: W = ½∮ s² dK_t by parts (docs/theory.md,
/// section 7) with K_t = ρ(G*/E*)K.
///
///     ForceCurve curve = sweep_pressures(surface, material, {1e6, 2e6, 5e6});
///     auto losses = surface_damping(surface, material, Drag{1e-9, 1e-6, 1e5}, curve);
///
/// K  is found by universal kriging from the forces and stiffnesses of the contacts at
///    Chebyshev–Lobatto points of δ. The covariances describe contact patches that touch, and cells
///    that enter, at random (docs/surface_damping.md).
/// ρ  is K_t/((G*/E*)K), a parabola in ln F. It comes from stick solves on the first grid, at the
///    load and at both ends, where an error is stated and the curve does not have K_t = (G*/E*)K;
///    otherwise from the curve at the load and its neighbours.
/// The range of δ is that of the oscillation. Where fewer than 100 cells (on the finer grid) enter
/// within it, it is widened until they do, at most to F/(4K), over which F changes by e^{±1/4}.
///
/// Errors. W is linear in the forces and stiffnesses, so the kriging gives its standard deviation,
/// with variances estimated from the contacts of all grids so far; 1.8 of them are stated. Cells:
/// the surface is interpolated on cells of half the size at the same pressure. Forces converge at
/// second order, so a third of the change of W is the error of the finer grid, and four thirds that
/// of the coarser. Intervals: the change of W from n/2 to n, nested, on the first grid. ρ: the
/// change of W with a straight ρ. Solver: the correction of each force for the gaps left in its
/// contact, as it enters W.
///
/// With a coefficient of friction the same springs slip, as in loss_with_slip(): W = −∫K_t w' dζ
/// with the loss w of one spring at each depth, which slips at μ/(ρG*/E*) times its depth, so that
/// a contact in gross sliding carries μF. Where springs slip that stay closed (about X/2 of stretch
/// below δ0 − u_z in a drag, or down to first touch), further contacts give K, in pieces over which
/// F falls by e^1.5. The loss is that at finite amplitude. Its error has the same parts; below the
/// oscillation ρ follows the curve, and counts as an error there. W without slip has the same bits
/// as without friction.
///
/// curve   of this surface and material, by sweep_pressures(); samples that did not converge give
///         no loss (converged = false)
/// throws  InvalidInput for a curve without loads, levels that are none of the four, relative_error
///         outside [0, 1); Interrupted where on_progress says stop
/// cost    for each load levels + 1 to 5 normal contacts and stiffnesses on the first grid and
///         three on others, in parallel over loads; with slip up to 4 intervals more on the first
///         grid and half as many on others; a halving of the cells costs five times the grid before
///         it
/// A surface may be spread over processes: the call is then collective and takes one load after the
/// other, and all numbers have the bits of one process, except those of isolated surfaces, as for K
/// of sweep_pressures().
std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Material& material,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options = {});

}  // namespace salebra
