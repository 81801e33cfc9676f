// SPDX-License-Identifier: GPL-3.0-or-later
// Fits of F ∝ exp(−ū/l) with mean gap ū and decay length l: weighted least squares, a test of the
// law, sensitivity to the pressure window, local decay length.
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/fit.hpp>

namespace salebra {
namespace {

struct Point {
  double mean_gap, pressure;
  double weight = 1;  ///< the mean weight of all points is 1
};

std::vector<Point> usable_points(const ForceCurve& curve) {
  std::vector<Point> points;
  for (const ForceSample& sample : curve.samples) {
    const double pressure =
        std::isnan(sample.pressure) ? sample.force / curve.nominal_area : sample.pressure;
    if (sample.converged && std::isfinite(sample.mean_gap) && pressure > 0 &&
        std::isfinite(pressure))
      points.push_back({sample.mean_gap, pressure});
  }
  return points;
}

std::vector<Point> points_in_window(const ForceCurve& curve,
                                    const std::optional<PressureWindow>& window,
                                    std::size_t least) {
  std::vector<Point> points = usable_points(curve);
  const bool by_gap = !window && std::isfinite(curve.rms_height);
  if (window) {
    require(window->pressure_min >= 0, "pressure_window", window->pressure_min, "must be >= 0");
    require(window->pressure_max > window->pressure_min, "pressure_window", window->pressure_max,
            "must be larger than the lower limit");
    std::erase_if(points, [&](const Point& point) {
      return !window->contains(point.pressure, PressureWindow::round_off);
    });
  } else if (by_gap) {
    std::erase_if(points, [&](const Point& point) {
      return point.mean_gap < curve.rms_height || point.mean_gap > 2.5 * curve.rms_height;
    });
  }
  std::string constraint = "points given, but at least " + std::to_string(least) + " are needed; ";
  constraint +=
      by_gap ? "give a pressure window or more samples with a mean gap of 1 to 2.5 rms heights"
             : "widen the window or compute more samples";
  require(points.size() >= least, "pressure_window", points.size(), constraint);
  return points;
}

/// Sorts the points by mean gap and sets their weights.
void weigh(std::vector<Point>& points, FitWeights weights) {
  std::ranges::sort(points, {}, &Point::mean_gap);
  require(points.front().mean_gap < points.back().mean_gap, "curve.mean_gap",
          points.front().mean_gap,
          "is the same in all samples of the window; compute samples at different loads");
  const std::size_t last = points.size() - 1;
  const double greatest = std::ranges::max(points, {}, &Point::pressure).pressure;
  double sum = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    switch (weights) {
      case FitWeights::equal:
        points[i].weight = 1;
        break;
      case FitWeights::force: {
        const double relative = points[i].pressure / greatest;
        points[i].weight = relative * relative;
        break;
      }
      case FitWeights::spacing:
        points[i].weight =
            points[std::min(i + 1, last)].mean_gap - points[i > 0 ? i - 1 : 0].mean_gap;
        break;
    }
    sum += points[i].weight;
  }
  for (Point& point : points) point.weight *= static_cast<double>(points.size()) / sum;
}

PressureWindow window_of(const std::vector<Point>& points) {
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::pressure);
  return {.pressure_min = low.pressure,
          .pressure_max = high.pressure,
          .points = static_cast<int>(points.size())};
}

