// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/interval_quadrature.hpp>

namespace salebra {

/// The normal contact of one body on any grid: how a shape given by a formula is refined.
using ContactSetsOnGrid = std::function<ContactSets(const Grid2D& grid)>;

struct AdaptiveQuadratureOptions {
  double relative_error = 0.01;  ///< of work_per_cycle, in (0, 1)
  Index max_points = 1024;      ///< cells along the longer side of the finest grid
  int max_intervals = 128;
  /// Direction, tolerances and progress. The search starts from its number of levels, or from half
  /// of the default if that is 0.
  IntervalQuadratureOptions quadrature = {};
};

/// One quadrature of the search.
struct QuadratureTrial {
  Grid2D grid;
  int intervals = 0;
  double work_per_cycle = 0;   ///< J
  double stiffness_ratio = 0;  ///< to ν = 0
  double error_estimate = 0;   ///< estimate of this quadrature alone, J
};

constexpr void describe(auto&& visit, std::type_identity<QuadratureTrial>) {
  using enum Dimension;
  using S = QuadratureTrial;
  visit(&S::grid, Part{"grid", "points and size"});
  visit(&S::intervals, Quantity{"intervals", dimensionless, "contacts in the oscillation"});
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::stiffness_ratio,
        Quantity{"stiffness_ratio", dimensionless, "work_per_cycle over work_by_force"});
  visit(&S::error_estimate, quantity::error_estimate);
}

struct AdaptiveQuadratureResult {
  IntervalQuadratureResult quadrature;  ///< the last one; its error_estimate is the one below
  Grid2D grid;
  int intervals = 0;
  /// Maximum of the last quadrature's own estimate and of the changes by the last halving of the
  /// cells and the last doubling of the levels, J. On a given grid there is no error of the cells
  /// in it.
  double error_estimate = 0;
  /// The change by the last halving of the cells, J; 0 where the grid is given.
  double cell_error = 0;
  bool reached = false;  ///< error_estimate <= relative_error · |W|
  std::vector<QuadratureTrial> trials;
};

/// Runs level quadratures until the requested relative error is reached, starting from few levels
/// and cells and refining the one whose last refinement changed the loss more. The contact area
/// grows by whole cells, so the error is not smooth in their size: it is not extrapolated, and the
/// change is taken for the error.
///
///     auto loss = adaptive_interval_quadrature(contacts, grid, material, motion, 1e-8);
///
/// cost  the last quadrature and about as much for those before it
AdaptiveQuadratureResult adaptive_interval_quadrature(const ContactSetsOnGrid& contact_sets, const Grid2D& grid,
                                                   const Material& material,
                                                   const Oscillation& motion,
                                                   double mean_indentation,
                                                   const AdaptiveQuadratureOptions& options = {});

/// The same on a grid that cannot be refined, such as that of a measured surface: only the number
/// of levels is chosen.
AdaptiveQuadratureResult adaptive_interval_quadrature(const ContactSets& contact_sets, const Grid2D& grid,
                                                   const Material& material,
                                                   const Oscillation& motion,
                                                   double mean_indentation,
                                                   const AdaptiveQuadratureOptions& options = {});

}  // namespace salebra
