// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>

using namespace salebra;

namespace {

/// Samples with ln p = y at ū = −x: a published regression of y on x has the slope 1/l.
ForceCurve curve_of(const std::vector<double>& x, const std::vector<double>& log_pressure) {
  ForceCurve curve{.model = "test", .nominal_area = 2, .samples = {}};
  for (std::size_t i = 0; i < x.size(); ++i)
    curve.samples.push_back({.mean_gap = -x[i], .pressure = std::exp(log_pressure[i])});
  return curve;
}

// Anscombe, The American Statistician 27 (1973) 17: the first set is linear with noise, the second
// a parabola without noise.
const std::vector<double> anscombe_x{10, 8, 13, 9, 11, 14, 6, 4, 12, 7, 5};
const std::vector<double> anscombe_linear{8.04, 6.95, 7.58,  8.81, 8.33, 9.96,
                                          7.24, 4.26, 10.84, 4.82, 5.68};
const std::vector<double> anscombe_parabola{9.14, 8.14, 8.74, 8.77, 9.26, 8.10,
                                            6.13, 3.10, 9.13, 7.26, 4.74};

}  // namespace

TEST_CASE("The fit is the published regression of Anscombe's first set", "[fit]") {
  const ExponentialFit fit =
      fit_exponential(curve_of(anscombe_x, anscombe_linear), {}, FitWeights::equal);
  // Slope 0.500091, intercept 3.000091, standard error 0.117906, R² 0.666542 (to the printed
  // digits); t(9) = 2.262157.
  CHECK(1 / fit.decay_length == Approx(0.500091).epsilon(2e-6));
  CHECK(std::log(fit.reference_pressure) == Approx(3.000091).epsilon(1e-6));
  CHECK(fit.r_squared == Approx(0.666542).epsilon(2e-6));
  CHECK(1 / fit.decay_length_low - 1 / fit.decay_length ==
        Approx(2.262157 * 0.117906).epsilon(1e-5));
  CHECK(1 / fit.decay_length - 1 / fit.decay_length_high ==
        Approx(2.262157 * 0.117906).epsilon(1e-5));
  CHECK(fit.window.points == 11);
  CHECK(fit.window.pressure_max == Approx(std::exp(10.84)));
  CHECK(std::isnan(fit.decay_length_over_rms_height));
}

TEST_CASE("Only the curve that bends refutes the exponential law", "[fit]") {
  CHECK_FALSE(
      test_exponential(curve_of(anscombe_x, anscombe_linear), {}, FitWeights::equal).refuted());
  const ExponentialTest bent =
      test_exponential(curve_of(anscombe_x, anscombe_parabola), {}, FitWeights::equal);
  // The second set is y = −5.9957 + 2.7808 x − 0.12671 x² within its two decimals.
  CHECK(bent.quadratic == Approx(-0.12671).epsilon(1e-4));
  CHECK(bent.refuted(1e-6));
  CHECK(1 / bent.decay_length_at_min_gap == Approx(2.7808 - 2 * 0.12671 * 14).epsilon(1e-3));
  CHECK(1 / bent.decay_length_at_max_gap == Approx(2.7808 - 2 * 0.12671 * 4).epsilon(1e-3));
}

TEST_CASE("An exact exponential has its decay length, no interval and no bend", "[fit]") {
  std::vector<double> x, log_pressure;
  for (int i = 0; i < 9; ++i) {
    x.push_back(-1e-7 * (1 + i * (1 + 0.1 * i)));
    log_pressure.push_back(20 + x.back() / 0.7e-7);
  }
  const ForceCurve curve = curve_of(x, log_pressure);
  const ExponentialFit fit = fit_exponential(curve);
  // exp and log add about 20 units of round-off to ln p, divided by its range of 20.
  CHECK(fit.decay_length == Approx(0.7e-7).epsilon(1e-14));
  CHECK(fit.decay_length_high - fit.decay_length_low < 1e-13 * fit.decay_length);
  CHECK(fit.r_squared == Approx(1).epsilon(1e-14));
  CHECK_FALSE(test_exponential(curve).refuted());
  for (double length : local_decay_length(curve).decay_length)
    CHECK(length == Approx(0.7e-7).epsilon(1e-13));
}

