// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program salebra-mpi, whose processes compute one surface together.
#include <chrono>

#include "mpi/mpi.hpp"
#include "program.hpp"
#include "terminal.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  cli::prepare_process(argv);  // starts the program once more, which MPI would not survive
  try {
    mpi::Session mpi;
    cli::Launch launch;
    launch.name = "salebra-mpi";
    launch.mpi = mpi::library();
    launch.communicator = mpi.communicator();
    launch.ranks_of_node = mpi.ranks_of_node();
    // All of them learn of a failure within milliseconds, or are about to wait for ever.
    launch.all_here = [&mpi] { return mpi.all_here(std::chrono::seconds(5)); };
    launch.abort = [&mpi](int status) { mpi.abort(status); };
    return cli::run_program(argc, argv, std::move(launch));
  } catch (const std::exception& error) {
    cli::print_to_stderr("salebra-mpi: error: " + std::string(error.what()) + "\n");
    return 1;
  }
}
