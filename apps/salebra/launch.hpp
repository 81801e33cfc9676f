// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <salebra/base/communicator.hpp>
#include <string>
#include <string_view>

namespace salebra::cli {

/// How the program was started: alone, or as one of several processes that compute one surface
/// together.
struct Launch {
  std::string name = "salebra";  ///< name of the program in messages
  /// Name of the MPI library of salebra-mpi; empty for salebra.
  std::string mpi = {};
  Communicator communicator = {};          ///< all processes
  Communicator communicator_of_node = {};  ///< the processes on this machine
  /// Returns true once all processes have called it, false if some do not within seconds.
  std::function<bool()> all_here = [] { return true; };
  /// Ends all processes with this exit status.
  std::function<void(int status)> abort = [](int) {};
};

/// Throws InvalidInput if there are several processes. `what` begins the sentence "… is computed by
/// one process only" of the message.
void require_one_process(const Launch& launch, std::string_view what);

/// Must be called first in main(), before MPI starts. Opens standard streams that are closed. If
/// the command line may use several threads, restarts the program with settings by which waiting
/// threads sleep instead of spinning.
void prepare_process(char** argv);

}  // namespace salebra::cli
