// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/enum_names.hpp>
#include <salebra/contact/law/force_curve.hpp>
#include <vector>

namespace salebra {

/// Range of pressures in which a law is fitted or a curve is known.
struct PressureWindow {
  double pressure_min = 0;  ///< Pa
  double pressure_max = 0;  ///< Pa
  int points = 0;           ///< number of samples in the window

  /// Returns true if the pressure lies in the window, whose limits are widened by the relative
  /// slack.
  bool contains(double pressure, double slack = 0) const {
    return pressure >= pressure_min * (1 - slack) && pressure <= pressure_max * (1 + slack);
  }
  /// Relative slack for rounding errors: the pressure of a sample at a load of 2 MPa is a sum over
  /// cells, whose last digit must not put the sample outside a window that ends at 2 MPa.
  static constexpr double round_off = 1e-9;
};

constexpr void describe(auto&& visit, std::type_identity<PressureWindow>) {
  using enum Dimension;
  using S = PressureWindow;
  visit(&S::pressure_min, Quantity{"pressure_min", pressure, "lowest pressure of the fit"});
  visit(&S::pressure_max, Quantity{"pressure_max", pressure, "highest pressure of the fit"});
  visit(&S::points, Kept{"points", "samples in the window"});
}

/// Weight of a sample in the least-squares fit of ln p.
enum class FitWeights {
  /// Weight of a sample: the interval of mean gap ū that reaches half way to its neighbouring
  /// samples. The sum of squares for the fit p = exp(a − ū/l) is then ∫(ln p − a + ū/l)² dū by the
  /// trapezoidal rule, so that l depends on the curve and the window, not on the spacing of the
  /// loads. Use it for computed curves, whose residuals are the misfit of the law, not noise.
  spacing,
  equal,  ///< weight 1: for values with similar relative errors
  force   ///< weight p²: for values with similar absolute errors, e.g. of a load cell
};

template <>
struct EnumNames<FitWeights> {
  static constexpr auto values =
      std::to_array<std::pair<FitWeights, std::string_view>>({{FitWeights::spacing, "spacing"},
                                                              {FitWeights::equal, "equal"},
                                                              {FitWeights::force, "force"}});
};

/// Fit of p = reference_pressure · exp(−ū/decay_length) by weighted least squares in ln p over a
/// window, with 95 % limits by Student's t. p is the nominal pressure, ū the mean gap.
struct ExponentialFit {
  double decay_length = 0;      ///< l, m
  double decay_length_low = 0;  ///< 95 % limits of l, m
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

/// Fits the exponential law to a curve:
///     const double decay_length = fit_exponential(curve).decay_length;
/// It uses the samples with a pressure in [pressure_min, pressure_max], limits included to 1e-9.
/// Without a window, it uses samples with ū between 1 and 2.5 h_rms, where the law fits best, or
/// all samples if h_rms is unknown. It ignores samples that did not converge and samples without a
/// mean gap or a pressure > 0. window.points of the argument is ignored; window.points of the
/// result is the number of samples used. decay_length_high is infinite if the 95 % interval of the
/// slope reaches zero. The interval assumes independent errors of ln p with one variance, whatever
/// the weights. For a computed curve the interval has no meaning, because the residuals are the
/// misfit of the law, not noise; the range of the local decay length from test_exponential is more
/// useful. Throws InvalidInput for fewer than three points, equal gaps, or a pressure that does not
/// fall with ū.
ExponentialFit fit_exponential(const ForceCurve& curve,
                               const std::optional<PressureWindow>& window = {},
                               FitWeights weights = FitWeights::spacing);

/// Test for curvature of ln p over the mean gap ū: fits ln p = a + b ū + c ū² with the window and
/// weights of fit_exponential, and tests c = 0 by Student's t.
struct ExponentialTest {
  double quadratic = 0;       ///< c, 1/m²; > 0 if the decay length grows with ū
  double standard_error = 0;  ///< standard error of c, 1/m²
  double significance = 1;    ///< p-value: two-sided probability of at least this |c| if the
                              ///< law holds
  /// −dū/d ln p of the parabola at the smallest ū of the window, m.
  double decay_length_at_min_gap = 0;
  double decay_length_at_max_gap = 0;  ///< at the largest ū of the window, m
  PressureWindow window;

  /// Returns true if the exponential law is rejected at this significance level. A computed curve
  /// has almost no noise, so that any curvature is significant; the difference of the two decay
  /// lengths shows how much it matters.
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
  visit(&S::decay_length_at_min_gap, Quantity{"decay_length_at_min_gap", length,
                                              "local decay length at the close end of the window"});
  visit(&S::decay_length_at_max_gap, Quantity{"decay_length_at_max_gap", length,
                                              "local decay length at the far end of the window"});
  visit(&S::window, Kept{"window", "pressures of the fit"});
}

/// Tests the law, e.g. `test_exponential(curve).refuted()`. Throws wherever fit_exponential does,
/// and for fewer than four points.
ExponentialTest test_exponential(const ForceCurve& curve,
                                 const std::optional<PressureWindow>& window = {},
                                 FitWeights weights = FitWeights::spacing);

/// How well F ∝ exp(−ū/l) describes a curve: the relative deviation of F/l², used in Eqs (12) and
/// (16), from F'' = F/l_local² at both ends of the fit window, with the local decay length l_local.
/// There is no probability, because the residuals of a computed curve are the misfit of the law,
/// not scatter.
struct LawDescription {
  double law_off_at_min_gap =
      0;  ///< (l_local/l)² − 1 at the smallest ū of the window; ∞ if l_local ≤ 0
  /// (l_local/l)² − 1 at the largest ū of the window; ∞ if l_local ≤ 0.
  double law_off_at_max_gap = 0;
  bool fair = false;  ///< true if F/l² is within a factor of two of F'' at both ends
};

constexpr void describe(auto&& visit, std::type_identity<LawDescription>) {
  using enum Dimension;
  using S = LawDescription;
  visit(&S::law_off_at_min_gap, Quantity{"law_off_at_min_gap", dimensionless,
                                         "F/l^2 over F'' at the close end of the window, less 1"});
  visit(&S::law_off_at_max_gap, Quantity{"law_off_at_max_gap", dimensionless,
                                         "F/l^2 over F'' at the far end of the window, less 1"});
  visit(&S::fair,
        Quantity{"fair", dimensionless, "whether one decay length describes the curve fairly"});
}

/// Compares the fitted decay length with the local decay lengths at the smallest and at the largest
/// mean gap of the window; all three in the same unit.
LawDescription describe_law(double decay_length, double at_min_gap, double at_max_gap);

/// Sensitivity of the fit to its window: the smallest and largest decay length of fit_exponential
/// over all runs of consecutive samples that contain at least half of the samples of the window,
/// and at least three.
struct WindowSensitivity {
  double decay_length_min = 0;  ///< m
  double decay_length_max = 0;  ///< m
  int windows = 0;              ///< number of runs fitted
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

/// Computes the sensitivity of the fit to its window. Throws wherever fit_exponential does.
WindowSensitivity window_sensitivity(const ForceCurve& curve,
                                     const std::optional<PressureWindow>& window = {},
                                     FitWeights weights = FitWeights::spacing);

/// Local decay length l(ū) = −dū/d ln p at the midpoints between consecutive samples; samples that
/// fit_exponential omits do not count.
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
/// Computes the local decay length. Throws InvalidInput for fewer than two usable samples.
LocalDecayLength local_decay_length(const ForceCurve& curve);

}  // namespace salebra
