// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/half_space/body.hpp>
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
  /// Hold::automatic holds the mean force at all loads if the contact lifts off at one of them.
  Hold hold = Hold::automatic;
  Amplitude amplitude = Amplitude::finite;
  Boundary boundary = Boundary::periodic;
  /// Number of intervals between the indentations at which the contact is solved: 4, 8, 16 or 32.
  /// Half as many are used on refined or coarsened grids, and on the given grid too if neither an
  /// error is stated (no refinements, no coarsen) nor choose_intervals is set.
  int intervals = 4;
  /// true: doubles the intervals, up to 32, as long as the last doubling changed the loss W by more
  /// than its standard deviation.
  bool choose_intervals = true;
  /// Number of times that the cells are halved (refined(), surface/refine.hpp). With 0 the
  /// discretisation error is unknown, and no error is stated.
  int refinements = 1;
  /// true: estimates the discretisation error from cells of twice the size instead of half the
  /// size, at a quarter of the cost, for large grids. The error is then that of the coarser grid,
  /// and rather too large.
  bool coarsen = false;
  /// true: returns the loss W on the given cells and uses the refined cells only for its error;
  /// false: returns W on the finest cells.
  bool keep_cells = false;
  /// Keeps halving the cells, beyond `refinements`, for each load whose error is not yet below this
  /// fraction of W; 0: no further halving.
  double relative_error = 0;
  /// How to estimate the error of continuing the scan periodically (the seam): the contact is
  /// solved once more on the given cells with this change, and the change of W is the error. Empty:
  /// not estimated.
  std::optional<SeamCheck> seam = {};
  /// μ, to include slip; NaN: infinite friction, no slip.
  double friction_coefficient = std::numeric_limits<double>::quiet_NaN();
  /// Excursion X of a Drag, the distance between its turning points, m. If it is NaN, the loss of a
  /// Drag with friction is NaN.
  double excursion = std::numeric_limits<double>::quiet_NaN();
  /// Limit for relative_error: the finest grid has at most this many times the given points along
  /// each side.
  Index max_refined = 8;
  Progress on_progress = {};
};

/// The loss of one surface at one load, with its numerical error.
struct SurfaceDamping : Loss {
  double stiffness_ratio = unknown;  ///< K_t/((G*/E*)K) at the load
  /// Direction of the tangential motion, from the x axis, rad: that of K_t of the curve.
  double direction = 0;
  double window = unknown;        ///< half the range of solved indentations, m
  int intervals = 0;              ///< intervals of the oscillation
  Index points = 0;               ///< points along x of the grid of this loss
  double indentation = unknown;   ///< mean indentation of the cycle, m, from first touch
  double mean_force = unknown;    ///< cycle mean of F, N
  double max_force = unknown;     ///< F at the largest indentation of the cycle, N
  double contact_time = unknown;  ///< share of the period in which the bodies touch
  /// Largest normal amplitude at this load, m, if the motion presses the surface beyond full
  /// contact and therefore has no loss; NaN otherwise.
  double possible_amplitude = unknown;
  Hold hold = Hold::indentation;  ///< the mean value that the oscillation keeps
  /// Number of cells that leave the contact while the bodies approach, over the number of those that
  /// enter; 0 on half-spaces. A loss of which it exceeds the relative error is not converged, since
  /// the integral assumes that no cell does.
  double leaving_share = 0;
  /// True if every contact converged, the cycle lies within the range of the contact, and W >= 0.
  bool converged = false;
};

constexpr void describe(auto&& visit, std::type_identity<SurfaceDamping>) {
  using enum Dimension;
  using S = SurfaceDamping;
  describe(visit, std::type_identity<Loss>{});
  visit(&S::stiffness_ratio, Kept{"stiffness_ratio", "K_t/((G*/E*)K)"});
  visit(&S::direction, quantity::direction);
  visit(&S::window, Kept{"window", "half the range of indentations that were solved", length});
  visit(&S::intervals, Kept{"intervals", "number of intervals"});
  visit(&S::points, Kept{"points", "points along x of the grid that work_per_cycle belongs to"});
  visit(&S::indentation, quantity::indentation);
  visit(&S::mean_force, quantity::mean_force);
  visit(&S::max_force, quantity::max_force);
  visit(&S::contact_time, quantity::contact_time);
  visit(&S::possible_amplitude,
        Kept{"possible_amplitude", "largest normal amplitude, if this one is impossible", length});
  visit(&S::hold, Kept{"hold", "mean value that the oscillation keeps: indentation or force"});
  visit(&S::leaving_share,
        Kept{"leaving_share", "cells that leave while the bodies approach over those that enter"});
  visit(&S::converged, Kept{"converged", "false: do not use work_per_cycle"});
}

