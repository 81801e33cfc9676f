// SPDX-License-Identifier: GPL-3.0-or-later
// Figures of single results: one curve, or the maps of a surface of a study.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/contact/law/law.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/slider.hpp>
#include <salebra/damping/stress_map.hpp>
#include <salebra/figures/figures.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/study/realisation.hpp>
#include <salebra/surface/summits.hpp>
#include <utility>

#include "axes.hpp"
#include "results/describe.hpp"

namespace salebra::figures {
namespace {

/// A map of the values that a function gives for the number of a point.
template <class Value>
Panel picture_panel(const SurfacePicture& picture, const Axis& scale, const Value& value) {
  Field values(picture.nx, picture.ny);
  for (Index i = 0; i < picture.nx; ++i)
    for (Index j = 0; j < picture.ny; ++j)
      values(i, j) = value(static_cast<std::size_t>(i * picture.ny + j));
  return {.title = scale.label,
          .x = {.label = "x", .unit = "m"},
          .y = {.label = "y", .unit = "m"},
          .image = Image{.x = cells(picture.nx, picture.step_x),
                         .y = cells(picture.ny, picture.step_y),
                         .values = std::move(values),
                         .scale = scale},
          .equal_scales = true};
}

/// The Gaussian with the rms height of the distribution; its mean is 0, that of the heights.
Curve gaussian_of(const SurfacePicture& picture) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < picture.height.size(); ++i) {
    sum += picture.height_density[i];
    squares += picture.height_density[i] * picture.height[i] * picture.height[i];
  }
  const double rms = std::sqrt(squares / sum);
  Curve curve{.name = "Gaussian", .x = picture.height, .style = Style::dashed};
  for (const double height : picture.height)
    curve.y.push_back(std::exp(-height * height / (2 * rms * rms)) /
                      (rms * std::sqrt(2 * std::numbers::pi)));
  return curve;
}

}  // namespace

Figure curve_figure(std::string_view x, std::string_view y, Curve curve) {
  const auto spread = [](std::vector<double> values) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return !values.empty() && spans_decades(values);
  };
  Panel panel{.x = axis_of(x, spread(curve.x)), .y = axis_of(y, spread(curve.y))};
  panel.curves.push_back(std::move(curve));
  return {.kind = std::string(y), .panels = {std::move(panel)}};
}

Figure figure_of(const Profile& profile) {
  Figure figure =
      curve_figure("x", "heights",
                   {.x = positions(static_cast<Index>(profile.heights.size()), profile.dx()),
                    .y = profile.heights});
  figure.kind = "profile";
  figure.panels[0].x = {.label = "x", .unit = "m"};
  figure.panels[0].y = axis_of("heights", false, "height");
  return figure;
}

Figure figure_of(const SummitList& list) {
  constexpr int bins = 40;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Summit& summit : list.summits) {
    low = std::min(low, summit.height);
    high = std::max(high, summit.height);
  }
  const double width = high > low ? (high - low) / bins : 1;
  Curve curve{.style = Style::line_and_points};
  for (int k = 0; k < bins && !list.summits.empty(); ++k) {
    curve.x.push_back(low + (k + 0.5) * width);
    curve.y.push_back(0);
  }
  for (const Summit& summit : list.summits)
    ++curve.y[static_cast<std::size_t>(std::min(bins - 1, int((summit.height - low) / width)))];
  return {.kind = "summits",
          .panels = {{.x = {.quantity = "height", .label = "height of the summit", .unit = "m"},
                      .y = {.label = "summits"},
                      .curves = {std::move(curve)}}}};
}

Figure figure_of(const SurfacePicture& picture, const std::vector<double>& pressures) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  Figure figure{.kind = "surface_of_study",
                .caption =
                    "Heights of a surface, the pressure at which each point touches first, "
                    "contact pressure and gap at one load, spectrum and heights."};
  const auto map = [&](const Axis& scale, const auto& values, const auto& value) {
    if (!values.empty()) figure.panels.push_back(picture_panel(picture, scale, value));
  };
  const auto of_load = [&](Index load) {
    return load >= 0 && load < static_cast<Index>(pressures.size())
               ? pressures[static_cast<std::size_t>(load)]
               : nothing;
  };
  const double mapped = of_load(picture.mapped_load);
  const std::string at =
      std::isfinite(mapped) ? " at " + format_quantity(mapped, Dimension::pressure, 3) : "";
  map(axis_of("heights", false, "height"), picture.heights,
      [&](std::size_t k) { return double(picture.heights[k]); });
  if (!pressures.empty() &&
      std::ranges::any_of(picture.first_load, [](auto load) { return load >= 0; }))
    map(axis_of("pressure", true, "pressure of first touch"), picture.first_load,
        [&](std::size_t k) { return of_load(picture.first_load[k]); });
  map(axis_of("contact_pressure", false, "contact pressure" + at), picture.contact_pressure,
      [&](std::size_t k) {
        return picture.contact_pressure[k] > 0 ? double(picture.contact_pressure[k]) : nothing;
      });
  map(axis_of("gap", false, "gap" + at), picture.gap, [&](std::size_t k) {
    // In contact the gap is round-off.
    return k < picture.contact_pressure.size() && picture.contact_pressure[k] > 0
               ? nothing
               : double(picture.gap[k]);
  });

  Panel spectrum{
      .title = "Hurst exponent H = " + interval_text(picture.hurst, picture.hurst_low,
                                                     picture.hurst_high, Dimension::dimensionless),
      .x = axis_of("wavenumber", true, "wave number q"),
      .y = axis_of("psd", true, "power spectral density C(q)"),
      .legend = Legend::bottom_left};
  if (std::isnan(picture.hurst)) spectrum.title = "power spectral density";
  spectrum.curves = {{.name = "this surface",
                      .x = picture.wavenumber,
                      .y = picture.psd,
                      .style = Style::line_and_points}};
  // Beyond the shortest wave of a filtered surface the spectrum is round-off.
  if (!picture.psd.empty())
    for (double& density : spectrum.curves[0].y)
      if (density < 1e-13 * std::ranges::max(picture.psd)) density = nothing;
  if (!picture.law.empty())
    spectrum.curves.push_back({.name = "self-affine law",
                               .x = picture.wavenumber,
                               .y = picture.law_psd,
                               .style = Style::dashed});
  figure.panels.push_back(std::move(spectrum));
  if (!picture.height.empty())
    figure.panels.push_back(
        {.title = "distribution of heights",
         .x = axis_of("height", false, "height"),
         .y = axis_of("height_density", false, "density"),
         .curves = {{.name = "this surface", .x = picture.height, .y = picture.height_density},
                    gaussian_of(picture)}});
  return figure;
}

