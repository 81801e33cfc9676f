// SPDX-License-Identifier: GPL-3.0-or-later
// Loops of the surface twin that are compiled for several vector widths.
#include "surface/twin_kernels.hpp"

#include "base/elementary.hpp"

namespace salebra::twin_detail {

using detail::exponential;
using detail::natural_log;

SALEBRA_VECTOR_WIDTHS
void add_products(std::span<const double> values, const double* table, std::span<double> sums) {
  const std::size_t columns = sums.size();
  double* const to = sums.data();
  for (std::size_t j = 0; j < values.size(); ++j) {
    const double value = values[j];
    const double* const row = table + j * columns;
    for (std::size_t c = 0; c < columns; ++c) to[c] += value * row[c];
  }
}

SALEBRA_VECTOR_WIDTHS
void add_squares(const AlongX& x, const AlongY& y, double weight, std::span<double> powers) {
  const double a = x.wave, b = x.plane, c = x.mean;
  const double *const u = y.wave, *const v = y.mean, *const w = y.slope;
  double* const to = powers.data();
  for (std::size_t k = 0; k < powers.size(); ++k) {
    const double amplitude = a * u[k] - b * v[k] - c * w[k];
    to[k] += weight * (amplitude * amplitude);
  }
}

SALEBRA_VECTOR_WIDTHS
void exponentials(std::span<double> values) {
  double* const at = values.data();
  for (std::size_t k = 0; k < values.size(); ++k)
    at[k] = exponential(at[k] > -690.0 ? at[k] : -690.0);
}

SALEBRA_VECTOR_WIDTHS
void logarithms(std::span<double> values) {
  double* const at = values.data();
  for (std::size_t k = 0; k < values.size(); ++k) at[k] = natural_log(at[k]);
}

}  // namespace salebra::twin_detail
