// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of a force curve with its fitted law, and of the pressure and gap of one contact.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/analysis/contact.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/lay.hpp>
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

/// The gap of the fitted law at a pressure.
double gap_of(const ExponentialFit& fit, double pressure) {
  return fit.decay_length * std::log(fit.reference_pressure / pressure);
}

/// The window of the fit as a range of the gaps of its samples; by the law if the curve has no sample
/// in it.
ShadedRange window_of(const ForceCurve& curve, const ExponentialFit& fit) {
  std::vector<double> gaps;
  for (const ForceSample& sample : curve.samples)
    if (sample.converged && fit.window.contains(sample.pressure, PressureWindow::round_off))
      gaps.push_back(sample.mean_gap);
  if (gaps.size() < 2)
    gaps = {gap_of(fit, fit.window.pressure_max), gap_of(fit, fit.window.pressure_min)};
  const auto [low, high] = std::ranges::minmax(gaps);
  return {.low = low, .high = high, .vertical = true};
}

std::string decay_length_text(const ExponentialFit& fit) {
  return "decay length l = " + interval_text(fit.decay_length, fit.decay_length_low,
                                             fit.decay_length_high, Dimension::length);
}

/// What the test of the law says if the law is poor, as the program does; a curve with too few points
/// in the window says nothing.
std::string verdict_of(const ForceCurve& curve, const ExponentialFit& fit) {
  if (fit.window.points < 4) return "";
  try {
    const ExponentialTest test = test_exponential(curve, fit.window);
    return poor_law(
        describe_law(fit.decay_length, test.decay_length_at_min_gap, test.decay_length_at_max_gap));
  } catch (const InvalidInput&) {
    return "";  // a fit to another curve
  }
}

void add_fit(Panel& panel, const ForceCurve& curve, const ExponentialFit& fit) {
  panel.title = decay_length_text(fit) + verdict_of(curve, fit);
  const ShadedRange window = window_of(curve, fit);
  const auto pressure = [&](double gap) {
    return fit.reference_pressure * std::exp(-gap / fit.decay_length);
  };
  panel.curves.push_back({.name = "p_0 e^{−ū/l}",
                          .quantity = "pressure",
                          .x = {window.low, window.high},
                          .y = {pressure(window.low), pressure(window.high)},
                          .style = Style::dashed});
  panel.ranges.push_back(window);
  panel.ranges.back().name = "window of the fit";
}

/// −dū/d ln p between neighbouring loads, and l of the fit: equal for an exponential law.
Panel local_panel(const LocalDecayLength& local, const std::optional<ExponentialFit>& fit) {
  Panel panel{.caption = "Local decay length between neighbouring loads.",
              .x = axis_of("mean_gap", false, "mean gap ū"),
              .y = axis_of("local_decay_length", false, "decay length −dū/d ln p")};
  panel.curves.push_back(
      {.x = local.mean_gap, .y = local.decay_length, .style = Style::line_and_points});
  if (fit) {
    panel.y.prefix_of = fit->decay_length;
    panel.lines.push_back(
        {.at = fit->decay_length, .name = "l of the fit", .quantity = "decay_length"});
  }
  return panel;
}

/// How far the pressures are from the fitted law.
Panel deviation_panel(const ForceCurve& curve, const ExponentialFit& fit) {
  Curve points{.style = Style::line_and_points};
  const auto& [low, high] = std::pair(fit.window.pressure_min, fit.window.pressure_max);
  for (const ForceSample& sample : curve.samples) {
    // Far from the window the deviation would use up the axis.
    if (!sample.converged || !(sample.pressure >= low / 2) || !(sample.pressure <= 2 * high))
      continue;
    points.x.push_back(sample.mean_gap);
    points.y.push_back(100 * (sample.pressure / (fit.reference_pressure *
                                                 std::exp(-sample.mean_gap / fit.decay_length)) -
                              1));
  }
  return {.caption =
              "Deviation of the pressure from the law, up to twice and from half the pressures "
              "of the window.",
          .x = axis_of("mean_gap", false, "mean gap ū"),
          .y = {.label = "deviation from the fit (%)"},
          .curves = {points},
          .lines = {{.at = 0, .name = "the fit"}},
          .ranges = {window_of(curve, fit)}};
}

}  // namespace

