// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <vector>

namespace salebra {

/// Pressures between which a law is fitted or a curve is known.
struct PressureWindow {
  double pressure_min = 0;  ///< Pa
  double pressure_max = 0;  ///< Pa
  int points = 0;

  /// slack: relative, of both limits.
  bool contains(double pressure, double slack = 0) const {
    return pressure >= pressure_min * (1 - slack) && pressure <= pressure_max * (1 + slack);
  }
  /// A load of 2 MPa comes back as a sum over cells: its last digit must not put it outside a
  /// window of 2 MPa.
  static constexpr double round_off = 1e-9;
};

constexpr void describe(auto&& visit, std::type_identity<PressureWindow>) {
  using enum Dimension;
  using S = PressureWindow;
  visit(&S::pressure_min, Quantity{"pressure_min", pressure, "lowest pressure of the fit"});
  visit(&S::pressure_max, Quantity{"pressure_max", pressure, "highest pressure of the fit"});
  visit(&S::points, Kept{"points", "samples in the window"});
}

/// What a sample counts for in the least squares of ln p.
enum class FitWeights {
  /// The length of ū that it stands for, half way to its neighbours. The sum of squares is then
  /// ∫(ln p − a + ū/l)² dū by the trapezoidal rule, so that l is a property of the curve and its
  /// window and not of how the loads were spread: what a computed curve needs, whose residuals are
  /// the misfit of the law and no noise.
  spacing,
  equal,  ///< one: for values whose relative errors are alike
  force   ///< p²: for values whose absolute errors are alike, such as those of a load cell
};

template <>
struct EnumNames<FitWeights> {
  static constexpr auto values =
      std::to_array<std::pair<FitWeights, std::string_view>>({{FitWeights::spacing, "spacing"},
                                                              {FitWeights::equal, "equal"},
                                                              {FitWeights::force, "force"}});
};

/// p = reference_pressure · exp(−ū/decay_length), weighted least squares in ln p over a window,
/// with Student-t 95 % limits.
struct ExponentialFit {
  double decay_length = 0;      ///< l, m
  double decay_length_low = 0;  ///< 95 % limits, m
  double decay_length_high = 0;
  double reference_pressure = 0;  ///< p at ū = 0, Pa
  double r_squared = 0;
  PressureWindow window;
  double decay_length_over_rms_height = ForceSample::unknown;
};

constexpr void describe(auto&& visit, std::type_identity<ExponentialFit>) {
  using enum Dimension;
  using S = ExponentialFit;
  visit(&S::decay_length, Quantity{"decay_length", length, "decay length of force with mean gap"});
  visit(&S::decay_length_low,
        Quantity{"decay_length_low", length, "decay length, lower 95 % limit"});
  visit(&S::decay_length_high,
        Quantity{"decay_length_high", length, "decay length, upper 95 % limit"});
  visit(&S::reference_pressure,
        Quantity{"reference_pressure", pressure, "fitted pressure at zero mean gap"});
  visit(&S::r_squared,
        Quantity{"r_squared", dimensionless, "coefficient of determination of the fit"});
  visit(&S::window, Part{"window", "pressures of the fit"});
  visit(&S::decay_length_over_rms_height,
        Quantity{"decay_length_over_rms_height", dimensionless, "decay length over rms height"});
}

/// Fits the samples whose pressure lies in [pressure_min, pressure_max], limits included to 1e-9;
/// without a window, those with ū between 1 and 2.5 h_rms, where the law is at its best, or all
/// samples if h_rms is unknown. Samples that did not converge, have no mean gap or no pressure > 0
/// are left out. window.points of the argument is not used; that of the result counts the samples.
/// Where the 95 % interval of the slope reaches zero, decay_length_high is infinite. The interval
/// holds for independent errors of ln p with one variance, whatever the weights. The residuals of a
/// computed curve are the misfit of the law: its interval means nothing, and test_exponential has
/// the range of the local l instead.
/// Throws InvalidInput for fewer than three points, equal gaps, or a pressure that does not fall
/// with ū.
ExponentialFit fit_exponential(const ForceCurve& curve,
                               const std::optional<PressureWindow>& window = {},
                               FitWeights weights = FitWeights::spacing);

/// Whether ln p bends: ln p = a + b ū + c ū² over the window of fit_exponential and with its
/// weights, and Student's t-test of c = 0.
struct ExponentialTest {
  double quadratic = 0;             ///< c, 1/m²; > 0 where l grows with ū
  double standard_error = 0;        ///< of c, 1/m²
  double significance = 1;          ///< two-sided probability of so large a |c| if the law held
  double decay_length_closest = 0;  ///< −dū/d ln p of the parabola at the least ū of the window, m
  double decay_length_farthest = 0;  ///< at the largest, m
  PressureWindow window;

