// SPDX-License-Identifier: GPL-3.0-or-later
// Bindings of analytic shapes.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>

#include <salebra/generators/shapes.hpp>
#include <utility>

#include "bindings.hpp"
#include "interop/surface.hpp"

namespace salebra::python {
namespace {

using Point = std::pair<double, double>;

ShapeCenter center_of(const std::optional<Point>& center) {
  if (!center) return {};
  return PlanePoint{center->first, center->second};
}

}  // namespace

void bind_shapes(nb::module_& m) {
  const auto center = [] { return nb::arg("center") = nb::none(); };
  m.def(
      "off_grid_center",
      [](const Grid2D& grid) {
        const PlanePoint point = off_grid_center(grid);
        return Point{point.x, point.y};
      },
      nb::arg("grid"),
      "The middle of the grid moved by (0.31, 0.17) of a cell, (x, y) in m: off the grid the "
      "contact area of a symmetric body does "
      "not jump by many cells at a time.");
  m.def(
      "paraboloid_surface",
      [](const Grid2D& grid, double radius, std::optional<Point> at) {
        return new_surface(paraboloid_surface(grid, radius, center_of(at)));
      },
      nb::arg("grid"), nb::arg("radius"), center(), "h = −r²/(2 radius), m.");
  m.def(
      "elliptic_paraboloid_surface",
      [](const Grid2D& grid, double radius_x, double radius_y, std::optional<Point> at) {
        return new_surface(elliptic_paraboloid_surface(grid, radius_x, radius_y, center_of(at)));
      },
      nb::arg("grid"), nb::arg("radius_x"), nb::arg("radius_y"), center(),
      "h = −x²/(2 radius_x) − y²/(2 radius_y), m.");
  m.def(
      "sphere_surface",
      [](const Grid2D& grid, double radius, std::optional<Point> at) {
        return new_surface(sphere_surface(grid, radius, center_of(at)));
      },
      nb::arg("grid"), nb::arg("radius"), center(),
      "The upper half of a sphere, h = √(radius² − r²) − radius, and −radius outside of it, m.");
  m.def(
      "ellipsoid_surface",
      [](const Grid2D& grid, double semi_x, double semi_y, double semi_z, std::optional<Point> at) {
        return new_surface(ellipsoid_surface(grid, semi_x, semi_y, semi_z, center_of(at)));
      },
      nb::arg("grid"), nb::arg("semi_x"), nb::arg("semi_y"), nb::arg("semi_z"), center(),
      "The upper half of an ellipsoid of the given semi-axes, m.");
  m.def(
      "cone_surface",
      [](const Grid2D& grid, double angle, std::optional<Point> at) {
        return new_surface(cone_surface(grid, angle, center_of(at)));
      },
      nb::arg("grid"), nb::arg("angle"), center(),
      "h = −r tan(angle), angle between flank and plane, rad.");
  m.def(
      "wedge_surface",
      [](const Grid2D& grid, double angle, std::optional<Point> at) {
        return new_surface(wedge_surface(grid, angle, center_of(at)));
      },
      nb::arg("grid"), nb::arg("angle"), center(), "``h = −|x| tan(angle)``: an edge along y.");
  m.def(
      "ridge_surface",
      [](const Grid2D& grid, double radius, std::optional<Point> at) {
        return new_surface(ridge_surface(grid, radius, center_of(at)));
      },
      nb::arg("grid"), nb::arg("radius"), center(),
      "h = −x²/(2 radius): a cylinder lying along y.");
  m.def(
      "flat_punch_surface",
      [](const Grid2D& grid, double radius, double depth, std::optional<Point> at) {
        return new_surface(flat_punch_surface(grid, radius, depth, center_of(at)));
      },
      nb::arg("grid"), nb::arg("radius"), nb::arg("depth"), center(),
      "A standing cylinder with a sharp edge: h = 0 for r <= radius, −depth outside, m.");
  m.def(
      "rounded_punch_surface",
      [](const Grid2D& grid, double flat_radius, double edge_radius, std::optional<Point> at) {
        return new_surface(rounded_punch_surface(grid, flat_radius, edge_radius, center_of(at)));
      },
      nb::arg("grid"), nb::arg("flat_radius"), nb::arg("edge_radius"), center(),
      "A standing cylinder with a rounded edge, m.");
  m.def(
      "pyramids_surface",
      [](const Grid2D& grid, Index count_x, Index count_y, double angle, const Point& shift) {
        return new_surface(
            pyramids_surface(grid, count_x, count_y, angle, {shift.first, shift.second}));
      },
      nb::arg("grid"), nb::arg("count_x"), nb::arg("count_y"), nb::arg("angle"),
      nb::arg("shift") = nb::make_tuple(0.0, 0.0),
      "count_x × count_y equal pyramids side by side, ``h = −tan(angle)·max(|x|, |y|)``. "
      "Periodic.");
  m.def(
      "sinusoid_surface",
      [](const Grid2D& grid, double amplitude, Index waves_x, Index waves_y, const Point& shift) {
        return new_surface(
            sinusoid_surface(grid, amplitude, waves_x, waves_y, {shift.first, shift.second}));
      },
      nb::arg("grid"), nb::arg("amplitude"), nb::arg("waves_x"), nb::arg("waves_y"),
      nb::arg("shift") = nb::make_tuple(0.0, 0.0),
      "h = amplitude·cos(2π waves_x x/lx)·cos(2π waves_y y/ly). Periodic.");
}

}  // namespace salebra::python
