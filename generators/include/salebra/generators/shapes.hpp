// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>

/// Surfaces given by a formula, e.g. a sphere with a radius of 1 mm:
///     const Surface sphere = sphere_surface(grid, 1e-3, off_grid_center(grid));
/// A single body is a hill whose highest point has the height 0, with negative heights elsewhere;
/// it is not periodic. Lengths in m, angles in rad. Each function throws InvalidInput unless the
/// grid is valid and the lengths are > 0. Cost: one pass.
namespace salebra {

/// A point in the plane, m.
struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// Position of the axis of a body; by default the middle of the grid, (lx/2, ly/2).
using ShapeCenter = std::optional<PlanePoint>;

/// Returns the middle of the grid shifted by (0.31, 0.17) of a cell. The contact area of a body
/// symmetric to the grid jumps by many cells at a time; off the grid the area-dependent error is
/// 5–20 times smaller (docs/theory.md, section 7).
PlanePoint off_grid_center(const Grid2D& grid);

/// h = −r²/(2 radius).
Surface paraboloid_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// h = −x²/(2 radius_x) − y²/(2 radius_y).
Surface elliptic_paraboloid_surface(const Grid2D& grid, double radius_x, double radius_y,
                                    const ShapeCenter& center = {});

/// The upper half of a sphere, h = √(radius² − r²) − radius, and −radius outside of it.
Surface sphere_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// The upper half of an ellipsoid of the given semi-axes, and −semi_z outside of it.
Surface ellipsoid_surface(const Grid2D& grid, double semi_x, double semi_y, double semi_z,
                          const ShapeCenter& center = {});

/// h = −r tan(angle), angle between flank and plane in (0, π/2).
Surface cone_surface(const Grid2D& grid, double angle, const ShapeCenter& center = {});

/// h = −|x| tan(angle): an edge along y.
Surface wedge_surface(const Grid2D& grid, double angle, const ShapeCenter& center = {});

/// h = −x²/(2 radius): a cylinder lying along y, in the parabolic approximation.
Surface ridge_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// An upright cylinder with a sharp edge: h = 0 for r <= radius, −depth outside.
Surface flat_punch_surface(const Grid2D& grid, double radius, double depth,
                           const ShapeCenter& center = {});

/// An upright cylinder with a rounded edge: h = 0 for r <= flat_radius, −(r − flat_radius)²/(2
/// edge_radius) outside.
Surface rounded_punch_surface(const Grid2D& grid, double flat_radius, double edge_radius,
                              const ShapeCenter& center = {});

/// An array of count_x × count_y equal pyramids, h = −tan(angle)·max(|x|, |y|) from the axis of
/// each. Periodic. Each is in the middle of its rectangle lx/count_x × ly/count_y; `shift` moves
/// them all.
Surface pyramids_surface(const Grid2D& grid, Index count_x, Index count_y, double angle,
                         const PlanePoint& shift = {});

/// h = amplitude · cos(2π waves_x (x − shift.x)/lx) · cos(2π waves_y (y − shift.y)/ly). Periodic.
/// waves_y = 0 gives straight waves, waves_y much smaller than waves_x elongated hills. Throws
/// unless waves_x, waves_y >= 0 have at least four points per wave and are not both 0.
Surface sinusoid_surface(const Grid2D& grid, double amplitude, Index waves_x, Index waves_y,
                         const PlanePoint& shift = {});

}  // namespace salebra
