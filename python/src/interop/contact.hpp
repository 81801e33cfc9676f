// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/contact/half_space/body.hpp>
#include <salebra/contact/half_space/material.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string>

#include "interop/arrays.hpp"
#include "interop/choice.hpp"

namespace salebra::python {

/// The body that was pressed, if it is not a half-space of a contact modulus. A pickle does not keep
/// it.
struct PressedBody {
  using left_out = void;
  std::optional<Body> body = {};
};

/// The Python object of a solved contact. It also keeps grid and contact modulus, so that the user
/// does not have to give them again.
struct BoundContact : NormalContactState {
  Grid2D grid;
  double contact_modulus = 0;  ///< NaN for a body
  Boundary boundary = Boundary::periodic;
  PressedBody pressed = {};
};

constexpr void describe(auto&& visit, std::type_identity<BoundContact>) {
  using S = BoundContact;
  describe(visit, std::type_identity<NormalContactState>{});
  visit(&S::grid, Kept{"grid", "points and size"});
  visit(&S::contact_modulus, Kept{"contact_modulus", "contact modulus E*", Dimension::pressure});
  visit(&S::boundary, Kept{"boundary", "'periodic' or 'free'"});
  keep(visit, &S::pressed);
}

/// Throws InvalidInput if the contact is distributed over processes. purpose: what needs it as a
/// whole.
inline void require_whole(const BoundContact& state, const std::string& purpose) {
  if (!state.communicator.alone())
    throw InvalidInput("state", "",
                       "is spread over " + std::to_string(state.communicator.size()) +
                           " processes, and " + purpose + " needs it whole; gather it first");
}

/// An argument that is a Material or, since a normal contact needs no more, only E*.
struct MaterialArgument {
  Material given;
  std::optional<double> contact_modulus;

  /// The material; throws InvalidInput unless E* > 0.
  Material material() const {
    return contact_modulus ? Material::of_contact_modulus(*contact_modulus) : given;
  }
};

/// An argument that is a MaterialArgument or any linear body.
struct PressedArgument {
  MaterialArgument material;
  std::optional<Body> body;

  Body pressed() const { return body ? *body : Body(material.material()); }
};

}  // namespace salebra::python

namespace nanobind::detail {

template <>
struct type_caster<salebra::python::MaterialArgument> {
  NB_TYPE_CASTER(salebra::python::MaterialArgument,
                 const_name<salebra::Material>() + const_name(" | float"))
  bool from_python(handle source, uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<double> number;
    if (number.from_python(source, flags, cleanup)) {
      value.contact_modulus = number.value;
      return true;
    }
    return try_cast(source, value.given);
  }
};

template <>
struct type_caster<salebra::python::PressedArgument> {
  NB_TYPE_CASTER(salebra::python::PressedArgument,
                 const_name<salebra::Material>() + const_name(" | ") + const_name<salebra::Body>() +
                     const_name(" | float"))
  bool from_python(handle source, uint32_t flags, cleanup_list* cleanup) noexcept {
    make_caster<salebra::python::MaterialArgument> material;
    if (material.from_python(source, flags, cleanup)) {
      value.material = material.value;
      return true;
    }
    const salebra::Body* body = nullptr;
    if (!try_cast(source, body)) return false;
    value.body = *body;
    return true;
  }
};

}  // namespace nanobind::detail
