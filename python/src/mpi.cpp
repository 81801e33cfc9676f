// SPDX-License-Identifier: GPL-3.0-or-later
// Module salebra._mpi: the processes of an MPI communicator, for salebra._core. A module of its
// own, so that MPI is loaded with the first surface that is spread, and a package without this file
// needs no MPI.
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

// Open MPI's handles are pointers, those of the others are numbers. Where another library's names
// came first into the process, these calls reach that one.
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
