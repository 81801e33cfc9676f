// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of oscillating contacts: contact regions, work over the time, loops.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/figures/figures.hpp>
#include <variant>

#include "axes.hpp"
#include "results/describe.hpp"

namespace salebra::figures {
namespace {

Panel contact_panel(const OscillationOutcome& outcome, const std::string& title) {
  Panel panel = map_panel(outcome.run.body.surface.grid, outcome.cycle->contact_map(), title,
                          {.low = 0, .high = 2});
  panel.image->palette = Palette::grey;
  panel.image->color_bar = false;
  return panel;
}

Panel work_panel(const OscillationOutcome& outcome, const std::string& title) {
  const bool drag = std::holds_alternative<Drag>(outcome.run.motion);
  const CycleResult& cycle = *outcome.cycle;
  const double predicted = outcome.intervals.small_amplitude_work;
  const bool lossless = !outcome.over(predicted);
  std::vector<double> values = column(cycle, drag ? &CycleSample::dissipated : &CycleSample::work);
  const double reference = lossless ? outcome.elastic_energy() : predicted;
  for (double& value : values) value /= reference;
  Panel panel;
  panel.title = title;
  panel.x = {.label = "time in periods", .low = 0, .high = 1};
  const std::string work = drag ? "energy released" : "W(t)";
  panel.y = {.label = lossless ? work + " / (K_x u_x^2/2)"
                               : work + (drag ? " / W_{Eq. 15}" : " / W_{Eq. 12}")};
  panel.curves.push_back({.x = column(cycle, &CycleSample::t), .y = std::move(values), .color = 0});
  if (!lossless) panel.lines.push_back({.at = 1, .name = drag ? "Eq. (15)" : "Eq. (12)"});
  return panel;
}

Panel loop_panel(const OscillationOutcome& outcome) {
  Panel panel;
  panel.title = "loop";
  panel.x = axis_of("tangential", false, "displacement x");
  panel.y = axis_of("tangential_force", false, "tangential force F_x");
  const auto add = [&](const char* name, const CycleResult& cycle) {
    panel.curves.push_back({.name = name,
                            .x = column(cycle, &CycleSample::tangential),
                            .y = column(cycle, &CycleSample::tangential_force)});
  };
  add("no slip", *outcome.cycle);
  if (std::isfinite(outcome.friction_coefficient)) add("friction", *outcome.frictional);
  if (outcome.coupled) add("coupled", *outcome.coupled);
  panel.legend = Legend::top_left;
  return panel;
}

}  // namespace

Figure figure_of(const std::vector<OscillationOutcome>& outcomes,
                 const std::vector<std::string>& names) {
  Figure figure{.kind = "oscillation", .caption = "Oscillating contacts."};
  const bool single = outcomes.size() == 1;
  if (!outcomes.empty()) {
    const OscillationCase& run = outcomes.front().run;
    figure.caption += fmt::format(
        " Motion: {}{}, mean indentation δ = {}; {} boundary; {}.",
        std::visit([](const auto& motion) { return motion_text(motion); }, run.motion),
        std::isfinite(outcomes.front().friction_coefficient) && outcomes.front().frictional
            ? fmt::format(", µ = {:.3g}", outcomes.front().friction_coefficient)
            : ", no slip",
        format_quantity(run.indentation, Dimension::length, 4), name_of(run.body.boundary),
        single ? names.front() : fmt::format("{}", fmt::join(names, ", ")));
  }
  if (!single) {
    figure.title = "Contact regions and work over a cycle";
    figure.columns = static_cast<int>(outcomes.size());
  }
  for (std::size_t k = 0; k < outcomes.size(); ++k)
    figure.panels.push_back(contact_panel(outcomes[k], single ? "contact" : names[k]));
  const auto way = [&](const OscillationOutcome& outcome) {
    return single ? "" : names[static_cast<std::size_t>(&outcome - outcomes.data())] + ": ";
  };
  for (const OscillationOutcome& outcome : outcomes) {
    const double work = outcome.work_per_cycle();
    figure.panels.push_back(work_panel(
        outcome,
        std::abs(work) > outcome.uncertain_loss()
            ? way(outcome) + "W = " + error_text(work, outcome.error_estimate(), Dimension::energy)
            : way(outcome) + "no loss"));
  }
  for (const OscillationOutcome& outcome : outcomes)
    if (outcome.frictional) figure.panels.push_back(loop_panel(outcome));
  // One sentence for the maps, and one for the curves.
  const std::size_t count = outcomes.size();
  const auto to = [&](std::size_t last) {
    return single ? "" : fmt::format("to ({}) ", char('a' + last));
  };
  if (count == 0) return figure;
  figure.panels[0].caption =
      to(count - 1) + "Cells always in contact (black) or during a part of the cycle (grey).";
  figure.panels[count].caption = to(2 * count - 1) + "Work over a cycle.";
  return figure;
}

}  // namespace salebra::figures
