// SPDX-License-Identifier: GPL-3.0-or-later
// Reads HDF5 files in a confined child process.
#include "confinement.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <salebra/base/error.hpp>
#include <string>
#include <string_view>

namespace salebra::confinement {
namespace {

/// Header of every block on the pipe.
struct Header {
  enum Kind : std::uint64_t { data, refusal, failure, end };
  std::uint64_t kind, size;
};
constexpr std::size_t longest_refusal = 4096;
/// How long a child may send nothing. It only reads a file and computes, so a longer pause means
/// that the disk does not answer.
constexpr std::chrono::seconds patience(60);

/// --- The child. ---

struct ParentIsGone {};

void write_all(int pipe, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw ParentIsGone();
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void send(int pipe, Header::Kind kind, std::span<const std::byte> bytes) {
  const Header header{kind, bytes.size()};
  write_all(pipe, std::as_bytes(std::span(&header, 1)));
  write_all(pipe, bytes);
}

void send_text(int pipe, Header::Kind kind, std::string_view text) {
  send(pipe, kind, std::as_bytes(std::span(text.substr(0, longest_refusal))));
}

/// Sends the parts of the message of an InvalidInput, separated by zero bytes, which no part
/// contains.
void send_refusal(int pipe, const InvalidInput& refusal) {
  const std::string end(1, '\0');
  send_text(pipe, Header::refusal,
            refusal.field() + end + refusal.value() + end + refusal.constraint() +
                (refusal.remedy().empty() ? "" : "; " + refusal.remedy()));
}

void limit(int resource, rlim_t most, rlim_t grace = 0) {
  rlimit both{};
  getrlimit(static_cast<__rlimit_resource_t>(resource), &both);
  both.rlim_cur = std::min(most, both.rlim_max);
  both.rlim_max = std::min(most + grace, both.rlim_max);
  setrlimit(static_cast<__rlimit_resource_t>(resource), &both);
}

/// Bytes of address space of the process; empty if the system does not report them.
std::optional<rlim_t> address_space() {
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (!file) return {};
  unsigned long pages = 0;
  const bool known = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  if (!known) return {};
  return pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Closes all descriptors that the child inherited from the parent, except a and b.
void close_all_but(int a, int b) {
#if defined(SYS_close_range)
  const auto close_range = [](int first, unsigned last) {
    if (static_cast<unsigned>(first) <= last)
      syscall(SYS_close_range, static_cast<unsigned>(first), last, 0U);
  };
  const auto [low, high] = std::minmax(a, b);
  if (low > 3) close_range(3, static_cast<unsigned>(low - 1));
  if (high > low + 1) close_range(low + 1, static_cast<unsigned>(high - 1));
  close_range(high + 1, ~0U);
#endif
}

void confine(const Hdf5Reading& reading, int pipe, std::optional<rlim_t> present) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // Resets signal handlers of the parent program, which would report the death of the child as that
  // of the program.
  for (const int sign :
       {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGXCPU, SIGSYS, SIGPIPE, SIGCHLD})
    std::signal(sign, SIG_DFL);
  // Ignores signals that a terminal sends to all processes of a program; the parent handles them.
  for (const int sign : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(sign, SIG_IGN);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  // Redirects standard error, on which the C library would report memory errors.
  if (const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC); nowhere >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (standard != pipe && standard != reading.descriptor) dup2(nowhere, standard);
  close_all_but(reading.descriptor, pipe);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_NOFILE, 0);
  limit(RLIMIT_NPROC, 0);
  // The hard limit is one second higher: reaching it sends SIGKILL instead of SIGXCPU.
  limit(RLIMIT_CPU, reading.seconds, 1);
  if (present) limit(RLIMIT_AS, *present + reading.memory);
}

[[noreturn]] void serve(const Hdf5Reading& reading, int pipe, std::optional<rlim_t> present) {
  try {
    confine(reading, pipe, present);
    try {
      reading.read([&](std::span<const std::byte> bytes) { send(pipe, Header::data, bytes); });
      send(pipe, Header::end, {});
    } catch (const InvalidInput& error) {
      send_refusal(pipe, error);
    } catch (const IoError& error) {
      send_text(pipe, Header::failure, error.what());
    } catch (const std::bad_alloc&) {
      send_refusal(pipe,
                   InvalidInput(reading.file.string(),
                                "takes more memory than a file of its size should; it is damaged"));
    }
  } catch (...) {
  }
  _exit(0);
}

/// --- The parent. ---

class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {
    fcntl(pipe_, F_SETFL, O_NONBLOCK);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    close(pipe_);
    if (is_there()) {
      kill(process_, SIGKILL);
      wait(0);
    }
  }

  /// Reads from the pipe. Returns false if the child ended before it wrote this number of bytes.
  bool receive(std::span<std::byte> bytes) {
    auto last = std::chrono::steady_clock::now();
    for (bool gone = false; !bytes.empty();) {
      const ssize_t got = read(pipe_, bytes.data(), bytes.size());
      if (got > 0) {
        bytes = bytes.subspan(static_cast<std::size_t>(got));
        last = std::chrono::steady_clock::now();
        continue;
      }
      if (got == 0 || gone) return false;
      if (errno == EINTR) continue;
      if (errno != EAGAIN) return false;
      pollfd readable{pipe_, POLLIN, 0};
      // Checks whether the child has ended: the pipe may stay open if another process, forked
      // meanwhile, has inherited its write end.
      if (poll(&readable, 1, 200) == 0) gone = !is_there();
      rests_ = std::chrono::steady_clock::now() - last > patience;
      if (rests_) return false;
    }
    return true;
  }

  /// The signal that ended the child; 0 if it ended without a signal, or if other code of the
  /// process collected its status first.
  int end() {
    // Waits up to a second, since a child closes the pipe by ending. A malicious file may have made
    // HDF5 close the pipe earlier; then the destructor ends the child.
    for (int i = 0; i < 100 && is_there(); ++i) usleep(10'000);
    return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
  }
  /// Whether receive() gave up, because the child sent nothing for too long.
  bool rests() const { return rests_; }

 private:
  bool is_there() {
    if (process_ > 0) wait(WNOHANG);
    return process_ > 0;
  }
  void wait(int options) {
    pid_t ended;
    do {
      ended = waitpid(process_, &status_, options);
    } while (ended < 0 && errno == EINTR);
    // If the program ignores SIGCHLD, the system forgets the status of a child as soon as it has
    // ended.
    if (ended != 0) process_ = -1;
    if (ended < 0) status_ = 0;
  }

  pid_t process_;
  int pipe_, status_ = 0;
  bool rests_ = false;
};

InvalidInput refusal_of(std::string_view text) {
  std::array<std::string_view, 2> parts;
  for (std::string_view& part : parts) {
    part = text.substr(0, text.find('\0'));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
  }
  return {parts[0], parts[1], text};
}

[[noreturn]] void refuse_dead(const Hdf5Reading& reading, Child& child) {
  const std::string file = reading.file.string();
  if (child.rests())
    throw InvalidInput(file, "keeps the HDF5 library waiting; is its disk in order?");
  const int sign = child.end();
  if (sign == SIGXCPU)
    throw InvalidInput(file, "keeps the HDF5 library busy without end; it is damaged");
  if (sign == SIGKILL)
    throw InvalidInput(file,
                       "could not be read, because the system ended the process that reads it; is "
                       "there enough memory?");
  throw InvalidInput(file, "makes the HDF5 library crash; it is damaged");
}

[[noreturn]] void refuse_unread(const Hdf5Reading& reading, int error) {
  throw IoError(reading.file.string() +
                ": not read, because the system grants no process to read it in (" +
                std::strerror(error) + "); end other programs or raise the limit on processes");
}

}  // namespace

void run_confined(const Hdf5Reading& reading) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) refuse_unread(reading, errno);
  fcntl(ends[0], F_SETPIPE_SZ, 1 << 20);  // a larger pipe needs fewer reads
  const std::optional<rlim_t> present = address_space();
  pid_t process = -1;
  int error = EAGAIN;
  reading.alone([&] {
    process = fork();
    error = errno;
    if (process == 0) {
      close(ends[0]);
      serve(reading, ends[1], present);
    }
  });
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    refuse_unread(reading, error);
  }
  Child child(process, ends[0]);
  while (true) {
    Header header;
    if (!child.receive(std::as_writable_bytes(std::span(&header, 1)))) refuse_dead(reading, child);
    switch (header.kind) {
      case Header::data:
        if (!child.receive(reading.location(header.size))) refuse_dead(reading, child);
        break;
      case Header::end:
        return;
      case Header::refusal:
      case Header::failure:
        if (header.size <= longest_refusal) {
          std::string text(header.size, '\0');
          if (!child.receive(std::as_writable_bytes(std::span(text)))) refuse_dead(reading, child);
          if (header.kind == Header::failure) throw IoError(text);
          throw refusal_of(text);
        }
        [[fallthrough]];
      default:
        throw InvalidInput(reading.file.string(),
                           "makes the HDF5 library give a wrong answer; it is damaged");
    }
  }
}

void install() { set_hdf5_runner(run_confined); }

}  // namespace salebra::confinement
