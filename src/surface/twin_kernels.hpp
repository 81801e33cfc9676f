// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <span>

/// Innermost loops of the surface twin, for every vector width with the same bits.
namespace salebra::twin_detail {

/// sums[c] += Σ_j values[j]·table[j·sums.size() + c].
void add_products(std::span<const double> values, const double* table, std::span<double> sums);

/// At one mode along x the transform of a wave, of its plane without the slope along y, and of its
/// mean; at modes along y those of the wave, of its mean, and of its slope.
struct AlongX {
  double wave, plane, mean;
};
struct AlongY {
  const double *wave, *mean, *slope;
};

/// powers[k] += weight·(x.wave·y.wave[k] − x.plane·y.mean[k] − x.mean·y.slope[k])².
void add_squares(const AlongX& x, const AlongY& y, double weight, std::span<double> powers);

/// values[k] = e^{values[k]}; below e^−690, that.
void exponentials(std::span<double> values);

/// values[k] = ln values[k], of normal numbers > 0.
void logarithms(std::span<double> values);

}  // namespace salebra::twin_detail
