// SPDX-License-Identifier: GPL-3.0-or-later
// Module salebra._mpi: MPI communicators for salebra._core. It is a module of its own, so that MPI
// is only loaded for the first distributed surface, and a package without this module needs no MPI.
#include "mpi/mpi.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <array>
#include <memory>
#include <salebra/base/error.hpp>
#include <string>

namespace nb = nanobind;

namespace {

#ifdef OPEN_MPI
constexpr bool open_mpi = true;
#else
constexpr bool open_mpi = false;
#endif

// The version of the loaded MPI library, if it is of the kind for which this module was built;
// otherwise the name of this kind. The kind matters, since handles of Open MPI are pointers and
// those of other libraries numbers. If a library of the wrong kind was loaded first, MPI calls
// reach that library.
std::string library_version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  const std::string version(text.data());
  if (version.starts_with("Open MPI") == open_mpi) return version;
  return open_mpi ? "Open MPI" : "MPICH or one of its kind";
}

nb::capsule communicator(int handle) {
  std::unique_ptr<salebra::Communicator> communicator;
  {
    const nb::gil_scoped_release unlocked;
    int granted = MPI_THREAD_SINGLE;
    MPI_Query_thread(&granted);
    salebra::require_that(granted >= MPI_THREAD_FUNNELED, "comm",
                          "needs an MPI that was started for programs with threads; call "
                          "mpi4py.MPI.Init_thread(), or let mpi4py start MPI");
    communicator =
        std::make_unique<salebra::Communicator>(salebra::mpi::communicator(MPI_Comm_f2c(handle)));
  }
  return {communicator.release(), "salebra.Communicator",
          [](void* held) noexcept { delete static_cast<salebra::Communicator*>(held); }};
}

}  // namespace

NB_MODULE(_mpi, m) {
  m.doc() = "MPI for salebra._core; see salebra._processes.";
  m.def("library_version", &library_version);
  m.def("communicator", &communicator, nb::arg("handle"));
}
