// SPDX-License-Identifier: GPL-3.0-or-later
// Trial run of a risky read in a child process whose effects are discarded.
#include "rehearsal.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "loaded_surface.hpp"

namespace salebra::detail {
namespace {

[[noreturn]] void act(const std::function<void()>& work, unsigned seconds) {
  // A program's own handlers would report the child's death as its own; so would the C library, on standard error.
  for (const int sign : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM})
    std::signal(sign, SIG_DFL);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  if (const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC); nowhere >= 0)
    dup2(nowhere, STDERR_FILENO);
  alarm(seconds);
  try {
    work();
  } catch (...) {
  }
  _exit(0);
}

}  // namespace

void rehearse(const std::filesystem::path& file, const std::function<void()>& work,
              unsigned seconds) {
  const pid_t child = fork();
  if (child < 0) return;
  if (child == 0) act(work, seconds);
  int status = 0;
  pid_t ended;
  do {
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  if (ended == child && WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    refuse(file, "keeps the HDF5 library busy without end; it is damaged");
  // Signals sent by others, SIGKILL from a system that is out of memory, and say nothing of the file.
  const auto from_outside = [](int sign) {
    return sign == SIGINT || sign == SIGTERM || sign == SIGHUP || sign == SIGKILL;
  };
  if (ended == child && WIFSIGNALED(status) && !from_outside(WTERMSIG(status)))
    refuse(file, "makes the HDF5 library crash; it is damaged");
}

}  // namespace salebra::detail
