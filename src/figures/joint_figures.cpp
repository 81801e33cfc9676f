// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of a joint: loss over force, and the loop of the largest motion.
#include <algorithm>
#include <cmath>
#include <salebra/damping/joint.hpp>
#include <salebra/figures/figures.hpp>

#include "axes.hpp"

namespace salebra::figures {

Figure figure_of(const std::vector<JointLoss>& losses, const std::vector<double>& displacement,
                 const std::vector<double>& loop) {
  std::vector<double> force, amplitude, work, low, high;
  for (const JointLoss& one : losses) {
    force.push_back(one.tangential_force);
    amplitude.push_back(one.tangential_amplitude);
    work.push_back(one.work_per_cycle);
    low.push_back(one.work_per_cycle - one.work_error);
    high.push_back(one.work_per_cycle + one.work_error);
  }
  const JointLoss& largest =
      *std::ranges::max_element(losses, {}, &JointLoss::tangential_amplitude);
  Figure figure{.kind = "joint",
                .caption =
                    "Loss of a joint in a cycle of the tangential motion, with its error, and "
                    "the loop of the largest motion between the tips of the others.",
                .columns = 2};
  figure.panels.push_back({.title = "Energy dissipated in a cycle",
                           .x = axis_of("tangential_force", spans_decades(force)),
                           .y = axis_of("work_per_cycle", spans_decades(work), "loss W")});
  figure.panels.back().curves = {{.name = "loss W",
                                  .quantity = "work_per_cycle",
                                  .x = force,
                                  .y = work,
                                  .low = low,
                                  .high = high,
                                  .style = Style::line_and_points}};
  figure.panels.push_back(
      {.title = "Largest motion: W = " +
                error_text(largest.work_per_cycle, largest.work_error, Dimension::energy),
       .x = axis_of("tangential_amplitude", false, "displacement x"),
       .y = axis_of("tangential_force", false, "tangential force T"),
       .legend = Legend::top_left});
  figure.panels.back().curves = {
      {.name = "loop", .x = displacement, .y = loop},
      {.name = "backbone", .x = amplitude, .y = force, .style = Style::dashed}};
  if (std::ranges::all_of(low, [](double value) { return std::isnan(value); }))
    figure.panels.front().curves.front().low = figure.panels.front().curves.front().high = {};
  return figure;
}

}  // namespace salebra::figures
