// SPDX-License-Identifier: GPL-3.0-or-later
// Analytic surfaces: paraboloid, sphere, cone, wedge, punches, pyramids, sinusoid.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/shapes.hpp>
#include <string>

#include "base/memory.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

template <class Height>
Surface surface_of(const Grid2D& grid, const std::string& name, bool periodic,
                   const Height& height) {
  Field heights = uninitialised_field(grid.nx, grid.ny);
  parallel::for_slabs(grid.nx, [&](Index begin, Index end) {
    for (Index ix = begin; ix < end; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy)
        heights(ix, iy) =
            height(static_cast<double>(ix) * grid.dx(), static_cast<double>(iy) * grid.dy());
  });
  return {grid, std::move(heights), periodic, name};
}

// A body whose surface has the heights height(x, y), where x and y count from the axis of the body.
template <class Height>
Surface body(const Grid2D& grid, const std::string& name, const ShapeCenter& center,
             const Height& height) {
  grid.validate();
  const PlanePoint axis = center.value_or(PlanePoint{grid.lx / 2, grid.ly / 2});
  require(std::isfinite(axis.x), "center.x", axis.x, "must be finite");
  require(std::isfinite(axis.y), "center.y", axis.y, "must be finite");
  return surface_of(grid, name, false,
                    [&](double x, double y) { return height(x - axis.x, y - axis.y); });
}

double checked_slope(double angle) {
  require(angle > 0 && angle < pi / 2, "angle", angle, "must lie in 0 < angle < pi/2 (rad)");
  return std::tan(angle);
}

}  // namespace

PlanePoint off_grid_center(const Grid2D& grid) {
  return {grid.lx / 2 + 0.31 * grid.dx(), grid.ly / 2 + 0.17 * grid.dy()};
}

Surface elliptic_paraboloid_surface(const Grid2D& grid, double radius_x, double radius_y,
                                    const ShapeCenter& center) {
  require_positive(radius_x, "radius_x");
  require_positive(radius_y, "radius_y");
  return body(grid, "elliptic paraboloid", center,
              [=](double x, double y) { return -x * x / (2 * radius_x) - y * y / (2 * radius_y); });
}

Surface paraboloid_surface(const Grid2D& grid, double radius, const ShapeCenter& center) {
  require_positive(radius, "radius");
  return body(grid, "paraboloid", center,
              [=](double x, double y) { return -(x * x + y * y) / (2 * radius); });
}

Surface ellipsoid_surface(const Grid2D& grid, double semi_x, double semi_y, double semi_z,
                          const ShapeCenter& center) {
  require_positive(semi_x, "semi_x");
  require_positive(semi_y, "semi_y");
  require_positive(semi_z, "semi_z");
  return body(grid, "ellipsoid", center, [=](double x, double y) {
    const double square = std::pow(x / semi_x, 2) + std::pow(y / semi_y, 2);
    // With s the squared relative distance from the axis, √(1−s) − 1 = −s/(1 + √(1−s)) avoids
    // cancellation near the apex.
    return square >= 1 ? -semi_z : -semi_z * square / (1 + std::sqrt(1 - square));
  });
}

Surface sphere_surface(const Grid2D& grid, double radius, const ShapeCenter& center) {
  require_positive(radius, "radius");
  Surface sphere = ellipsoid_surface(grid, radius, radius, radius, center);
  sphere.origin = "sphere";
  return sphere;
}

Surface cone_surface(const Grid2D& grid, double angle, const ShapeCenter& center) {
  const double slope = checked_slope(angle);
  return body(grid, "cone", center, [=](double x, double y) { return -slope * std::hypot(x, y); });
}

Surface wedge_surface(const Grid2D& grid, double angle, const ShapeCenter& center) {
  const double slope = checked_slope(angle);
  return body(grid, "wedge", center, [=](double x, double) { return -slope * std::abs(x); });
}

Surface ridge_surface(const Grid2D& grid, double radius, const ShapeCenter& center) {
  require_positive(radius, "radius");
  return body(grid, "ridge", center, [=](double x, double) { return -x * x / (2 * radius); });
}

Surface flat_punch_surface(const Grid2D& grid, double radius, double depth,
                           const ShapeCenter& center) {
  require_positive(radius, "radius");
  require_positive(depth, "depth");
  return body(grid, "flat punch", center,
              [=](double x, double y) { return std::hypot(x, y) <= radius ? 0 : -depth; });
}

Surface rounded_punch_surface(const Grid2D& grid, double flat_radius, double edge_radius,
                              const ShapeCenter& center) {
  require_positive(flat_radius, "flat_radius");
  require_positive(edge_radius, "edge_radius");
  return body(grid, "rounded punch", center, [=](double x, double y) {
    const double beyond = std::max(std::hypot(x, y) - flat_radius, 0.0);
    return -beyond * beyond / (2 * edge_radius);
  });
}

Surface pyramids_surface(const Grid2D& grid, Index count_x, Index count_y, double angle,
                         const PlanePoint& shift) {
  grid.validate();
  require(count_x >= 1 && 2 * count_x <= grid.nx, "count_x", count_x,
          "must lie in 1 … nx/2, at least two points a pyramid");
  require(count_y >= 1 && 2 * count_y <= grid.ny, "count_y", count_y,
          "must lie in 1 … ny/2, at least two points a pyramid");
  const double slope = checked_slope(angle);
  const double tile_x = grid.lx / static_cast<double>(count_x);
  const double tile_y = grid.ly / static_cast<double>(count_y);
  // std::remainder gives the signed distance from the axis of the nearest pyramid.
  return surface_of(grid, "pyramids", true, [=](double x, double y) {
    const double from_axis_x = std::remainder(x - shift.x - tile_x / 2, tile_x);
    const double from_axis_y = std::remainder(y - shift.y - tile_y / 2, tile_y);
    return -slope * std::max(std::abs(from_axis_x), std::abs(from_axis_y));
  });
}

Surface sinusoid_surface(const Grid2D& grid, double amplitude, Index waves_x, Index waves_y,
                         const PlanePoint& shift) {
  grid.validate();
  require_positive(amplitude, "amplitude");
  require(waves_x >= 0 && 4 * waves_x <= grid.nx, "waves_x", waves_x, "must lie in 0 … nx/4");
  require(waves_y >= 0 && 4 * waves_y <= grid.ny, "waves_y", waves_y, "must lie in 0 … ny/4");
  require(waves_x + waves_y > 0, "waves_x", waves_x, "and waves_y are both 0; give one of them");
  const double qx = 2 * pi * static_cast<double>(waves_x) / grid.lx;
  const double qy = 2 * pi * static_cast<double>(waves_y) / grid.ly;
  return surface_of(grid, "sinusoid", true, [=](double x, double y) {
    return amplitude * std::cos(qx * (x - shift.x)) * std::cos(qy * (y - shift.y));
  });
}

}  // namespace salebra
