// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/grid.hpp>
#include <vector>

#include "half_space.hpp"
#include "normal_symbol.hpp"

namespace salebra::detail {

// A stencil that is even along both axes: at cell (a, b) of a field x it gives Σ weight(i, j) x(a +
// i, b + j) over |i|, |j| <= radius.
struct MultilevelStencil {
  int radius = 0;
  std::vector<double> weights;  // (radius + 1)² weights for i, j >= 0
  double weight(int i, int j) const;
};

// One level of a multilevel kernel that approximates the normal compliance G ≈ T + P C Pᵀ: T is a
// stencil, P interpolates from a grid of half as many cells along each axis by a cubic B-spline
// with the weights (1 4 6 4 1)/8 along each axis, and C is a convolution on that grid, which the
// next level approximates in turn.
struct MultilevelRung {
  MultilevelStencil stencil;
  // Bound of |G^−½ (T + P C Pᵀ − G) G^−½| over the sampled frequencies. The error of a kernel is at
  // most the sum of the errors of its levels.
  double error = 0;
};

inline constexpr int max_intervals = 6;

// Stencils for cells of dx × dy with dx dy = 1 and E* = 1, for the finest level first. Each
// minimises the largest error over the frequencies of a grid of 512² cells: linear least squares
// with the best symbol C of the coarser grid, which is explicit, repeated with larger weights where
// the error is large (Lawson's algorithm, Rice and Usow (1968)). depth: number of levels, <=
// max_intervals. Cost: none for square cells and depth <= 4, which are tabulated; otherwise some
// milliseconds per level, once for each ratio of sides and boundary.
std::vector<MultilevelRung> multilevel_design(double dx_over_dy, Boundary boundary, int depth);

// The symbol of a kernel that is even along both axes, on a quarter of its period: (period_x/2 + 1,
// period_y/2 + 1) values.
struct QuarterSymbol {
  Index period_x = 0, period_y = 0;
  std::vector<double> value, metric;  // symbol g; 1/W, where an error W counts as 1

  Index columns() const { return period_y / 2 + 1; }
  std::size_t index(Index i, Index j) const { return static_cast<std::size_t>(i * columns() + j); }
};

// Computes the symbol C that a stencil with transform T leaves for a grid of half as many cells
// along each axis; the periods of `fine` must be even. Four frequencies θ_k of the finer grid
// coincide as one frequency Q of the coarser grid. With the symbol g_k at θ_k and W_k = |g_k|,
//     C(Q) = ¼ Σ_k u_k² D_k/(Σ_k u_k²)²,  u_k² = v_k²/W_k,  D_k = (g_k − T(θ_k))/W_k,
//     v_k = cos⁴(θ_x/2) cos⁴(θ_y/2) at θ_k = (θ_x, θ_y).
// C(0) = (g(0) − T(0))/4, so that a constant pressure has its exact displacement. Each process
// computes its own columns and receives all others. Collective.
QuarterSymbol coarse_symbol(const NormalSymbol& fine, const MultilevelStencil& stencil,
                            const Communicator& communicator);
QuarterSymbol coarse_symbol(const QuarterSymbol& fine, const MultilevelStencil& stencil);

}  // namespace salebra::detail
