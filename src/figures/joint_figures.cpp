// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of a joint: loss over force, and the loop of the largest motion.
#include <salebra/damping/joint.hpp>
#include <salebra/figures/figures.hpp>

#include "axes.hpp"

namespace salebra::figures {

Figure figure_of(const std::vector<JointLoss>& losses, const std::vector<double>& displacement,
                 const std::vector<double>& loop) {
  std::vector<double> force, amplitude, work;
  for (const JointLoss& one : losses) {
    force.push_back(one.tangential_force);
    amplitude.push_back(one.tangential_amplitude);
    work.push_back(one.work_per_cycle);
  }
  Figure figure;
  figure.columns = 2;
  figure.panels.push_back({.title = "Energy dissipated in a cycle",
                           .x = axis_of("tangential_force", spans_decades(force)),
                           .y = {.label = "W", .unit = "J", .logarithmic = spans_decades(work)}});
  figure.panels.back().curves = {{.name = "W", .x = force, .y = work}};
  figure.panels.push_back({.title = "Loop of the largest motion, and backbone",
                           .x = {.label = "x", .unit = "m"},
                           .y = {.label = "T", .unit = "N"},
                           .legend = Legend::top_left});
  figure.panels.back().curves = {
      {.name = "loop", .x = displacement, .y = loop},
      {.name = "backbone", .x = amplitude, .y = force, .style = Style::dashed}};
  return figure;
}

}  // namespace salebra::figures
