// SPDX-License-Identifier: GPL-3.0-or-later
// What precedes everything else in main(): standard streams, and the wait policy of OpenMP's
// threads.
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

// Not for commands of few numbers, nor for help, nor where there is one thread.
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

// By default OpenMP's threads spin while they wait for each other, which makes a run on a shared
// machine many times slower and gains nothing on a quiet one. Asleep at once they are some 5 %
// slower than after a thousand looks, which GNU's OpenMP can be told. The choice is read from the
// environment when the OpenMP library is loaded, before main, so the program starts itself once
// more with it, which takes 11 ms. Where that fails it continues, more slowly.
void wait_without_spinning(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT") || !threads_may_run(argv))
    return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  setenv("GOMP_SPINCOUNT", "1000", 1);
  execv("/proc/self/exe", argv);
}

// The first file that is opened takes the number of a standard stream that is closed, and what is
// printed would go there. Opened the wrong way round, so that reading and printing fail as on the
// closed descriptor.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(descriptor, F_GETFD) < 0)
      open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace

void require_one_process(const Launch& launch, std::string_view what) {
  if (launch.communicator.alone()) return;
  throw InvalidInput(what, fmt::format("is computed by one process alone, and these are {}; use "
                                       "salebra, or one process",
                                       launch.communicator.size()));
}

void prepare_process(char** argv) {
  open_standard_streams();
  wait_without_spinning(argv);
  // A process that has started itself once more is called "exe", after /proc/self/exe.
  prctl(PR_SET_NAME, program_invocation_short_name);
}

}  // namespace salebra::cli
