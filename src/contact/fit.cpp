// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/contact/fit.hpp>

namespace salebra {
namespace {

struct Point {
  double mean_gap, pressure;
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
    // A load of 2 MPa comes back as a sum over cells: its last digit must not put it outside a window of 2 MPa.
    constexpr double slack = 1e-9;
    std::erase_if(points, [&](const Point& point) {
      return point.pressure < window->pressure_min * (1 - slack) ||
             point.pressure > window->pressure_max * (1 + slack);
    });
  } else if (by_gap) {
    std::erase_if(points, [&](const Point& point) {
      return point.mean_gap < curve.rms_height || point.mean_gap > 2.5 * curve.rms_height;
    });
  }
  std::string constraint =
      "points are too few, at least " + std::to_string(least) + " are needed; ";
  constraint +=
      by_gap ? "give a pressure window or more samples with a mean gap of 1 to 2.5 rms heights"
             : "widen the window or compute more samples";
  require(points.size() >= least, "pressure_window", points.size(), constraint);
  return points;
}

PressureWindow window_of(const std::vector<Point>& points) {
  const auto [low, high] = std::ranges::minmax(points, {}, &Point::pressure);
  return {.pressure_min = low.pressure,
          .pressure_max = high.pressure,
          .points = static_cast<int>(points.size())};
}

/// Least squares y = mean_y + b u + c v with u = ū − mean and v = u² made orthogonal to 1 and u, so that no term
/// disturbs the others and no large sums cancel.
struct Regression {
  double mean_x = 0, mean_y = 0;
  double square_u = 0, square_v = 0, square_y = 0;
  double skew = 0;  ///< Σu³/Σu²: v = u² − skew·u − Σu²/n
  double slope = 0, quadratic = 0;
  double linear_residual = 0;  ///< Σ(y − mean_y − b u)²
  double full_residual = 0;    ///< Σ(y − mean_y − b u − c v)²
};

Regression regress(const std::vector<Point>& points) {
  const double count = static_cast<double>(points.size());
  Regression fit;
  const auto [closest, farthest] = std::ranges::minmax(points, {}, &Point::mean_gap);
  require(closest.mean_gap < farthest.mean_gap, "curve.mean_gap", closest.mean_gap,
          "is the same in all samples of the window; compute samples at different loads");
  for (const Point& point : points) {
    fit.mean_x += point.mean_gap / count;
    fit.mean_y += std::log(point.pressure) / count;
  }
  double product_u = 0, cube = 0;
  for (const Point& point : points) {
    const double u = point.mean_gap - fit.mean_x, y = std::log(point.pressure) - fit.mean_y;
    fit.square_u += u * u;
    fit.square_y += y * y;
    product_u += u * y;
    cube += u * u * u;
  }
  fit.slope = product_u / fit.square_u;
  fit.skew = cube / fit.square_u;
  auto orthogonal = [&](double u) { return u * u - fit.skew * u - fit.square_u / count; };
  double product_v = 0;
  for (const Point& point : points) {
    const double v = orthogonal(point.mean_gap - fit.mean_x);
    fit.square_v += v * v;
    product_v += v * (std::log(point.pressure) - fit.mean_y);
  }
  if (fit.square_v > 0) fit.quadratic = product_v / fit.square_v;
  for (const Point& point : points) {
    const double u = point.mean_gap - fit.mean_x;
    const double linear = std::log(point.pressure) - fit.mean_y - fit.slope * u;
    const double full = linear - fit.quadratic * orthogonal(u);
    fit.linear_residual += linear * linear;
    fit.full_residual += full * full;
  }
  require(fit.slope < 0, "curve.pressure", points.front().pressure,
          "does not fall with the mean gap over the window; check the curve");
  return fit;
}

}  // namespace

ExponentialFit fit_exponential(const ForceCurve& curve,
                               const std::optional<PressureWindow>& window) {
  const std::vector<Point> points = points_in_window(curve, window, 3);
  const Regression fit = regress(points);
  const double freedom = static_cast<double>(points.size()) - 2;
  const double standard_error = std::sqrt(fit.linear_residual / freedom / fit.square_u);
  const double reach = gsl_cdf_tdist_Pinv(0.975, freedom) * standard_error;
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
                                 const std::optional<PressureWindow>& window) {
  const std::vector<Point> points = points_in_window(curve, window, 4);
  const Regression fit = regress(points);
  require(fit.square_v > 0, "curve.mean_gap", points.size(),
          "points have only two different mean gaps; compute samples at different loads");
  const double freedom = static_cast<double>(points.size()) - 3;
  ExponentialTest test;
  test.quadratic = fit.quadratic;
  test.standard_error = std::sqrt(fit.full_residual / freedom / fit.square_v);
  // Residuals at the round-off of ln p are a perfect fit and tell nothing about c.
  const double round_off = 1e-14 * std::sqrt(fit.square_y / fit.square_v);
  test.significance =
      std::abs(test.quadratic) <= round_off
          ? 1
          : 2 * gsl_cdf_tdist_Q(std::abs(test.quadratic) / test.standard_error, freedom);
  auto decay_length = [&](double mean_gap) {
    return -1 / (fit.slope + fit.quadratic * (2 * (mean_gap - fit.mean_x) - fit.skew));
  };
  const auto [closest, farthest] = std::ranges::minmax(points, {}, &Point::mean_gap);
  test.decay_length_closest = decay_length(closest.mean_gap);
  test.decay_length_farthest = decay_length(farthest.mean_gap);
  test.window = window_of(points);
  return test;
}

WindowSensitivity window_sensitivity(const ForceCurve& curve,
                                     const std::optional<PressureWindow>& window) {
  std::vector<Point> points = points_in_window(curve, window, 3);
  std::ranges::sort(points, {}, &Point::pressure);
  const std::size_t least = std::max<std::size_t>(3, (points.size() + 1) / 2);
  WindowSensitivity sensitivity{.decay_length_min = std::numeric_limits<double>::infinity()};
  for (std::size_t begin = 0; begin + least <= points.size(); ++begin)
    for (std::size_t end = begin + least; end <= points.size(); ++end) {
      const double length = -1 / regress({points.begin() + static_cast<std::ptrdiff_t>(begin),
                                          points.begin() + static_cast<std::ptrdiff_t>(end)})
                                     .slope;
      sensitivity.decay_length_min = std::min(sensitivity.decay_length_min, length);
      sensitivity.decay_length_max = std::max(sensitivity.decay_length_max, length);
      ++sensitivity.windows;
    }
  return sensitivity;
}

LocalDecayLength local_decay_length(const ForceCurve& curve) {
  const std::vector<Point> points = usable_points(curve);
  require(points.size() >= 2, "curve", points.size(),
          "usable samples (converged, p > 0, ū known) are too few; at least two are needed");
  LocalDecayLength local;
  for (std::size_t i = 1; i < points.size(); ++i) {
    local.mean_gap.push_back((points[i].mean_gap + points[i - 1].mean_gap) / 2);
    local.decay_length.push_back((points[i - 1].mean_gap - points[i].mean_gap) /
                                 std::log(points[i].pressure / points[i - 1].pressure));
  }
  return local;
}

}  // namespace salebra
