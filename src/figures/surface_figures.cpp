// SPDX-License-Identifier: GPL-3.0-or-later
// Figure of a surface: height map, spectrum with fit, height distribution.
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <salebra/figures/figures.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/twin.hpp>

#include "axes.hpp"

namespace salebra::figures {
namespace {

Panel spectrum_panel(const PowerSpectrum& spectrum, const HurstEstimate& hurst) {
  const RadialSpectrum radial = radial_spectrum(spectrum, 6);
  Panel panel;
  panel.title = "power spectral density";
  panel.x = {.label = "wave number q", .unit = "rad/m", .logarithmic = true};
  panel.y = {.label = "C(q)", .unit = "m^4", .logarithmic = true};
  panel.legend = Legend::bottom_left;
  Curve measured{.name = "radial mean", .style = Style::line_and_points};
  double strongest = 0;
  for (const double density : radial.psd) strongest = std::max(strongest, density);
  for (std::size_t k = 0; k < radial.wavenumber.size(); ++k) {
    // Leaves out densities that are only rounding errors beyond a cut-off; they would extend the
    // axis by thirty decades.
    if (!(radial.psd[k] > 1e-20 * strongest)) continue;
    measured.x.push_back(radial.wavenumber[k]);
    measured.y.push_back(radial.psd[k]);
  }
  panel.curves.push_back(std::move(measured));
  if (hurst.found()) {
    // Draws a power law with the fitted exponent H. Its factor is the mean of C(q) q^{2(1+H)} over
    // the Fourier modes in the fitted range (C: spectral density at the wavenumber q).
    double level = 0, weight = 0;
    for (std::size_t k = 0; k < radial.wavenumber.size(); ++k) {
      const double q = radial.wavenumber[k];
      if (q < hurst.wavenumber_min || q > hurst.wavenumber_max) continue;
      const double modes = static_cast<double>(radial.modes[k]);
      level += modes * radial.psd[k] * std::pow(q, 2 * (1 + hurst.value));
      weight += modes;
    }
    Curve law{
        .name = fmt::format("H = {:.2f} ({:.2f} … {:.2f})", hurst.value, hurst.low, hurst.high),
        .style = Style::dashed};
    for (const double q : {hurst.wavenumber_min, hurst.wavenumber_max}) {
      law.x.push_back(q);
      law.y.push_back(level / weight * std::pow(q, -2 * (1 + hurst.value)));
    }
    if (weight > 0) panel.curves.push_back(std::move(law));
  }
  return panel;
}

Panel distribution_panel(const Surface& surface) {
  const HeightStatistics heights = height_statistics(surface);
  const HeightHistogram histogram = height_histogram(BearingCurve(surface));
  Panel panel;
  panel.title = fmt::format("skewness {:.2f}, kurtosis {:.2f}", heights.skewness, heights.kurtosis);
  panel.x = {.label = "height", .unit = "m"};
  panel.y = {.label = "density", .unit = "1/m"};
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
  result.spectrum = power_spectrum(surface);
  result.hurst = estimate_hurst(*result.spectrum);
  return result;
}

Figure figure_of(const Surface& surface, const SurfaceSpectrum& of) {
  Figure figure;
  figure.panels.push_back(
      map_panel(surface.grid, surface.heights, "heights", {.label = "height", .unit = "m"}));
  if (of.spectrum && of.spectrum->psd.maxCoeff() > 0)
    figure.panels.push_back(spectrum_panel(*of.spectrum, of.hurst));
  if (height_statistics(surface).rms_height > 0)
    figure.panels.push_back(distribution_panel(surface));
  figure.columns = static_cast<int>(figure.panels.size());
  return figure;
}

Figure figure_of(const SurfaceTwin& twin) {
  Panel panel;
  panel.title = "power spectral density of the surface";
  panel.x = {.label = "wave number q", .unit = "rad/m", .logarithmic = true};
  panel.y = {.label = "C(q)", .unit = "m^4", .logarithmic = true};
  panel.legend = Legend::bottom_left;
  panel.curves.push_back({.name = "by all scans, 95 %",
                          .x = twin.spectrum.wavenumber,
                          .y = twin.spectrum.psd,
                          .low = twin.spectrum.low,
                          .high = twin.spectrum.high});
  return {.panels = {panel}};
}

}  // namespace salebra::figures
