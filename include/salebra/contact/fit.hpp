// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/contact/force_curve.hpp>
#include <vector>

namespace salebra {

struct PressureWindow {
  double pressure_min = 0;  ///< Pa
  double pressure_max = 0;  ///< Pa
  int points = 0;
};

/// p = reference_pressure · exp(−ū/decay_length), least squares in ln p over a window, with Student-t 95 % limits.
struct ExponentialFit {
  double decay_length = 0;         ///< l, m
  double decay_length_low = 0;     ///< 95 % limits, m
  double decay_length_high = 0;
  double reference_pressure = 0;   ///< p at ū = 0, Pa
  double r_squared = 0;
  PressureWindow window;
  double decay_length_over_rms_height = ForceSample::unknown;
};

/// Fits the samples whose pressure lies in [pressure_min, pressure_max]; without a window, those with
/// ū between 1 and 2.5 h_rms (all samples if h_rms is unknown). Throws InvalidInput for fewer than three points.
ExponentialFit fit_exponential(const ForceCurve& curve,
                               const std::optional<PressureWindow>& window = {});

/// l(ū) = −dū/d ln p at the midpoints between consecutive samples.
struct LocalDecayLength {
  std::vector<double> mean_gap;      ///< m
  std::vector<double> decay_length;  ///< m
};
LocalDecayLength local_decay_length(const ForceCurve& curve);

}  // namespace salebra