TEST_CASE("Exponential summits obey the law, Gaussian ones bend it", "[fit]") {
  SummitEnsemble ensemble{.summit_density = 1e10,
                          .radius = 1e-6,
                          .summit_rms = 2e-8,
                          .mean_height = 3e-8,
                          .distribution = SummitDistribution::exponential,
                          .rms_height = 2.2e-8};
  const Material material = Material::of_contact_modulus(1e11, 0.3);
  std::vector<double> separations;
  for (int i = 0; i < 12; ++i) separations.push_back(5e-9 * i);
  auto curve_of_ensemble = [&] {
    return curve_at_separations(StatisticalSummits(ensemble, material, 1e-6), separations);
  };
  const ExponentialFit fit = fit_exponential(curve_of_ensemble());
  CHECK(fit.decay_length == Approx(2e-8).epsilon(1e-12));
  CHECK(fit.decay_length_over_rms_height == Approx(2e-8 / 2.2e-8).epsilon(1e-12));
  // ū = s + 3e-8 lies within 2.2e-8 … 5.5e-8 for s from 0 to 2.5e-8.
  CHECK(fit.window.points == 6);
  CHECK_FALSE(test_exponential(curve_of_ensemble()).refuted());

  ensemble.distribution = SummitDistribution::gaussian;
  const ForceCurve gaussian = curve_of_ensemble();
  const ExponentialTest test = test_exponential(gaussian);
  CHECK(test.refuted(1e-3));
  CHECK(test.quadratic < 0);
  CHECK(test.decay_length_at_min_gap > test.decay_length_at_max_gap);
  // The secant between neighbours gives l = F/K at their midpoint, to the second order of 0.25 σ.
  const LocalDecayLength local = local_decay_length(gaussian);
  const StatisticalSummits summits(ensemble, material, 1e-6);
  REQUIRE(local.mean_gap.size() == 11);
  for (std::size_t i = 0; i < local.mean_gap.size(); ++i) {
    const double separation = local.mean_gap[i] - 3e-8;
    CHECK(local.decay_length[i] ==
          Approx(summits.force(separation) / summits.normal_stiffness(separation)).epsilon(2e-3));
  }
}

TEST_CASE("The law is fair where F/l^2 is within a factor of two of F'' at both ends", "[fit]") {
  const LawDescription law = describe_law(2, 1.5, 2.5);
  CHECK(law.law_off_at_min_gap == 0.5625 - 1);
  CHECK(law.law_off_at_max_gap == 1.5625 - 1);
  CHECK(law.fair);
  // The squares of 1.41 and 1.42 lie on either side of 2, those of 0.71 and 0.70 on either side of
  // 1/2.
  CHECK(describe_law(1, 0.71, 1.41).fair);
  CHECK(describe_law(1e-9, 1.41e-9, 0.71e-9).fair);
  for (const double off : {0.70, 1.42}) {
    CHECK_FALSE(describe_law(1, off, 1).fair);
    CHECK_FALSE(describe_law(1, 1, off).fair);
  }
  // A negative l means that the parabola of the fit has turned.
  CHECK(std::isinf(describe_law(1, 1, -1).law_off_at_max_gap));
  CHECK_FALSE(describe_law(1, 1, -1).fair);
}

