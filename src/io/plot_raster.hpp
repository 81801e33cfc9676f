// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>

#include "display_axis.hpp"
#include "plot.hpp"

namespace salebra::detail {

/// An image as equal cells on the axes as drawn.
struct Raster {
  double x0 = 0, dx = 0, y0 = 0, dy = 0;  ///< middle of the first cell, and the spacing
  Field values;                           ///< as drawn: scaled, logarithm taken
  DisplayAxis scale;                      ///< of the colours, with both limits
};

/// Throws InvalidInput where coordinates and values do not belong together.
void check_raster(const PlotImage& image);

Raster rasterise(const PlotImage& image, const DisplayAxis& x, const DisplayAxis& y);

/// The range of the values that are numbers; (∞, −∞) if none is.
std::pair<double, double> finite_range(const Field& values);

}  // namespace salebra::detail
