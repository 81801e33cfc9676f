// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/progress.hpp>
#include <salebra/contact/normal/normal.hpp>

namespace salebra {

struct FlowOptions {
  /// The solver stops at this relative error of a flow factor, as estimated with its
  /// preconditioner; 1e-14 to 1e-1.
  double tolerance = 1e-8;
  int max_iterations = 200;  ///< limit for each direction, >= 1
  /// Direction of the lay of the surface, from the x axis, rad: adds the flow factors across and
  /// along it. NaN: no lay.
  double lay_angle = std::numeric_limits<double>::quiet_NaN();
  Progress on_progress = {};
};

/// Viscous flow through the gap between rough surfaces.
struct FlowFactors {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double mean_gap = unknown;  ///< mean of g over all cells, contact included, m
  bool percolates_x = false;  ///< whether a path through the gap spans the period along x
  bool percolates_y = false;  ///< whether a path through the gap spans the period along y
  /// Flow factor along x: flow under a pressure gradient along x, divided by the flow between
  /// smooth walls at the mean gap. NaN if no path through the gap spans the period along x, so that
  /// there is no flow.
  double pressure_flow_factor_x = unknown;
  double pressure_flow_factor_y = unknown;  ///< flow factor along y, likewise
  /// Flow along x under a pressure gradient along y, divided by the flow between smooth walls along
  /// the gradient; as much flows along y under a gradient along x. 0 if the gap percolates along
  /// one axis only.
  double pressure_flow_factor_xy = unknown;
  /// Flow factors across and along the lay of FlowOptions::lay_angle; NaN without a lay, or without
  /// flow in this direction.
  double pressure_flow_factor_across = unknown, pressure_flow_factor_along = unknown;
  /// Errors of these factors by the size of the cells.
  double pressure_flow_factor_x_error = unknown, pressure_flow_factor_y_error = unknown,
         pressure_flow_factor_across_error = unknown, pressure_flow_factor_along_error = unknown;
  /// Gap between smooth walls with the same flow, averaged over x and y, m; NaN without flow.
  double effective_gap = unknown;
  /// Bruggeman's estimate of the flow factors along x and y from the distribution of gaps alone.
  /// NaN if half of the cells or more are closed, because the estimate then predicts no flow.
  double bruggeman_flow_factor = unknown;
  double residual = 0;  ///< relative error of the factors, as estimated by the solver
  int iterations = 0;   ///< total of the solves along x and along y
  Termination termination = Termination::converged;

