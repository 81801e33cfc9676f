// SPDX-License-Identifier: GPL-3.0-or-later
// The argument `comm`: a communicator of mpi4py, whose processes compute together.
#include "interop/processes.hpp"

namespace salebra::python {

Communicator ProcessesArgument::communicator() const {
  if (comm.is_none()) return {};
  const nb::object held = nb::module_::import_("salebra._processes").attr("communicator")(comm);
  return *static_cast<const Communicator*>(
      PyCapsule_GetPointer(held.ptr(), "salebra.Communicator"));
}

}  // namespace salebra::python
