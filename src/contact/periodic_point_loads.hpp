// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstdint>
#include <memory>
#include <salebra/base/fft.hpp>
#include <span>
#include <vector>

namespace salebra::detail {

struct PlanePoint {
  double x, y;
};

/// Displacements of a half-space under point forces that repeat with the periods lx, ly, relative to the mean plane:
///     u_i = Σ_j G(x_i − x_j) P_j,   G = (1/(lx ly)) Σ_{q≠0} (2/q) exp(iq·x)   for E* = 1,
/// the force's own 1/(πr) left out at its own place (what its images do there stays). By Ewald's split 1/r = erfc(αr)/r + erf(αr)/r:
/// neighbours in a list, the rest on a grid through Gaussians and an FFT, to a relative 1e-9 of the greatest displacement.
/// Symmetric. Cost of apply: N log N; memory about 1.3 kB a point.
class PeriodicPointLoads {
 public:
  /// Points anywhere; they are wrapped. At least one.
  PeriodicPointLoads(std::vector<PlanePoint> points, double lx, double ly);

  /// displacements may not be loads. Not from two threads at once.
  void apply(std::span<const double> loads, std::span<double> displacements);

 private:
  struct Pair {
    std::uint32_t first, second;
    double kernel;
  };
  void find_pairs(double cutoff);

  std::vector<PlanePoint> points_;
  double lx_, ly_;
  double split_ = 0;       ///< α
  double self_ = 0;        ///< of the grid part, which knows no own place
  double background_ = 0;  ///< mean of the short-range part, taken off
  std::vector<Pair> pairs_;
  Index nx_ = 0, ny_ = 0;
  double width_ = 0;  ///< τ of exp(−r²/4τ), r in cells
  std::unique_ptr<RealFft2D<double>> fft_;
  std::vector<double> field_, symbol_;
  std::vector<std::complex<double>> modes_;
};

}  // namespace salebra::detail
