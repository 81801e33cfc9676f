// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of `compare`: curves of all models with 95 % bands.
#include "compare_figure.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace salebra::cli {
namespace {

std::vector<double> column(const std::vector<EnsembleMean>& estimates,
                           double EnsembleMean::*member) {
  std::vector<double> values;
  for (const EnsembleMean& estimate : estimates) values.push_back(estimate.*member);
  return values;
}

PlotCurve band(const std::string& name, const std::vector<double>& x,
               const std::vector<EnsembleMean>& y) {
  return {.name = name,
          .x = x,
          .y = column(y, &EnsembleMean::mean),
          .low = column(y, &EnsembleMean::low),
          .high = column(y, &EnsembleMean::high)};
}

/// The window of the fit, what the theories of vanishing load say, and the law with the fitted l.
void add_references(const StudyResult& result, const std::vector<double>& loads,
                    const std::vector<double>& forces, std::array<PlotPanel, 4>& panels) {
  auto& [gaps, areas, stiffness, damping] = panels;
  if (!result.configuration.window) gaps.lines = {{.at = 1}, {.at = 2.5}};
  const StudyTheories theories = result.theories();
  areas.lines = {{.at = theories.bgt_area_slope, .name = "BGT"}};
  if (!result.configuration.has(ContactModel::persson))
    areas.lines.push_back({.at = theories.persson_area_slope, .name = "Persson"});
  PlotCurve edge = band("boundary elements, less the edge", loads,
                        result.at_pressures([&](const Realisation& r, std::size_t k) {
                          return r.spots[k].corrected_area_fraction / result.pressures[k] *
                                 r.moments.rms_slope() *
                                 result.configuration.material.contact_modulus;
                        }));
  edge.style = PlotStyle::dotted;
  edge.color = 0;
  areas.curves.push_back(std::move(edge));
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  PlotCurve law = band(drag ? "Eq. (16), fitted l" : "Eq. (12), fitted l", forces,
                       result.damping(&DampingPoint::damping_constant_closed_form));
  law.low = law.high = {};
  law.style = PlotStyle::dashed;
  law.color = 7;
  damping.curves.push_back(std::move(law));
}

/// Force–gap, area–load, stiffness–load and damping–force of one point, with bands of 95 %.
std::array<PlotPanel, 4> panels_of(const StudyResult& result) {
  std::array<PlotPanel, 4> panels;
  auto& [gaps, areas, stiffness, damping] = panels;
  std::vector<double> loads, forces;
  for (const double pressure : result.pressures) {
    loads.push_back(pressure / result.contact_scale);
    forces.push_back(pressure * result.grid.area());
  }
  gaps.x = areas.x = stiffness.x = {.label = "nominal pressure p/(E^{*}h')", .logarithmic = true};
  gaps.y = {.label = "mean gap ū/h_{rms}"};
  areas.y = {.label = "area over load, A E^{*}h'/F"};
  stiffness.y = {.label = "stiffness K h_{rms}/F"};
  damping.x = {.label = "normal force F", .unit = "N", .logarithmic = true};
  damping.y = {.label = "damping constant γ", .unit = "N s/m", .logarithmic = true};
  gaps.legend = PlotLegend::bottom_left;
  damping.legend = PlotLegend::top_left;
  for (const StudyModel& model : result.models()) {
    const auto scaled = [&](auto value) {
      return result.at_pressures([&](const Realisation& r, std::size_t k) {
        const auto& samples = r.of(model.id).curve.samples;
        return k < samples.size() && samples[k].converged ? double(value(r, samples[k]))
                                                          : ForceSample::unknown;
      });
    };
    // The place among all models decides: a model keeps its colour whatever is drawn beside it.
    const auto add = [&](PlotPanel& panel, const std::vector<double>& x,
                         const std::vector<EnsembleMean>& y) {
      panel.curves.push_back(band("", x, y));
      panel.curves.back().color = int(model.id);
    };
    add(gaps, loads, scaled([](const Realisation& r, const ForceSample& sample) {
          return sample.mean_gap / r.heights.rms_height;
        }));
    gaps.curves.back().name = model.title;
    add(areas, loads, scaled([&](const Realisation& r, const ForceSample& sample) {
          return sample.contact_area_fraction / sample.pressure * r.moments.rms_slope() *
                 result.configuration.material.contact_modulus;
        }));
    add(stiffness, loads, scaled([](const Realisation& r, const ForceSample& sample) {
          return sample.normal_stiffness * r.heights.rms_height / sample.force;
        }));
    add(damping, forces, result.damping(&DampingPoint::damping_constant, model.id));
  }
  add_references(result, loads, forces, panels);
  return panels;
}

/// Limits that hold all curves with their bands, so that panels beside each other can be compared.
void share_limits(const std::vector<PlotPanel*>& panels) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const PlotPanel* panel : panels)
    for (const PlotCurve& curve : panel->curves)
      for (const auto* values : {&curve.y, &curve.low, &curve.high})
        for (const double value : *values)
          if (std::isfinite(value) && (value > 0 || !panel->y.logarithmic)) {
            low = std::min(low, value);
            high = std::max(high, value);
          }
  if (!(low < high)) return;
  const bool logarithmic = panels.front()->y.logarithmic;
  const double margin = 0.04 * (logarithmic ? std::log(high / low) : high - low);
  for (PlotPanel* panel : panels) {
    panel->y.low = logarithmic ? low * std::exp(-margin) : low - margin;
    panel->y.high = logarithmic ? high * std::exp(margin) : high + margin;
  }
}

}  // namespace

Figure compare_figure(const std::vector<StudyResult>& results, const ParameterLists& varied) {
  Figure figure;
  figure.columns = results.size() == 1 ? 2 : int(results.size());
  std::vector<std::array<PlotPanel, 4>> points;
  for (const StudyResult& result : results) points.push_back(panels_of(result));
  for (std::size_t quantity = 0; quantity < 4; ++quantity) {
    std::vector<PlotPanel*> row;
    for (auto& point : points) row.push_back(&point[quantity]);
    if (row.size() > 1) share_limits(row);
  }
  for (std::size_t quantity = 0; quantity < 4; ++quantity)
    for (std::size_t i = 0; i < points.size(); ++i) {
      PlotPanel& panel = points[i][quantity];
      // The first column explains the lines of all.
      if (i > 0)
        for (PlotCurve& curve : panel.curves) curve.name.clear();
      if (quantity == 0 && points.size() > 1)
        panel.title = describe_point(varied, results[i].configuration);
      figure.panels.push_back(std::move(panel));
    }
  return figure;
}

}  // namespace salebra::cli
