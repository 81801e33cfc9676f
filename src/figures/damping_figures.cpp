// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of the damping commands: contact, cycle, damping curve, stress, friction and damper maps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <salebra/analysis/contact.hpp>
#include <salebra/analysis/damping.hpp>
#include <salebra/base/units.hpp>
#include <salebra/damping/asperity_damping.hpp>
#include <salebra/damping/friction_map.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/damping/trajectory_damping.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/results/quantity.hpp>
#include <salebra/surface/lay.hpp>

#include "axes.hpp"

namespace salebra::figures {
namespace {

using std::numbers::pi;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double degrees = 180 / pi;

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

// The first point after sample `from` where the indentation of a path passes `level`, rising or
// falling. index: the sample after this point; x: displacement there.
struct Passage {
  std::size_t index = 0;
  double x = nothing;
  bool found = false;
};

Passage passage(const SampledMotion& path, double level, bool rising, std::size_t from) {
  for (std::size_t i = from + 1; i < path.time.size(); ++i) {
    const double before = path.indentation[i - 1] - level, now = path.indentation[i] - level;
    if (rising ? before < 0 && now >= 0 : before >= 0 && now < 0) {
      const double share = before / (before - now);
      return {i,
              path.displacement[i - 1] + share * (path.displacement[i] - path.displacement[i - 1]),
              true};
    }
  }
  return {};
}

Panel path_panel(const SampledMotion& path) {
  Panel panel;
  panel.title = "A point of the body and the spring it meets";
  panel.x = {.label = "x", .unit = "m"};
  panel.y = {.label = "height over the undeformed surface", .unit = "m"};
  const auto [low, high] = std::ranges::minmax(path.indentation);
  const double level = 0.5 * (low + high);
  Curve orbit{.name = "path of the point"};
  orbit.x = path.displacement;
  for (const double indentation : path.indentation) orbit.y.push_back(level - indentation);
  panel.curves.push_back(orbit);
  const Passage touch = passage(path, level, true, 0);
  const Passage leave = touch.found ? passage(path, level, false, touch.index) : Passage{};
  if (leave.found) {
    panel.curves.push_back({.name = "in contact: x_1 to x_2",
                            .x = {touch.x, leave.x},
                            .y = {0, 0},
                            .style = Style::line_and_points});
  }
  panel.lines.push_back({.at = 0, .name = "undeformed surface"});
  panel.legend = Legend::top_left;
  panel.y.low = -0.55 * (high - low);
  panel.y.high = 0.8 * (high - low);
  return panel;
}

/// The springs of an axisymmetric foundation, drawn as coils side by side.
Curve coils_of(const IndenterLaw& law, double indentation) {
  const double edge = law.contact_radius(indentation);
  Curve coils{.name = "springs", .color = 7};
  for (int i = -24; i <= 24; ++i) {
    const double x = 1.8 * edge * i / 25;
    const double depth = std::abs(x) <= edge ? law.profile().image(std::abs(x)) - indentation : 0.0;
    coils.x.insert(coils.x.end(), {x, x, nothing});
    coils.y.insert(coils.y.end(), {-1.5 * indentation, std::min(0.0, depth), nothing});
  }
  return coils;
}

Curve force_of(const IndenterLaw& law, double most) {
  Curve force{.x = {}, .y = {}};
  for (int i = 0; i <= 200; ++i) {
    force.x.push_back(most * i / 200);
    force.y.push_back(law.force(most * i / 200));
  }
  return force;
}

}  // namespace

Figure figure_of(const IndenterLaw& law, double indentation) {
  constexpr int points = 400;
  const double edge = law.contact_radius(indentation);
  const double reach = std::min(1.8 * edge, law.profile().max_radius());
  Curve body{.name = "indenter", .color = 6}, surface{.name = "surface", .color = 0};
  Curve image{.name = "image g(|x|) − δ", .color = 6},
      springs{.name = "ends of the springs", .color = 0};
  Curve pressure{.color = 1};
  for (int i = -points; i <= points; ++i) {
    const double r = 1.8 * edge * i / points, distance = std::abs(r);
    surface.x.push_back(r);
    surface.y.push_back(-law.surface_displacement(indentation, distance));
    const double depth = distance <= reach ? law.profile().image(distance) - indentation : nothing;
    springs.x.push_back(r);
    springs.y.push_back(distance <= edge ? std::min(0.0, depth) : 0);
    if (distance <= reach) {
      body.x.push_back(r);
      body.y.push_back(law.profile().height(distance) - indentation);
      image.x.push_back(r);
      image.y.push_back(depth);
    }
    // Avoids the edge itself, where the pressure may be infinite.
    if (distance < 1.2 * edge) {
      pressure.x.push_back(r);
      pressure.y.push_back(law.pressure(indentation, distance * (1 - 1e-9)));
    }
  }
  Figure figure{.kind = "indenter",
                .caption =
                    "(a) An axisymmetric indenter at rest, (b) its one-dimensional image on "
                    "independent springs, (c) the pressure and (d) the force.",
                .columns = 2};
  const Axis height = {.label = "height", .unit = "m"};
  figure.panels.push_back({.title = "contact with the half-space",
                           .x = {.label = "r", .unit = "m"},
                           .y = height,
                           .legend = Legend::bottom_right});
  figure.panels.back().curves = {surface, body};
  figure.panels.push_back(
      {.title = "one-dimensional image, Eq. (3)",
       .x = {.label = "x", .unit = "m"},
       .y = {.label = "height", .unit = "m", .low = -1.5 * indentation, .high = 1.8 * indentation},
       .legend = Legend::top_left});
  figure.panels.back().curves = {coils_of(law, indentation), springs, image};
  figure.panels.push_back({.title = "pressure",
                           .x = {.label = "r", .unit = "m"},
                           .y = {.label = "p", .unit = "Pa", .low = 0}});
  figure.panels.back().curves = {pressure};
  figure.panels.push_back(
      {.title = "force, F = " + format_quantity(law.force(indentation), Dimension::force, 3),
       .x = {.label = "indentation δ", .unit = "m"},
       .y = {.label = "F", .unit = "N"}});
  figure.panels.back().curves = {
      force_of(law, std::min(1.5 * indentation, law.highest_indentation())),
      {.x = {indentation}, .y = {law.force(indentation)}, .style = Style::points, .color = 1}};
  return figure;
}

Figure figure_of(const SampledMotion& path, const TrajectoryDamping& loss) {
  Figure figure{.kind = "motion",
                .caption =
                    "One period of the motion: (a) the path of a point of the body, (b) the "
                    "tangential force over the displacement, and (c) the energy lost.",
                .columns = 3};
  figure.panels.push_back(path_panel(path));
  figure.panels.push_back(
      {.title = loss.transverse_force.empty() ? "Loop: its area is the loss" : "Loop along x",
       .x = {.label = "x", .unit = "m"},
       .y = {.label = "tangential force F_x", .unit = "N"}});
  figure.panels.back().curves = {{.quantity = "tangential_force",
                                  .x = path.displacement,
                                  .y = loss.tangential_force,
                                  .color = 1}};
  Panel& work = figure.panels.emplace_back();
  work.title = "Energy lost in a period, W = " +
               error_text(loss.work_per_cycle, loss.work_per_cycle_error(), Dimension::energy);
  const double start = path.time.front();
  Curve lost{.quantity = "dissipated", .x = path.time, .y = loss.dissipated, .color = 2};
  for (double& time : lost.x) time = (time - start) / path.period();
  work.x = {.label = "t / period"};
  work.y = {.label = "energy lost since the start", .unit = "J"};
  work.curves.push_back(lost);
  return figure;
}

Figure figure_of(std::string_view quantity, const std::vector<double>& values,
                 const std::vector<DampingResult>& results) {
  const Axis x = axis_of(quantity, grows_by_factors(values));
  Figure figure{
      .kind = "damping",
      .caption = "Loss of a motion, and by the closed form for small amplitudes, Eq. (12) or (15).",
      .columns = 3,
      .one_legend = true};
  figure.panels = {{.title = "energy lost in a cycle",
                    .caption = "Energy lost in a cycle.",
                    .x = x,
                    .y = axis_of("work_per_cycle"),
                    .legend = Legend::top_left},
                   {.title = "Damping constant",
                    .caption = "Damping constant.",
                    .x = x,
                    .y = axis_of("damping_constant")},
                   {.title = "error of the closed form, without slip",
                    .caption = "Deviation of the closed form from the loss without slip.",
                    .x = x,
                    .y = {.label = "closed form over loss − 1 (%)"}}};
  const std::size_t directions = results.size() / values.size();
  // The headline of the table: the damping constant at its last value.
  if (const DampingResult& last = results.back();
      directions == 1 && std::isfinite(last.damping_constant)) {
    figure.panels[1].title =
        "γ = " +
        error_text(last.damping_constant, last.damping_constant_error(), Dimension::damping) +
        " at " + value_text(values.back(), x.unit);
    figure.panels[1].y.prefix_of = last.damping_constant;
    figure.panels[1].x.prefix_of = values.back();
  }
  const std::string form = "closed form";
  // Points show where the values are; a fine series is a line.
  const Style style = values.size() > 30 ? Style::line : Style::line_and_points;
  for (std::size_t d = 0; d < directions; ++d) {
    const DampingResult& first = results[d * values.size()];
    const std::string way = directions > 1 ? ", " + direction_in_words(first.direction) : "";
    // The loss of a contact that slips may be unknown where the loss without slip is known.
    const bool slips = std::ranges::any_of(results, [](const DampingResult& one) {
      return std::isfinite(one.slip_work) ||
             (std::isnan(one.work_per_cycle) && std::isfinite(one.work_per_cycle_without_slip));
    });
    const auto add = [&](Panel& panel, const std::string& name, const char* of, const auto& number,
                         const auto& error) {
      Curve curve{.name = name, .quantity = of, .x = values, .style = style};
      for (std::size_t k = d * values.size(); k < (d + 1) * values.size(); ++k) {
        curve.y.push_back(number(results[k]));
        curve.low.push_back(curve.y.back() - error(results[k]));
        curve.high.push_back(curve.y.back() + error(results[k]));
      }
      const auto known = [](double value) { return std::isfinite(value); };
      if (!std::ranges::any_of(curve.y, known)) return;
      if (!std::ranges::any_of(curve.low, known)) curve.low = curve.high = {};
      panel.curves.push_back(std::move(curve));
    };
    const auto none = [](const DampingResult&) { return ContactParameters::unknown; };
    add(
        figure.panels[0], (slips ? "with slip" : "without slip") + way, "work_per_cycle",
        [](const DampingResult& one) { return one.work_per_cycle; },
        [](const DampingResult& one) { return one.work_per_cycle_error(); });
    if (slips)
      add(
          figure.panels[0], "without slip" + way, "work_per_cycle_without_slip",
          [](const DampingResult& one) { return one.work_per_cycle_without_slip; },
          [](const DampingResult& one) { return one.error_without_slip.total(); });
    add(
        figure.panels[2], way.empty() ? "" : way.substr(2), "",
        [](const DampingResult& one) {
          return 100 * (one.small_amplitude_work / one.work_per_cycle_without_slip - 1);
        },
        none);
    add(
        figure.panels[1], (slips ? "with slip" : "without slip") + way, "damping_constant",
        [](const DampingResult& one) { return one.damping_constant; },
        [](const DampingResult& one) { return one.damping_constant_error(); });
    if (slips)
      add(
          figure.panels[1], "without slip" + way, "damping_constant_without_slip",
          [](const DampingResult& one) { return one.damping_constant_without_slip; },
          [](const DampingResult& one) { return one.damping_constant_without_slip_error(); });
    // The closed form is the same in all directions.
    if (d + 1 < directions) continue;
    add(
        figure.panels[0], form, "small_amplitude_work",
        [](const DampingResult& one) { return one.small_amplitude_work; }, none);
    add(
        figure.panels[1], form, "",
        [](const DampingResult& one) { return one.small_amplitude_work * one.damping_per_work; },
        none);
    if (directions == 1) figure.panels[2].curves.back().color = slips ? 2 : 1;
    for (const std::size_t panel : {0u, 1u})
      if (!figure.panels[panel].curves.empty())
        figure.panels[panel].curves.back().style = Style::dashed;
  }
  std::erase_if(figure.panels, [](const Panel& panel) { return panel.curves.empty(); });
  if (std::ranges::any_of(figure.panels.front().curves,
                          [](const Curve& curve) { return !curve.low.empty(); }))
    figure.caption += " Bands are numerical errors.";
  for (Panel& panel : figure.panels) {
    std::vector<double> all;
    for (const Curve& curve : panel.curves)
      std::ranges::copy_if(curve.y, std::back_inserter(all),
                           [](double value) { return std::isfinite(value); });
    panel.y.logarithmic = spans_decades(all);
  }
  return figure;
}

double colour_limit(const Field& shear) {
  std::vector<double> sizes;
  for (Index i = 0; i < shear.rows(); ++i)
    for (Index j = 0; j < shear.cols(); ++j)
      if (shear(i, j) != 0) sizes.push_back(std::abs(shear(i, j)));
  std::ranges::sort(sizes);
  return sizes.empty()
             ? 1
             : sizes[static_cast<std::size_t>(0.98 * static_cast<double>(sizes.size() - 1))];
}

namespace {

/// The shear stress over the radius at one phase.
Panel section_of(const OscillatingStress& stress, double angle, double most, double limit,
                 const char* title) {
  const double least = stress.min_contact_radius();
  Panel panel{.title = title,
              .x = {.label = "r", .unit = "m", .low = 0, .high = 1.05 * most},
              .y = {.label = "τ", .unit = "Pa", .low = -3 * limit, .high = 3 * limit}};
  Curve curve{.color = 1};
  const double here = stress.contact_radius(angle);
  // Points are dense on both sides of the smallest contact radius, where the stress has a
  // logarithmic singularity, and towards the edge.
  for (const auto& [from, to] : {std::pair{0.0, least}, {least, here}}) {
    for (int i = 0; i <= 300 && to > from; ++i) {
      const double r = from + (to - from) * 0.5 * (1 - std::cos(pi * (0.003 + 0.994 * i / 300)));
      curve.x.push_back(r);
      curve.y.push_back(stress.shear(angle, r));
    }
  }
  curve.x.push_back(here);
  curve.y.push_back(0);
  curve.x.push_back(1.05 * most);
  curve.y.push_back(0);
  panel.curves.push_back(curve);
  panel.lines = {{.at = least, .vertical = true, .name = "smallest contact radius"},
                 {.at = most, .vertical = true, .name = "largest contact radius"}};
  return panel;
}

}  // namespace

Figure figure_of(const IndenterLaw& law, double indentation, const Oscillation& motion,
                 const StressMap& map) {
  const OscillatingStress stress(law, indentation, motion);
  const double most = std::ranges::max(map.contact_radius);
  const std::vector<double> cycle = scaled(map.angle, 1 / (2 * pi));
  const Axis radius = {.label = "r", .unit = "m"};
  const Axis time = {.label = "ωt / 2π"};
  const double limit = colour_limit(map.shear);
  Curve edge{.x = map.contact_radius, .y = cycle, .color = 6};
  const auto in_contact = [&](const Field& field) {
    Field image = field.transpose();
    for (Index i = 0; i < image.rows(); ++i)
      for (Index j = 0; j < image.cols(); ++j)
        if (map.radial_position[static_cast<std::size_t>(i)] >=
            map.contact_radius[static_cast<std::size_t>(j)])
          image(i, j) = nothing;
    return image;
  };

  Figure figure{
      .kind = "stress_map",
      .caption =
          "Tangential stress τ (a) and pressure p (c) over the radius and the phase of the "
          "normal motion, white outside the contact, whose edge is the black line; τ "
          "over the radius while the indenter is pulled out (b) and pressed in (d). "
          "Both singularities go beyond the scale. Motion: " +
          std::visit([](const auto& one) { return motion_text(one); }, motion) +
          ", δ = " + format_quantity(indentation, Dimension::length, 4) + ".",
      .columns = 2};
  Panel& shear = figure.panels.emplace_back();
  shear.title = "tangential stress τ";
  shear.x = radius;
  shear.y = time;
  shear.image = Image{.x = map.radial_position,
                      .y = cycle,
                      .values = in_contact(map.shear),
                      .scale = {.label = "τ", .unit = "Pa", .low = -limit, .high = limit},
                      .palette = Palette::diverging};
  shear.curves.push_back(edge);

  figure.panels.push_back(
      section_of(stress, pi / 3, most, limit, "τ(r) while pulling out, ωt/2π = 1/6"));
  Panel& pressure = figure.panels.emplace_back();
  pressure.title = "pressure p";
  pressure.x = radius;
  pressure.y = time;
  pressure.image = Image{.x = map.radial_position,
                         .y = cycle,
                         .values = in_contact(map.contact_pressure),
                         .scale = {.label = "p", .unit = "Pa"}};
  pressure.curves.push_back(edge);
  figure.panels.push_back(
      section_of(stress, -pi / 3, most, limit, "τ(r) while pressing in, ωt/2π = −1/6"));
  figure.panels[0].lines = {{.at = 1.0 / 6, .name = "(b)"}, {.at = -1.0 / 6, .name = "(d)"}};
  return figure;
}

Figure figure_of(const FrictionMap& map) {
  const Axis number = {
      .quantity = "friction_number", .label = "M = μE* u_z / (G* u_x)", .logarithmic = true};
  Panel panel, missing, parts;
  panel.title = "W(μ) / W(∞)";
  panel.x = number;
  panel.y = {.label = "phase φ_0 (°)"};
  panel.image =
      Image{.x = map.friction_number,
            .y = scaled(map.phase, degrees),
            .values = map.loss_ratio,
            .scale = {.quantity = "loss_ratio", .label = "W(μ) / W(∞)", .low = 0, .high = 1.5},
            .contours = {0.5, 0.9, 0.95, 0.99}};

  missing.title = "how far the result for μ = ∞ is off";
  missing.x = number;
  missing.y = {.label = "|1 − W(μ) / W(∞)|", .logarithmic = true, .low = 1e-4, .high = 2};
  missing.legend = Legend::top_right;
  parts.x = number;
  parts.y = {.label = "share of W(∞)"};
  parts.legend = Legend::bottom_right;
  const auto nearest = [&](double angle) {
    const auto distance = [&](double phase) { return std::abs(phase - angle); };
    return static_cast<Index>(std::ranges::min_element(map.phase, {}, distance) -
                              map.phase.begin());
  };
  std::vector<Index> columns;
  for (const double angle : {30.0, 45.0, 60.0, 90.0}) {
    const Index j = nearest(angle / degrees);
    if (std::ranges::find(columns, j) == columns.end()) columns.push_back(j);
  }
  for (const Index j : columns) {
    Curve curve{
        .name = fmt::format("φ_0 = {:.0f}°", map.phase[static_cast<std::size_t>(j)] * degrees),
        .x = map.friction_number};
    for (Index i = 0; i < map.loss_ratio.rows(); ++i)
      curve.y.push_back(std::abs(1 - map.loss_ratio(i, j)));
    missing.curves.push_back(curve);
  }
  const Index j = columns.back();
  parts.title = fmt::format("parts of the loss at φ_0 = {:.0f}°",
                            map.phase[static_cast<std::size_t>(j)] * degrees);
  Curve relaxation{.name = "springs that open", .x = map.friction_number};
  Curve slip{.name = "slip in permanent contact", .x = map.friction_number};
  Curve sum{.name = "sum", .x = map.friction_number, .style = Style::dashed, .color = 6};
  for (Index i = 0; i < map.loss_ratio.rows(); ++i) {
    relaxation.y.push_back(map.relaxation_ratio(i, j));
    slip.y.push_back(map.slip_ratio(i, j));
    sum.y.push_back(map.loss_ratio(i, j));
  }
  parts.curves = {relaxation, slip, sum};
  return {.kind = "friction_map",
          .caption =
              "(a) Loss with friction W(μ) over the loss without slip W(∞), over the friction "
              "number M and the phase φ_0, with lines of equal ratio; (b) its deviation from 1 at "
              "single phases; (c) its parts at one phase: springs that open, and slip where the "
              "contact never opens.",
          .panels = {panel, missing, parts},
          .columns = 3};
}

namespace {

Panel damper_panel(const DamperMap& map, std::optional<double> falling_slope) {
  Panel panel;
  panel.title = "Damping constant γ";
  const Index amplitudes = map.damping_constant.rows(), frequencies = map.damping_constant.cols();
  const Axis amplitude = {.label = "normal amplitude u_z",
                          .unit = "m",
                          .logarithmic = spans_decades(map.normal_amplitude)};
  const std::vector<double> hertz = scaled(map.angular_frequency, 1 / (2 * pi));
  const Axis frequency = {
      .label = "frequency ω / 2π", .unit = "Hz", .logarithmic = spans_decades(hertz)};
  if (amplitudes > 1 && frequencies > 1) {
    panel.x = frequency;
    panel.y = amplitude;
    panel.image = Image{.x = hertz,
                        .y = map.normal_amplitude,
                        .values = map.damping_constant.transpose(),
                        .scale = axis_of("damping_constant", true, "damping constant γ")};
    if (falling_slope) {
      panel.title =
          fmt::format("Steady sliding is stable where γ > b = {:.4g} N s/m", *falling_slope);
      panel.image->contours = {*falling_slope};
      panel.image->scale.prefix_of = 1;  // contours are labelled in N s/m
    }
    return panel;
  }
  panel.y = axis_of("damping_constant");
  const bool over_amplitude = amplitudes > 1;
  panel.x = over_amplitude ? amplitude : frequency;
  Curve curve{.x = over_amplitude ? map.normal_amplitude : hertz, .style = Style::line_and_points};
  for (Index i = 0; i < amplitudes; ++i)
    for (Index j = 0; j < frequencies; ++j) curve.y.push_back(map.damping_constant(i, j));
  panel.y.logarithmic = spans_decades(curve.y);
  panel.curves.push_back(curve);
  if (falling_slope) panel.lines.push_back({.at = *falling_slope, .name = "b, stable above"});
  return panel;
}

Panel decay_panel(const OscillatorDecay& decay) {
  Panel panel;
  panel.title = fmt::format("Free decay: damping ratio {:.3g}", decay.damping_ratio);
  const double ratio = decay.damping_ratio, omega = decay.natural_frequency;
  const double duration = std::min(4 * decay.decay_time, 60 * 2 * pi / omega);
  panel.x = {.label = "time", .unit = "s"};
  panel.y = {.label = "x / x_0"};
  Curve path{.name = "x"}, bound{.name = "exp(−t/decay time)", .style = Style::dashed};
  for (int i = 0; i <= 4000; ++i) {
    const double time = duration * i / 4000;
    path.x.push_back(time);
    // Displacement of an oscillator released at rest. For a damping ratio above 1 it is the sum of
    // two decaying exponentials, since cosh and sinh would overflow.
    const double fall = ratio * omega, split = omega * std::sqrt(std::abs(1 - ratio * ratio));
    if (split * duration < 1e-6)
      path.y.push_back(std::exp(-fall * time) * (1 + fall * time));
    else if (ratio < 1)
      path.y.push_back(std::exp(-fall * time) *
                       (std::cos(split * time) + fall / split * std::sin(split * time)));
    else
      path.y.push_back(0.5 * ((1 + fall / split) * std::exp((split - fall) * time) +
                              (1 - fall / split) * std::exp(-(split + fall) * time)));
    bound.x.push_back(time);
    bound.y.push_back(std::exp(-time / decay.decay_time));
  }
  panel.curves = {path};
  if (ratio < 1) panel.curves.push_back(bound);
  return panel;
}

/// The smallest amplitude that stabilises sliding, over the frequency.
Panel border_panel(const std::vector<double>& omega, const std::vector<double>& least) {
  Curve border{
      .x = scaled(omega, 1 / (2 * pi)), .y = least, .style = Style::line_and_points, .color = 1};
  Panel panel;
  panel.title = "Least amplitude that stabilises";
  panel.x = {.label = "frequency ω / 2π", .unit = "Hz", .logarithmic = spans_decades(border.x)};
  panel.y = {.label = "normal amplitude u_z", .unit = "m", .logarithmic = true};
  panel.curves.push_back(border);
  return panel;
}

}  // namespace

Figure figure_of(const DamperSolution& answer, std::optional<double> falling_slope,
                 const std::vector<double>& angular_frequency) {
  Figure figure{
      .kind = "damper",
      .caption = "Damping constant of a slow tangential motion beside a normal oscillation."};
  if (answer.map.damping_constant.size() > 1)
    figure.panels.push_back(damper_panel(answer.map, falling_slope));
  if (answer.decay) figure.panels.push_back(decay_panel(*answer.decay));
  const std::vector<double>& least = answer.stabilising_amplitude;
  if (least.size() > 1 &&
      std::ranges::any_of(least, [](double value) { return std::isfinite(value); }))
    figure.panels.push_back(border_panel(angular_frequency, least));
  return figure;
}

Figure figure_of(const DamperMap& map) {
  return {.kind = "damper", .panels = {damper_panel(map, {})}};
}

Figure figure_of(const AsperityDamping& loss) {
  Curve curve;
  for (const double work : loss.work)
    if (work > 0) curve.y.push_back(work);
  std::ranges::sort(curve.y, std::greater{});
  for (std::size_t k = 1; k <= curve.y.size(); ++k) curve.x.push_back(double(k));
  return {
      .kind = "asperity_damping",
      .panels = {{.title = "loss W = " + format_quantity(loss.work_per_cycle, Dimension::energy, 4),
                  .x = {.label = "summit, the largest loss first", .logarithmic = true},
                  .y = axis_of("work_per_cycle", true, "loss in a cycle"),
                  .curves = {curve}}}};
}

}  // namespace salebra::figures
