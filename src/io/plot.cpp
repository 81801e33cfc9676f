// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing of a figure by gnuplot in a child process, to a file that appears whole.
#include "plot.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <salebra/base/error.hpp>
#include <sstream>

#include "atomic_file.hpp"
#include "gnuplot_script.hpp"

extern char** environ;

namespace salebra {
namespace {

detail::PictureFormat format_of(const std::filesystem::path& file) {
  const std::string suffix = file.extension().string();
  for (const auto& [known, format] : {std::pair{".png", detail::PictureFormat::png},
                                      {".svg", detail::PictureFormat::svg},
                                      {".pdf", detail::PictureFormat::pdf}})
    if (suffix == known) return format;
  require(false, "plot", "'" + file.string() + "'",
          "has no picture's suffix; use .png, .svg or .pdf");
  return {};
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw IoError(file.string() + ": " + reason + "; no picture was written");
}

bool installed(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access(((folder.empty() ? "." : folder) + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

void require_gnuplot(const std::filesystem::path& file) {
  if (!installed("gnuplot"))
    fail(file, "gnuplot is not installed (Debian package gnuplot-nox), which draws the pictures");
}

// A file in memory: the child neither blocks on a full pipe nor leaves anything behind.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC)) {
    if (descriptor_ < 0)
      throw IoError(std::string("gnuplot: cannot be given its input (") + std::strerror(errno) +
                    ")");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(descriptor_); }

  int descriptor() const { return descriptor_; }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0)
        throw IoError(std::string("gnuplot: cannot be given its input (") + std::strerror(errno) +
                      ")");
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
  int descriptor_;
};

// The line of gnuplot's complaint that says what is wrong, after the script's line and a caret that
// point at it.
std::string complaint(const std::string& text) {
  std::istringstream lines(text);
  std::string last;
  for (std::string line; std::getline(lines, line);)
    if (line.find_first_not_of(" \t^") != std::string::npos)
      last = line.substr(line.find_first_not_of(" \t"));
  return last.substr(0, 200);
}

/// What gnuplot draws; `file` is only named in messages.
std::string run_gnuplot(const std::filesystem::path& file, std::string_view script) {
  MemoryFile input("script"), picture("picture"), errors("errors");
  input.write(script);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, picture.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.descriptor(), STDERR_FILENO);
  std::string program = "gnuplot", defaults = "--default-settings", standard_input = "-";
  const std::array<char*, 4> arguments = {program.data(), defaults.data(), standard_input.data(),
                                          nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    fail(file, std::string("gnuplot cannot be started (") + std::strerror(error) + ")");
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) fail(file, "gnuplot was lost");
  if (WIFSIGNALED(status))
    fail(file, "gnuplot was ended by signal " + std::to_string(WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0) fail(file, "gnuplot failed (" + complaint(errors.read()) + ")");
  return picture.read();
}

// gnuplot does not always report a failed write: then the end is missing.
void require_whole(const std::filesystem::path& file, std::string_view picture,
                   detail::PictureFormat format) {
  constexpr std::size_t tail = 32;
  const std::string_view end = picture.substr(picture.size() - std::min(picture.size(), tail));
  const char* const last = format == detail::PictureFormat::png   ? "IEND"
                           : format == detail::PictureFormat::svg ? "</svg>"
                                                                  : "%%EOF";
  if (end.find(last) == std::string_view::npos)
    fail(file, "gnuplot left the picture incomplete; is the memory full?");
}

}  // namespace

std::string plot_text(std::string_view plain) {
  std::string out;
  for (const char c : plain) {
    if (std::string_view("_^{}@&~\\").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

void require_plot(const std::filesystem::path& file, const WriteOptions& options) {
  format_of(file);
  require_output(file, options);
  require_gnuplot(file);
}

void write_plot(const std::filesystem::path& file, const Figure& figure,
                const WriteOptions& options) {
  const detail::PictureFormat format = format_of(file);
  require_gnuplot(file);
  detail::AtomicFile target(file, options);
  const std::string picture = run_gnuplot(file, detail::gnuplot_script(figure, format));
  require_whole(file, picture, format);
  target.write(picture);
  target.commit();
}

}  // namespace salebra
