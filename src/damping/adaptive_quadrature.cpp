// SPDX-License-Identifier: GPL-3.0-or-later
// Phase quadrature refined until the estimated error of the loss meets a tolerance.
#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/damping/adaptive_quadrature.hpp>

namespace salebra {
namespace {

// Number of intervals of the first trial if the user gives none. With fewer intervals the fits
// cannot show the scatter of their own data.
int first_intervals(const Oscillation& motion, const IntervalQuadratureOptions& options) {
  if (options.intervals > 0) return options.intervals;
  return std::holds_alternative<Drag>(motion) ? 16 : 8;
}

void validate(const AdaptiveQuadratureOptions& options) {
  require(options.relative_error > 0 && options.relative_error < 1, "relative_error",
          options.relative_error, "must lie between 0 and 1");
  require(options.max_points >= 1, "max_points", options.max_points, "must be >= 1");
  require(options.max_intervals >= 4, "max_intervals", options.max_intervals, "must be >= 4");
}

}  // namespace

AdaptiveQuadratureResult adaptive_interval_quadrature(const ContactSetsOnGrid& contact_sets,
                                                      const Grid2D& grid, const Body& body,
                                                      const Oscillation& motion,
                                                      double mean_indentation,
                                                      const AdaptiveQuadratureOptions& options) {
  validate(options);
  grid.validate();
  constexpr double unknown = std::numeric_limits<double>::infinity();
  AdaptiveQuadratureResult result;
  result.grid = grid;
  result.intervals = first_intervals(motion, options.quadrature);
  const auto run = [&] {
    IntervalQuadratureOptions quadrature = options.quadrature;
    quadrature.intervals = result.intervals;
    result.quadrature = interval_quadrature(contact_sets(result.grid), result.grid, body, motion,
                                            mean_indentation, quadrature);
    result.trials.push_back({result.grid, result.intervals, result.quadrature.work_per_cycle,
                             result.quadrature.stiffness_ratio, result.quadrature.error_estimate});
    const std::size_t count = result.trials.size();
    return count < 2 ? unknown
                     : std::abs(result.trials[count - 1].work_per_cycle -
                                result.trials[count - 2].work_per_cycle);
  };
  const auto finer_grid = [&] {
    return std::max(result.grid.nx, result.grid.ny) * 2 <= options.max_points;
  };
  const auto more_intervals = [&] { return result.intervals * 2 <= options.max_intervals; };

  run();
  double by_levels = unknown, by_grid = finer_grid() ? unknown : 0;
  for (;;) {
    result.error_estimate =
        std::max({result.quadrature.error_estimate, by_levels == unknown ? 0 : by_levels,
                  by_grid == unknown ? 0 : by_grid});
    const bool compared = by_levels < unknown && by_grid < unknown;
    result.reached = compared && result.quadrature.converged() &&
                     result.error_estimate <=
                         options.relative_error * std::abs(result.quadrature.work_per_cycle);
    if (result.reached || !result.quadrature.converged()) break;
    const bool intervals_next = more_intervals() && (by_levels >= by_grid || !finer_grid());
    if (!intervals_next && !finer_grid()) break;
    if (intervals_next) {
      result.intervals *= 2;
      by_levels = run();
    } else {
      result.grid.nx *= 2;
      result.grid.ny *= 2;
      by_grid = run();
    }
  }
  result.quadrature.error_estimate = result.error_estimate;
  result.cell_error = by_grid == unknown ? 0 : by_grid;
  return result;
}

AdaptiveQuadratureResult adaptive_interval_quadrature(const ContactSets& contact_sets,
                                                      const Grid2D& grid, const Body& body,
                                                      const Oscillation& motion,
                                                      double mean_indentation,
                                                      const AdaptiveQuadratureOptions& options) {
  AdaptiveQuadratureOptions fixed_grid = options;
  fixed_grid.max_points = 1;
  return adaptive_interval_quadrature([&](const Grid2D&) { return contact_sets; }, grid, body,
                                      motion, mean_indentation, fixed_grid);
}

}  // namespace salebra
