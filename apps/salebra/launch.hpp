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
  std::string name = "salebra";     ///< of the program, in messages
  std::string mpi = {};             ///< of salebra-mpi, its library; empty: salebra
  Communicator communicator = {};          ///< all processes
  Communicator ranks_of_node = {};  ///< those on this machine
  /// True once all processes have come here, false where some do not within seconds.
  std::function<bool()> all_here = [] { return true; };
  /// Ends all processes with that status.
  std::function<void(int status)> abort = [](int) {};
};

/// Throws InvalidInput where there are several processes. `what` completes "is computed by one
/// process alone".
void require_one_process(const Launch& launch, std::string_view what);

/// What precedes everything else in main(), MPI included: standard streams that are open, and
/// threads that do not spin while they wait, for which the program starts itself once more where
/// the command line may use several.
void prepare_process(char** argv);

}  // namespace salebra::cli
