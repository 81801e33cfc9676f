// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/describe.hpp>
#include <vector>

namespace salebra {

/// Roughness of one side of a joint, as an instrument states it.
struct SideRoughness {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double rms_height = unknown;  ///< Rq or Sq, m
  double rms_slope = unknown;   ///< Sdq, √⟨|∇h|²⟩; of profiles √2 Rdq; NaN: not known
  double skewness = unknown;    ///< Rsk or Ssk; NaN: not known
};

constexpr void describe(auto&& visit, std::type_identity<SideRoughness>) {
  using S = SideRoughness;
  visit(&S::rms_height, Kept{"rms_height", "root mean square height", Dimension::length});
  visit(&S::rms_slope, Kept{"rms_slope", "root mean square of the gradient"});
  visit(&S::skewness, Kept{"skewness", "skewness of the heights"});
}

/// What the roughness of two sides says of their force law F ∝ exp(δ/l) without a map.
struct RoughnessLaw {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double rms_height = unknown;  ///< of the sum of the sides, h = √(h₁² + h₂²), m
  double rms_slope = unknown;   ///< of the sum, h' = √(h₁'² + h₂'²); NaN: not known
  double skewness = unknown;    ///< of the sum, (s₁h₁³ + s₂h₂³)/h³; NaN: not known
  double relative_pressure = unknown;  ///< p/(E*h'); NaN: not known
  double decay_length = unknown;       ///< l = F/K, m: median of the ensemble
  /// 95 % limits of the ensemble, m; they hold both for F/K, which small motions need, and for U/F
  /// with the elastic energy U, which motions need in which the contact slides as a whole.
  double decay_length_low = unknown, decay_length_high = unknown;
};

constexpr void describe(auto&& visit, std::type_identity<RoughnessLaw>) {
  using enum Dimension;
  using S = RoughnessLaw;
  visit(&S::rms_height, Quantity{"rms_height", length, "root mean square height"});
  visit(&S::rms_slope,
        WhereKnown{{"rms_slope", dimensionless, "root mean square of the gradient"}});
  visit(&S::skewness, WhereKnown{{"skewness", dimensionless, "skewness of the heights"}});
  visit(&S::relative_pressure,
        WhereKnown{{"relative_pressure", dimensionless, "pressure over E* times the rms slope"}});
  visit(&S::decay_length, Quantity{"decay_length", length, "decay length of force with gap"});
  visit(&S::decay_length_low, Quantity{"decay_length_low", length, "lower 95 % limit"});
  visit(&S::decay_length_high, Quantity{"decay_length_high", length, "upper 95 % limit"});
}

/// Estimates the decay length of the force law of a joint from the roughness of its sides:
///     const RoughnessLaw law = law_of_roughness({{.rms_height = 0.8e-6}, {.rms_height = 0.4e-6}});
/// l/h is taken from an ensemble of 900 pairs of surfaces (docs/comparison.md, "Pairs of workshop
/// surfaces"), by the skewness of the sum and the load p/(E*h'), linear in the skewness and in ln of
/// the load. Where the skewness or a slope is not known, the limits hold for all surfaces of the
/// ensemble: skewness from −1.5 to 0, p/(E*h') from 0.0005 to 0.1.
/// sides     one, against a smooth body, or two
/// pressure_over_modulus  p/E*; NaN: not known
/// throws    InvalidInput for values that are not > 0, a skewness outside −2 … 0.3, and a load
///           outside 0.0005 … 0.1, where the ensemble has no surfaces
RoughnessLaw law_of_roughness(
    const std::vector<SideRoughness>& sides,
    double pressure_over_modulus = std::numeric_limits<double>::quiet_NaN());

}  // namespace salebra
