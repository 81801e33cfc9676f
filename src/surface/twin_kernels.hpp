// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <span>

/// Innermost loops of the surface twin, for every vector width with the same bits.
namespace salebra::twin_detail {

/// sums[c] += Σ_j values[j]·table[j·sums.size() + c].
void add_products(std::span<const double> values, const double* table, std::span<double> sums);

/// powers[k] += weight·(a·u[k] − b·v[k] − c·w[k])².
void add_squares(double a, double b, double c, const double* u, const double* v, const double* w,
                 double weight, std::span<double> powers);

/// values[k] = e^{values[k]}; below e^−690, that.
void exponentials(std::span<double> values);

/// values[k] = ln values[k], of normal numbers > 0.
void logarithms(std::span<double> values);

}  // namespace salebra::twin_detail