TEST_CASE("The 95 % interval covers the truth in 95 % of noisy curves, whatever the weights",
          "[fit]") {
  std::mt19937_64 random(5);
  auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  auto noise = [&] {
    return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * std::numbers::pi * uniform());
  };
  const FitWeights weights = GENERATE(FitWeights::equal, FitWeights::spacing);
  int covered = 0, refuted = 0;
  const int repeats = 1000;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    std::vector<double> x, log_pressure;
    for (int i = 0; i < 8; ++i) {
      x.push_back(i + 0.08 * i * i);  // gaps between neighbours grow twofold
      log_pressure.push_back(2.0 * x.back() + 0.3 * noise());
    }
    const ForceCurve curve = curve_of(x, log_pressure);
    const ExponentialFit fit = fit_exponential(curve, {}, weights);
    covered += fit.decay_length_low <= 0.5 && 0.5 <= fit.decay_length_high;
    refuted += test_exponential(curve, {}, weights).refuted();
  }
  // Binomial: 950 ± 7 and 50 ± 7; the normal quantile 1.96 instead of Student's 2.45 would cover
  // 902. Student's distribution is exact for equal weights; unequal weights change it by a per cent
  // here.
  CHECK(covered == Approx(950).margin(24));
  CHECK(refuted == Approx(50).margin(24));
}

TEST_CASE("Spacing weights make l a property of the curve, not of where it was sampled", "[fit]") {
  // ln p = −ū − ū²/10 on 0 … 2: the line closest to ū² in the mean square has the slope 0 + 2, so
  // 1/l = 1.2.
  auto curve_at = [](int samples, double grading) {
    std::vector<double> x, log_pressure;
    for (int i = 0; i < samples; ++i) {
      const double gap = 2 * std::pow(double(i) / (samples - 1), grading);
      x.push_back(-gap);
      log_pressure.push_back(-gap - 0.1 * gap * gap);
    }
    return curve_of(x, log_pressure);
  };
  auto error = [&](int samples, double grading, FitWeights weights) {
    return std::abs(1 / fit_exponential(curve_at(samples, grading), {}, weights).decay_length -
                    1.2);
  };
  // Evenly spaced samples of a parabola are exact by symmetry; others have the second order of the
  // trapezoidal rule.
  CHECK(error(51, 1, FitWeights::spacing) < 1e-12);
  CHECK(error(401, 2, FitWeights::spacing) < 1e-5);
  CHECK(error(51, 2, FitWeights::spacing) / error(101, 2, FitWeights::spacing) ==
        Approx(4).epsilon(0.1));
  // Equal weights favour the many samples near ū = 0, where l is larger.
  CHECK(error(401, 2, FitWeights::equal) > 0.02);
  // All weights find the bend.
  for (const FitWeights weights : {FitWeights::spacing, FitWeights::equal, FitWeights::force})
    CHECK(test_exponential(curve_at(21, 2), {}, weights).quadratic == Approx(-0.1).epsilon(1e-9));
}

TEST_CASE("The interval of a weighted fit follows from how it answers each value", "[fit]") {
  const std::vector<double> gaps{0, 0.3, 0.5, 1.2, 1.4, 2.6, 3},
      log_pressure{0, -1.6, -2.3, -6.4, -6.9, -13.2, -15};
  const std::size_t n = gaps.size();
  std::vector<double> x;
  for (const double gap : gaps) x.push_back(-gap);
  const ExponentialFit fit = fit_exponential(curve_of(x, log_pressure));
  // The fit is linear in ln p, so differences are the derivatives of the slope −1/l and of each
  // residual.
  double squares = 0, trace = 0, variance = 0;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> changed = log_pressure;
    changed[j] += 1;
    const ExponentialFit other = fit_exponential(curve_of(x, changed));
    const double slope = 1 / fit.decay_length - 1 / other.decay_length;
    const double intercept = std::log(other.reference_pressure / fit.reference_pressure);
    variance += slope * slope;
    for (std::size_t i = 0; i < n; ++i) {
      const double weight = gaps[std::min(i + 1, n - 1)] - gaps[i > 0 ? i - 1 : 0];
      const double answer = (i == j ? 1 : 0) - intercept - slope * gaps[i];
      trace += weight * answer * answer;
      if (j > 0) continue;
      const double residual =
          log_pressure[i] - std::log(fit.reference_pressure) + gaps[i] / fit.decay_length;
      squares += weight * residual * residual;
    }
  }
  // t(5) = 2.570582; s² comes from Σw r², whose expectation is s² times the trace.
  CHECK(1 / fit.decay_length_low - 1 / fit.decay_length ==
        Approx(2.570582 * std::sqrt(variance * squares / trace)).epsilon(1e-6));
}

