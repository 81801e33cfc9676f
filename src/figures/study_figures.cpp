// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of `compare`: curves of all models with 95 % bands.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <salebra/figures/figures.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>

namespace salebra::figures {
namespace {

std::vector<double> column(const std::vector<EnsembleMean>& estimates,
                           double EnsembleMean::*member) {
  std::vector<double> values;
  for (const EnsembleMean& estimate : estimates) values.push_back(estimate.*member);
  return values;
}

Curve band(const std::string& name, const std::vector<double>& x,
           const std::vector<EnsembleMean>& y) {
  return {.name = name,
          .x = x,
          .y = column(y, &EnsembleMean::mean),
          .low = column(y, &EnsembleMean::low),
          .high = column(y, &EnsembleMean::high)};
}

/// Adds γ of the motion as the user described it, with the same numbers as the table of the study:
/// with the 95 % interval over the surfaces or, for one surface, the numerical error.
void add_answer(const StudyResult& result, Panel& damping) {
  const StudySolution answer = solution_of(result);
  const bool sample = result.realisations.size() > 1;
  bool any_bar = false;
  Curve points{.x = result.pressures, .style = Style::points, .color = 0};
  for (const StatedMean& one : answer.damping_constant) {
    const double low = sample ? one.low : one.mean - one.error,
                 high = sample ? one.high : one.mean + one.error;
    const bool bar = !std::isnan(low);
    any_bar |= bar;
    points.y.push_back(one.mean);
    points.low.push_back(bar ? low : one.mean);
    points.high.push_back(bar ? high : one.mean);
  }
  if (std::ranges::all_of(points.y, [](double value) { return std::isnan(value); })) return;
  if (answer.slips()) {
    points.name =
        fmt::format("with slip, µ = {:g}", result.configuration.known.friction_coefficient);
    damping.curves.front().name = "without slip, as all lines";
  } else {
    points.name = "without slip";
  }
  if (any_bar) points.name += sample ? ", 95 %" : ", ± error";
  damping.curves.push_back(std::move(points));
}

/// Adds the window of the fit, the limits of theories for vanishing load, and the exponential law
/// with the fitted decay length l.
void add_references(const StudyResult& result, std::array<Panel, 4>& panels) {
  auto& [gaps, areas, stiffness, damping] = panels;
  if (!result.configuration.window) gaps.lines = {{.at = 1}, {.at = 2.5}};
  const StudyTheories theories = result.theories();
  areas.lines = {{.at = theories.bgt_area_slope, .name = "BGT"}};
  if (!result.configuration.has(ContactModel::persson))
    areas.lines.push_back({.at = theories.persson_area_slope, .name = "Persson"});
  Curve edge = band("boundary elements, less the edge", result.pressures,
                    result.at_pressures([&](const Realisation& r, std::size_t k) {
                      return r.spots[k].corrected_area_fraction / result.pressures[k] *
                             r.moments.rms_slope() * result.configuration.material.contact_modulus;
                    }));
  edge.style = Style::dotted;
  edge.color = 0;
  areas.curves.push_back(std::move(edge));
  if (result.configuration.adhesion) return;
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  Curve law = band(drag ? "Eq. (16), fitted l" : "Eq. (12), fitted l", result.pressures,
                   result.damping(&DampingPoint::damping_constant_closed_form));
  law.low = law.high = {};
  law.style = Style::dashed;
  law.color = 7;
  damping.curves.push_back(std::move(law));
}

/// Panels of one point of the parameter grid: gap, area, stiffness and damping over the pressure,
/// with bands of 95 %.
std::array<Panel, 4> panels_of(const StudyResult& result) {
  std::array<Panel, 4> panels;
  auto& [gaps, areas, stiffness, damping] = panels;
  for (Panel& panel : panels) {
    panel.x = {.label = "nominal pressure p", .unit = "Pa", .logarithmic = true};
    panel.second_x = SecondAxis{.label = "p/(E^{*}h')", .factor = 1 / result.contact_scale};
  }
  damping.second_x =
      SecondAxis{.label = "normal force F", .unit = "N", .factor = result.grid.area()};
  gaps.y = {.label = "mean gap ū/h_{rms}"};
  areas.y = {.label = "area over load, A E^{*}h'/F"};
  stiffness.y = {.label = "stiffness K h_{rms}/F"};
  damping.y = {.label = "damping constant γ", .unit = "N s/m", .logarithmic = true};
  gaps.legend = Legend::bottom_left;
  damping.legend = Legend::top_left;
  for (const StudyModel& model : result.models()) {
    const auto scaled = [&](auto value) {
      return result.at_pressures([&](const Realisation& r, std::size_t k) {
        const auto& samples = r.of(model.id).curve.samples;
        return k < samples.size() && samples[k].converged ? double(value(r, samples[k]))
                                                          : ForceSample::unknown;
      });
    };
    // Models are numbered as in the list of all models, and the number sets the colour, so each
    // model has the same colour in every figure.
    const auto add = [&](Panel& panel, const std::vector<EnsembleMean>& y) {
      panel.curves.push_back(band("", result.pressures, y));
      panel.curves.back().color = int(model.id);
    };
    add(gaps, scaled([](const Realisation& r, const ForceSample& sample) {
          return sample.mean_gap / r.heights.rms_height;
        }));
    gaps.curves.back().name = model.title;
    add(areas, scaled([&](const Realisation& r, const ForceSample& sample) {
          return sample.contact_area_fraction / sample.pressure * r.moments.rms_slope() *
                 result.configuration.material.contact_modulus;
        }));
    add(stiffness, scaled([](const Realisation& r, const ForceSample& sample) {
          return sample.normal_stiffness * r.heights.rms_height / sample.force;
        }));
    if (!result.configuration.adhesion)
      add(damping, result.damping(&DampingPoint::damping_constant_without_slip, model.id));
  }
  add_references(result, panels);
  if (!result.configuration.adhesion) add_answer(result, damping);
  return panels;
}

/// Whether a panel has a finite value to show; false if no model computes its quantity.
bool shows_anything(const Panel* panel) {
  return std::ranges::any_of(panel->curves, [&](const Curve& curve) {
    return std::ranges::any_of(curve.y, [&](double value) {
      return std::isfinite(value) && (value > 0 || !panel->y.logarithmic);
    });
  });
}

/// Gives all panels the same limits, which contain all their curves and bands, so that they can be
/// compared.
void share_limits(const std::vector<Panel*>& panels) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Panel* panel : panels)
    for (const Curve& curve : panel->curves)
      for (const auto* values : {&curve.y, &curve.low, &curve.high})
        for (const double value : *values)
          if (std::isfinite(value) && (value > 0 || !panel->y.logarithmic) &&
              (values != &curve.low || curve.style != Style::points)) {
            low = std::min(low, value);
            high = std::max(high, value);
          }
  if (!(low < high)) return;
  const bool logarithmic = panels.front()->y.logarithmic;
  const double margin = 0.04 * (logarithmic ? std::log(high / low) : high - low);
  for (Panel* panel : panels) {
    panel->y.low = logarithmic ? low * std::exp(-margin) : low - margin;
    panel->y.high = logarithmic ? high * std::exp(margin) : high + margin;
  }
}

}  // namespace

Figure figure_of(const std::vector<StudyResult>& results, const ParameterLists& varied) {
  Figure figure;
  figure.columns = results.size() == 1 ? 2 : int(results.size());
  std::vector<std::array<Panel, 4>> points;
  for (const StudyResult& result : results) points.push_back(panels_of(result));
  for (std::size_t quantity = 0; quantity < 4; ++quantity) {
    std::vector<Panel*> row;
    for (auto& point : points) row.push_back(&point[quantity]);
    if (!std::ranges::all_of(row, shows_anything)) continue;
    if (row.size() > 1) share_limits(row);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Panel& panel = points[i][quantity];
      // Only panels in the first column have a legend.
      if (i > 0)
        for (Curve& curve : panel.curves) curve.name.clear();
      if (quantity == 0 && points.size() > 1)
        panel.title = describe_point(varied, results[i].configuration);
      figure.panels.push_back(std::move(panel));
    }
  }
  return figure;
}

}  // namespace salebra::figures
