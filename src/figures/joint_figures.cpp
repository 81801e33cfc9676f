// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of a joint: loss over force, and the loop of the largest motion.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <salebra/damping/joint.hpp>
#include <salebra/figures/figures.hpp>

#include "axes.hpp"

namespace salebra::figures {

namespace {

/// The backbone: half the size of the branch of the loop from its lower to its upper tip.
Curve backbone_of(const std::vector<double>& displacement, const std::vector<double>& loop) {
  Curve backbone{.name = "backbone", .style = Style::dashed};
  const std::size_t count = displacement.size();
  const auto lowest = std::size_t(std::ranges::min_element(displacement) - displacement.begin());
  const double x0 = displacement[lowest], force = loop[lowest];
  for (std::size_t k = 0; k < count; ++k) {
    // The loop is closed, so that the branch may begin anywhere in the list.
    const std::size_t at = (lowest + k) % count;
    const double x = (displacement[at] - x0) / 2;
    if (!backbone.x.empty() && !(x > backbone.x.back())) {
      if (x < backbone.x.back()) break;
      continue;
    }
    backbone.x.push_back(x);
    backbone.y.push_back((loop[at] - force) / 2);
  }
  return backbone;
}

}  // namespace

Figure figure_of(const std::vector<JointLoss>& losses, const std::vector<double>& displacement,
                 const std::vector<double>& loop, double normal_force, double friction_coefficient,
                 const std::array<std::vector<double>, 2>& limits) {
  std::vector<double> force, amplitude, work;
  auto [low, high] = limits;
  const bool several = !low.empty();
  for (const JointLoss& one : losses) {
    force.push_back(one.tangential_force);
    amplitude.push_back(one.tangential_amplitude);
    work.push_back(one.work_per_cycle);
    if (several) continue;
    low.push_back(one.work_per_cycle - one.work_error);
    high.push_back(one.work_per_cycle + one.work_error);
  }
  if (std::ranges::all_of(low, [](double value) { return std::isnan(value); })) low = high = {};
  const auto largest = std::size_t(
      std::ranges::max_element(losses, {}, &JointLoss::tangential_amplitude) - losses.begin());
  const std::string loss =
      several ? interval_text(work[largest], low[largest], high[largest], Dimension::energy)
              : error_text(work[largest], losses[largest].work_error, Dimension::energy);
  Figure figure{.kind = "joint",
                .caption = fmt::format(
                    "A joint under the normal force {}, with a coefficient of friction of {:.3g}.",
                    format_quantity(normal_force, Dimension::force, 4), friction_coefficient),
                .columns = 2};
  // The force does not grow further while the joint slides; then the amplitude tells the motions
  // apart.
  bool slides = false;
  for (std::size_t k = 1; k < force.size(); ++k)
    slides = slides || std::abs(force[k] - force[k - 1]) < 1e-3 * force[k];
  const std::vector<double>& along = slides ? amplitude : force;
  figure.panels.push_back(
      {.title =
           fmt::format("normal force F = {}, µ = {:.3g}",
                       format_quantity(normal_force, Dimension::force, 4), friction_coefficient),
       .caption =
           fmt::format("Energy lost in a cycle{}.", several        ? ", with its 95 % limits"
                                                    : !low.empty() ? ", with its numerical error"
                                                                   : ""),
       .x = axis_of(slides ? "tangential_amplitude" : "tangential_force", grows_by_factors(along)),
       .y = axis_of("work_per_cycle", spans_decades(work), "loss W in a cycle"),
       .legend = Legend::top_left});
  figure.panels.back().curves = {
      {.name = several ? "mean, 95 % limits over surfaces" : "",
       .quantity = "work_per_cycle",
       .x = along,
       .y = work,
       .low = low,
       .high = high,
       // A single point has a bar in place of a band.
       .style = losses.size() == 1 ? Style::points : Style::line_and_points}};
  figure.panels.back().y.prefix_of = work[largest];
  double sliding = HUGE_VAL;
  for (std::size_t k = 0; k < losses.size(); ++k)
    if (losses[k].regime == Regime::sliding) sliding = std::min(sliding, along[k]);
  if (std::isfinite(sliding))
    figure.panels.back().lines.push_back(
        {.at = sliding, .vertical = true, .name = "sliding from here on"});
  figure.panels.push_back(
      {.title = fmt::format("largest motion, {}: W = {}", name_of(losses[largest].regime), loss),
       .caption =
           std::string("Loop of the largest motion with its backbone.") +
           (losses[largest].regime == Regime::sliding
                ? " It counts as sliding: a contact as small as the region that sticks would carry "
                  "less than 5 % of F."
                : ""),
       .x = axis_of("tangential_amplitude", false, "displacement x"),
       .y = axis_of("tangential_force", false, "tangential force F_x"),
       .legend = Legend::top_left});
  figure.panels.back().curves = {{.name = "loop", .x = displacement, .y = loop},
                                 backbone_of(displacement, loop)};
  return figure;
}

}  // namespace salebra::figures
