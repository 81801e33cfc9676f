// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

#include "half_space.hpp"
#include "normal_symbol.hpp"

namespace salebra::detail {

// A stencil even in both axes: Σ weight(i, j) x(a + i, b + j) over |i|, |j| <= radius.
struct MultilevelStencil {
  int radius = 0;
  std::vector<double> weights;  // (radius + 1)², of i, j >= 0
  double weight(int i, int j) const;
};

// One level of a multilevel kernel G ≈ T + P C Pᵀ: T a stencil, P the interpolation of a cubic B-spline with
// taps (1 4 6 4 1)/8 along each axis from a grid of half as many cells, C a convolution there,
// which is the G of the next level.
struct MultilevelRung {
  MultilevelStencil stencil;
  // Bound of |G^−½ (T + P C Pᵀ − G) G^−½| over the frequencies looked at. The errors of levels add
  // up at most.
  double error = 0;
};

inline constexpr int max_intervals = 6;

// Stencils for cells of dx × dy with dx dy = 1 and E* = 1, the widest first. Each minimises the
// largest error over the frequencies of a grid of 512² cells: linear least squares with the best C,
// which is explicit, and weights raised where the error is large: Lawson's algorithm, Rice and Usow
// (1968). depth <= max_intervals. Cost: some milliseconds a level, once for each ratio of sides and
// boundary.
std::vector<MultilevelRung> multilevel_design(double dx_over_dy, Boundary boundary, int depth);

// A symbol, even along both axes, on a quarter of its period: (period_x/2 + 1, period_y/2 + 1).
struct QuarterSymbol {
  Index period_x = 0, period_y = 0;
  std::vector<double> value, metric;  // g, and 1/W, W the error that counts as one

  Index columns() const { return period_y / 2 + 1; }
  std::size_t index(Index i, Index j) const { return static_cast<std::size_t>(i * columns() + j); }
};

// C for the stencil given, on half the period, which must be even; periods are those of the finer
// grid:
//     C(Q) = ¼ Σ_k u_k² D_k/(Σ_k u_k²)²,  u_k² = v_k²/W_k,  D_k = (g_k − T(θ_k))/W_k,  v = cos⁴(θ_x/2) cos⁴(θ_y/2)
// over the four frequencies θ_k that look the same on the coarser grid, W_k = |g_k|. C(0) = (g(0) −
// T(0))/4, which takes a constant to where G takes it.
// Each process makes its columns and gets those of all. Collective.
QuarterSymbol coarse_symbol(const NormalSymbol& fine, const MultilevelStencil& stencil,
                            const Communicator& communicator);
QuarterSymbol coarse_symbol(const QuarterSymbol& fine, const MultilevelStencil& stencil);

}  // namespace salebra::detail