Figure figure_of(const ContactLaw& law, const std::vector<double>& indentation) {
  Curve curve{.x = indentation};
  for (const double depth : indentation) curve.y.push_back(law.force(depth));
  Figure figure = curve_figure("indentation", "force", std::move(curve));
  figure.kind = "law";
  figure.panels[0].x = axis_of("indentation", false, "indentation δ");
  figure.panels[0].y.label = "normal force F";
  return figure;
}

Figure figure_of(const Realisation& surface) {
  Panel panel{.x = axis_of("mean_gap", false, "mean gap ū"),
              .y = axis_of("pressure", true, "nominal pressure p")};
  for (const ModelResult& model : surface.models) {
    Curve curve{.name = title_of(name_of(model.model)), .color = static_cast<int>(model.model)};
    for (const ForceSample& sample : model.curve.samples) {
      if (!sample.converged) continue;
      curve.x.push_back(sample.mean_gap);
      curve.y.push_back(sample.pressure);
    }
    panel.curves.push_back(std::move(curve));
  }
  return {.kind = "surface_models", .panels = {std::move(panel)}};
}

Figure figure_of(const SampledMotion& path) {
  return {.kind = "motion",
          .panels = {{.x = {.quantity = "displacement", .label = "displacement x", .unit = "m"},
                      .y = axis_of("indentation", false, "indentation δ"),
                      .curves = {{.x = path.displacement, .y = path.indentation}}}}};
}

Figure figure_of(const CycleResult& cycle) {
  Figure figure{.kind = "cycle", .columns = 3};
  figure.panels.push_back(
      {.title = "loss W = " + error_text(cycle.work_per_cycle, cycle.step_error, Dimension::energy),
       .caption = "Tangential force over the displacement.",
       .x = axis_of("tangential", false, "displacement x"),
       .y = axis_of("tangential_force", false, "tangential force F_x"),
       .curves = {{.x = column(cycle, &CycleSample::tangential),
                   .y = column(cycle, &CycleSample::tangential_force)}}});
  figure.panels.push_back(
      {.caption = "Work over the cycle.",
       .x = {.label = "time in periods", .low = 0, .high = 1},
       .y = axis_of("work", false, "work of the tangential force"),
       .curves = {{.x = column(cycle, &CycleSample::t), .y = column(cycle, &CycleSample::work)}}});
  if (const Field map = cycle.contact_map(); map.size() > 0)
    figure.panels.push_back(
        {.caption = "Cells always in contact (black) or during a part of the cycle (grey).",
         .x = {.label = "cell along x"},
         .y = {.label = "cell along y"},
         .image = Image{.x = cells(map.rows(), 1),
                        .y = cells(map.cols(), 1),
                        .values = map,
                        .scale = {.low = 0, .high = 2},
                        .palette = Palette::grey,
                        .color_bar = false},
         .equal_scales = true});
  return figure;
}

Figure figure_of(const StressMap& map) {
  Axis stress = axis_of("shear", false, "shear stress τ");
  stress.high = colour_limit(map.shear);
  stress.low = -*stress.high;
  const auto panel = [&](const Field& values, const Axis& scale, Palette palette) {
    return Panel{.title = scale.label,
                 .x = {.quantity = "radial_position", .label = "radius r", .unit = "m"},
                 .y = {.quantity = "angle", .label = "phase θ", .unit = "rad"},
                 .image = Image{.x = map.radial_position,
                                .y = map.angle,
                                .values = values.transpose(),
                                .scale = scale,
                                .palette = palette},
                 .curves = {{.name = "edge of the contact",
                             .quantity = "contact_radius",
                             .x = map.contact_radius,
                             .y = map.angle,
                             .color = 6}}};
  };
  return {.kind = "stress_map",
          .caption =
              "Shear stress and pressure over the radius and the phase of the normal motion; "
              "the black line is the edge of the contact.",
          .panels = {panel(map.shear, stress, Palette::diverging),
                     panel(map.contact_pressure, axis_of("contact_pressure", false, "pressure p"),
                           Palette::sequential)},
          .columns = 2};
}

Figure figure_of(const SliderMotion& motion) {
  return {.kind = "slider",
          .panels = {{.x = axis_of("time", false, "time t"),
                      .y = {.quantity = "slider_offset",
                            .label = "distance from the drive x − Vt",
                            .unit = "m"},
                      .curves = {{.x = motion.time, .y = motion.slider_offset}}}}};
}

}  // namespace salebra::figures
