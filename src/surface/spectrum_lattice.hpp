// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <salebra/base/grid.hpp>

/// The wave vectors of a half-spectrum (nx, ny/2+1).
namespace salebra::detail {

/// Wave number q of mode i along an axis of n points and length l, rad/m; −π/dx < q <= π/dx with dx
/// = l/n.
inline double wavenumber(Index i, Index n, double length) {
  return 2 * std::numbers::pi * static_cast<double>(2 * i <= n ? i : i - n) / length;
}

/// Number of modes of the full spectrum that a mode of the half-spectrum represents: 1 in the
/// columns j = 0 and, for even ny, j = ny/2, which contain their own conjugates, and 2 elsewhere.
inline double multiplicity(Index j, Index ny) { return j == 0 || 2 * j == ny ? 1.0 : 2.0; }

}  // namespace salebra::detail
