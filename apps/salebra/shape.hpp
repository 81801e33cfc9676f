// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <salebra/base/enum_names.hpp>

namespace salebra {

/// Shapes with a formula. Generated surfaces, axisymmetric indenters and oscillating bodies each
/// support some of them.
enum class Shape {
  sphere,
  paraboloid,
  elliptic_paraboloid,
  ellipsoid,
  cone,
  power,  ///< f = B r^N
  wedge,
  ridge,
  cylinder,  ///< with a flat face
  rounded_cylinder,
  pyramids,
  sinusoid
};

template <>
struct EnumNames<Shape> {
  static constexpr auto values = std::to_array<std::pair<Shape, std::string_view>>(
      {{Shape::sphere, "sphere"},
       {Shape::paraboloid, "paraboloid"},
       {Shape::elliptic_paraboloid, "elliptic_paraboloid"},
       {Shape::ellipsoid, "ellipsoid"},
       {Shape::cone, "cone"},
       {Shape::power, "power"},
       {Shape::wedge, "wedge"},
       {Shape::ridge, "ridge"},
       {Shape::cylinder, "cylinder"},
       {Shape::rounded_cylinder, "rounded_cylinder"},
       {Shape::pyramids, "pyramids"},
       {Shape::sinusoid, "sinusoid"}});
};

}  // namespace salebra
