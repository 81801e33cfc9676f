// SPDX-License-Identifier: GPL-3.0-or-later
// What rehearse() is in the fuzzers: a process for each input costs ten milliseconds under sanitizers, hence one child stands ready,
// rehearses input after input, and is replaced when it dies. What it died of is told apart: HDF5's own memory errors are why there is
// a rehearsal, and the input is refused as the reader would; an error in our code ends the fuzzer.
#include <poll.h>
#include <sanitizer/asan_interface.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include "../../../src/io/loaded_surface.hpp"
#include "../../../src/io/rehearsal.hpp"

namespace salebra::detail {
namespace {

constexpr int rehearsals_of_a_child = 2000;  // HDF5 leaves memory behind where a file is damaged
constexpr int patience = 2000;               // milliseconds
constexpr int out_of_memory = 12;  // status of a child to which the allocator refused memory

/// Memory that both processes see: the report of a sanitizer in the child.
char* report() {
  constexpr std::size_t size = 1 << 16;
  static char* const text = static_cast<char*>(
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  return text;
}

void keep_report(const char* text) { std::strncpy(report(), text, (1 << 16) - 1); }

/// Whether one of the three innermost functions of a stack, of which two may be the sanitizer's and the C library's, is of the HDF5 library.
bool is_of_hdf5(std::string_view stack) {
  const auto library = stack.find("libhdf5");
  return library < stack.find("    #3 ");
}

class Child {
 public:
  bool stands() const { return process_ > 0 && rehearsals_ < rehearsals_of_a_child; }

  void start(const std::function<void()>& work) {
    dismiss();
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
      throw std::logic_error("no pair of sockets");
    process_ = fork();
    if (process_ < 0) throw std::logic_error("no process");
    channel_ = ends[process_ == 0];
    close(ends[process_ != 0]);
    rehearsals_ = 0;
    if (process_ == 0) serve(work);
  }

  enum class End { well, late, dead };

  End rehearse_once() {
    ++rehearsals_;
    report()[0] = '\0';
    char word = 1;
    if (write(channel_, &word, 1) != 1) return End::dead;
    pollfd answer{channel_, POLLIN, 0};
    if (poll(&answer, 1, patience) == 0) return End::late;
    return read(channel_, &word, 1) == 1 ? End::well : End::dead;
  }

  /// The status that the child ended with, as waitpid has it.
  int dismiss() {
    if (process_ <= 0) return 0;
    close(channel_);
    int status = 0;
    // A child that has died goes with its own status, one that is busy is killed.
    if (waitpid(process_, &status, WNOHANG) == 0) {
      kill(process_, SIGKILL);
      waitpid(process_, &status, 0);
    }
    process_ = -1;
    return status;
  }

 private:
  [[noreturn]] void serve(const std::function<void()>& work) const {
    // libFuzzer would keep what the child dies of as a broken input.
    __sanitizer_set_death_callback([] { _exit(1); });
    __asan_set_error_report_callback(keep_report);
    if (!std::getenv("SALEBRA_FUZZ_REPORTS"))
      if (FILE* nowhere = std::freopen("/dev/null", "w", stderr); !nowhere) _exit(1);
    for (char word = 0; read(channel_, &word, 1) == 1;) {
      try {
        work();
      } catch (const std::bad_alloc&) {
        _exit(out_of_memory);  // HDF5 throws nothing: a size of the file reached our own code
      } catch (...) {
      }
      if (write(channel_, &word, 1) != 1) break;
    }
    _exit(0);
  }

  pid_t process_ = -1;
  int channel_ = -1;
  int rehearsals_ = 0;
};

}  // namespace

void rehearse(const std::filesystem::path& file, const std::function<void()>& work, unsigned) {
  // A fuzzer gives every input to one reader in one file: the work that the child began with is that of every later call.
  static Child child;
  if (!child.stands()) {
    report();
    child.start(work);
  }
  const Child::End end = child.rehearse_once();
  if (end == Child::End::well) return;
  const int status = child.dismiss();
  if (end == Child::End::late)
    refuse(file, "keeps the HDF5 library busy without end; it is damaged");
  const std::string stack = report();
  if (WIFEXITED(status) && !is_of_hdf5(stack))
    throw std::logic_error("the rehearsal ended with status " +
                           std::to_string(WEXITSTATUS(status)) + "\n" + stack);
  refuse(file, "makes the HDF5 library crash; it is damaged");
}

}  // namespace salebra::detail
