// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/damping/level_quadrature.hpp>

namespace salebra {

/// The levels of one body on a grid of its own size: how a shape given by a formula is refined.
using LevelsOnGrid = std::function<ContactLevels(const Grid2D& grid)>;

struct AdaptiveQuadratureOptions {
  double relative_error = 0.01;  ///< of work_per_cycle, in (0, 1)
  Index most_points = 1024;      ///< cells along the longer side of the finest grid
  int most_levels = 128;
  /// Direction, tolerances and progress; its number of levels is where the search begins, half of
  /// the usual number if 0.
  LevelQuadratureOptions quadrature = {};
};

/// One quadrature of the search.
struct QuadratureTrial {
  Grid2D grid;
  int levels = 0;
  double work_per_cycle = 0;   ///< J
  double stiffness_ratio = 0;  ///< to ν = 0
  double error_estimate = 0;   ///< of this quadrature by itself, J
};

constexpr void describe(auto&& visit, std::type_identity<QuadratureTrial>) {
  using enum Dimension;
  using S = QuadratureTrial;
  visit(&S::grid, Part{"grid", "points and size"});
  visit(&S::levels, Quantity{"levels", dimensionless, "contact levels"});
  visit(&S::work_per_cycle, quantity::work_per_cycle);
  visit(&S::stiffness_ratio,
        Quantity{"stiffness_ratio", dimensionless, "work_per_cycle over work_by_force"});
  visit(&S::error_estimate, quantity::error_estimate);
}

struct AdaptiveQuadratureResult {
  LevelQuadratureResult quadrature;  ///< the last; its error_estimate is the one below
  Grid2D grid;
  int levels = 0;
  /// The largest of the last quadrature's own estimate and of the changes that the last halving of
  /// the cells and the last doubling of the levels made; J. Where the grid is given, its cells are
  /// part of the problem and no error of theirs is in it.
  double error_estimate = 0;
  /// The part of it that is the change by the last halving of the cells, J; 0 where the grid is
  /// given.
  double cell_error = 0;
  bool reached = false;  ///< error_estimate <= relative_error · |W|
  std::vector<QuadratureTrial> trials;
};

/// Level quadrature with as many levels and cells as a requested relative error needs. It begins
/// with few of both and refines the one whose last refinement changed the loss more. The area of
/// the contact grows by whole cells, so that the error is not smooth in their size and is not
/// extrapolated: the change is taken for the error.
/// cost  the last quadrature and about as much for those before it
AdaptiveQuadratureResult adaptive_level_quadrature(const LevelsOnGrid& levels, const Grid2D& grid,
                                                   const Material& material,
                                                   const Oscillation& motion,
                                                   double mean_indentation,
                                                   const AdaptiveQuadratureOptions& options = {});

/// Takes levels on one grid that cannot be refined, such as those of a measured surface: the levels
/// alone are chosen.
AdaptiveQuadratureResult adaptive_level_quadrature(const ContactLevels& levels, const Grid2D& grid,
                                                   const Material& material,
                                                   const Oscillation& motion,
                                                   double mean_indentation,
                                                   const AdaptiveQuadratureOptions& options = {});

}  // namespace salebra
