// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/generators/spectrum.hpp>
#include <salebra/results/describe.hpp>

namespace salebra {

template <class Visitor>
constexpr void describe(Visitor&& visit, std::type_identity<SelfAffineParameters>) {
  using enum Dimension;
  using S = SelfAffineParameters;
  visit(&S::hurst, Quantity{"hurst", dimensionless, "Hurst exponent"});
  visit(&S::long_cutoff, Quantity{"long_cutoff", length, "longest wavelength"});
  visit(&S::rolloff, Quantity{"rolloff", length, "roll-off wavelength"});
  visit(&S::short_cutoff, Quantity{"short_cutoff", length, "shortest wavelength"});
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope, Quantity{"rms_slope", dimensionless, "root mean square of the gradient"});
}

}  // namespace salebra
