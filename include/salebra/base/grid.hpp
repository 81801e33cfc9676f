// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <salebra/base/communicator.hpp>
#include <salebra/base/describe.hpp>
#include <string>

namespace salebra {

using Index = Eigen::Index;

/// Scalar field on a Grid2D: (nx, ny), x first, y contiguous, so that field(ix, iy) is the value in
/// cell (ix, iy).
using Field = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Regular grid of nx × ny cells on a rectangle of lx × ly metres:
///     const Grid2D grid{512, 512, 1e-4, 1e-4};
/// Point (ix, iy) is at x = ix·dx, y = iy·dy; lx = nx·dx is the period of a periodic surface.
struct Grid2D {
  Index nx = 0;
  Index ny = 0;
  double lx = 0;  ///< m
  double ly = 0;  ///< m

  double dx() const { return lx / static_cast<double>(nx); }
  double dy() const { return ly / static_cast<double>(ny); }
  Index points() const { return nx * ny; }
  double area() const { return lx * ly; }           ///< m²
  double cell_area() const { return dx() * dy(); }  ///< m²
  bool operator==(const Grid2D&) const = default;

  /// Throws InvalidInput unless nx, ny >= 1 and lx, ly are finite and > 0.
  void validate() const;
};

constexpr void describe(auto&& visit, std::type_identity<Grid2D>) {
  using enum Dimension;
  visit(&Grid2D::nx, Quantity{"nx", dimensionless, "points along x"});
  visit(&Grid2D::ny, Quantity{"ny", dimensionless, "points along y"});
  visit(&Grid2D::lx, Quantity{"size_x", length, "length of the surface along x"});
  visit(&Grid2D::ly, Quantity{"size_y", length, "length of the surface along y"});
}

class RowPartition;

/// Heights of the rough side, e.g. `Surface{grid, heights}`. A hill is positive; hills touch first.
/// If a surface is distributed over processes, `grid` is the whole grid, while `heights` has only
/// the rows of this process, as given by partition(). Functions that accept distributed surfaces
/// say so; all other functions throw.
struct Surface {
  Grid2D grid;
  Field heights;          ///< (nx, ny) or (partition().count(), ny), m; NaN: undefined point
  bool periodic = false;  ///< whether the surface repeats along x and y
  std::string origin;     ///< file, or generator with its seed; for provenance only
  Communicator communicator = {};  ///< processes that share the rows

  /// Returns the distribution of rows over processes.
  RowPartition partition() const;
  /// Returns the number of NaN heights in this process. Cost: one pass over the heights.
  Index undefined_points() const;
  /// Throws InvalidInput if the surface is distributed. `purpose` is a noun for the message "is
  /// spread over 4 processes, and <purpose> needs it whole".
  void require_whole(const std::string& purpose) const;
  /// Calls require_whole(), and throws InvalidInput unless the grid is valid, `heights` has the
  /// shape of the grid and every height is finite. `purpose` is a noun for the message "undefined
  /// points cannot be used in <purpose>".
  void require_complete(const std::string& purpose) const;
  /// Like require_complete(), but accepts a distributed surface and checks the rows of this
  /// process.
  void require_complete_rows(const std::string& purpose) const;
};

constexpr void describe(auto&& visit, std::type_identity<Surface>) {
  using enum Dimension;
  using S = Surface;
  visit(&S::grid, Part{"grid", "points and size"});
  visit(&S::heights, Quantity{"heights", length, "height, positive out of the material"});
  visit(&S::periodic, Quantity{"periodic", dimensionless, "whether the surface repeats itself"});
  visit(&S::origin, Kept{"origin", "file, or generator with its seed"});
  visit(&S::communicator, Kept{});
  visit(&S::undefined_points,
        Quantity{"undefined_points", dimensionless, "points without a height"});
}

}  // namespace salebra
