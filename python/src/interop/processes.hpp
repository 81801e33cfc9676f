// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <salebra/base/communicator.hpp>

namespace salebra::python {

namespace nb = nanobind;

/// The argument `comm`: None, or a communicator of mpi4py.
struct ProcessesArgument {
  nb::object comm = nb::none();
  /// The communicator of these processes, or of one process for None. Throws InvalidInput if the
  /// package was built without MPI or the communicator cannot be used. All processes must call.
  Communicator communicator() const;
};

}  // namespace salebra::python

namespace nanobind::detail {

template <>
struct type_caster<salebra::python::ProcessesArgument> {
  NB_TYPE_CASTER(salebra::python::ProcessesArgument, const_name("mpi4py.MPI.Intracomm"))
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept {
    if (!source.is_none() && !hasattr(source, "py2f")) return false;
    value.comm = borrow(source);
    return true;
  }
  static handle from_cpp(const salebra::python::ProcessesArgument& argument, rv_policy,
                         cleanup_list*) noexcept {
    return object(argument.comm).release();
  }
};

}  // namespace nanobind::detail
