// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/figures/figure.hpp>
#include <utility>

#include "display_axis.hpp"

namespace salebra::figures {

/// An image resampled to cells of equal size, in the numbers that the axes of the picture show.
struct Raster {
  /// Centre of the first cell, and distance of the cells, along x and y.
  double x0 = 0, dx = 0, y0 = 0, dy = 0;
  /// In the numbers of the colour scale: with an SI prefix, and as logarithms if it is logarithmic.
  Field values;
  DisplayAxis scale;  ///< colour scale, with both limits set
};

/// Throws InvalidInput if the numbers of coordinates do not match the size of `values`.
void check_raster(const Image& image);

Raster rasterise(const Image& image, const DisplayAxis& x, const DisplayAxis& y);

/// Minimum and maximum of the finite values; (∞, −∞) if no value is finite.
std::pair<double, double> finite_range(const Field& values);

}  // namespace salebra::figures
