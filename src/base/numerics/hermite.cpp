// SPDX-License-Identifier: GPL-3.0-or-later
// Monotone piecewise cubic interpolation, its derivatives and its inverse.
#include "hermite.hpp"

#include <algorithm>
#include <cmath>

namespace salebra::detail {
namespace {

/// Derivative at x[at] of the cubic through four nodes starting at x[first].
double four_point_slope(const std::vector<double>& x, const std::vector<double>& y,
                        std::size_t first, std::size_t at) {
  double slope = 0;
  for (std::size_t j = first; j < first + 4; ++j) {
    if (j == at) continue;
    // Weight of node j in the derivative at node `at`, from Lagrange's polynomials. The weights of
    // all nodes sum to zero, so only the differences y_j − y_at contribute.
    double weight = 1 / (x[j] - x[at]);
    for (std::size_t k = first; k < first + 4; ++k)
      if (k != j && k != at) weight *= (x[at] - x[k]) / (x[j] - x[k]);
    slope += weight * (y[j] - y[at]);
  }
  return slope;
}

double limited(double slope, double secant) {
  if (slope * secant <= 0) return 0;
  return std::abs(slope) > 3 * std::abs(secant) ? 3 * secant : slope;
}

}  // namespace

MonotoneHermite::MonotoneHermite(std::vector<double> x, std::vector<double> y,
                                 std::vector<double> slopes)
    : x_(std::move(x)), y_(std::move(y)), slopes_(std::move(slopes)) {
  const std::size_t nodes = x_.size();
  if (slopes_.empty()) {
    slopes_.resize(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
      std::size_t first = std::min(i - std::min<std::size_t>(i, 1), nodes - 4);
      // Of the two windows of four nodes around an inner node, the shorter one is used.
      if (i >= 2 && i + 2 < nodes && x_[i] - x_[i - 2] < x_[i + 2] - x_[i]) first = i - 2;
      slopes_[i] = four_point_slope(x_, y_, first, i);
    }
  }
  for (std::size_t i = 0; i + 1 < nodes; ++i) {
    const double secant = (y_[i + 1] - y_[i]) / (x_[i + 1] - x_[i]);
    slopes_[i] = limited(slopes_[i], secant);
    slopes_[i + 1] = limited(slopes_[i + 1], secant);
  }
}

MonotoneHermite::Point MonotoneHermite::at(double x) const {
  const auto above = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
  return on(static_cast<std::size_t>(above - x_.begin()) - 1, x);
}

MonotoneHermite::Point MonotoneHermite::on(std::size_t i, double x) const {
  const double width = x_[i + 1] - x_[i], t = (x - x_[i]) / width;
  const double rise = y_[i + 1] - y_[i], m0 = slopes_[i] * width, m1 = slopes_[i + 1] * width;
  const double quadratic = 3 * rise - 2 * m0 - m1, cubic = m0 + m1 - 2 * rise;
  return {y_[i] + t * (m0 + t * (quadratic + t * cubic)),
          (m0 + t * (2 * quadratic + 3 * t * cubic)) / width,
          (2 * quadratic + 6 * t * cubic) / (width * width)};
}

double MonotoneHermite::where(double value) const {
  const auto above = std::upper_bound(y_.begin() + 1, y_.end() - 1, value);
  const std::size_t i = static_cast<std::size_t>(above - y_.begin()) - 1;
  double low = x_[i], high = x_[i + 1];
  double x = low + (high - low) * (value - y_[i]) / (y_[i + 1] - y_[i]);
  // Newton's method, kept in the bracket by bisection: a limited slope may be zero at a node, and
  // Newton's step would divide by it.
  for (int step = 0; step < 200 && low < high; ++step) {
    const Point point = at(x);
    const double excess = point.value - value;
    (excess > 0 ? high : low) = x;
    if (excess == 0) return x;
    double next = x - excess / point.slope;
    if (!(next > low && next < high)) next = low + (high - low) / 2;
    if (std::abs(next - x) <= 1e-16 * std::max(std::abs(low), std::abs(high))) return next;
    x = next;
  }
  return x;
}

}  // namespace salebra::detail
