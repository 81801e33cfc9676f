// SPDX-License-Identifier: GPL-3.0-or-later
// First steps of main(): standard streams, and the wait policy of OpenMP's threads.
#include "launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <string_view>

namespace salebra::cli {
namespace {

// Returns whether the command line may lead to work on several threads: false for commands with
// little work, for help, and with one thread.
bool threads_may_run(char** argv) {
  using namespace std::string_view_literals;
  if (parallel::threads() == 1 || !argv[0] || !argv[1]) return false;
  const std::string_view command = argv[1];
  for (const auto few : {"completion"sv, "export"sv, "fit"sv, "help"sv, "init"sv, "viscoelastic"sv})
    if (command == few) return false;
  if (command.starts_with('-')) return false;
  for (char** word = argv + 2; *word; ++word)
    if (*word == "--help"sv || *word == "-h"sv || *word == "--threads=1"sv ||
        (*word == "--threads"sv && word[1] && word[1] == "1"sv))
      return false;
  return true;
}

// Makes waiting OpenMP threads sleep. By default they spin while they wait for each other, which
// makes a run on a shared machine many times slower and gains nothing on a quiet one. Threads that
// sleep at once are about 5 % slower than threads that first spin a thousand times, which GNU's
// OpenMP can do. The OpenMP library reads these settings from the environment when it is loaded,
// before main(). Therefore the program sets them and restarts itself, which takes 11 ms. If the
// restart fails the program continues, more slowly.
void wait_without_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT") || !threads_may_run(argv))
    return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "1000", 1);
  execv("/proc/self/exe", argv);
}

// If a standard stream is closed, the first file that is opened gets its number, and output would
// go to that file. Each closed stream is opened for the opposite direction, so that reading and
// printing fail as on the closed descriptor.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

void require_one_process(const Launch& launch, std::string_view what) {
  if (launch.communicator.alone()) return;
  throw InvalidInput(
      what, fmt::format(
                "is computed by one process only, but {} are running; use salebra, or one process",
                launch.communicator.size()));
}

void prepare_process(char** argv) {
  open_standard_streams();
  wait_without_spinning(argv);
  // After the restart the system would show the process as "exe", so its name is set again.
  prctl(PR_SET_NAME, program_invocation_short_name);
}

}  // namespace salebra::cli
