// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <span>

/// Innermost loops of the surface twin, with the same bits for every vector width.
namespace salebra::twin_detail {

/// Adds to sums[c], for each c, the products Σ_j values[j]·table[j·sums.size() + c].
void add_products(std::span<const double> values, const double* table, std::span<double> sums);

/// One-dimensional Fourier transforms, under a taper, of a plane wave and of its least-squares
/// plane. AlongX, at one mode along x: of the wave, of its plane without the slope along y, and of
/// its mean. AlongY, at several modes along y: of the wave, of its mean, and of its slope.
struct AlongX {
  double wave, plane, mean;
};
struct AlongY {
  const double *wave, *mean, *slope;
};

/// Adds the powers of a wave less its least-squares plane at the modes k along y: powers[k] +=
/// weight·(x.wave·y.wave[k] − x.plane·y.mean[k] − x.mean·y.slope[k])².
void add_squares(const AlongX& x, const AlongY& y, double weight, std::span<double> powers);

/// values[k] = e^{values[k]}, but at least e^−690.
void exponentials(std::span<double> values);

/// values[k] = ln values[k], of normal numbers > 0.
void logarithms(std::span<double> values);

}  // namespace salebra::twin_detail
