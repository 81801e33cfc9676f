// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace salebra::detail {

/// Piecewise cubic y(x) through the nodes (x_i, y_i) with given or estimated slopes, limited so
/// that y grows or falls wherever the data do (0 <= slope/secant <= 3 on both sides of a node, the
/// sufficient condition of Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238). Slopes that
/// are not given are taken from the cubic through the four nearest nodes. With node spacing h their
/// error is O(h³), which keeps the errors that exact slopes give: O(h⁴) for y, O(h³) for y', O(h²)
/// for y''. Steffen's three-point slopes lose one power of h in each.
class MonotoneHermite {
 public:
  struct Point {
    double value, slope, curvature;
  };

  /// x: nodes, strictly increasing, at least four; slopes: empty, or one for each node.
  MonotoneHermite(std::vector<double> x, std::vector<double> y, std::vector<double> slopes = {});

  double front() const { return x_.front(); }
  double back() const { return x_.back(); }
  const std::vector<double>& nodes() const { return x_; }
  /// y, y', y'' at x in [front, back]. At a node y'' belongs to the interval above it.
  Point at(double x) const;
  /// The point at x on the interval between node i and node i + 1, without a search.
  Point on(std::size_t i, double x) const;
  /// Returns x with y(x) = value, to round-off in x, for increasing y and value in [y(front),
  /// y(back)].
  double where(double value) const;

 private:
  std::vector<double> x_, y_, slopes_;
};

}  // namespace salebra::detail
