// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/generators/spectrum.hpp>
#include <string>

namespace salebra::detail {

/// Relative tolerance with which a wave at a cut-off belongs to the spectrum, whatever the rounding
/// of 2π/λ for its wavelength λ.
constexpr double limit_tolerance = 1e-9;

/// Throws InvalidInput for the same parameters as the constructor of SelfAffineSpectrum.
void validate(const SelfAffineParameters& parameters);

std::string describe(const SelfAffineParameters& parameters);

}  // namespace salebra::detail
