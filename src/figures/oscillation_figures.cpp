// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of oscillating contacts: contact regions, work over the time, loops.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <salebra/analysis/oscillation.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/assumption_verdicts.hpp>
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

/// The loss without slip, or that with slip: of the motion as described where friction is known.
std::string loss_text(const OscillationOutcome& outcome, bool slip) {
  const CycleResult& cycle = slip ? *outcome.frictional : *outcome.cycle;
  const double error = slip ? cycle.step_error : outcome.error_estimate();
  if (!(std::abs(cycle.work_per_cycle) > outcome.uncertain_loss())) return "no loss";
  return "W = " + error_text(cycle.work_per_cycle, error, Dimension::energy) +
         (slip ? " with slip" : "");
}

Panel work_panel(const OscillationOutcome& outcome, const std::string& title) {
  const bool drag = std::holds_alternative<Drag>(outcome.run.motion);
  const double predicted = outcome.intervals.small_amplitude_work;
  const bool lossless = !outcome.over(predicted);
  // A loss by slip that is far above that without slip would hide it.
  const bool dominated = outcome.slips() && outcome.frictional->work_per_cycle > 10 * predicted;
  const double reference = dominated ? 1 : lossless ? outcome.elastic_energy() : predicted;
  Panel panel;
  panel.title = title;
  panel.x = {.label = "time in periods", .low = 0, .high = 1};
  const std::string work = drag ? "energy lost" : "W(t)";
  if (dominated)
    panel.y = {.label = work, .unit = "J"};
  else
    panel.y = {.label = lossless ? work + " / (K_x u_x^2/2)"
                                 : work + (drag ? " / W_{Eq. 15}" : " / W_{Eq. 12}")};
  const auto add = [&](const char* name, const CycleResult& cycle, int color) {
    std::vector<double> values =
        column(cycle, drag ? &CycleSample::dissipated : &CycleSample::work);
    for (double& value : values) value /= reference;
    panel.curves.push_back({.name = name,
                            .x = column(cycle, &CycleSample::t),
                            .y = std::move(values),
                            .color = color});
  };
  if (!dominated) add(outcome.slips() ? "without slip" : "", *outcome.cycle, 0);
  if (outcome.slips()) add("with slip", *outcome.frictional, 1);
  panel.legend = Legend::top_left;
  if (!lossless && !dominated)
    panel.lines.push_back({.at = 1, .name = drag ? "Eq. (15)" : "Eq. (12)"});
  return panel;
}

Panel loop_panel(const OscillationOutcome& outcome, const std::string& title) {
  Panel panel;
  panel.title = title;
  panel.x = axis_of("tangential", false, "displacement x");
  panel.y = axis_of("tangential_force", false, "tangential force F_x");
  const auto add = [&](const char* name, const CycleResult& cycle) {
    panel.curves.push_back({.name = name,
                            .x = column(cycle, &CycleSample::tangential),
                            .y = column(cycle, &CycleSample::tangential_force)});
  };
  add("without slip", *outcome.cycle);
  if (outcome.slips()) add("with slip", *outcome.frictional);
  if (outcome.coupled) add("coupled", *outcome.coupled);
  panel.legend = Legend::top_left;
  return panel;
}

std::string setting_of(const OscillationCase& run) {
  return std::visit([](const auto& motion) { return motion_text(motion); }, run.motion) +
         ", mean indentation δ = " + format_quantity(run.indentation, Dimension::length, 4) + ", " +
         std::string(name_of(run.body.boundary)) + " boundary";
}

}  // namespace

Figure figure_of(const std::vector<OscillationOutcome>& outcomes,
                 const std::vector<std::string>& names, std::span<const Assumptions> assumptions) {
  Figure figure{.kind = "oscillation", .caption = "Oscillating contacts."};
  const std::size_t count = outcomes.size();
  if (count == 0) return figure;
  const bool single = count == 1;
  const OscillationOutcome& first = outcomes.front();
  const bool alike = std::ranges::all_of(outcomes, [&](const OscillationOutcome& one) {
    return setting_of(one.run) == setting_of(first.run);
  });
  figure.caption += alike ? " Motion: " + setting_of(first.run) : std::string(" Motions");
  for (std::size_t k = 0; k < count && !alike; ++k)
    figure.caption += (k == 0 ? ": " : "; ") + names[k] + ", " + setting_of(outcomes[k].run);
  figure.caption += first.slips() ? fmt::format("; µ = {:.3g}", first.friction_coefficient)
                                  : std::string("; no slip");
  figure.caption += alike ? fmt::format("; {}.", fmt::join(names, ", ")) : ".";
  if (!single) {
    figure.title = "Contact regions and work over a cycle";
    figure.columns = static_cast<int>(count);
  }
  for (std::size_t k = 0; k < count; ++k)
    figure.panels.push_back(contact_panel(outcomes[k], single ? "contact" : names[k]));
  std::vector<std::vector<AssumptionVerdict>> verdicts;
  for (std::size_t k = 0; k < assumptions.size(); ++k)
    verdicts.push_back(verdicts_of(assumptions.subspan(k, 1), outcomes[k].slips()));
  // That nothing was checked is said once for all contacts.
  const bool unchecked =
      !single && !verdicts.empty() && std::ranges::all_of(verdicts, [](const auto& one) {
        return validity_of(one) == Validity::not_checked;
      });
  for (std::size_t k = 0; k < count; ++k) {
    const std::string validity =
        !unchecked && k < verdicts.size() ? validity_text(verdicts[k]) : "";
    figure.panels.push_back(work_panel(
        outcomes[k], (single ? "" : names[k] + ": ") + loss_text(outcomes[k], outcomes[k].slips()) +
                         (validity.empty() ? "" : " (" + validity + ")")));
  }
  // The title has the loss of the motion as described.
  if (first.slips()) {
    std::vector<std::string> losses;
    for (std::size_t k = 0; k < count; ++k)
      losses.push_back((single ? "" : names[k] + ", ") + loss_text(outcomes[k], false));
    figure.caption += fmt::format(" Without slip: {}.", fmt::join(losses, "; "));
  }
  if (unchecked) figure.title += " (" + validity_text(verdicts[0]) + ")";
  figure.one_legend = true;
  std::size_t loops = 0;
  for (std::size_t k = 0; k < count; ++k)
    if (outcomes[k].frictional) {
      // Under a drag the body does not return, and the line is open.
      const char* what =
          std::holds_alternative<Drag>(outcomes[k].run.motion) ? "force over displacement" : "loop";
      figure.panels.push_back(loop_panel(outcomes[k], (single ? "" : names[k] + ": ") + what));
      ++loops;
    }
  // One sentence for the maps, and one for each kind of curves.
  const auto to = [&](std::size_t last) {
    return single ? "" : fmt::format("{} ({}) ", count == 2 ? "and" : "to", char('a' + last));
  };
  figure.panels[0].caption =
      to(count - 1) + "Cells always in contact (black) or during a part of the cycle (grey).";
  figure.panels[count].caption = to(2 * count - 1) + (std::holds_alternative<Drag>(first.run.motion)
                                                          ? "Energy lost over a cycle."
                                                          : "Work over a cycle.");
  if (loops > 0)
    figure.panels[2 * count].caption = to(2 * count + loops - 1) + "Force over displacement.";
  return figure;
}

}  // namespace salebra::figures