/// Computes the damping of one surface at each load of its curve from contacts solved inside the
/// oscillation, without interpolation between loads: W = ½∮ s² dK_t integrated by parts
/// (docs/theory.md, section 7), with the released distance s of a spring and K_t = ρ(G*/E*)K.
///
///     ForceCurve curve = sweep_pressures(surface, material, {1e6, 2e6, 5e6});
///     auto losses = surface_damping(surface, material, Drag{1e-9, 1e-6, 1e5}, curve);
///
/// K  is found by universal kriging from the forces and stiffnesses of the contacts at
///    Chebyshev–Lobatto points of δ. The covariances describe contact patches that touch, and cells
///    that enter, at random (docs/surface_damping.md).
/// ρ  is K_t/((G*/E*)K), a parabola in ln F. If an error is stated and the curve has a computed
///    K_t, ρ comes from stick solves on the given grid at the load and at the smallest and largest
///    solved indentation; otherwise it comes from the curve at the load and its neighbouring loads.
/// Contacts are solved over the range of δ of the oscillation. If fewer than 100 cells (of the
/// finer grid) enter the contact within this range, it is widened until 100 do, at most to ±F/(4K),
/// over which F changes by a factor e^{±1/4}.
///
/// Wide oscillations, with u_z above 0.75 F/K or through lift-off, use one law of the surface for
/// all loads instead. Its contacts lie at equal steps of δ between a hundredth of the lowest load
/// and the largest force of the motions, however large this is; F and K between contacts come from
/// a cubic polynomial of ln F through both. The steps are halved, from 16 to at most 64 intervals,
/// as long as this changes a loss by more than 1 % (or a third of relative_error). Below its lowest
/// contact the law opens as in TabulatedLaw.
/// An elastic surface can be pressed up to full contact; a motion beyond it has no loss, and
/// possible_amplitude says which motion does.
///
/// Errors. W is linear in the forces and stiffnesses of the contacts, so the kriging also gives its
/// standard deviation, with variances estimated from the contacts of all grids solved so far.
/// Noise: 1.8 standard deviations. Cells: the surface is interpolated on cells of half the size at
/// the same pressure. Forces converge at second order in the cell size, so a third of the change of
/// W is the error of the finer grid, and four thirds of it that of the coarser grid; on surfaces with
/// a skewness beyond ±0.5, four thirds of it, since the interpolation at the edges of plateaus decides. Intervals: the
/// change of W from half as many intervals, on the given grid. Stiffness ratio: the change of W if
/// ρ is linear in ln F. Solver: the effect on W of correcting each force for the gaps that remain
/// in its contact. In a wide oscillation the noise comes from the scatter of K at the smallest indentation,
/// above which springs open, and the change of W if the law continues exponentially below its lowest
/// contact is part of the error.
///
/// With a coefficient of friction the springs slip, as in loss_with_slip(): W = −∫K_t w' dζ, where
/// w(ζ) is the loss of a spring that touches at the depth ζ, per unit stiffness. Such a spring
/// slips at the stretch (δ − ζ)μ/(ρG*/E*), so that a contact in gross sliding carries μF. If
/// springs that stay closed slip (in a Drag those whose stretch limit is below about X/2), K at
/// indentations below the oscillation comes from further contacts, in pieces over which F falls by
/// a factor e^1.5. The loss with slip is always that at finite amplitude. Its error has the same
/// parts as without slip; at indentations below the oscillation ρ comes from the curve, and its
/// variation counts as an error. The loss without slip has the same bits as in a call without
/// friction.
///
/// body    a Material, or any Body, of which ρ is K_t/K; not half-spaces are periodic only
/// curve   force curve of this surface and body from sweep_pressures(), with K_t of stick solves
///         (options.stick) unless the body is a half-space; the tangential motion
///         has the direction of its K_t. A sample that did not converge gives no loss (converged =
///         false)
/// throws  InvalidInput for a curve without loads, intervals other than 4, 8, 16 or 32, and a
///         relative_error outside [0, 1); Interrupted if on_progress says stop
/// cost    for each load between intervals + 1 and intervals + 5 normal contacts with their
///         stiffnesses on the given grid and three on each other grid, in parallel over loads; with
///         slip up to 4 further intervals on the given grid and 2 on each other grid; each halving
///         of the cells costs five times as much as the previous grid
/// A surface may be distributed over processes: the call is then collective and computes one load
/// after the other. All numbers have the same bits as in one process, except for isolated surfaces
/// (Boundary::free), whose K is rounded differently, as in sweep_pressures().
std::vector<SurfaceDamping> surface_damping(const Surface& surface, const Body& body,
                                            const Oscillation& motion, const ForceCurve& curve,
                                            const SurfaceDampingOptions& options = {});

/// The losses of motions in several directions, one list for each curve: curves of the same
/// contacts with K_t in these directions, from sweep_directions(). Contacts are solved once for all
/// directions, so that a second direction costs little more than its stick solves. With
/// relative_error, cells are halved until the losses in all directions are precise enough.
///     const auto losses = surface_damping(surface, material, Drag{1e-9, 1e-6, 1e5}, curves);
std::vector<std::vector<SurfaceDamping>> surface_damping(const Surface& surface, const Body& body,
                                                         const Oscillation& motion,
                                                         const std::vector<ForceCurve>& curves,
                                                         const SurfaceDampingOptions& options = {});

}  // namespace salebra
