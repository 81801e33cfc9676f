// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/fft.hpp"

namespace salebra::detail {

struct PlanePoint {
  double x, y;
};

/// Displacements u_i of a half-space at the points x_i under point forces P_j at x_j that repeat
/// with the periods lx and ly, relative to the mean plane, for E* = 1:
///     u_i = Σ_j G(x_i − x_j) P_j,   G(x) = (1/(lx ly)) Σ_{q≠0} (2/q) exp(iq·x),
/// summed over the wave vectors q of length q. The displacement 1/(πr) by a force at its own
/// position is left out; that by its periodic images stays. Ewald's split 1/r = erfc(αr)/r +
/// erf(αr)/r: the first part is summed over a list of neighbours, and the second goes onto a grid
/// through a smooth window and an FFT (the "exponential of semicircle" of Barnett, Magland, af
/// Klinteberg, SIAM J. Sci. Comput. 41 (2019) C479). The error is about 1e-9 of the largest
/// displacement. The matrix of G is symmetric. Cost of apply() for N points: N log N, about 0.5 µs
/// per point; construction takes ten times as long; memory about 1 kB per point.
class PeriodicPointLoads {
 public:
  /// points: at least one; points outside the period are wrapped into it.
  PeriodicPointLoads(std::vector<PlanePoint> points, double lx, double ly);

  /// loads and displacements must not overlap in memory. Only one thread at a time may call it.
  void apply(std::span<const double> loads, std::span<double> displacements);

 private:
  struct Pair {
    std::uint32_t first, second;
    double kernel;
  };
  /// First grid node of the window of a point; the weights of its nodes are in weights_.
  struct Window {
    Index row, column;
  };
  void find_pairs(const std::vector<PlanePoint>& points, double cutoff);
  void place_windows(const std::vector<PlanePoint>& points);
  void set_symbol();
  template <class AtRow>
  void visit(std::size_t point, const AtRow& at_row);

  std::size_t count_;
  double lx_, ly_;
  double split_ = 0;       ///< Ewald's parameter α, 1/m
  double self_ = 0;        ///< grid displacement by a force at its own position
  double background_ = 0;  ///< mean of the short-range part, which is subtracted
  std::vector<Pair> pairs_;
  Index nx_ = 0, ny_ = 0;
  std::vector<Window> windows_;
  std::vector<double> weights_;  ///< of each point, first along x, then along y
  std::unique_ptr<RealFft2D<double>> fft_;
  std::vector<double> field_, symbol_;
  std::vector<std::complex<double>> modes_;
};

}  // namespace salebra::detail
