// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <salebra/base/grid.hpp>

/// The wave vectors of a half-spectrum (nx, ny/2+1).
namespace salebra::detail {

/// q of index i along an axis of n points and length l, rad/m; −π/dx < q <= π/dx.
inline double wavenumber(Index i, Index n, double length) {
  return 2 * std::numbers::pi * static_cast<double>(2 * i <= n ? i : i - n) / length;
}

/// How often a mode of the half-spectrum stands in the full one: the columns j = 0 and, for even
/// ny, j = ny/2 hold their own conjugates.
inline double multiplicity(Index j, Index ny) { return j == 0 || 2 * j == ny ? 1.0 : 2.0; }

}  // namespace salebra::detail
