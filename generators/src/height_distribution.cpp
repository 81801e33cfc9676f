// SPDX-License-Identifier: GPL-3.0-or-later
// Height distributions given by their quantile function: Gaussian, Weibull, sampled, and Johnson's
// curves.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <utility>

namespace salebra {

double normal_quantile(double u) {
  require(u > 0 && u < 1, "u", u, "must lie in 0 < u < 1");
  if (u > 0.5) return -normal_quantile(1 - u);
  // Newton's method for x in ln Φ(x) = ln u, with the standard normal distribution Φ. ln Φ is
  // concave, so iterates rise to the root from any start below it, such as this one.
  double x = -std::sqrt(-2 * std::log(u));
  for (int step = 0; step < 20; ++step) {
    const double below = std::erfc(-x / std::numbers::sqrt2) / 2;
    const double density = std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi);
    const double change = std::log(u / below) * below / density;
    x += change;
    if (std::abs(change) < 4e-16 * std::abs(x)) break;
  }
  return x;
}

HeightDistribution gaussian_heights() { return {normal_quantile, "gaussian heights"}; }

HeightDistribution weibull_heights(double shape) {
  require_positive(shape, "shape");
  return {[=](double u) { return std::pow(-std::log1p(-u), 1 / shape); },
          "weibull heights, shape " + std::to_string(shape)};
}

HeightDistribution sampled_heights(std::vector<double> heights) {
  for (const double height : heights)
    require(std::isfinite(height), "heights", height, "must be finite; remove undefined points");
  auto sorted = std::make_shared<std::vector<double>>(std::move(heights));
  std::sort(sorted->begin(), sorted->end());
  require(sorted->size() >= 2 && sorted->front() < sorted->back(), "heights", sorted->size(),
          "values do not define a distribution; give at least two different ones");
  const std::string name = "distribution of " + std::to_string(sorted->size()) + " heights";
  return {[sorted](double u) {
            const auto last = static_cast<double>(sorted->size() - 1);
            const double position =
                std::clamp(u * static_cast<double>(sorted->size()) - 0.5, 0.0, last);
            const auto below = static_cast<std::size_t>(std::min(position, last - 1));
            const double part = position - static_cast<double>(below);
            return (1 - part) * (*sorted)[below] + part * (*sorted)[below + 1];
          },
          name};
}

