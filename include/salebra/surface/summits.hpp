// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/describe.hpp>
#include <salebra/base/grid.hpp>
#include <vector>

namespace salebra {

/// A local maximum with its osculating paraboloid.
struct Summit {
  double x = 0;           ///< m; vertex of the paraboloid, within one cell of the highest point
  double y = 0;           ///< m
  double height = 0;      ///< height of the vertex, m, in the heights of the surface
  double curvature1 = 0;  ///< the larger principal curvature, 1/m; > 0
  double curvature2 = 0;  ///< the smaller principal curvature, 1/m; >= 0

  double mean_radius() const { return 2 / (curvature1 + curvature2); }  ///< 1/(mean curvature), m
};

constexpr void describe(auto&& visit, std::type_identity<Summit>) {
  using enum Dimension;
  using S = Summit;
  visit(&S::x, Quantity{"x", length, "position along x"});
  visit(&S::y, Quantity{"y", length, "position along y"});
  visit(&S::height, Kept{"height", "height from the zero of the heights", length});
  visit(&S::curvature1, Kept{"curvature1", "larger principal curvature", inverse_length});
  visit(&S::curvature2, Kept{"curvature2", "smaller principal curvature", inverse_length});
  visit(&S::mean_radius, Kept{"mean_radius", "one over the mean curvature", length});
}

/// Summits of a surface; if it is distributed, each process has those of its rows.
struct SummitList {
  std::vector<Summit> summits;
  /// Area, m², of the cells (of all processes) whose eight neighbours exist and are defined.
  double searched_area = 0;
  Communicator communicator = {};
  Index rows = 0;                    ///< rows of the surface; 0 if there is no surface
  std::vector<Index> in_block = {};  ///< number of summits in each block of rows
};

constexpr void describe(auto&& visit, std::type_identity<SummitList>) {
  using S = SummitList;
  visit(&S::summits, Table{"summits", "in the order of their rows"});
  visit(&S::searched_area,
        Kept{"searched_area", "cells whose eight neighbours exist and are defined",
             Dimension::length_squared});
  visit(&S::communicator, Kept{});
  visit(&S::rows, Kept{});
  visit(&S::in_block, Kept{});
}

/// Finds the summits, the points higher than their eight neighbours:
///     const SummitStatistics statistics = summit_statistics(find_summits(surface));
/// If neighbouring points are equally high, the last one in row order counts as the highest, so
/// that a pair of equal points is one summit. The paraboloid is the least-squares fit to the point
/// and its neighbours (3 × 3 points). If this fit is not a cap with its vertex within one cell,
/// which happens with structure at the scale of the grid, the point itself and its second
/// differences along x and y are used instead. Points without any curvature are not summits. On a
/// periodic surface neighbours are found across the border; otherwise points on the border are not
/// searched. Neighbours of undefined points are never searched. Throws InvalidInput for fewer than
/// 3 × 3 points. Cost: one pass over the heights. Collective.
SummitList find_summits(const Surface& surface);

/// Summit statistics for the Greenwood–Williamson theory.
struct SummitStatistics {
  double summit_density = 0;  ///< summits per searched area, 1/m²
  double mean_height = 0;     ///< mean height of the summits, m; NaN without summits
  double rms_height = 0;      ///< standard deviation of the summit heights, m; NaN without summits
  double mean_radius =
      0;  ///< 1/⟨mean curvature⟩, m, which is (3/8)√(π/m4) for a Gaussian isotropic surface
};

constexpr void describe(auto&& visit, std::type_identity<SummitStatistics>) {
  using enum Dimension;
  using S = SummitStatistics;
  visit(&S::summit_density, Quantity{"summit_density", inverse_length_squared, "summits per area"});
  visit(&S::mean_height,
        Quantity{"mean_height", length, "mean summit height above the mean plane"});
  visit(&S::rms_height, Quantity{"summit_rms", length, "standard deviation of summit heights"});
  visit(&S::mean_radius, Quantity{"mean_radius", length, "mean radius of summits"});
}

/// Computes the statistics. Collective; same bits for any number of threads and processes.
SummitStatistics summit_statistics(const SummitList& list);

}  // namespace salebra
