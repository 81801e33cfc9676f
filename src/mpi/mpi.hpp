// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// MPI's C++ bindings are skipped: the MPI standard no longer has them, and they would have to be
// linked.
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

/// Wraps the processes of an MPI communicator. They communicate over a duplicate of this
/// communicator, so messages never mix with the caller's own. Each process may call MPI from one
/// thread at a time. Collective; MPI must be initialised, and the last copy of the result must be
/// destroyed before MPI is finalised. Throws Error if an MPI call fails; the result cannot be used
/// afterwards.
Communicator communicator(MPI_Comm processes);

/// Returns the name and version that the MPI library reports, such as "Open MPI v4.1.4".
std::string library();

/// Initialises MPI when constructed and finalises it when destroyed. A program that leaves
/// initialisation and finalisation to salebra holds one Session.
class Session {
 public:
  /// Throws Error if the MPI library does not support programs with threads.
  Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  /// Finalises MPI, for which it waits for the other processes. No copy of a communicator may exist
  /// any more.
  ~Session();

  /// The communicator of all processes, and the communicator of the processes that share memory
  /// with this process. Collective.
  Communicator communicator() const;
  Communicator communicator_of_node() const;
  /// Waits until all processes have called this function. Returns false if some have not called it
  /// within `patience`, because they compute or wait for this process in another call; call it
  /// again to wait longer.
  bool all_here(std::chrono::milliseconds patience);
  /// Ends all processes with this exit status.
  [[noreturn]] void abort(int status) const;

 private:
  MPI_Comm meeting_ = MPI_COMM_NULL;  ///< used by all_here() only, so it never meets other messages
  MPI_Request met_ = MPI_REQUEST_NULL;
};

}  // namespace salebra::mpi
