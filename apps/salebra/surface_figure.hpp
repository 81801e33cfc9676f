// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <salebra/io/plot.hpp>
#include <salebra/surface/spectrum.hpp>

namespace salebra::cli {

/// A surface in three panels: the map of its heights, its radial power spectral density with the fitted law, and the
/// distribution of its heights beside the Gaussian one of the same mean and rms height. Without every point defined there is no
/// spectrum, and the second panel is left out.
/// spectrum   of the surface, or none; hurst as estimated from it
Figure surface_figure(const Surface& surface, const PowerSpectrum* spectrum,
                      const HurstEstimate& hurst);

/// The same for a surface of which nothing is known yet.
Figure surface_figure(const Surface& surface);

}  // namespace salebra::cli
