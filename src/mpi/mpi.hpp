// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Without the C++ bindings, which the standard no longer has and which would have to be linked.
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#include <chrono>
#include <salebra/base/communicator.hpp>
#include <string>

/// MPI as the transport of communicators. No other header of salebra includes mpi.h.
namespace salebra::mpi {

/// The processes of an MPI communicator. They talk in a copy of it, hence never to the caller's own
/// messages. Each process may call MPI from one thread at a time. Collective; MPI must be
/// initialised, and the last handle be gone before it is finalised.
/// throws   Error for what MPI refuses; the communicator is of no use then
Communicator communicator(MPI_Comm processes);

/// What the MPI library calls itself, "Open MPI v4.1.4".
std::string library();

/// MPI from its start to its end, once in a program that leaves both to salebra.
class Session {
 public:
  /// Throws Error where the MPI library cannot be called by a program with threads.
  Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  /// Waits for the other processes. No handle of a communicator may be left.
  ~Session();

  /// All processes, and those of them that share this one's memory. Collective.
  Communicator communicator() const;
  Communicator ranks_of_node() const;
  /// Waits until all processes have called this. False: some did not in time, for they compute, or
  /// wait for this one elsewhere; another call waits on.
  bool all_here(std::chrono::milliseconds patience);
  /// Ends all processes with that status.
  [[noreturn]] void abort(int status) const;

 private:
  MPI_Comm meeting_ = MPI_COMM_NULL;  ///< for all_here() alone, whatever else is under way
  MPI_Request met_ = MPI_REQUEST_NULL;
};

}  // namespace salebra::mpi
