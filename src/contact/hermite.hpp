// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace salebra::detail {

/// Piecewise cubic through (x_i, y_i) with given or estimated slopes, limited so that it grows or
/// falls wherever the data do (0 <= slope/secant <= 3 on both sides, the sufficient condition of
/// Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238). Slopes that are not given are those of
/// the cubic through the four nearest nodes: with their O(h³) error the interpolant keeps the order
/// of one with exact slopes, 4 for y, 3 for y', 2 for y'' — Steffen's three-point slopes lose one
/// in each.
class MonotoneHermite {
 public:
  struct Point {
    double value, slope, curvature;
  };

  /// x strictly increasing, at least four nodes; slopes empty or one for each node.
  MonotoneHermite(std::vector<double> x, std::vector<double> y, std::vector<double> slopes = {});

  double front() const { return x_.front(); }
  double back() const { return x_.back(); }
  const std::vector<double>& nodes() const { return x_; }
  /// y, y', y'' at x in [front, back]. At a node y'' belongs to the interval above it.
  Point at(double x) const;
  /// The point on interval i, from node i to node i + 1: without the search.
  Point on(std::size_t i, double x) const;
  /// x with y(x) = value, for increasing y and value in [y(front), y(back)]; to round-off in x.
  double where(double value) const;

 private:
  std::vector<double> x_, y_, slopes_;
};

}  // namespace salebra::detail
