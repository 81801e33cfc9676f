// SPDX-License-Identifier: GPL-3.0-or-later
// Elementwise power of positive numbers, compiled for each vector width.
#include "powers.hpp"

#include <cstddef>

#include "elementary.hpp"

namespace salebra {
namespace {

SALEBRA_VECTOR_WIDTHS
void raise(double* values, std::size_t count, double exponent) {
#pragma omp simd
  for (std::size_t k = 0; k < count; ++k)
    values[k] = detail::exponential(exponent * detail::natural_log(values[k]));
}

}  // namespace

void raise_to_power(std::span<double> values, double exponent) {
  raise(values.data(), values.size(), exponent);
}

}  // namespace salebra