/// Weighted least squares y = mean_y + b u + c v for y = ln p, with weights w. u is the mean gap
/// minus its weighted mean; v is u² made orthogonal to 1 and u in the weighted sums, so that the
/// coefficients b and c do not disturb each other and no large sums cancel. The standard errors
/// assume independent values of y with one variance s², whatever the weights. With residuals r, the
/// coefficient of an orthogonal term φ (1, u or v) has the variance
///     Var = s² Σw²φ²/(Σwφ²)²,   s² = Σw r²/(Σw − Σ_φ Σw²φ²/Σwφ²),
/// which are the textbook formulas if all weights are equal.
struct Regression {
  double mean_x = 0, mean_y = 0;
  double square_u = 0, square_v = 0, square_y = 0;  ///< Σw u², Σw v², Σw (y − mean_y)²
  double skew = 0;  ///< Σw u³/Σw u²: v = u² − skew·u − Σw u²/Σw
  double slope = 0, quadratic = 0;
  double slope_error = 0;      ///< standard error of b, with c = 0
  double quadratic_error = 0;  ///< standard error of c
  double linear_residual = 0;  ///< Σw(y − mean_y − b u)²
};

Regression regress(const std::vector<Point>& points) {
  const double count = static_cast<double>(points.size());
  Regression fit;
  for (const Point& point : points) {
    fit.mean_x += point.weight * point.mean_gap / count;
    fit.mean_y += point.weight * std::log(point.pressure) / count;
  }
  double product_u = 0, cube = 0;
  for (const Point& point : points) {
    const double u = point.mean_gap - fit.mean_x, y = std::log(point.pressure) - fit.mean_y;
    fit.square_u += point.weight * u * u;
    fit.square_y += point.weight * y * y;
    product_u += point.weight * u * y;
    cube += point.weight * u * u * u;
  }
  fit.slope = product_u / fit.square_u;
  fit.skew = cube / fit.square_u;
  auto orthogonal = [&](double u) { return u * u - fit.skew * u - fit.square_u / count; };
  double product_v = 0;
  for (const Point& point : points) {
    const double v = orthogonal(point.mean_gap - fit.mean_x);
    fit.square_v += point.weight * v * v;
    product_v += point.weight * v * (std::log(point.pressure) - fit.mean_y);
  }
  if (fit.square_v > 0) fit.quadratic = product_v / fit.square_v;
  double full_residual = 0, twice_1 = 0, twice_u = 0, twice_v = 0;  // twice: Σw²φ²
  for (const Point& point : points) {
    const double u = point.mean_gap - fit.mean_x, v = orthogonal(u), w = point.weight;
    const double linear = std::log(point.pressure) - fit.mean_y - fit.slope * u;
    const double full = linear - fit.quadratic * v;
    fit.linear_residual += w * linear * linear;
    full_residual += w * full * full;
    twice_1 += w * w;
    twice_u += w * w * u * u;
    twice_v += w * w * v * v;
  }
  const double linear_freedom = count - twice_1 / count - twice_u / fit.square_u;
  fit.slope_error = std::sqrt(fit.linear_residual / linear_freedom * twice_u) / fit.square_u;
  if (fit.square_v > 0) {
    const double freedom = linear_freedom - twice_v / fit.square_v;
    fit.quadratic_error = std::sqrt(full_residual / freedom * twice_v) / fit.square_v;
  }
  require(fit.slope < 0, "curve.pressure", points.front().pressure,
          "does not fall with the mean gap over the window; check the curve");
  return fit;
}

}  // namespace

ExponentialFit fit_exponential(const ForceCurve& curve, const std::optional<PressureWindow>& window,
                               FitWeights weights) {
  std::vector<Point> points = points_in_window(curve, window, 3);
  weigh(points, weights);
  const Regression fit = regress(points);
  const double freedom = static_cast<double>(points.size()) - 2;
  const double reach = gsl_cdf_tdist_Pinv(0.975, freedom) * fit.slope_error;
  ExponentialFit result;
  result.decay_length = -1 / fit.slope;
  result.decay_length_low = 1 / (reach - fit.slope);
  result.decay_length_high =
      reach < -fit.slope ? -1 / (fit.slope + reach) : std::numeric_limits<double>::infinity();
  result.reference_pressure = std::exp(fit.mean_y - fit.slope * fit.mean_x);
  result.r_squared = 1 - fit.linear_residual / fit.square_y;
  result.window = window_of(points);
  result.decay_length_over_rms_height = result.decay_length / curve.rms_height;
  return result;
}

