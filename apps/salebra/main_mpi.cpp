// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program salebra-mpi, whose processes compute one surface together.
#include <chrono>

#include "mpi/mpi.hpp"
#include "program.hpp"
#include "terminal.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  cli::prepare_process(argv);  // restarts the program, which is not possible after MPI has started
  try {
    mpi::Session mpi;
    cli::Launch launch;
    launch.name = "salebra-mpi";
    launch.mpi = mpi::library();
    launch.communicator = mpi.communicator();
    launch.communicator_of_node = mpi.communicator_of_node();
    // A process calls this after a failure. If all have failed, all call it within milliseconds. If
    // some have not called it after 5 s, they are waiting for messages of this process.
    launch.all_here = [&mpi] { return mpi.all_here(std::chrono::seconds(5)); };
    launch.abort = [&mpi](int status) { mpi.abort(status); };
    return cli::run_program(argc, argv, std::move(launch));
  } catch (const std::exception& error) {
    cli::print_to_stderr("salebra-mpi: error: " + std::string(error.what()) + "\n");
    return 1;
  }
}