  bool converged() const { return termination == Termination::converged; }
  /// Flow factor along the direction e at an angle from x, rad: e·Φ·e, the flow along e under a
  /// pressure gradient along e. NaN if nothing flows.
  double flow_factor(double angle) const;
  /// Whether fluid flows along the direction at this angle.
  bool percolates(double angle) const { return !std::isnan(flow_factor(angle)); }
};

constexpr void describe(auto&& visit, std::type_identity<FlowFactors>) {
  using enum Dimension;
  using S = FlowFactors;
  visit(&S::mean_gap, Kept{"mean_gap", "mean gap, cells in contact included", length});
  visit(&S::percolates_x,
        Quantity{"percolates_x", dimensionless, "whether the gap percolates along x"});
  visit(&S::percolates_y,
        Quantity{"percolates_y", dimensionless, "whether the gap percolates along y"});
  visit(&S::pressure_flow_factor_x,
        Quantity{"pressure_flow_factor_x", dimensionless,
                 "flow along x over that between smooth walls at the mean gap"});
  visit(&S::pressure_flow_factor_y,
        Quantity{"pressure_flow_factor_y", dimensionless,
                 "flow along y over that between smooth walls at the mean gap"});
  visit(&S::pressure_flow_factor_xy,
        Quantity{"pressure_flow_factor_xy", dimensionless,
                 "flow along x under a gradient along y over that between smooth walls"});
  visit(&S::pressure_flow_factor_across,
        WhereKnown{"pressure_flow_factor_across", dimensionless,
                   "flow across the lay over that between smooth walls at the mean gap"});
  visit(&S::pressure_flow_factor_along,
        WhereKnown{"pressure_flow_factor_along", dimensionless,
                   "flow along the lay over that between smooth walls at the mean gap"});
  visit(&S::pressure_flow_factor_x_error,
        Quantity{"pressure_flow_factor_x_error", dimensionless,
                 "error of pressure_flow_factor_x by the size of cells"});
  visit(&S::pressure_flow_factor_y_error,
        Quantity{"pressure_flow_factor_y_error", dimensionless,
                 "error of pressure_flow_factor_y by the size of cells"});
  visit(&S::pressure_flow_factor_across_error,
        WhereKnown{"pressure_flow_factor_across_error", dimensionless,
                   "error of pressure_flow_factor_across by the size of cells"});
  visit(&S::pressure_flow_factor_along_error,
        WhereKnown{"pressure_flow_factor_along_error", dimensionless,
                   "error of pressure_flow_factor_along by the size of cells"});
  visit(&S::effective_gap,
        Quantity{"effective_gap", length, "gap between smooth walls that let pass the same flow"});
  visit(&S::bruggeman_flow_factor,
        Quantity{"bruggeman_flow_factor", dimensionless,
                 "flow factor by Bruggeman's effective medium of the same gaps"});
  visit(&S::residual, Kept{"residual", "relative error of the flow factors"});
  visit(&S::iterations, Kept{"iterations", "iterations of the solver"});
  visit(&S::termination, Kept{"termination", "how the iteration ended"});
  visit(&S::converged, Kept{"converged", "false: do not use the flow factors"});
}

/// Computes the pressure flow factors of Patir and Cheng (1978) for a periodic gap:
///     const FlowFactors flow = flow_factors(state.gap, surface.grid);
/// They follow from Reynolds' equation
///     ∇·(g³∇p) = 0,   ⟨∇p⟩ = e_x,   φ_x = ⟨g³ ∂p/∂x⟩/⟨g⟩³,
/// where p is the fluid pressure and e_x the unit vector along x, and likewise along y. The
/// conductance of a face between two cells is the harmonic mean of their g³. Cells with a gap of at
/// most 1e-9 ⟨g⟩ are closed; fluid passes the sides of cells, not the corners. φ_x = φ_y = 1 −
/// (3/2)⟨(g − ⟨g⟩)²⟩/⟨g⟩² for an isotropic roughness much lower than the gap [Tripp (1983)].
/// Bruggeman's factor b solves ⟨(s − b)/(s + b)⟩ = 0 over all cells, s = g³/⟨g⟩³ [Bruggeman
/// (1935)]; Dapp et al. (2012) compare it with the exact flow. Gaps of isotropic contacts stop
/// percolating at a contact area of about 0.42 [Wang and Müser (2020)], and between 0.35 and 0.5 by
/// chance if few roughness wavelengths fit into the period.
/// The flow is linear in the gradient, so the two solves along x and y give the flow factor along
/// any direction e: e·Φ·e with the symmetric matrix Φ of pressure_flow_factor_x, _xy and _y. The
/// error of a factor by its cells is three quarters of its change on every second cell along x and
/// y; the factors converge at second order, but of the flow through constrictions of a few cells up
/// to two thirds of the change remain. If the cells of twice the size let nothing pass, the error
/// is three quarters of the factor. It is NaN for fewer than 8 cells along an axis.
/// gap      (nx, ny), m, finite; cells with a gap <= 0 are closed
/// throws   InvalidInput, before any computation, for invalid gaps or options; non-convergence is
///          returned, not thrown
/// cost     conjugate gradients with an algebraic multigrid, 8 to 25 iterations per axis, each as
///          long as three transform pairs, and a quarter of this for the errors; about 120 bytes per
///          cell. Results have the same bits
///          for every thread count
FlowFactors flow_factors(const Field& gap, const Grid2D& grid, const FlowOptions& options = {});

/// Computes the flow factors of the gap of a contact, in which cells with p > 0 are closed. Throws
/// InvalidInput if the contact is distributed over several processes.
FlowFactors flow_factors(const NormalContactState& state, const Grid2D& grid,
                         const FlowOptions& options = {});

}  // namespace salebra
