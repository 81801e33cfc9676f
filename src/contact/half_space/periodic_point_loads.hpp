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

/// Displacements of a half-space under point forces that repeat with the periods lx, ly, relative
/// to the mean plane:
///     u_i = Σ_j G(x_i − x_j) P_j,   G = (1/(lx ly)) Σ_{q≠0} (2/q) exp(iq·x)   for E* = 1,
/// the force's own 1/(πr) left out at its own place (what its images do there stays). By Ewald's
/// split 1/r = erfc(αr)/r + erf(αr)/r: neighbours in a list, the rest on a grid through a smooth
/// window and an FFT (the "exponential of semicircle" of Barnett, Magland, af Klinteberg, SIAM J.
/// Sci. Comput. 41 (2019) C479), to some 1e-9 of the greatest displacement. Symmetric. Cost of
/// apply: N log N, about 0.5 µs a point; of construction ten times as much; memory about 1 kB a
/// point.
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
  /// Where the window of a point begins on the grid; its weights are in weights_.
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
  double split_ = 0;       ///< α
  double self_ = 0;        ///< of the grid part, which knows no own place
  double background_ = 0;  ///< mean of the short-range part, taken off
  std::vector<Pair> pairs_;
  Index nx_ = 0, ny_ = 0;
  std::vector<Window> windows_;
  std::vector<double> weights_;  ///< of each point, first along x, then along y
  std::unique_ptr<RealFft2D<double>> fft_;
  std::vector<double> field_, symbol_;
  std::vector<std::complex<double>> modes_;
};

}  // namespace salebra::detail
