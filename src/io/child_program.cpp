// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a program in a child process whose standard streams are files in memory.
#include "child_program.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/progress.hpp>
#include <sstream>

extern char** environ;

namespace salebra::detail {
namespace {

class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }

  int descriptor() const { return descriptor_; }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(descriptor_, 0, SEEK_SET);
  }

  std::string read() const {
    std::string text;
    std::array<char, 4096> buffer;
    lseek(descriptor_, 0, SEEK_SET);
    for (ssize_t size; (size = ::read(descriptor_, buffer.data(), buffer.size())) > 0;)
      text.append(buffer.data(), static_cast<std::size_t>(size));
    return text;
  }

 private:
  [[noreturn]] static void fail() {
    throw IoError(std::string("a program that is called cannot be given its input (") +
                  std::strerror(errno) + ")");
  }

  int descriptor_;
};

}  // namespace

std::string found_on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (folder.starts_with('/') && access((folder + "/" + program).c_str(), X_OK) == 0)
      return folder + "/" + program;
  return "";
}

namespace {

void limit(pid_t child, __rlimit_resource resource, rlim_t most) {
  rlimit both{};
  if (prlimit(child, resource, nullptr, &both) != 0) return;
  both.rlim_cur = both.rlim_max = std::min(most, both.rlim_max);
  prlimit(child, resource, &both, nullptr);
}

/// Waits for the end of the child and returns its status. Kills the child when its time limit has
/// passed or limits.stopped() returns true.
int wait_for(pid_t child, const std::string& name, const ChildLimits& limits, ChildRun& run) {
  using namespace std::chrono;
  const auto end = steady_clock::now() + limits.time;
  int status = 0;
  bool stopped = false;
  // The pause between two checks grows from 0.5 to 20 ms, so that a short run is not delayed.
  for (microseconds pause(500);; pause = std::min<microseconds>(pause * 11 / 10, 20ms)) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) throw IoError(name + " was lost");
    stopped = stopped || (limits.stopped && limits.stopped());
    run.late = steady_clock::now() > end;
    if (stopped || run.late) kill(child, SIGKILL);
    usleep(static_cast<useconds_t>(pause.count()));
  }
  if (stopped) throw Interrupted(name + ": stopped");
  return status;
}

}  // namespace

ChildRun run_child(std::vector<std::string> words, std::string_view input,
                   const ChildLimits& limits) {
  const std::string program = found_on_path(words.front());
  if (program.empty()) return {.start_error = ENOENT, .output = {}, .errors = {}};
  MemoryFile given("input"), output("output"), errors("errors");
  given.write(input);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, given.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ChildRun run;
  pid_t child = 0;
  run.start_error =
      posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (run.start_error != 0) return run;
  limit(child, RLIMIT_CORE, 0);
  limit(child, RLIMIT_DATA, limits.memory);
  const int status = wait_for(child, words.front(), limits, run);
  run.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  run.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
  run.output = output.read();
  run.errors = errors.read();
  return run;
}

}  // namespace salebra::detail
