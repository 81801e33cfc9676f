// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <salebra/damping/cycle.hpp>
#include <string>

namespace salebra::python {

/// The Python object of ContactSets, with the grid of the sets.
struct BoundContactSets {
  ContactSets contact_sets;
  Grid2D grid;
  std::string identity;  ///< text that identifies the contacts in the settings of a checkpoint
};

/// An argument that is a Python function of the indentation. It returns a contact set and a force.
struct ContactSetFunction {
  nanobind::object function;
};

}  // namespace salebra::python

namespace nanobind::detail {

template <>
struct type_caster<salebra::python::ContactSetFunction> {
  NB_TYPE_CASTER(
      salebra::python::ContactSetFunction,
      const_name("collections.abc.Callable[[float], tuple[numpy.typing.ArrayLike, float]]"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept {
    if (!PyCallable_Check(source.ptr())) return false;
    value.function = borrow(source);
    return true;
  }
};

}  // namespace nanobind::detail