  /// The law is refuted at this level. A computed curve has next to no noise, so that any bend is
  /// significant: how much it matters is the difference of the two decay lengths.
  bool refuted(double level = 0.05) const { return significance < level; }
};

constexpr void describe(auto&& visit, std::type_identity<ExponentialTest>) {
  using enum Dimension;
  using S = ExponentialTest;
  visit(&S::quadratic, Quantity{"quadratic", inverse_length_squared,
                                "coefficient of the squared mean gap in ln p"});
  visit(&S::standard_error, Quantity{"standard_error", inverse_length_squared,
                                     "standard error of the quadratic coefficient"});
  visit(&S::significance,
        Quantity{"significance", dimensionless, "probability of so large a bend if the law held"});
  visit(&S::decay_length_closest, Quantity{"decay_length_closest", length,
                                           "local decay length at the close end of the window"});
  visit(&S::decay_length_farthest, Quantity{"decay_length_farthest", length,
                                            "local decay length at the far end of the window"});
  visit(&S::window, Kept{"window", "pressures of the fit"});
}

/// Throws as fit_exponential does, and for fewer than four points.
ExponentialTest test_exponential(const ForceCurve& curve,
                                 const std::optional<PressureWindow>& window = {},
                                 FitWeights weights = FitWeights::spacing);

/// How well F ∝ exp(−ū/l) describes a curve: how far F/l², which Eqs (12) and (16) rest on, is off
/// F'' at the two ends of the window. The residuals of a computed curve are the misfit of the law,
/// not scatter, so that no probability belongs to them.
struct LawDescription {
  double law_off_closest =
      0;  ///< (l_local/l)² − 1 at the least ū of the window; ∞ where l_local ≤ 0
  double law_off_farthest = 0;  ///< at the largest
  bool fair = false;            ///< F/l² is within a factor of two of F'' at both ends
};

constexpr void describe(auto&& visit, std::type_identity<LawDescription>) {
  using enum Dimension;
  using S = LawDescription;
  visit(&S::law_off_closest, Quantity{"law_off_closest", dimensionless,
                                      "F/l^2 over F'' at the close end of the window, less 1"});
  visit(&S::law_off_farthest, Quantity{"law_off_farthest", dimensionless,
                                       "F/l^2 over F'' at the far end of the window, less 1"});
  visit(&S::fair,
        Quantity{"fair", dimensionless, "whether one decay length describes the curve fairly"});
}

/// l of the fit, and the local l at the closest and the farthest end of its window, in any one
/// unit.
LawDescription describe_law(double decay_length, double closest, double farthest);

/// How much the fit owes to its window: the least and the largest decay length of fit_exponential
/// over every run of consecutive samples in the window that holds at least half of them, and at
/// least three.
struct WindowSensitivity {
  double decay_length_min = 0;  ///< m
  double decay_length_max = 0;  ///< m
  int windows = 0;              ///< how many runs were fitted
};

constexpr void describe(auto&& visit, std::type_identity<WindowSensitivity>) {
  using enum Dimension;
  using S = WindowSensitivity;
  visit(&S::decay_length_min,
        Quantity{"decay_length_min", length, "minimum decay length over parts of the window"});
  visit(&S::decay_length_max,
        Quantity{"decay_length_max", length, "maximum decay length over parts of the window"});
  visit(&S::windows, Kept{"windows", "parts of the window that were fitted"});
}

/// Throws as fit_exponential does.
WindowSensitivity window_sensitivity(const ForceCurve& curve,
                                     const std::optional<PressureWindow>& window = {},
                                     FitWeights weights = FitWeights::spacing);

/// l(ū) = −dū/d ln p at the midpoints between consecutive samples; those that fit_exponential
/// leaves out take no part.
struct LocalDecayLength {
  std::vector<double> mean_gap;      ///< m
  std::vector<double> decay_length;  ///< m
};

constexpr void describe(auto&& visit, std::type_identity<LocalDecayLength>) {
  using enum Dimension;
  using S = LocalDecayLength;
  visit(&S::mean_gap, Quantity{"mean_gap", length, "mean gap of the deformed surfaces"});
  visit(&S::decay_length,
        Quantity{"local_decay_length", length, "local decay length -d(mean gap)/d ln(pressure)"});
}
/// Throws InvalidInput for fewer than two usable samples.
LocalDecayLength local_decay_length(const ForceCurve& curve);

}  // namespace salebra