Figure figure_of(const ForceCurve& all, const std::optional<ExponentialFit>& given) {
  const std::vector<ForceCurve> curves = by_direction(all);
  const ForceCurve& curve = curves.front();
  const std::optional<ExponentialFit> fit =
      given && std::isfinite(given->decay_length) ? given : std::nullopt;
  Figure figure{
      .kind = "curve",
      .caption = fit ? "A force curve and the exponential law fitted in the shaded window."
                     : "A force curve."};
  const Axis pressure = axis_of("pressure", true, "nominal pressure p");
  Curve gaps = points_of(curve, curve.model.empty() ? "curve" : title_of(curve.model),
                         &ForceSample::mean_gap, &ForceSample::pressure);
  // A measured curve may have no gap but an indentation.
  const bool indented = gaps.x.empty();
  if (indented) gaps = points_of(curve, gaps.name, &ForceSample::indentation, &ForceSample::force);
  require(!gaps.x.empty(), "curve", curve.samples.size(),
          "samples, none of which converged with a mean gap and a pressure, or with an indentation "
          "and a force: there is nothing to draw");
  Panel& law = figure.panels.emplace_back();
  law.caption = indented ? "Force over indentation." : "Pressure over mean gap.";
  law.x = indented ? axis_of("indentation", false, "indentation δ")
                   : axis_of("mean_gap", false, "mean gap ū");
  law.y = indented ? axis_of("force", true, "normal force F") : pressure;
  // A logarithmic axis cannot show tension.
  law.y.logarithmic = std::ranges::none_of(gaps.y, [](double value) { return value < 0; });
  law.curves.push_back(std::move(gaps));
  if (fit) {
    add_fit(law, curve, *fit);
    figure.panels.push_back(local_panel(local_decay_length(curve), fit));
    figure.panels.back().ranges.push_back(window_of(curve, *fit));
    figure.panels.push_back(deviation_panel(curve, *fit));
    set_limits({&figure.panels[0], &figure.panels[1], &figure.panels[2]}, &Panel::x);
  }

  Curve areas = points_of(curve, "", &ForceSample::pressure, &ForceSample::contact_area_fraction);
  if (!areas.x.empty()) {
    figure.panels.push_back({.caption = "Contact area.",
                             .x = pressure,
                             .y = axis_of("contact_area_fraction", true, "contact area A/A_0"),
                             .detail = fit.has_value()});
    figure.panels.back().curves.push_back(std::move(areas));
  }
  Panel stiffness{.caption = "Stiffness.",
                  .x = axis_of("force", true, "normal force F"),
                  .y = {.label = "stiffness", .unit = "N/m", .logarithmic = true},
                  .legend = Legend::top_left,
                  .detail = fit.has_value()};
  Panel ratio{.caption = "Tangential over normal stiffness.",
              .x = pressure,
              .y = {.label = "stiffness ratio K_t/K"},
              .detail = fit.has_value()};
  const auto add = [&](const ForceCurve& one, const std::string& name, const char* quantity,
                       double ForceSample::*member) {
    Curve points = points_of(one, name, &ForceSample::force, member);
    points.quantity = quantity;
    if (!points.x.empty()) stiffness.curves.push_back(std::move(points));
  };
  add(curve, "normal, K", "normal_stiffness", &ForceSample::normal_stiffness);
  for (const ForceCurve& one : curves) {
    const std::string way =
        std::isnan(one.direction()) ? "" : ", " + direction_in_words(one.direction());
    add(one, "tangential, K_t" + way, "tangential_stiffness", &ForceSample::tangential_stiffness);
    Curve quotient = points_of(one, way.substr(std::min<std::size_t>(2, way.size())),
                               &ForceSample::pressure, &ForceSample::tangential_stiffness);
    std::size_t k = 0;
    for (const ForceSample& sample : one.samples)
      if (sample.converged && std::isfinite(sample.pressure) &&
          std::isfinite(sample.tangential_stiffness))
        quotient.y[k++] /= sample.normal_stiffness;
    std::vector<double> known = quotient.y;
    std::erase_if(known, [](double y) { return !std::isfinite(y); });
    if (known.empty()) continue;
    // A ratio that is the same at all loads is that of the moduli and no result.
    const auto [least, most] = std::ranges::minmax(known);
    if (known.size() == 1 || most - least >= 1e-9 * most)
      ratio.curves.push_back(std::move(quotient));
    else if (!stiffness.curves.empty() &&
             stiffness.curves.back().quantity == "tangential_stiffness")
      stiffness.curves.back().name += " = (G^{*}/E^{*})K, assumed";
  }
  if (!stiffness.curves.empty()) figure.panels.push_back(std::move(stiffness));
  if (!ratio.curves.empty()) figure.panels.push_back(std::move(ratio));
  return figure;
}