namespace {

struct Shape {
  double skewness = 0;
  double kurtosis = 3;
};

// Skewness and kurtosis of x(Z) for a standard normal variable Z, by the trapezoidal rule over
// −limit … limit. For such integrands its error falls faster than any power of the step.
template <class Transform>
Shape shape_of(const Transform& x, double limit, double step) {
  double weight = 0, mean = 0;
  for (double z = -limit; z <= limit; z += step) {
    const double w = std::exp(-z * z / 2);
    weight += w;
    mean += w * x(z);
  }
  mean /= weight;
  double m2 = 0, m3 = 0, m4 = 0;
  for (double z = -limit; z <= limit; z += step) {
    const double w = std::exp(-z * z / 2) / weight;
    const double deviation = x(z) - mean, square = deviation * deviation;
    m2 += w * square;
    m3 += w * square * deviation;
    m4 += w * square * square;
  }
  return {m3 / std::pow(m2, 1.5), m4 / (m2 * m2)};
}

// Skewness and kurtosis of Johnson's unbounded curve S_U: closed form of Johnson (1949), with γ < 0
// for a positive skewness; Ω = −γ/δ > 0.
Shape unbounded_shape(double gamma, double delta) {
  const double w = std::exp(1 / (delta * delta)), omega = -gamma / delta;
  const double a = w * std::cosh(2 * omega) + 1;
  const double w2 = w * w;
  return {std::sqrt(w * (w - 1) / 2) * (w * (w + 2) * std::sinh(3 * omega) + 3 * std::sinh(omega)) /
              std::pow(a, 1.5),
          (w2 * (w2 * w2 + 2 * w2 * w + 3 * w2 - 3) * std::cosh(4 * omega) +
           4 * w2 * (w + 2) * std::cosh(2 * omega) + 3 * (2 * w + 1)) /
              (2 * a * a)};
}

double bounded_transform(double z, double gamma, double delta) {
  return 1 / (1 + std::exp(-(z - gamma) / delta));
}

Shape bounded_shape(double gamma, double delta) {
  return shape_of([=](double z) { return bounded_transform(z, gamma, delta); }, 9.0,
                  std::min(0.05, delta / 5));
}

// Skewness and kurtosis of Johnson's lognormal curve S_L, with w = exp(1/δ²).
Shape lognormal_shape(double w) {
  return {std::sqrt(w - 1) * (w + 2), w * w * (w * (w + 2) + 3) - 3};
}

// Root of an increasing function between low and high, by bisection to the last bits.
template <class Function>
double root_of(const Function& increasing, double low, double high) {
  for (int step = 0; step < 100; ++step) {
    const double middle = (low + high) / 2;
    (increasing(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

// The parameter γ at which a Johnson curve with the given parameter δ has the given skewness. The
// skewness grows from 0 as γ moves away from 0 in the direction (1 or −1).
template <class ShapeOf>
double gamma_of(const ShapeOf& shape, double skewness, double delta, double direction) {
  if (skewness == 0) return 0;
  double reach = 1;
  // Near the lognormal curve γ is large.
  while (shape(direction * reach, delta).skewness < skewness && reach < 4096) reach *= 2;
  return direction * root_of(
                         [&](double magnitude) {
                           return shape(direction * magnitude, delta).skewness - skewness;
                         },
                         0, reach);
}

// Quantile of a Johnson curve as a function of a standard normal z, for a skewness >= 0.
std::function<double(double)> johnson_transform(double skewness, double kurtosis) {
  const double w_lognormal =
      skewness == 0
          ? 1
          : root_of([&](double w) { return lognormal_shape(w).skewness - skewness; }, 1, 1e3);
  const double excess = kurtosis - lognormal_shape(w_lognormal).kurtosis;
  // If the kurtosis is this close to that of the lognormal curve of equal skewness, γ grows without
  // bound, and the curve is lognormal within rounding.
  if (std::abs(excess) < 1e-6 * kurtosis) {
    const double scale = std::sqrt(std::log(w_lognormal));
    if (scale < 1e-6) return [](double z) { return z; };
    return [=](double z) { return std::exp(scale * z); };
  }
  // Among curves of equal skewness, the kurtosis increases with w = exp(1/δ²) from the lognormal
  // curve on (unbounded curves S_U), and with δ up to the lognormal curve (bounded curves S_B).
  if (excess > 0) {
    const auto delta_of = [](double w) { return 1 / std::sqrt(std::log(w)); };
    const double w = root_of(
        [&](double trial) {
          const double delta = delta_of(trial);
          const double gamma = gamma_of(unbounded_shape, skewness, delta, -1);
          return unbounded_shape(gamma, delta).kurtosis - kurtosis;
        },
        w_lognormal * (1 + 1e-9), std::max(2.0, 2 * w_lognormal) + kurtosis);
    const double delta = delta_of(w), gamma = gamma_of(unbounded_shape, skewness, delta, -1);
    return [=](double z) { return std::sinh((z - gamma) / delta); };
  }
  constexpr double min_delta = 0.05;
  const double max_delta =
      w_lognormal > 1 ? std::min(1e3, 1 / std::sqrt(std::log(w_lognormal))) : 1e3;
  const double delta = root_of(
      [&](double trial) {
        const double gamma = gamma_of(bounded_shape, skewness, trial, 1);
        return bounded_shape(gamma, trial).kurtosis - kurtosis;
      },
      min_delta, max_delta);
  const double gamma = gamma_of(bounded_shape, skewness, delta, 1);
  return [=](double z) { return bounded_transform(z, gamma, delta); };
}

}  // namespace

HeightDistribution johnson_heights(double skewness, double kurtosis) {
  require(std::isfinite(skewness) && std::abs(skewness) <= 10, "skewness", skewness,
          "must lie in -10 … 10");
  require(kurtosis > skewness * skewness + 1 && kurtosis <= 1000, "kurtosis", kurtosis,
          "must exceed skewness^2 + 1, as for every distribution, and be at most 1000");
  const auto transform = johnson_transform(std::abs(skewness), kurtosis);
  const Shape reached = shape_of(transform, 30.0, 0.01);
  require(std::abs(reached.skewness - std::abs(skewness)) < 1e-3 * (1 + std::abs(skewness)) &&
              std::abs(reached.kurtosis - kurtosis) < 1e-3 * kurtosis,
          "kurtosis", kurtosis, "is too close to skewness^2 + 1 for a smooth distribution");
  const double sign = skewness < 0 ? -1 : 1;
  return {[=](double u) { return sign * transform(sign * normal_quantile(u)); },
          "johnson heights, skewness " + std::to_string(skewness) + ", kurtosis " +
              std::to_string(kurtosis)};
}

}  // namespace salebra
