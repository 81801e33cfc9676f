// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/twin.hpp>
#include <string>

#include "io/plot.hpp"

namespace salebra::cli {

/// The spectrum of a surface. A spectrum needs every point, so it is empty if a point is undefined.
struct SurfaceSpectrum {
  std::optional<PowerSpectrum> spectrum;
  HurstEstimate hurst;  ///< estimated from `spectrum`
};

SurfaceSpectrum spectrum_of(const Surface& surface);

/// A map of a field over the cells of a grid, in colours.
PlotPanel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                    const PlotAxis& scale);

/// A surface in three panels: the map of its heights; its radial power spectral density with the
/// fitted power law; the distribution of its heights with the Gaussian of the same mean and rms
/// height. The second panel is left out if there is no spectrum or if it is zero.
Figure surface_figure(const Surface& surface, const SurfaceSpectrum& of);

/// The power spectral density of a surface twin, which several scans have in common, with its 95 %
/// band.
Figure twin_figure(const SurfaceTwin& twin);

}  // namespace salebra::cli