TEST_CASE("Force weights are those of errors of one size in p", "[fit]") {
  // The normal equations with weights p², solved for the slope by another method than the fit's.
  const std::vector<double> gaps{0, 0.7, 1.1, 2.5, 3}, log_pressure{0.1, -0.6, -1.3, -2.2, -3.2};
  std::vector<double> x;
  double s0 = 0, s1 = 0, s2 = 0, t0 = 0, t1 = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    x.push_back(-gaps[i]);
    const double weight = std::exp(2 * log_pressure[i]);
    s0 += weight;
    s1 += weight * gaps[i];
    s2 += weight * gaps[i] * gaps[i];
    t0 += weight * log_pressure[i];
    t1 += weight * gaps[i] * log_pressure[i];
  }
  const double slope = (s0 * t1 - s1 * t0) / (s0 * s2 - s1 * s1);
  CHECK(fit_exponential(curve_of(x, log_pressure), {}, FitWeights::force).decay_length ==
        Approx(-1 / slope).epsilon(1e-12));
}

TEST_CASE("The window decides which samples count", "[fit]") {
  ForceCurve curve = curve_of({1, 2, 3, 4, 5, 6}, {1, 2, 3, 14, 15, 16});
  const ExponentialFit low = fit_exponential(curve, PressureWindow{0, std::exp(3.5)});
  CHECK(low.decay_length == Approx(1).epsilon(1e-13));
  CHECK(low.window.points == 3);
  CHECK(low.window.pressure_max == Approx(std::exp(3)));

  SECTION("samples without convergence, contact or gap are left out") {
    curve.samples[1].converged = false;
    CHECK_THROWS_WITH(fit_exponential(curve, PressureWindow{0, std::exp(3.5)}),
                      Catch::Contains("at least 3"));
  }
  SECTION("forces stand in for pressures") {
    for (ForceSample& sample : curve.samples) {
      sample.force = 2 * sample.pressure;
      sample.pressure = ForceSample::unknown;
    }
    CHECK(fit_exponential(curve, PressureWindow{0, std::exp(3.5)}).decay_length ==
          Approx(low.decay_length).epsilon(1e-14));
  }
  SECTION("limits in the wrong order") {
    CHECK_THROWS_AS(fit_exponential(curve, PressureWindow{5, 2}), InvalidInput);
  }
  SECTION("a test of the bend needs one point more than the line") {
    CHECK_THROWS_WITH(test_exponential(curve, PressureWindow{0, std::exp(3.5)}),
                      Catch::Contains("at least 4"));
  }
  SECTION("no sample in the default window") {
    curve.rms_height = 100;
    CHECK_THROWS_WITH(fit_exponential(curve), Catch::Contains("rms heights"));
  }
  SECTION("a curve that falls") {
    for (ForceSample& sample : curve.samples) sample.mean_gap = -sample.mean_gap;
    CHECK_THROWS_WITH(fit_exponential(curve), Catch::Contains("does not fall"));
  }
  SECTION("equal gaps") {
    for (ForceSample& sample : curve.samples) sample.mean_gap = 1;
    CHECK_THROWS_WITH(fit_exponential(curve), Catch::Contains("same in all"));
  }
  SECTION("an empty curve") { CHECK_THROWS_AS(local_decay_length({}), InvalidInput); }
}

