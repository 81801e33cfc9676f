// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of `compare`: curves of all models with 95 % bands.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <salebra/figures/figures.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/study_solution.hpp>
#include <tuple>

#include "axes.hpp"

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
  Curve points{
      .quantity = "damping_constant", .x = result.pressures, .style = Style::points, .color = 0};
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
  // The headline of the table: γ at the highest pressure at which it is known.
  for (std::size_t k = answer.damping_constant.size(); k-- > 0;) {
    const StatedMean& one = answer.damping_constant[k];
    if (!std::isfinite(one.mean)) continue;
    const std::string at = " at " + format_quantity(result.pressures[k], Dimension::pressure, 3);
    damping.title = "γ = " +
                    (sample ? interval_text(one.mean, one.low, one.high, Dimension::damping)
                            : error_text(one.mean, one.error, Dimension::damping)) +
                    at;
    break;
  }
}

using Panels = std::array<Panel, 6>;

/// Adds the window of the fit, the limits of theories for vanishing load, and the exponential law
/// with the fitted decay length l.
void add_references(const StudyResult& result, Panels& panels) {
  auto& [gaps, areas, stiffness, damping, ratios, lengths] = panels;
  if (!result.configuration.window)
    gaps.ranges = {{.low = 1, .high = 2.5, .name = "window of the fit"}};
  const StudyTheories theories = result.theories();
  areas.lines = {{.at = theories.bgt_area_slope, .name = "Bush, Gibson, Thomas"}};
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
  // A body that is not a half-space has no ratio of moduli.
  const double modulus_ratio = result.configuration.pressed().modulus_ratio();
  if (!ratios.curves.empty() && std::isfinite(modulus_ratio))
    ratios.lines = {{.at = modulus_ratio,
                     .name = "G^{*}/E^{*}",
                     .quantity = "modulus_ratio"}};
  const EnsembleMean length = result.decay_length();
  if (std::isfinite(length.mean)) {
    gaps.title = "decay length l = " +
                 interval_text(length.mean, length.low, length.high, Dimension::length);
    lengths.lines = {{.at = length.mean, .name = "l of the fit", .quantity = "decay_length"}};
  }
  for (const Realisation& one : result.realisations) {
    const LocalDecayLength& local = one.of(ContactModel::bem).local;
    lengths.curves.push_back(
        {.name = lengths.curves.empty() ? "between loads, of each surface" : "",
         .x = local.mean_gap,
         .y = local.decay_length,
         .style = Style::line_and_points,
         .color = 0});
  }
  if (result.configuration.adhesion) return;
  const bool drag = std::holds_alternative<Drag>(result.configuration.motion);
  Curve law = band(drag ? "Eq. (16), fitted l" : "Eq. (12), fitted l", result.pressures,
                   result.damping(&DampingPoint::damping_constant_closed_form));
  law.low = law.high = {};
  law.quantity = "damping_constant_closed_form";
  law.style = Style::dashed;
  law.color = 7;
  damping.curves.push_back(std::move(law));
}

/// Panels of one point of the parameter grid: gap, area, stiffness and damping over the pressure,
/// with bands of 95 %; tangential over normal stiffness, and local decay lengths over the gap.
Panels panels_of(const StudyResult& result) {
  Panels panels;
  auto& [gaps, areas, stiffness, damping, ratios, lengths] = panels;
  for (Panel& panel : panels) {
    panel.x = axis_of("pressure", true, "nominal pressure p");
    panel.second_x = SecondAxis{.label = "p/(E^{*}h')", .factor = 1 / result.contact_scale};
  }
  damping.second_x =
      SecondAxis{.label = "normal force F", .unit = "N", .factor = result.grid.area()};
  lengths.x = axis_of("mean_gap", false, "mean gap ū");
  lengths.second_x = {};
  gaps.y = {.quantity = "mean_gap_over_rms_height", .label = "mean gap ū/h_{rms}"};
  areas.y = {.label = "area over load, A E^{*}h'/F"};
  stiffness.y = {.label = "stiffness K h_{rms}/F"};
  damping.y = axis_of("damping_constant", true, "damping constant γ");
  ratios.y = {.label = "stiffness ratio K_t/K", .low = 0};
  lengths.y = axis_of("local_decay_length", false, "local decay length −dū/d ln p");
  lengths.y.low = 0;
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
    add(ratios, scaled([](const Realisation&, const ForceSample& sample) {
          return sample.tangential_stiffness / sample.normal_stiffness;
        }));
    ratios.curves.back().name = model.title;
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
  const bool logarithmic = panels.front()->y.logarithmic;
  const std::optional<double> fixed = panels.front()->y.low;
  if (fixed) low = std::min(low, *fixed);
  if (!(low < high)) return;
  const double margin = 0.04 * (logarithmic ? std::log(high / low) : high - low);
  for (Panel* panel : panels) {
    panel->y.low = fixed ? low : logarithmic ? low * std::exp(-margin) : low - margin;
    panel->y.high = logarithmic ? high * std::exp(margin) : high + margin;
  }
}

}  // namespace

Figure figure_of(const std::vector<StudyResult>& results, const ParameterLists& varied) {
  Figure figure{.kind = "study",
                .caption =
                    "Gap, area, stiffness and damping of all models over the pressure, with "
                    "95 % bands, and the damping constants of the motion as described."};
  figure.columns = results.size() == 1 ? 2 : int(results.size());
  std::vector<Panels> points;
  for (const StudyResult& result : results) points.push_back(panels_of(result));
  for (std::size_t quantity = 0; quantity < std::tuple_size_v<Panels>; ++quantity) {
    std::vector<Panel*> row;
    for (auto& point : points) row.push_back(&point[quantity]);
    if (!std::ranges::all_of(row, shows_anything)) continue;
    if (row.size() > 1) share_limits(row);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Panel& panel = points[i][quantity];
      // Only panels in the first column have a legend.
      if (i > 0) {
        for (Curve& curve : panel.curves) curve.name.clear();
        for (ReferenceLine& line : panel.lines) line.name.clear();
        for (ShadedRange& range : panel.ranges) range.name.clear();
      }
      if (quantity == 0 && points.size() > 1)
        panel.title = describe_point(varied, results[i].configuration) +
                      (panel.title.empty() ? "" : ", " + panel.title);
      figure.panels.push_back(std::move(panel));
    }
  }
  return figure;
}

Figure figure_of(const StudyResult& result) {
  return figure_of(std::vector<StudyResult>{result}, ParameterLists{});
}

Figure figure_of(const StudySolution& solution) {
  const auto curve = [&](const char* name, const char* quantity,
                         const std::vector<StatedMean>& means) {
    Curve out{.name = name, .quantity = quantity, .x = solution.pressures};
    const bool sample =
        std::ranges::any_of(means, [](const StatedMean& one) { return std::isfinite(one.low); });
    for (const StatedMean& one : means) {
      out.y.push_back(one.mean);
      out.low.push_back(sample ? one.low : one.mean - one.error);
      out.high.push_back(sample ? one.high : one.mean + one.error);
    }
    out.style = Style::points;
    return out;
  };
  Panel panel{.x = axis_of("pressure", true, "nominal pressure p"),
              .y = axis_of("damping_constant", true, "damping constant γ"),
              .legend = Legend::top_left};
  panel.curves.push_back(curve(solution.slips() ? "with slip" : "without slip", "damping_constant",
                               solution.damping_constant));
  if (solution.slips())
    panel.curves.push_back(curve("without slip", "damping_constant_without_slip",
                                 solution.damping_constant_without_slip));
  return {.kind = "study_solution", .panels = {panel}};
}

}  // namespace salebra::figures
