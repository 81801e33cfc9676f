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

/// Binds a generator make(grid, sizes…, center), with one size for each name in `argument`.
template <class Make, class... Argument>
void body(nb::module_& m, const char* name, Make make, const char* description,
          Argument... arguments) {
  m.def(
      name,
      [make](const Grid2D& grid, decltype(arguments, 0.0)... sizes,
             const std::optional<Point>& center) {
        ShapeCenter at;
        if (center) at = PlanePoint{center->first, center->second};
        return new_surface(make(grid, sizes..., at));
      },
      nb::arg("grid"), arguments..., nb::arg("center") = nb::none(), description);
}

}  // namespace

void bind_shapes(nb::module_& m) {
  m.def(
      "off_grid_center",
      [](const Grid2D& grid) {
        const PlanePoint point = off_grid_center(grid);
        return Point{point.x, point.y};
      },
      nb::arg("grid"),
      "The middle of the grid, moved by (0.31, 0.17) of a cell, as (x, y) in m. With such a centre "
      "the "
      "contact area of a symmetric body does not jump by many cells at a time.");
  body(m, "paraboloid_surface", &paraboloid_surface, "h = −r²/(2 radius), m.", nb::arg("radius"));
  body(m, "elliptic_paraboloid_surface", &elliptic_paraboloid_surface,
       "h = −x²/(2 radius_x) − y²/(2 radius_y), m.", nb::arg("radius_x"), nb::arg("radius_y"));
  body(m, "sphere_surface", &sphere_surface,
       "The upper half of a sphere, h = √(radius² − r²) − radius, and −radius outside of it, m.",
       nb::arg("radius"));
  body(m, "ellipsoid_surface", &ellipsoid_surface,
       "The upper half of an ellipsoid of the given semi-axes, m.", nb::arg("semi_x"),
       nb::arg("semi_y"), nb::arg("semi_z"));
  body(m, "cone_surface", &cone_surface, "h = −r tan(angle), angle between flank and plane, rad.",
       nb::arg("angle"));
  body(m, "wedge_surface", &wedge_surface, "``h = −|x| tan(angle)``: an edge along y.",
       nb::arg("angle"));
  body(m, "ridge_surface", &ridge_surface, "h = −x²/(2 radius): a cylinder lying along y.",
       nb::arg("radius"));
  body(m, "flat_punch_surface", &flat_punch_surface,
       "A standing cylinder with a sharp edge: h = 0 for r <= radius, −depth outside, m.",
       nb::arg("radius"), nb::arg("depth"));
  body(m, "rounded_punch_surface", &rounded_punch_surface,
       "A standing cylinder with a rounded edge, m.", nb::arg("flat_radius"),
       nb::arg("edge_radius"));
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
