// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/generators/spectrum.hpp>
#include <string>

namespace salebra::detail {

/// A wave on a cut-off belongs to the spectrum, whatever the rounding of 2π/λ.
constexpr double limit_tolerance = 1e-9;

/// Throws InvalidInput as SelfAffineSpectrum says.
void validate(const SelfAffineParameters& parameters);

std::string describe(const SelfAffineParameters& parameters);

}  // namespace salebra::detail
