// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of `salebra sliding`: friction over velocity and amplitude, regimes, the motion of a
// slider.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/analysis/sliding.hpp>
#include <salebra/figures/figures.hpp>

#include "axes.hpp"

namespace salebra::figures {

Figure figure_of(const std::vector<SlidingPoint>& points, double friction) {
  Curve mean{.name = "computed", .quantity = "friction_coefficient"},
      slow{.name = "µ_0 + Γv/F, at most µ"};
  slow.style = Style::dashed;
  if (points.size() <= 30) mean.style = Style::line_and_points;
  Curve total{.name = "total", .quantity = "work_per_cycle"},
      opening{.name = "relaxation", .quantity = "relaxation_work"},
      slip{.name = "slip", .quantity = "slip_work"};
  total.style = opening.style = mean.style;
  slip.style = Style::dashed;
  slip.color = 6;
  for (const SlidingPoint& point : points) {
    const double velocity = point.velocity;
    const SteadySliding& state = point.state;
    for (Curve* curve : {&mean, &total, &opening, &slip}) curve->x.push_back(velocity);
    mean.y.push_back(state.friction_coefficient);
    // Only a surface has errors.
    if (const double error = point.errors.friction_coefficient_error; !std::isnan(error)) {
      mean.low.push_back(state.friction_coefficient - error);
      mean.high.push_back(state.friction_coefficient + error);
    }
    total.y.push_back(state.relaxation_work + state.slip_work);
    opening.y.push_back(state.relaxation_work);
    slip.y.push_back(state.slip_work);
  }
  if (mean.low.size() != mean.x.size()) mean.low = mean.high = {};
  const Axis x = axis_of("velocity", grows_by_factors(mean.x));
  // The limit is known between the computed velocities too.
  constexpr int pieces = 200;
  const SlidingPoint& first = points.front();
  const auto [lowest, highest] = std::ranges::minmax(mean.x);
  for (int k = 0; k <= pieces; ++k) {
    const double part = double(k) / pieces;
    slow.x.push_back(x.logarithmic ? lowest * std::pow(highest / lowest, part)
                                   : lowest + part * (highest - lowest));
    slow.y.push_back(std::min(
        friction, first.state.static_friction_coefficient +
                      first.state.low_speed_damping * slow.x.back() / first.state.mean_force));
  }
  Figure figure{
      .kind = "sliding",
      .caption =
          "Steady sliding under a normal oscillation; above the critical velocity v_c nothing "
          "sticks.",
      .columns = 2};
  figure.panels.push_back(
      {.title =
           "static friction µ_0 = " + error_text(first.state.static_friction_coefficient,
                                                 first.errors.static_friction_coefficient_error,
                                                 Dimension::dimensionless),
       .caption = "Mean tangential over mean normal force, with its limit for slow sliding, µ_0 + "
                  "Γv/F (static friction µ_0, damping constant Γ).",
       .x = x,
       .y = axis_of("friction_coefficient", false, "coefficient of friction F_x/F"),
       .legend = Legend::top_left});
  figure.panels.back().curves = {mean, slow};
  figure.panels.push_back(
      {.title = "slow sliding: Γ = " +
                error_text(first.state.low_speed_damping, first.errors.low_speed_damping_error,
                           Dimension::damping) +
                "; without slip γ = " + value_text(first.state.relaxation_damping, "N s/m"),
       .caption = "Energy lost in a normal cycle; relaxation is the part of springs that open.",
       .x = x,
       .y = axis_of("work_per_cycle", spans_decades(total.y), "loss W in a normal cycle"),
       .legend = Legend::top_left});
  figure.panels.back().curves = {total, opening, slip};
  const double critical = first.state.critical_velocity;
  if (critical > lowest && critical < highest)
    figure.panels.front().lines = {{.at = critical,
                                    .vertical = true,
                                    .name = "v_c = " + value_text(critical, "m/s"),
                                    .quantity = "critical_velocity"}};
  return figure;
}

Figure figure_of(const std::vector<SlidingPoint>& points, const SlidingProblem& problem) {
  const bool relative = !problem.velocity_ratios.empty();
  const std::vector<double>& along = relative ? problem.velocity_ratios : problem.velocities;
  const std::vector<double>& amplitudes = problem.normal_amplitude;
  Figure figure{.kind = "sliding_map",
                .caption =
                    "Steady sliding under a normal oscillation. (a) Mean tangential over mean "
                    "normal force. (b) Its growth with the velocity; white where it does not grow.",
                .columns = 2};
  const auto panel = [&](const char* title, Axis scale, double SteadySliding::*member) {
    Image image{.x = along, .y = amplitudes, .scale = std::move(scale)};
    image.values = Field(Index(along.size()), Index(amplitudes.size()));
    for (std::size_t i = 0; i < along.size(); ++i)
      for (std::size_t j = 0; j < amplitudes.size(); ++j) {
        const double value = points[j * along.size() + i].state.*member;
        image.values(Index(i), Index(j)) =
            image.scale.logarithmic && !(value > 0) ? ContactParameters::unknown : value;
      }
    figure.panels.push_back(
        {.title = title,
         .x = axis_of(relative ? "velocity_ratio" : "velocity", grows_by_factors(along)),
         .y = axis_of("normal_amplitude", grows_by_factors(amplitudes)),
         .image = std::move(image)});
  };
  panel("Friction of steady sliding", axis_of("friction_coefficient", false, "F_x/F"),
        &SteadySliding::friction_coefficient);
  panel("Growth of friction with velocity",
        {.label = "dF_x/dv", .unit = "N s/m", .logarithmic = true},
        &SteadySliding::sliding_damping);
  return figure;
}

Figure figure_of(const RegimeMap& map, double omega) {
  Figure figure{
      .kind = "regimes",
      .caption =
          "Loss W of an oscillation to and fro over the excursion X at the velocity v, "
          "over its loss without slip, with the borders of the regimes: no slip below "
          "the black line, partial slip between the lines, sliding above the red line. White: "
          "the excursion is shorter than the way in one normal cycle."};
  Panel& panel = figure.panels.emplace_back();
  panel.title = "loss of a slow oscillation over that without slip";
  const auto axis = [](const char* label, const char* unit, const std::vector<double>& values) {
    const auto [low, high] = std::ranges::minmax(values);
    return Axis{.label = label,
                .unit = unit,
                .logarithmic = spans_decades(values),
                .low = low,
                .high = high};
  };
  panel.x = axis("sliding velocity v", "m/s", map.velocity);
  panel.y = axis("excursion X", "m", map.excursion);
  panel.image = Image{.x = map.velocity,
                      .y = map.excursion,
                      .values = map.loss_ratio,
                      .scale = {.quantity = "loss_ratio",
                                .label = "W / W(no slip)",
                                .logarithmic = true,
                                .low = 1,
                                .high = 1e3}};
  Curve no_slip{.name = "no slip below", .x = map.velocity, .color = 6};
  Curve sliding{.name = "sliding above", .x = map.velocity, .color = 1};
  Curve cycle{.name = "one normal cycle", .x = map.velocity, .color = 7};
  cycle.style = Style::dashed;
  for (std::size_t i = 0; i < map.velocity.size(); ++i) {
    cycle.y.push_back(2 * std::numbers::pi * map.velocity[i] / omega);
    no_slip.y.push_back(map.no_slip_excursion[i] > cycle.y.back() ? map.no_slip_excursion[i]
                                                                  : ContactParameters::unknown);
    sliding.y.push_back(std::max(map.sliding_excursion, cycle.y.back()));
  }
  Curve critical{.name = "critical velocity v_c", .style = Style::dotted, .color = 6};
  if (map.critical_velocity > *panel.x.low && map.critical_velocity < *panel.x.high) {
    critical.x.assign(2, map.critical_velocity);
    critical.y = {*panel.y.low, *panel.y.high};
  }
  for (Curve* curve : {&no_slip, &sliding, &cycle, &critical})
    if (std::ranges::any_of(curve->y, [](double y) { return std::isfinite(y); }))
      panel.curves.push_back(*curve);
  panel.legend = Legend::bottom_right;
  return figure;
}

Figure figure_of(const SliderMotion& full, const SliderMotion& averaged, double stiffness) {
  const auto curve = [](const SliderMotion& motion, const char* name) {
    Curve over_time{.name = name};
    for (const double time : motion.time) over_time.x.push_back(time - motion.time.front());
    return over_time;
  };
  Curve velocity = curve(full, "full equation"), force = velocity;
  Curve averaged_velocity = curve(averaged, "averaged equation");
  averaged_velocity.style = Style::dashed;
  Curve averaged_force = averaged_velocity;
  velocity.y = full.slider_velocity, averaged_velocity.y = averaged.slider_velocity;
  for (const double offset : full.slider_offset) force.y.push_back(-stiffness * offset);
  for (const double offset : averaged.slider_offset)
    averaged_force.y.push_back(-stiffness * offset);
  Figure figure{.kind = "slider",
                .caption =
                    "Motion of a slider on a contact that oscillates, by the full equation and "
                    "by the averaged one. (a) Its velocity. (b) The force of its spring.",
                .columns = 2};
  figure.panels.push_back({.title = "Velocity of the slider",
                           .x = axis_of("time", false, "time t"),
                           .y = {.label = "velocity of the slider", .unit = "m/s"},
                           .legend = Legend::top_left});
  figure.panels.back().curves = {velocity, averaged_velocity};
  figure.panels.push_back({.title = "Force of the spring",
                           .x = axis_of("time", false, "time t"),
                           .y = {.label = "spring force k(Vt − x)", .unit = "N"},
                           .legend = Legend::top_left});
  figure.panels.back().curves = {force, averaged_force};
  return figure;
}

}  // namespace salebra::figures
