// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a force curve with its fitted law, and of the pressure and gap of one contact.
#include <algorithm>
#include <cmath>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/surface/lay.hpp>
#include <tuple>
#include <utility>

#include "axes.hpp"

namespace salebra::figures {
namespace {

/// The points (x, y) of the converged samples that have both numbers.
Curve points_of(const ForceCurve& curve, std::string name, double ForceSample::*x,
                double ForceSample::*y) {
  Curve points{.name = std::move(name), .style = Style::line_and_points};
  for (const ForceSample& sample : curve.samples) {
    if (!sample.converged || !std::isfinite(sample.*x) || !std::isfinite(sample.*y)) continue;
    points.x.push_back(sample.*x);
    points.y.push_back(sample.*y);
  }
  return points;
}

void add_fit(Panel& panel, const ExponentialFit& fit) {
  const auto gap = [&](double pressure) {
    return fit.decay_length * std::log(fit.reference_pressure / pressure);
  };
  const double low = fit.window.pressure_min, high = fit.window.pressure_max;
  panel.curves.push_back({.name = "p_0 e^{-ū/l}, fitted between the lines",
                          .x = {gap(high), gap(low)},
                          .y = {high, low},
                          .style = Style::dashed});
  panel.lines = {{.at = gap(high), .vertical = true}, {.at = gap(low), .vertical = true}};
}

}  // namespace

Figure figure_of(const ForceCurve& all, const std::optional<ExponentialFit>& fit) {
  Figure figure;
  const std::vector<ForceCurve> curves = by_direction(all);
  const ForceCurve& curve = curves.front();
  const Axis pressure{.label = "nominal pressure p", .unit = "Pa", .logarithmic = true};
  Curve gaps = points_of(curve, curve.model.empty() ? "curve" : plain_text(curve.model),
                         &ForceSample::mean_gap, &ForceSample::pressure);
  require(
      !gaps.x.empty(), "curve", curve.samples.size(),
      "samples, none of which converged with a mean gap and a pressure: there is nothing to draw");
  Panel& law = figure.panels.emplace_back();
  law.x = {.label = "mean gap ū", .unit = "m"};
  law.y = pressure;
  law.curves.push_back(std::move(gaps));
  if (fit && std::isfinite(fit->decay_length)) add_fit(law, *fit);

  Curve areas = points_of(curve, "", &ForceSample::pressure, &ForceSample::contact_area_fraction);
  if (!areas.x.empty()) {
    Panel& panel = figure.panels.emplace_back();
    panel.x = pressure;
    panel.y = {.label = "contact area A/A_0", .logarithmic = true};
    panel.curves.push_back(std::move(areas));
  }
  Panel stiffness;
  stiffness.x = {.label = "normal force F", .unit = "N", .logarithmic = true};
  stiffness.y = {.label = "stiffness", .unit = "N/m", .logarithmic = true};
  stiffness.legend = Legend::top_left;
  const auto add = [&](const ForceCurve& one, const std::string& name,
                       double ForceSample::*member) {
    if (Curve points = points_of(one, name, &ForceSample::force, member); !points.x.empty())
      stiffness.curves.push_back(std::move(points));
  };
  add(curve, "normal, K", &ForceSample::normal_stiffness);
  for (const ForceCurve& one : curves)
    add(one,
        std::isnan(one.direction()) ? "tangential, K_t"
                                    : "tangential, K_t, " + direction_in_words(one.direction()),
        &ForceSample::tangential_stiffness);
  if (!stiffness.curves.empty()) figure.panels.push_back(std::move(stiffness));
  return figure;
}

Figure figure_of(const ForceCurve& loading, const ForceCurve& unloading) {
  Figure figure;
  for (const auto& [label, unit, y] :
       {std::tuple("nominal pressure p", "Pa", &ForceSample::pressure),
        {"contact area A/A_0", "", &ForceSample::contact_area_fraction}}) {
    Panel& panel = figure.panels.emplace_back();
    panel.x = {.label = "indentation", .unit = "m"};
    panel.y = {.label = label, .unit = unit};
    panel.legend = Legend::top_left;
    panel.curves = {points_of(loading, "loading", &ForceSample::indentation, y),
                    points_of(unloading, "unloading", &ForceSample::indentation, y)};
  }
  return figure;
}

Figure figure_of(const Grid2D& grid, const NormalContactState& state) {
  Figure figure;
  figure.panels.push_back(
      map_panel(grid, state.contact_pressure, "contact pressure", {.label = "p", .unit = "Pa"}));
  figure.panels.push_back(map_panel(grid, state.gap, "gap", {.label = "g", .unit = "m"}));
  figure.columns = 2;
  return figure;
}

}  // namespace salebra::figures
