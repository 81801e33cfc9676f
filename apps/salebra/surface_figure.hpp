// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>
#include <salebra/surface/spectrum.hpp>
#include <salebra/surface/twin.hpp>
#include <string>

#include "io/plot.hpp"

namespace salebra::cli {

/// A spectrum needs every point: without one there is none.
struct SurfaceSpectrum {
  std::optional<PowerSpectrum> spectrum;
  HurstEstimate hurst;  ///< estimated from it
};

SurfaceSpectrum spectrum_of(const Surface& surface);

/// A field over the cells of a grid, in colours.
PlotPanel map_panel(const Grid2D& grid, const Field& values, const std::string& title,
                    const PlotAxis& scale);

/// A surface in three panels: the map of its heights, its radial power spectral density with the
/// fitted law, and the distribution of its heights beside the Gaussian one of the same mean and rms
/// height. The second panel is left out where there is no spectrum, or no power in it.
Figure surface_figure(const Surface& surface, const SurfaceSpectrum& of);

/// The spectrum that several scans have in common, with its 95 % band.
Figure twin_figure(const SurfaceTwin& twin);

}  // namespace salebra::cli
