// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/grid.hpp>

/// Surfaces given by a formula, e.g. a sphere with a radius of 1 mm:
///     const Surface sphere = sphere_surface(grid, 1e-3, off_grid_center(grid));
/// A single body is a hill whose highest point has the height 0; all other heights are negative,
/// and the surface is not periodic. r is the distance from the axis of the body, x and y are
/// measured from it. Lengths in m, angles in rad. Each function throws InvalidInput unless the grid
/// is valid and the lengths are > 0. Cost: one pass over the points.
namespace salebra {

/// A point in the plane, m.
struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// Position of the axis of a body; by default the middle of the grid, (lx/2, ly/2).
using ShapeCenter = std::optional<PlanePoint>;

/// Returns the middle of the grid shifted by (0.31, 0.17) of a cell. If a body is symmetric to the
/// grid, its contact area grows by many cells at a time; with its axis at this point, errors due to
/// whole cells are 5 to 20 times smaller (docs/theory.md, section 7).
PlanePoint off_grid_center(const Grid2D& grid);

/// Paraboloid, h = −r²/(2 radius).
Surface paraboloid_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// Elliptic paraboloid, h = −x²/(2 radius_x) − y²/(2 radius_y).
Surface elliptic_paraboloid_surface(const Grid2D& grid, double radius_x, double radius_y,
                                    const ShapeCenter& center = {});

/// The upper half of a sphere, h = √(radius² − r²) − radius for r < radius; h = −radius outside.
Surface sphere_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// The upper half of an ellipsoid with the given semi-axes; h = −semi_z outside.
Surface ellipsoid_surface(const Grid2D& grid, double semi_x, double semi_y, double semi_z,
                          const ShapeCenter& center = {});

/// Cone, h = −r tan(angle); angle is between the flank and the plane, in (0, π/2).
Surface cone_surface(const Grid2D& grid, double angle, const ShapeCenter& center = {});

/// Wedge with its edge along y, h = −|x| tan(angle).
Surface wedge_surface(const Grid2D& grid, double angle, const ShapeCenter& center = {});

/// Cylinder lying along y, in the parabolic approximation h = −x²/(2 radius).
Surface ridge_surface(const Grid2D& grid, double radius, const ShapeCenter& center = {});

/// An upright cylinder with a sharp edge: h = 0 for r <= radius, −depth outside.
Surface flat_punch_surface(const Grid2D& grid, double radius, double depth,
                           const ShapeCenter& center = {});

/// An upright cylinder with a rounded edge: h = 0 for r <= flat_radius, −(r − flat_radius)²/(2
/// edge_radius) outside.
Surface rounded_punch_surface(const Grid2D& grid, double flat_radius, double edge_radius,
                              const ShapeCenter& center = {});

/// A periodic array of count_x × count_y equal pyramids, h = −tan(angle)·max(|x|, |y|) with x and y
/// measured from the axis of each pyramid. Each pyramid is in the middle of its rectangle
/// lx/count_x × ly/count_y; `shift` moves all pyramids.
Surface pyramids_surface(const Grid2D& grid, Index count_x, Index count_y, double angle,
                         const PlanePoint& shift = {});

/// Periodic waves, h = amplitude · cos(2π waves_x (x − shift.x)/lx) · cos(2π waves_y (y −
/// shift.y)/ly). waves_y = 0 gives straight waves; waves_y much smaller than waves_x gives
/// elongated hills. Throws unless waves_x, waves_y >= 0 have at least four points per wave and are
/// not both 0.
Surface sinusoid_surface(const Grid2D& grid, double amplitude, Index waves_x, Index waves_y,
                         const PlanePoint& shift = {});

}  // namespace salebra
