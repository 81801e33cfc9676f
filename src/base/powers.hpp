// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

namespace salebra {

/// values[k] = values[k]^exponent, vectorised, with the same bits on every machine with IEEE
/// arithmetic. values must be normal numbers > 0 and their powers lie in 1e-300 … 1e300; the
/// relative error is below 4e-16·(1 + |exponent · ln value|). Nothing is checked.
void raise_to_power(std::span<double> values, double exponent);

}  // namespace salebra