ExponentialTest test_exponential(const ForceCurve& curve,
                                 const std::optional<PressureWindow>& window, FitWeights weights) {
  std::vector<Point> points = points_in_window(curve, window, 4);
  weigh(points, weights);
  const Regression fit = regress(points);
  require(fit.square_v > 0, "curve.mean_gap", points.size(),
          "points have only two different mean gaps; compute samples at more loads");
  const double freedom = static_cast<double>(points.size()) - 3;
  ExponentialTest test;
  test.quadratic = fit.quadratic;
  test.standard_error = fit.quadratic_error;
  // Residuals at the round-off of ln p mean a perfect fit, which says nothing about the curvature c
  // of ln p over the gap.
  const double round_off = 1e-14 * std::sqrt(fit.square_y / fit.square_v);
  test.significance =
      std::abs(test.quadratic) <= round_off
          ? 1
          : 2 * gsl_cdf_tdist_Q(std::abs(test.quadratic) / test.standard_error, freedom);
  auto decay_length = [&](double mean_gap) {
    return -1 / (fit.slope + fit.quadratic * (2 * (mean_gap - fit.mean_x) - fit.skew));
  };
  test.decay_length_at_min_gap = decay_length(points.front().mean_gap);
  test.decay_length_at_max_gap = decay_length(points.back().mean_gap);
  test.window = window_of(points);
  return test;
}

LawDescription describe_law(double decay_length, double at_min_gap, double at_max_gap) {
  // Where the fitted parabola of ln p turns, the local decay length is infinite or negative and has
  // no meaning: the law is far off.
  const auto off = [&](double local) {
    const double ratio = local / decay_length;
    return ratio > 0 ? ratio * ratio - 1 : std::numeric_limits<double>::infinity();
  };
  const auto within = [](double off) { return off > -0.5 && off < 1; };
  LawDescription law{.law_off_at_min_gap = off(at_min_gap), .law_off_at_max_gap = off(at_max_gap)};
  law.fair = within(law.law_off_at_min_gap) && within(law.law_off_at_max_gap);
  return law;
}

WindowSensitivity window_sensitivity(const ForceCurve& curve,
                                     const std::optional<PressureWindow>& window,
                                     FitWeights weights) {
  std::vector<Point> points = points_in_window(curve, window, 3);
  std::ranges::sort(points, {}, &Point::pressure);
  const std::size_t least = std::max<std::size_t>(3, (points.size() + 1) / 2);
  WindowSensitivity sensitivity{.decay_length_min = std::numeric_limits<double>::infinity()};
  for (std::size_t begin = 0; begin + least <= points.size(); ++begin)
    for (std::size_t end = begin + least; end <= points.size(); ++end) {
      std::vector<Point> run(points.begin() + static_cast<std::ptrdiff_t>(begin),
                             points.begin() + static_cast<std::ptrdiff_t>(end));
      weigh(run, weights);
      const double length = -1 / regress(run).slope;
      sensitivity.decay_length_min = std::min(sensitivity.decay_length_min, length);
      sensitivity.decay_length_max = std::max(sensitivity.decay_length_max, length);
      ++sensitivity.windows;
    }
  return sensitivity;
}

LocalDecayLength local_decay_length(const ForceCurve& curve) {
  const std::vector<Point> points = usable_points(curve);
  require(points.size() >= 2, "curve", points.size(),
          "usable samples (converged, p > 0, ū known) given; at least two are needed");
  LocalDecayLength local;
  for (std::size_t i = 1; i < points.size(); ++i) {
    local.mean_gap.push_back((points[i].mean_gap + points[i - 1].mean_gap) / 2);
    local.decay_length.push_back((points[i - 1].mean_gap - points[i].mean_gap) /
                                 std::log(points[i].pressure / points[i - 1].pressure));
  }
  return local;
}

}  // namespace salebra