TEST_CASE("The sensitivity is the range of fits over parts of the window", "[fit]") {
  // Two straight pieces of slopes 1 and 2: runs of at least three of five samples lie within each.
  const ForceCurve curve = curve_of({1, 2, 3, 4, 5}, {1, 2, 3, 5, 7});
  const WindowSensitivity sensitivity = window_sensitivity(curve);
  CHECK(sensitivity.windows == 6);
  CHECK(sensitivity.decay_length_max == Approx(1).epsilon(1e-13));
  CHECK(sensitivity.decay_length_min == Approx(0.5).epsilon(1e-13));
  CHECK(fit_exponential(curve).decay_length < 1);
  const WindowSensitivity narrow = window_sensitivity(curve, PressureWindow{0, std::exp(3.5)});
  CHECK(narrow.windows == 1);
  CHECK(narrow.decay_length_min == narrow.decay_length_max);
}

TEST_CASE("The sensitivity weighs as the fit does", "[fit]") {
  const std::vector<double> x{1, 2, 4, 5, 8}, y{1, 2, 3, 5, 7};
  for (const FitWeights weights : {FitWeights::equal, FitWeights::spacing, FitWeights::force}) {
    double least = 1e9, greatest = 0;
    // Runs of at least three of five samples.
    for (std::size_t begin = 0; begin < 3; ++begin)
      for (std::size_t end = begin + 3; end <= 5; ++end) {
        const auto part = [&](const std::vector<double>& all) {
          return std::vector<double>(all.begin() + std::ptrdiff_t(begin),
                                     all.begin() + std::ptrdiff_t(end));
        };
        const double length = fit_exponential(curve_of(part(x), part(y)), {}, weights).decay_length;
        least = std::min(least, length);
        greatest = std::max(greatest, length);
      }
    const WindowSensitivity sensitivity = window_sensitivity(curve_of(x, y), {}, weights);
    CHECK(sensitivity.decay_length_min == Approx(least).epsilon(1e-13));
    CHECK(sensitivity.decay_length_max == Approx(greatest).epsilon(1e-13));
  }
}

TEST_CASE("With four samples the bend has one degree of freedom, and Cauchy's probability",
          "[fit]") {
  // Four even positions: c = Σvy/Σv² with v = (1, −1, −1, 1), and the residual is along (−1, 3, −3,
  // 1)/√20.
  const std::vector<double> y{1, 2.2, 2.9, 4.4};
  const double bend = (y[0] - y[1] - y[2] + y[3]) / 4;
  const double residual = (-y[0] + 3 * y[1] - 3 * y[2] + y[3]) / std::sqrt(20);
  const double t = std::abs(bend) / (std::abs(residual) / 2);  // Σv² = 4
  const ExponentialTest test = test_exponential(curve_of({1, 2, 3, 4}, y), {}, FitWeights::equal);
  CHECK(test.quadratic == Approx(bend).epsilon(1e-12));
  CHECK(test.significance == Approx(1 - 2 / std::numbers::pi * std::atan(t)).epsilon(1e-10));
}

TEST_CASE("A load on the limit of the window is in it, whatever its last digit", "[fit]") {
  ForceCurve curve = curve_of({1, 2, 3, 4, 5}, {1, 2, 3, 4, 5.5});
  const double low = curve.samples[1].pressure, high = curve.samples[3].pressure;
  curve.samples[1].pressure = low * (1 - 1e-12);
  curve.samples[3].pressure = high * (1 + 1e-12);
  CHECK(fit_exponential(curve, PressureWindow{low, high}).window.points == 3);
}

TEST_CASE("An interval that reaches a flat line has no upper limit", "[fit]") {
  const ExponentialFit fit = fit_exponential(curve_of({1, 2, 3}, {1, 5, 2}));
  CHECK(std::isinf(fit.decay_length_high));
  CHECK(fit.decay_length_low > 0);
}
