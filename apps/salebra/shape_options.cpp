// SPDX-License-Identifier: GPL-3.0-or-later
// Options that describe an analytic shape on a grid.
#include "shape_options.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <salebra/base/error.hpp>
#include <salebra/generators/shapes.hpp>
#include <vector>

#include "options.hpp"
#include "shape.hpp"

namespace salebra::cli {
namespace {

/// The options of a shape in the order of the arguments of its generator, and the generator.
struct MadeShape {
  std::vector<std::string> options;
  std::function<Surface(const Grid2D&, const std::vector<double>&, const PlanePoint&)> make;
};

Index whole(double value, const char* option) {
  require(value == std::floor(value) && value >= 0 && value < 1e6, option, value,
          "must be a whole number >= 0");
  return static_cast<Index>(value);
}

/// Options and generator of a shape. A single shape has its axis at the point `center`; the pattern
/// of a repeated shape is shifted by it.
MadeShape maker_of(Shape shape) {
  using Values = std::vector<double>;
  if (shape == Shape::sphere)
    return {{"--radius"},
            [](auto& grid, const Values& v, auto& at) { return sphere_surface(grid, v[0], at); }};
  if (shape == Shape::paraboloid)
    return {{"--radius"}, [](auto& grid, const Values& v, auto& at) {
              return paraboloid_surface(grid, v[0], at);
            }};
  if (shape == Shape::elliptic_paraboloid)
    return {{"--radius-x", "--radius-y"}, [](auto& grid, const Values& v, auto& at) {
              return elliptic_paraboloid_surface(grid, v[0], v[1], at);
            }};
  if (shape == Shape::ellipsoid)
    return {{"--semi-x", "--semi-y", "--semi-z"}, [](auto& grid, const Values& v, auto& at) {
              return ellipsoid_surface(grid, v[0], v[1], v[2], at);
            }};
  if (shape == Shape::cone)
    return {{"--angle"},
            [](auto& grid, const Values& v, auto& at) { return cone_surface(grid, v[0], at); }};
  if (shape == Shape::wedge)
    return {{"--angle"},
            [](auto& grid, const Values& v, auto& at) { return wedge_surface(grid, v[0], at); }};
  if (shape == Shape::ridge)
    return {{"--radius"},
            [](auto& grid, const Values& v, auto& at) { return ridge_surface(grid, v[0], at); }};
  if (shape == Shape::cylinder)
    return {{"--radius", "--depth"}, [](auto& grid, const Values& v, auto& at) {
              return flat_punch_surface(grid, v[0], v[1], at);
            }};
  if (shape == Shape::rounded_cylinder)
    return {{"--radius", "--edge-radius"}, [](auto& grid, const Values& v, auto& at) {
              return rounded_punch_surface(grid, v[0], v[1], at);
            }};
  if (shape == Shape::pyramids)
    return {{"--count-x", "--count-y", "--angle"}, [](auto& grid, const Values& v, auto& at) {
              return pyramids_surface(grid, whole(v[0], "--count-x"), whole(v[1], "--count-y"),
                                      v[2], at);
            }};
  return {{"--amplitude", "--count-x", "--count-y"}, [](auto& grid, const Values& v, auto& at) {
            return sinusoid_surface(grid, v[0], whole(v[1], "--count-x"), whole(v[2], "--count-y"),
                                    at);
          }};
}

}  // namespace

void ShapeOptions::add_to(Command& app) {
  const Heading under(app, "Shape, instead of a spectrum");
  std::vector<std::string> words;
  for (const auto& [value, word] : EnumNames<Shape>::values)
    if (value != Shape::power) words.push_back(option_word(value));
  add_choice(app, "--shape", shape, words, "shape");
  const auto length = [&](const char* name, std::optional<double>& value, const char* help) {
    add_quantity(app, name, value, Dimension::length, help);
  };
  length("--radius", radius,
         "sphere, paraboloid, ridge: radius of curvature; cylinder, rounded-cylinder: radius of "
         "the flat face");
  length("--radius-x", radius_x, "elliptic-paraboloid: radius of curvature along x");
  length("--radius-y", radius_y, "elliptic-paraboloid: radius of curvature along y");
  length("--semi-x", semi_x, "ellipsoid: semi-axis along x");
  length("--semi-y", semi_y, "ellipsoid: semi-axis along y");
  length("--semi-z", semi_z, "ellipsoid: semi-axis out of the surface");
  length("--depth", depth, "cylinder: depth from its face to the ground");
  length("--edge-radius", edge_radius,
         "rounded-cylinder: radius of curvature outside the flat face");
  length("--amplitude", amplitude, "sinusoid: amplitude");
  length("--center-x", center_x, "x of the axis; pyramids, sinusoid: shift along x");
  length("--center-y", center_y, "the same along y");
  add_quantity(app, "--angle", angle, Dimension::angle,
               "cone, wedge, pyramids: angle between the flank and the plane");
  add_quantity(app, "--count-x", count_x, Dimension::dimensionless,
               "pyramids, sinusoid: number along x");
  add_quantity(app, "--count-y", count_y, Dimension::dimensionless, "the same along y");
  add_choice(app, "--center", center, {"off-grid", "middle"},
             "where the axis is; default off-grid: (0.31, 0.17) of a cell off the middle, which "
             "makes the contact area grow smoothly");
}

Surface ShapeOptions::surface(const Grid2D& grid) const {
  const MadeShape named = maker_of(*parse_enum<Shape>(shape));
  const std::vector<std::pair<std::string, const std::optional<double>*>> known{
      {"--radius", &radius},       {"--radius-x", &radius_x}, {"--radius-y", &radius_y},
      {"--semi-x", &semi_x},       {"--semi-y", &semi_y},     {"--semi-z", &semi_z},
      {"--angle", &angle},         {"--depth", &depth},       {"--edge-radius", &edge_radius},
      {"--amplitude", &amplitude}, {"--count-x", &count_x},   {"--count-y", &count_y}};
  std::vector<double> values;
  for (const std::string& option : named.options) {
    const auto found = std::ranges::find(known, option, [](auto& entry) { return entry.first; });
    values.push_back(required(*found->second, option, "--shape " + shape + " needs it"));
  }
  for (const auto& [option, value] : known)
    require_that(!*value || std::ranges::find(named.options, option) != named.options.end(), option,
                 "given, but --shape " + shape + " has none; leave it out");
  const bool repeated = shape == "pyramids" || shape == "sinusoid";
  const PlanePoint off_grid = off_grid_center(grid);
  const PlanePoint middle{grid.lx / 2, grid.ly / 2};
  PlanePoint at = center == "middle" ? middle : off_grid;
  if (repeated) at = {at.x - middle.x, at.y - middle.y};
  return named.make(grid, values, {center_x.value_or(at.x), center_y.value_or(at.y)});
}

}  // namespace salebra::cli
