// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of losses on a viscoelastic body, of an indenter and of a rough surface, and of its creep.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/figures/figures.hpp>

#include "axes.hpp"

namespace salebra::figures {

Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<ViscoelasticLoss>& losses) {
  const Axis x = axis_of(quantity, grows_by_factors(values));
  const auto curve = [&](const char* name, const char* of, const auto& value) {
    Curve out{.name = name, .quantity = of, .x = values, .style = Style::line_and_points};
    for (const ViscoelasticLoss& loss : losses) out.y.push_back(value(loss));
    return out;
  };
  Figure figure{.kind = "viscoelastic",
                .caption = "An oscillating contact of a viscoelastic body.",
                .columns = 2};
  const ViscoelasticDamping& last = losses.back().damping;
  figure.panels.push_back(
      {.title = "W = " + value_text(last.work_per_cycle, "J") +
                ", γ = " + value_text(last.damping_constant, "N s/m") + " at " +
                value_text(values.back(), x.unit),
       .caption = "Energy lost in a cycle and its causes, beside the loss of "
                  "an elastic body of the relaxed modulus. γ is that of the tangential motion.",
       .x = x,
       .y = axis_of("work_per_cycle", true, "loss W"),
       .legend = Legend::top_left});
  figure.panels.back().y.prefix_of = last.work_per_cycle;
  figure.panels.back().curves = {
      curve("material, normal", "normal_material_work",
            [](const auto& loss) { return loss.damping.normal_material_work; }),
      curve("material, tangential", "tangential_material_work",
            [](const auto& loss) { return loss.damping.tangential_material_work; }),
      curve("relaxation", "relaxation_work",
            [](const auto& loss) { return loss.damping.relaxation_work; }),
      curve("elastic, relaxed modulus", "elastic_work",
            [](const auto& loss) { return loss.elastic_work; })};
  figure.panels.back().curves.back().style = Style::dashed;
  Curve total = curve("total", "work_per_cycle",
                      [](const auto& loss) { return loss.damping.work_per_cycle; });
  total.style = Style::dotted;
  total.color = 6;
  figure.panels.back().curves.push_back(std::move(total));
  figure.panels.push_back(
      {.title = "complex shear modulus",
       .caption = "Complex modulus.",
       .x = x,
       .y = {.label = "shear modulus G′, G″", .unit = "Pa", .logarithmic = true},
       .legend = Legend::top_left});
  figure.panels.back().curves = {
      curve("storage modulus G′", "storage_modulus",
            [](const auto& loss) { return loss.storage_modulus; }),
      curve("loss modulus G″", "loss_modulus", [](const auto& loss) { return loss.loss_modulus; })};
  return figure;
}

Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<ViscoelasticCycle>& cycles) {
  require(!cycles.empty(), "cycles", cycles.size(), "given: there is nothing to draw");
  // Users give frequencies in Hz.
  const bool angular = quantity == "angular_frequency";
  std::vector<double> along = values;
  if (angular)
    for (double& value : along) value /= 2 * std::numbers::pi;
  const Axis x = axis_of(angular ? "frequency" : quantity, grows_by_factors(values));
  const auto curve = [&](const char* name, const char* of, double ViscoelasticCycle::*value) {
    Curve out{.name = name, .quantity = of, .x = along, .style = Style::line_and_points};
    for (const ViscoelasticCycle& cycle : cycles) out.y.push_back(cycle.*value);
    return out;
  };
  using C = ViscoelasticCycle;
  Figure figure{.kind = "viscoelastic_cycle",
                .caption =
                    "A rough contact on a viscoelastic body. (a) Energy lost in a cycle by the "
                    "normal and the tangential motion, with the part that cells release when they "
                    "leave, and their sum with its numerical error (band). (b) Stiffnesses in and "
                    "out of phase.",
                .columns = 2};
  // A cycle whose steady state was not found has no loss.
  std::size_t shown = cycles.size() - 1;
  while (shown > 0 && !std::isfinite(cycles[shown].work_per_cycle)) --shown;
  const C& last = cycles[shown];
  figure.panels.push_back(
      {.title =
           "W = " + error_text(last.work_per_cycle, last.work_per_cycle_error, Dimension::energy) +
           ", γ = " + value_text(last.damping_constant, "N s/m") + " at " +
           value_text(along[shown], x.unit),
       .x = x,
       .y = axis_of("work_per_cycle", true, "loss W"),
       .legend = Legend::top_left});
  if (std::isfinite(last.work_per_cycle)) figure.panels.back().y.prefix_of = last.work_per_cycle;
  figure.panels.back().curves = {curve("normal", "normal_work", &C::normal_work),
                                 curve("tangential", "tangential_work", &C::tangential_work),
                                 curve("released by leaving cells", "jump_work", &C::jump_work)};
  figure.panels.back().curves.back().style = Style::dashed;
  Curve total = curve("total", "work_per_cycle", &C::work_per_cycle);
  total.style = Style::dotted;
  total.color = 6;
  for (const C& cycle : cycles) {
    total.low.push_back(cycle.work_per_cycle - cycle.work_per_cycle_error);
    total.high.push_back(cycle.work_per_cycle + cycle.work_per_cycle_error);
  }
  figure.panels.back().curves.push_back(std::move(total));
  figure.panels.push_back({.title = "dynamic stiffness",
                           .x = x,
                           .y = {.label = "stiffness", .unit = "N/m", .logarithmic = true},
                           .legend = Legend::top_left});
  figure.panels.back().curves = {
      curve("normal, storage", "normal_storage_stiffness", &C::normal_storage_stiffness),
      curve("normal, loss", "normal_loss_stiffness", &C::normal_loss_stiffness),
      curve("tangential, storage", "tangential_storage_stiffness",
            &C::tangential_storage_stiffness),
      curve("tangential, loss", "tangential_loss_stiffness", &C::tangential_loss_stiffness)};
  return figure;
}

Figure figure_of(const ViscoelasticPath& path) {
  using P = ViscoelasticPoint;
  const auto column = [&](double P::*value) {
    std::vector<double> out;
    for (const P& point : path.points) out.push_back(point.*value);
    return out;
  };
  const std::vector<double> time = column(&P::time);
  const Axis x = axis_of("time", spans_decades(time));
  // What was prescribed has no error.
  const bool held = !path.points.empty() && std::isnan(path.points.front().indentation_error);
  Figure figure{
      .kind = "viscoelastic_path",
      .caption =
          held ? "Relaxation of a rough contact on a viscoelastic body. (a) Pressure. (b) Area."
               : "Creep of a rough contact on a viscoelastic body. (a) Indentation. (b) Area.",
      .columns = 2};
  const std::string first = held ? "pressure" : "indentation";
  figure.panels.push_back({.x = x, .y = axis_of(first)});
  figure.panels.back().curves = {{.quantity = first,
                                  .x = time,
                                  .y = column(held ? &P::pressure : &P::indentation),
                                  .style = Style::line_and_points}};
  figure.panels.push_back({.x = x, .y = axis_of("contact_area_fraction")});
  figure.panels.back().curves = {{.quantity = "contact_area_fraction",
                                  .x = time,
                                  .y = column(&P::contact_area_fraction),
                                  .style = Style::line_and_points}};
  return figure;
}

}  // namespace salebra::figures
