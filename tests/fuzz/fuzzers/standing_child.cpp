// SPDX-License-Identifier: GPL-3.0-or-later
// The runner of HDF5 readings in the fuzzers. A process for each input costs ten milliseconds under
// sanitizers, hence one child stands ready, reads input after input, and is replaced when it dies;
// what it survives is read once more in the fuzzer, which sees the code that it reaches. What it
// died of is told apart: HDF5's own memory errors are why the program reads in a child, and the
// input is refused as there; an error in our code ends the fuzzer.
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

#include "../../../src/io/hdf5_document.hpp"
#include "../../../src/io/loaded_surface.hpp"
#include "io/hdf5_runner.hpp"

namespace salebra {
namespace {

using detail::refuse;

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

/// Whether one of the three innermost functions of a stack, of which two may be the sanitizer's and
/// the C library's, is of the HDF5 library.
bool is_of_hdf5(std::string_view stack) {
  const auto library = stack.find("libhdf5");
  return library < stack.find("    #3 ");
}

/// Everything that a reader can ask of a file.
void read_all(const std::filesystem::path& file) {
  using Kind = detail::hdf5::Object::Kind;
  const detail::hdf5::Document document{detail::InputFile(file)};
  std::vector<std::string> groups{"/"};
  while (!groups.empty()) {
    const std::string group = groups.back();
    groups.pop_back();
    for (const auto& [name, kind] : document.group(group).members) {
      const std::string path = group + "/" + name;
      if (kind == Kind::group) groups.push_back(path);
      if (kind != Kind::numbers || !document.dataset(path).refusal.empty()) continue;
      std::vector<double> values(document.numeric(path).count());
      document.numbers(path, values);
    }
  }
}

class Child {
 public:
  bool stands() const { return process_ > 0 && rehearsals_ < rehearsals_of_a_child; }

  void start(const std::filesystem::path& file) {
    dismiss();
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0)
      throw std::logic_error("no pair of sockets");
    process_ = fork();
    if (process_ < 0) throw std::logic_error("no process");
    channel_ = ends[process_ == 0];
    close(ends[process_ != 0]);
    rehearsals_ = 0;
    if (process_ == 0) serve(file);
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
  [[noreturn]] void serve(const std::filesystem::path& file) const {
    set_hdf5_runner(nullptr);
    // libFuzzer would keep what the child dies of as a broken input.
    __sanitizer_set_death_callback([] { _exit(1); });
    __asan_set_error_report_callback(keep_report);
    if (!std::getenv("SALEBRA_FUZZ_REPORTS"))
      if (FILE* nowhere = std::freopen("/dev/null", "w", stderr); !nowhere) _exit(1);
    for (char word = 0; read(channel_, &word, 1) == 1;) {
      try {
        read_all(file);
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

void run_twice(const Hdf5Reading& reading) {
  // A fuzzer gives every input to one reader in one file: the file that the child began with is
  // that of every later call.
  static Child child;
  const std::filesystem::path& file = reading.file;
  if (!child.stands()) {
    report();
    child.start(file);
  }
  const Child::End end = child.rehearse_once();
  if (end == Child::End::well) {
    reading.read([&](std::span<const std::byte> bytes) {
      const std::span<std::byte> place = reading.location(bytes.size());
      std::memcpy(place.data(), bytes.data(), bytes.size());
    });
    return;
  }
  const int status = child.dismiss();
  if (end == Child::End::late)
    refuse(file, "keeps the HDF5 library busy without end; it is damaged");
  const std::string stack = report();
  if (WIFEXITED(status) && !is_of_hdf5(stack))
    throw std::logic_error("the rehearsal ended with status " +
                           std::to_string(WEXITSTATUS(status)) + "\n" + stack);
  refuse(file, "makes the HDF5 library crash; it is damaged");
}

[[maybe_unused]] const bool installed = (set_hdf5_runner(run_twice), true);

}  // namespace
}  // namespace salebra
