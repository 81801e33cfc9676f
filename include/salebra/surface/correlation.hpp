// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/surface/axis.hpp>
#include <vector>

namespace salebra {

/// Correlation functions of a surface: means over all pairs of defined points at a distance vector
/// r, up to half the surface along each axis (a non-periodic surface has few pairs beyond, and a
/// periodic one repeats itself):
///     autocorrelation  A(r) = ⟨(h(x) − ⟨h⟩)(h(x+r) − ⟨h⟩)⟩,  ⟨h⟩ the mean of all defined points
///     structure        S(r) = ⟨(h(x+r) − h(x))²⟩, also called height-height correlation function
/// On a complete periodic surface S = 2(A(0) − A(r)). Otherwise prefer S, which does not depend on
/// the mean. The function called autocorrelation in SurfaceTopography is S/2. Fields have the shape
/// (2·(nx/2)+1, ny/2+1): row nx/2 + i and column j >= 0 belong to r = (i·dx, j·dy). Negative y are
/// not stored, since A and S are even in r.
struct CorrelationMap {
  Grid2D grid;            ///< grid of the surface
  Field autocorrelation;  ///< A, m²; NaN if there is no pair
  Field structure;        ///< S, m²; NaN if there is no pair
  Field pairs;            ///< number of pairs

  Index origin() const { return grid.nx / 2; }  ///< row with lag 0 along x
  double lag_x(Index row) const { return static_cast<double>(row - origin()) * grid.dx(); }
  double lag_y(Index column) const { return static_cast<double>(column) * grid.dy(); }
};

constexpr void describe(auto&& visit, std::type_identity<CorrelationMap>) {
  using enum Dimension;
  using S = CorrelationMap;
  visit(&S::grid, Kept{"grid", "points and size of the surface"});
  visit(&S::autocorrelation,
        Kept{"autocorrelation", "A; NaN where there is no pair", length_squared});
  visit(&S::structure, Kept{"structure", "S; NaN where there is no pair", length_squared});
  visit(&S::pairs, Kept{"pairs", "number of pairs"});
}

/// Computes the correlation functions; undefined points are ignored:
///     const Correlation mean = radial_correlation(correlation_map(surface));
/// Throws InvalidInput wherever height_statistics does. Cost: two real FFTs of the grid for a
/// complete periodic surface; otherwise six real FFTs, with 1.5 times as many points along each
/// axis if the surface is not periodic.
CorrelationMap correlation_map(const Surface& surface);

/// Autocorrelation A and structure function S over distance. Every entry has at least one pair of
/// points, and the first entry is distance 0.
struct Correlation {
  std::vector<double> distance;         ///< m, increasing
  std::vector<double> autocorrelation;  ///< A, m²
  std::vector<double> structure;        ///< S, m²
  std::vector<double> pairs;            ///< number of pairs
};

constexpr void describe(auto&& visit, std::type_identity<Correlation>) {
  using enum Dimension;
  using S = Correlation;
  visit(&S::distance, Quantity{"distance", length, "distance of the points of a pair"});
  visit(&S::autocorrelation,
        Quantity{"autocorrelation", length_squared, "mean of h(x) h(x+r), h from the mean"});
  visit(&S::structure, Quantity{"structure", length_squared, "mean of (h(x+r) - h(x))^2"});
  visit(&S::pairs, Quantity{"pairs", dimensionless, "pairs in the mean"});
}

/// Returns A and S along one axis, as means over all profiles, at all multiples of the point
/// spacing.
Correlation profile_correlation(const CorrelationMap& map, Axis axis);

/// Returns A and S averaged over all directions, up to half the shorter side of the surface.
/// Distances are divided into rings whose limits have the ratio 2^(1/bins_per_octave); within a
/// ring, lags are weighted by their number of pairs. Empty rings are omitted.
Correlation radial_correlation(const CorrelationMap& map, int bins_per_octave = 4);

}  // namespace salebra
