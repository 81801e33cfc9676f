// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/interval_quadrature.hpp>

namespace salebra {

/// Returns the contact sets of one body on a given grid. It lets a shape that is given by a formula
/// be solved on finer and finer grids.
using ContactSetsOnGrid = std::function<ContactSets(const Grid2D& grid)>;

struct AdaptiveQuadratureOptions {
  double relative_error = 0.01;  ///< requested error of work_per_cycle, in (0, 1)
  Index max_points = 1024;       ///< cells along the longer side of the finest grid
  int max_intervals = 128;
  /// Direction, tolerances and progress of each quadrature. The search starts from
  /// quadrature.intervals, or from half of the default number of intervals if that is 0.
  IntervalQuadratureOptions quadrature = {};
};

/// One quadrature of the search for a sufficient grid and number of intervals.
struct QuadratureTrial {
  Grid2D grid;
  int intervals = 0;
  double work_per_cycle = 0;   ///< J
  double stiffness_ratio = 0;  ///< work_per_cycle over that with K_t = (G*/E*)K
  double error_estimate = 0;   ///< error by IntervalQuadratureResult, J
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
  /// Result of the last quadrature; quadrature.error_estimate is replaced by the error_estimate of
  /// this struct.
  IntervalQuadratureResult quadrature;
  Grid2D grid;
  int intervals = 0;
  /// Maximum of three errors of W, J: the last quadrature's own estimate, the change of W by the
  /// last halving of the cells, and its change by the last doubling of the intervals. On a grid
  /// that cannot be refined, the error due to the cell size is not included.
  double error_estimate = 0;
  /// Change of W by the last halving of the cells, J; 0 if the cells were not halved.
  double cell_error = 0;
  bool reached = false;  ///< whether error_estimate <= relative_error · |W|
  std::vector<QuadratureTrial> trials;
};

/// Runs interval quadrature until the requested relative error is reached, starting from few
/// intervals and cells. Each step refines the intervals or the cells, whichever changed the loss
/// more when they were last refined. The contact area grows by whole cells, so the loss is not a
/// smooth function of the cell size: its last change is taken as the error, without extrapolation.
///
///     auto loss = adaptive_interval_quadrature(contacts, grid, body, motion, 1e-8);
///
/// cost  that of the last quadrature, and about as much again for all earlier quadratures
AdaptiveQuadratureResult adaptive_interval_quadrature(
    const ContactSetsOnGrid& contact_sets, const Grid2D& grid, const Body& body,
    const Oscillation& motion, double mean_indentation,
    const AdaptiveQuadratureOptions& options = {});

/// Runs adaptive interval quadrature on a grid that cannot be refined, such as that of a measured
/// surface: only the number of intervals is chosen.
AdaptiveQuadratureResult adaptive_interval_quadrature(
    const ContactSets& contact_sets, const Grid2D& grid, const Body& body,
    const Oscillation& motion, double mean_indentation,
    const AdaptiveQuadratureOptions& options = {});

}  // namespace salebra
