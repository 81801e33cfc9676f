// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of results as Python has them: forces along a path, contact sets, one model of a study.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/mdr/viscoelastic.hpp>
#include <salebra/damping/assumptions.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/realisation.hpp>

#include "axes.hpp"

namespace salebra::figures {
namespace {

/// A force at each step of a path, of which the result does not keep the displacement.
Figure along_path(std::string_view name, const char* label, const std::vector<double>& force) {
  Curve curve{.x = std::vector<double>(force.size()), .y = force};
  std::iota(curve.x.begin(), curve.x.end(), 0);
  return {.kind = std::string(name),
          .panels = {{.x = {.label = "step of the path"},
                      .y = axis_of(name, false, label),
                      .curves = {std::move(curve)}}}};
}

}  // namespace

Figure figure_of(const TrajectoryDamping& loss) {
  Figure figure = along_path("tangential_force", "tangential force F_x", loss.tangential_force);
  figure.panels[0].title =
      "loss W = " + error_text(loss.work_per_cycle, loss.work_per_cycle_error(), Dimension::energy);
  return figure;
}

Figure figure_of(const ViscoelasticDamping& loss) {
  return along_path("force", "normal force F", loss.force);
}

Figure figure_of(const ViscoelasticIndentation& contact) {
  return along_path("force", "normal force F", contact.force);
}

Figure figure_of(const ContactSetAt& set) {
  return {.kind = "contact_set",
          .caption = "Cells in contact, black.",
          .panels = {{.x = {.label = "cell along x"},
                      .y = {.label = "cell along y"},
                      .image = Image{.x = cells(set.contact.rows(), 1),
                                     .y = cells(set.contact.cols(), 1),
                                     .values = set.contact.cast<double>(),
                                     .palette = Palette::grey,
                                     .color_bar = false},
                      .equal_scales = true}}};
}

Figure figure_of(const RegimeMap& map) {
  // At an infinite frequency a normal cycle takes no excursion, and that line is left out.
  Figure figure = figure_of(map, std::numeric_limits<double>::infinity());
  std::erase_if(figure.panels[0].curves, [](const Curve& one) { return one.color == 7; });
  return figure;
}

Figure figure_of(const ExponentialFit& fit) {
  const std::vector<double> window{fit.window.pressure_min, fit.window.pressure_max};
  Curve law{.name = "p_0 e^{−ū/l}", .y = window, .style = Style::dashed};
  for (const double pressure : window)
    law.x.push_back(fit.decay_length * std::log(fit.reference_pressure / pressure));
  return {.kind = "fit",
          .caption = "The exponential law in the window of its fit.",
          .panels = {{.title = "decay length l = " +
                               interval_text(fit.decay_length, fit.decay_length_low,
                                             fit.decay_length_high, Dimension::length),
                      .x = axis_of("mean_gap", false, "mean gap ū"),
                      .y = axis_of("pressure", true, "nominal pressure p"),
                      .curves = {std::move(law)}}}};
}

Figure figure_of(const ModelResult& result) {
  ForceCurve curve = result.curve;
  curve.model = name_of(result.model);
  return figure_of(curve, result.fit);
}

Figure figure_of(const std::vector<DampingPoint>& points) {
  Curve described{.name = "without slip", .quantity = "damping_constant", .style = Style::points};
  Curve without{
      .name = "without slip", .quantity = "damping_constant_without_slip", .style = Style::dashed};
  for (const DampingPoint& one : points) {
    if (std::isfinite(one.slip_work)) described.name = "as described";
    const double error = one.damping_constant_error();
    described.x.push_back(one.pressure);
    described.y.push_back(one.damping_constant);
    described.low.push_back(one.damping_constant - (std::isfinite(error) ? error : 0));
    described.high.push_back(one.damping_constant + (std::isfinite(error) ? error : 0));
    without.y.push_back(one.damping_constant_without_slip);
  }
  without.x = described.x;
  Panel panel{.x = axis_of("pressure", true, "nominal pressure p"),
              .y = axis_of("damping_constant", true, "damping constant γ"),
              .curves = {described}};
  if (described.name != without.name) panel.curves.push_back(std::move(without));
  return {.kind = "damping",
          .caption = "Damping constant with its numerical error, and without slip.",
          .panels = {std::move(panel)}};
}

}  // namespace salebra::figures