Figure figure_of(const LocalDecayLength& local) {
  return {.kind = "local_decay_length", .panels = {local_panel(local, {})}};
}

Figure figure_of(const ForceCurve& loading, const ForceCurve& unloading) {
  Figure figure{.kind = "cycle_of_gaps",
                .caption = "Loading and unloading; negative pressures pull the bodies together."};
  for (const auto& [y, member] :
       {std::pair(axis_of("pressure", false, "nominal pressure p"), &ForceSample::pressure),
        {axis_of("contact_area_fraction", false, "contact area A/A_0"),
         &ForceSample::contact_area_fraction}})
    figure.panels.push_back(
        {.x = axis_of("indentation"),
         .y = y,
         .curves = {points_of(loading, "loading", &ForceSample::indentation, member),
                    points_of(unloading, "unloading", &ForceSample::indentation, member)},
         .legend = Legend::top_left});
  return figure;
}

Figure figure_of(const Grid2D& grid, const NormalContactState& state) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto touches = state.contact_pressure > 0;
  const Field pressure = touches.select(state.contact_pressure, nothing),
              open = touches.select(nothing, state.gap);
  const std::string share =
      fmt::format("contact area A/A_0 = {:.3g} % at {}", 100 * state.contact_area_fraction,
                  format_quantity(state.mean_pressure, Dimension::pressure, 3));
  const std::string gap = "mean gap " + format_quantity(state.mean_gap, Dimension::length, 3);
  return {.kind = "contact",
          .caption = "A contact at the nominal pressure " +
                     format_quantity(state.mean_pressure, Dimension::pressure, 3) +
                     ". (a) Pressure on the contact spots. (b) Gap beside them. Both are white "
                     "elsewhere.",
          .panels = {map_panel(grid, touches.any() ? pressure : state.contact_pressure, share,
                               axis_of("contact_pressure", false, "pressure")),
                     map_panel(grid, touches.all() ? state.gap : open, gap,
                               axis_of("gap", false, "gap"))},
          .columns = 2};
}

Figure figure_of(const ContactSpots& spots) {
  Curve curve{.style = Style::line_and_points};
  for (const ContactSpot& spot : spots.spots) {
    curve.x.push_back(spot.area);
    curve.y.push_back(static_cast<double>(curve.x.size()));
  }
  return {
      .kind = "contact_spots",
      .panels = {
          {.title = fmt::format("{} spots", spots.spots.size()),
           .x = {.quantity = "area", .label = "area of a spot", .unit = "m^2", .logarithmic = true},
           .y = {.label = "spots at least as large", .logarithmic = true},
           .curves = {curve}}}};
}

Figure figure_of(const SpotStatistics& spots) {
  Curve curve{.y = spots.spots_by_size, .style = Style::line_and_points};
  for (std::size_t k = 0; k < curve.y.size(); ++k) curve.x.push_back(std::pow(2.0, double(k)));
  return {.kind = "spot_statistics",
          .panels = {{.title = fmt::format("{:.4g} spots", spots.spot_count),
                      .x = {.label = "cells of a spot, at least", .logarithmic = true},
                      .y = {.quantity = "spots_by_size", .label = "spots"},
                      .curves = {curve}}}};
}

}  // namespace salebra::figures
