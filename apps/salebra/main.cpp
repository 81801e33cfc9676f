// SPDX-License-Identifier: GPL-3.0-or-later
// Entry point of the program salebra.
#include "program.hpp"

int main(int argc, char** argv) {
  salebra::cli::prepare_process(argv);
  return salebra::cli::run_program(argc, argv);
}
