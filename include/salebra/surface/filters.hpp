// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>

namespace salebra {

/// Cut-off wavelengths (nesting indices) of the Gaussian filters of ISO 16610-21 and -61, m. A wave
/// whose length is the cut-off keeps half of its amplitude.
struct GaussianFilters {
  /// The S-filter removes waves that are shorter; empty: no S-filter.
  std::optional<double> s_filter = {};
  /// The L-filter removes waves that are longer; empty: no L-filter.
  std::optional<double> l_filter = {};

  bool given() const { return s_filter || l_filter; }
};

constexpr void describe(auto&& visit, std::type_identity<GaussianFilters>) {
  using enum Dimension;
  using S = GaussianFilters;
  visit(&S::s_filter,
        Quantity{"s_filter", length, "cut-off of the S-filter, which removes shorter waves"});
  visit(&S::l_filter,
        Quantity{"l_filter", length, "cut-off of the L-filter, which removes longer waves"});
}

/// Returns the surface that the filters leave: first the S-filter smooths the heights, then the
/// L-filter subtracts its smooth surface. Remove tilt and form first:
///     const Surface rough = filtered(detrended(surface, Detrend::plane), {2.5e-6, 250e-6});
/// A filter with the cut-off λc weights the points at the distance (x, y) by
///     exp(−π(x² + y²)/(αλc)²),   α = √(ln 2/π),
/// i.e. a plane wave of length λ keeps the fraction 2^−(λc/λ)² of its amplitude. A periodic surface
/// is continued periodically. On any other surface, and around undefined points, the weights are
/// divided by their sum over the defined points (the zero-order Gaussian regression filter of ISO
/// 16610-28): a constant stays a constant up to the edge, while a slope g changes the smooth surface
/// at an edge by 0.15 λc g. Undefined points stay undefined. The results on the waves that the grid
/// carries are exact, also for short cut-offs.
/// throws  InvalidInput for a cut-off shorter than two cells or longer than the surface along an
///         axis with more than one point, for an s_filter that is not shorter than the l_filter, if
///         no height is defined, and for a surface that is distributed over processes
/// cost    for each filter one convolution, on a grid that is longer by 1.5 λc along each axis if
///         the surface is not periodic; two if it is not periodic or has undefined points
Surface filtered(Surface surface, const GaussianFilters& filters);

}  // namespace salebra
