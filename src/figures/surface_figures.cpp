// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of a surface: height map, spectrum with fit, height distribution.
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <salebra/figures/figures.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/lay.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/twin.hpp>
#include <utility>

#include "axes.hpp"
#include "surface/profile_law.hpp"

namespace salebra::figures {
namespace {

/// The 95 % interval of the mean of n independent powers.
void add_interval(Curve& curve, double mean, double powers) {
  const auto limit = [&](double share) {
    return 2 * powers * mean / gsl_cdf_chisq_Pinv(share, 2 * powers);
  };
  curve.low.push_back(limit(0.975));
  curve.high.push_back(limit(0.025));
}

/// The power law q^{-exponent} in the fitted range, at the level of the powers there, each with its
/// weight.
Curve law_of(const HurstEstimate& hurst, double exponent, std::string name, const Curve& measured,
             const std::vector<double>& weights) {
  double level = 0, weight = 0;
  for (std::size_t k = 0; k < measured.x.size(); ++k) {
    const double q = measured.x[k];
    if (q < hurst.wavenumber_min || q > hurst.wavenumber_max) continue;
    level += weights[k] * measured.y[k] * std::pow(q, exponent);
    weight += weights[k];
  }
  Curve law{.name = std::move(name), .style = Style::dashed};
  for (const double q : {hurst.wavenumber_min, hurst.wavenumber_max}) {
    law.x.push_back(q);
    law.y.push_back(level / weight * std::pow(q, -exponent));
  }
  return law;
}

/// Roll-off and short cut-off of a law, as far as it has them.
void add_ends(Panel& panel, const SelfAffineFit& law, const std::string& way) {
  for (const auto& [name, length] :
       {std::pair("roll-off", law.rolloff.value), {"cut-off", law.short_cutoff.value}})
    if (std::isfinite(length))
      panel.lines.push_back(
          {.at = 2 * std::numbers::pi / length,
           .vertical = true,
           .name = name + way + " " + format_quantity(length, Dimension::length, 3)});
}

std::string lay_text(const SurfaceLay& lay) {
  constexpr double degrees = 180 / std::numbers::pi;
  return fmt::format(
      ", lay at {:.0f}° ± {:.1g}°, slope across over along {}", lay.angle * degrees,
      lay.angle_error * degrees,
      interval_text(lay.ratio, lay.ratio_low, lay.ratio_high, Dimension::dimensionless));
}

std::string hurst_text(const HurstEstimate& hurst) {
  return fmt::format("H = {:.2f} ({:.2f} … {:.2f})", hurst.value, hurst.low, hurst.high);
}

Panel spectrum_panel(const SurfaceSpectrum& of) {
  const PowerSpectrum& spectrum = *of.spectrum;
  const HurstEstimate& hurst = of.law.hurst;
  const RadialSpectrum radial = radial_spectrum(spectrum, 6);
  Panel panel{
      .title = hurst.found() ? "Hurst exponent " + hurst_text(hurst) : "no power law was found",
      .x = axis_of("wavenumber", true, "wave number q"),
      .y = axis_of("psd", true, "power spectral density C"),
      .legend = Legend::bottom_left};
  Curve measured{.name = "radial mean, 95 % confidence band",
                 .quantity = "psd",
                 .style = Style::line_and_points};
  std::vector<double> weights;
  double strongest = 0;
  for (const double density : radial.psd) strongest = std::max(strongest, density);
  for (std::size_t k = 0; k < radial.wavenumber.size(); ++k) {
    // Leaves out densities beyond a cut-off that are only rounding errors or the leakage of a
    // window; they would extend the axis by twenty decades.
    if (!(radial.psd[k] > 1e-13 * strongest)) continue;
    measured.x.push_back(radial.wavenumber[k]);
    measured.y.push_back(radial.psd[k]);
    weights.push_back(static_cast<double>(radial.modes[k]));
    // A mode and its mirror image are one power.
    add_interval(measured, radial.psd[k], weights.back() / 2 / spectrum.correlated_modes);
  }
  panel.curves.push_back(std::move(measured));
  if (hurst.found())
    panel.curves.push_back(law_of(hurst, 2 * (1 + hurst.value), "power law q^{−2(1+H)}",
                                  panel.curves.front(), weights));
  add_ends(panel, of.law, "");
  return panel;
}

/// The spectra of profiles across and along the lay.
Panel lay_panel(const SurfaceSpectrum& of) {
  const PowerSpectrum& spectrum = *of.spectrum;
  Panel panel{.title = "Hurst exponent " + hurst_text(of.of_lay->across.hurst) + " across",
              .x = axis_of("wavenumber", true, "wave number q"),
              .y = axis_of("profile_psd", true, "power spectral density C_1"),
              .legend = Legend::bottom_left};
  if (!of.of_lay->across.hurst.found()) panel.title = "profiles; no power law was found";
  for (const bool along : {false, true}) {
    const SelfAffineFit& law = along ? of.of_lay->along : of.of_lay->across;
    const double direction = of.lay.angle + (along ? 0 : std::numbers::pi / 2);
    const std::string way = along ? " along" : " across";
    const double lowest =
        2 * std::numbers::pi *
        std::hypot(std::cos(direction) / spectrum.grid.lx, std::sin(direction) / spectrum.grid.ly);
    Curve measured{.name = way.substr(1) + " the lay, 95 % confidence band",
                   .quantity = "profile_psd",
                   .style = Style::line_and_points,
                   .color = along ? 1 : 0};
    std::vector<double> weights;
    double strongest = 0;
    for (const detail::SpectrumBin& bin : detail::profile_bins(spectrum, direction, lowest)) {
      strongest = std::max(strongest, bin.power);
      if (!(bin.power > 1e-10 * strongest)) continue;
      measured.x.push_back(bin.wavenumber);
      measured.y.push_back(bin.power);
      weights.push_back(bin.modes);
      add_interval(measured, bin.power, bin.modes);
    }
    panel.curves.push_back(std::move(measured));
    if (law.hurst.found()) {
      panel.curves.push_back(law_of(law.hurst, 1 + 2 * law.hurst.value,
                                    fmt::format("q^{{−(1+2H)}}, H = {:.2f}", law.hurst.value),
                                    panel.curves.back(), weights));
      panel.curves.back().color = along ? 8 : 6;
    }
    add_ends(panel, law, way);
  }
  return panel;
}

Panel distribution_panel(const Surface& surface) {
  const HeightStatistics heights = height_statistics(surface);
  const HeightHistogram histogram = height_histogram(BearingCurve(surface));
  Panel panel{.caption =
                  "Distribution of the heights beside the Gaussian of the same mean and rms "
                  "height."};
  panel.title = fmt::format("skewness {}{:.2f}, kurtosis {:.2f}", heights.skewness < 0 ? "−" : "",
                            std::abs(heights.skewness), heights.kurtosis);
  panel.x = axis_of("height", false, "height");
  panel.y = axis_of("height_density", false, "probability density");
  panel.curves.push_back({.name = "heights",
                          .x = histogram.height,
                          .y = histogram.height_density,
                          .style = Style::line_and_points});
  Curve gaussian{.name = "Gaussian", .style = Style::dashed};
  constexpr int points = 121;
  for (int k = 0; k < points; ++k) {
    const double z = -4 + 8.0 * k / (points - 1);
    gaussian.x.push_back(heights.mean + z * heights.rms_height);
    gaussian.y.push_back(std::exp(-z * z / 2) /
                         (std::sqrt(2 * std::numbers::pi) * heights.rms_height));
  }
  panel.curves.push_back(std::move(gaussian));
  return panel;
}

}  // namespace

SurfaceSpectrum spectrum_of(const Surface& surface) {
  SurfaceSpectrum result;
  if (surface.undefined_points() > 0) return result;
  const SurfaceLay lay = surface_lay(surface);
  if (lay.found()) {
    // Profiles need a window on every surface.
    result.spectrum = power_spectrum(surface, Window::hann);
    result.of_lay = fit_self_affine(*result.spectrum, lay);
    result.lay = lay;
  } else {
    result.spectrum = power_spectrum(surface);
    result.law = fit_self_affine(*result.spectrum);
  }
  return result;
}

Figure figure_of(const Surface& surface, const SurfaceSpectrum& of) {
  const HeightStatistics statistics = height_statistics(surface);
  Figure figure{
      .kind = "surface",
      .caption = fmt::format("A surface of {} × {} points.", surface.grid.nx, surface.grid.ny)};
  figure.panels.push_back(
      map_panel(surface.grid, surface.heights,
                "rms height " + format_quantity(statistics.rms_height, Dimension::length, 3) +
                    (of.of_lay ? lay_text(of.lay) : ""),
                axis_of("heights", false, "height")));
  figure.panels.back().caption = "Heights.";
  if (of.spectrum && of.spectrum->psd.maxCoeff() > 0) {
    figure.panels.push_back(of.of_lay ? lay_panel(of) : spectrum_panel(of));
    figure.panels.back().caption =
        fmt::format("{} with the 95 % confidence band{}.",
                    of.of_lay ? "Power spectral density of profiles across and along the lay"
                              : "Radial power spectral density",
                    of.law.hurst.found() || (of.of_lay && of.of_lay->across.hurst.found())
                        ? " and the fitted power law in the range of its fit"
                        : "");
  }
  if (statistics.rms_height > 0) figure.panels.push_back(distribution_panel(surface));
  figure.columns = static_cast<int>(figure.panels.size());
  return figure;
}

Figure figure_of(const Surface& surface) { return figure_of(surface, spectrum_of(surface)); }

Figure figure_of(const SurfaceTwin& twin) {
  Panel panel;
  panel.title = "Hurst exponent H = " + interval_text(twin.hurst.value, twin.hurst.low,
                                                      twin.hurst.high, Dimension::dimensionless);
  if (std::isnan(twin.hurst.value)) panel.title = "power spectral density of the surface";
  panel.x = axis_of("wavenumber", true, "wave number q");
  panel.y = axis_of("psd", true, "power spectral density C(q)");
  panel.legend = Legend::bottom_left;
  panel.curves.push_back({.name = "all scans, 95 % confidence band",
                          .quantity = "psd",
                          .x = twin.spectrum.wavenumber,
                          .y = twin.spectrum.psd,
                          .low = twin.spectrum.low,
                          .high = twin.spectrum.high});
  return {.kind = "twin",
          .caption =
              "Power spectral density of the surface that all scans have in common, with its "
              "95 % confidence band.",
          .panels = {panel}};
}

namespace {

/// A figure of one panel with one curve.
Figure line_figure(std::string kind, Axis x, Axis y, std::vector<double> along,
                   std::vector<double> values, Style style = Style::line) {
  Panel panel{.x = std::move(x), .y = std::move(y)};
  panel.curves.push_back({.x = std::move(along), .y = std::move(values), .style = style});
  return {.kind = std::move(kind), .panels = {panel}};
}

}  // namespace

Figure figure_of(const RadialSpectrum& spectrum) {
  return line_figure("radial_spectrum", axis_of("wavenumber", true, "wave number q"),
                     axis_of("psd", true, "power spectral density C(q)"), spectrum.wavenumber,
                     spectrum.psd, Style::line_and_points);
}

Figure figure_of(const ProfilePsd& spectrum) {
  return line_figure("profile_psd", axis_of("wavenumber", true, "wave number q"),
                     axis_of("profile_psd", true, "power spectral density C_1(q)"),
                     spectrum.wavenumber, spectrum.psd);
}

Figure figure_of(const HeightHistogram& histogram) {
  return line_figure("height_histogram", axis_of("height", false, "height"),
                     axis_of("height_density", false, "probability density"), histogram.height,
                     histogram.height_density, Style::line_and_points);
}

Figure figure_of(const Correlation& correlation) {
  return line_figure("correlation", axis_of("distance", false, "distance"),
                     axis_of("autocorrelation", false, "autocorrelation"), correlation.distance,
                     correlation.autocorrelation);
}

Figure figure_of(const ScaleDependence& slopes) {
  return line_figure("scale_dependence", axis_of("spacing", true, "distance"),
                     axis_of("profile_slope", true, "rms slope"), slopes.spacing,
                     slopes.profile_slope, Style::line_and_points);
}

Figure figure_of(const BearingCurve& curve) {
  std::vector<double> part, height;
  for (int k = 0; k <= 200; ++k) {
    part.push_back(k / 200.0);
    height.push_back(curve.height(part.back()));
  }
  return line_figure("bearing_curve", {.label = "part of the surface above"},
                     axis_of("height", false, "height"), part, height);
}

Figure figure_of(const PowerSpectrum& spectrum) {
  // Sorted along q_x, since an image needs increasing coordinates.
  std::vector<double> along = spectrum.wavenumbers_x();
  std::vector<Index> order(along.size());
  std::iota(order.begin(), order.end(), Index(0));
  std::ranges::sort(order, {}, [&](Index i) { return along[static_cast<std::size_t>(i)]; });
  std::ranges::sort(along);
  Field values(spectrum.psd.rows(), spectrum.psd.cols());
  for (Index i = 0; i < values.rows(); ++i)
    values.row(i) = spectrum.psd.row(order[static_cast<std::size_t>(i)]);
  Axis scale = axis_of("psd", true, "C(q)");
  // Densities below are rounding errors.
  if (const double most = values.maxCoeff(); most > 0) scale.low = 1e-20 * most;
  return {.kind = "power_spectrum",
          .panels = {{.x = {.label = "wave number q_x", .unit = "rad/m"},
                      .y = {.label = "wave number q_y", .unit = "rad/m"},
                      .image = Image{.x = along,
                                     .y = spectrum.wavenumbers_y(),
                                     .values = std::move(values),
                                     .scale = std::move(scale)},
                      .equal_scales = true}}};
}

Figure figure_of(const CorrelationMap& map) {
  Image image{.values = map.autocorrelation,
              .scale = axis_of("autocorrelation", false, "autocorrelation"),
              .palette = Palette::diverging};
  for (Index i = 0; i < map.autocorrelation.rows(); ++i) image.x.push_back(map.lag_x(i));
  for (Index j = 0; j < map.autocorrelation.cols(); ++j) image.y.push_back(map.lag_y(j));
  return {.kind = "correlation_map",
          .panels = {{.x = {.label = "distance along x", .unit = "m"},
                      .y = {.label = "distance along y", .unit = "m"},
                      .image = std::move(image),
                      .equal_scales = true}}};
}

}  // namespace salebra::figures
