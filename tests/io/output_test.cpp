// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <functional>
#include <iterator>
#include <salebra/base/error.hpp>
#include <salebra/io/output.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/results/force_curve_file.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

/// Runs `write` in a child process with a limit on the size of files. Returns its exit status: 0
/// success, 3 IoError, 4 another exception, 128 + signal for a crash. The child calls exit(), so
/// that HDF5's clean-up at the end of a process runs too.
int status_with_file_limit(rlim_t bytes, const std::function<void()>& write) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGSEGV, SIG_DFL);
    std::signal(SIGABRT, SIG_DFL);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    int status = 0;
    try {
      write();
    } catch (const IoError&) {
      status = 3;
    } catch (...) {
      status = 4;
    }
    std::exit(status);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Surface flat(Index n) { return {{n, n, 1, 1}, Field::Constant(n, n, 0.5), true, "test"}; }

}  // namespace

TEST_CASE("An existing file is replaced only when that is asked for", "[output]") {
  const Scratch scratch;
  const std::string name = GENERATE("surface.h5", "surface.npy", "surface.txt");
  const auto file = scratch.file(name, "precious");
  CHECK_THROWS_WITH(write_surface(file, flat(4)),
                    Contains(name) && Contains("exists") && Contains("`overwrite`"));
  CHECK(std::filesystem::file_size(file) == 8);
  CHECK(files_in(scratch.folder()) == 1);
  write_surface(file, flat(4), {}, {.overwrite = true});
  CHECK(std::filesystem::file_size(file) > 8);
}

TEST_CASE("A folder or a device is never replaced by a file", "[output]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "folder.h5");
  CHECK_THROWS_AS(require_output(scratch / "folder.h5", {.overwrite = true}), InvalidInput);
  CHECK_THROWS_AS(require_output("/dev/null", {.overwrite = true}), InvalidInput);
  CHECK_NOTHROW(require_output(scratch / "new.h5"));
  CHECK_NOTHROW(require_output("new-in-this-folder.h5"));
}

TEST_CASE("An output that cannot be written is refused before any work", "[output]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(require_output(scratch / (std::string(252, 'x') + ".h5")),
                    Contains("name is too long") && Contains("shorten"));
  std::filesystem::create_symlink(scratch / "nothing", scratch / "link.h5");
  CHECK_THROWS_WITH(require_output(scratch / "link.h5"), Contains("symbolic link"));
  CHECK_NOTHROW(require_output(scratch / "link.h5", {.overwrite = true}));
  // Nobody, not even root, can create files there.
  CHECK_THROWS_AS(require_output("/proc/results.h5"), IoError);
  CHECK(files_in(scratch.folder()) == 1);
}

TEST_CASE("An array and a sidecar that are not of one pair are refused", "[output]") {
  const Scratch scratch;
  const auto array = scratch / "a.npy", sidecar = scratch / "a.npy.json";
  write_surface(array, flat(4));
  std::filesystem::rename(array, scratch / "old.npy");
  std::filesystem::rename(sidecar, scratch / "old.json");
  Surface other = flat(4);
  other.heights(1, 1) = 2;
  write_surface(array, other);
  CHECK_NOTHROW(read_surface(array));
  const auto options = std::filesystem::copy_options::overwrite_existing;
  std::filesystem::copy_file(scratch / "old.json", sidecar, options);
  CHECK_THROWS_WITH(read_surface(array), Contains("a.npy.json") && Contains("checksum"));
  write_surface(array, other, {}, {.overwrite = true});
  std::filesystem::copy_file(scratch / "old.npy", array, options);
  CHECK_THROWS_WITH(read_surface(array), Contains("a.npy.json") && Contains("checksum"));
}

TEST_CASE("A result file that is not committed leaves nothing", "[output]") {
  const Scratch scratch;
  {
    ResultFile results(scratch / "results.h5", {});
    results.group("fit").scalar("decay_length", 1e-7, "m", "decay length");
    CHECK(files_in(scratch.folder()) == 1);
    CHECK_FALSE(std::filesystem::exists(scratch / "results.h5"));
  }
  CHECK(files_in(scratch.folder()) == 0);
}

TEST_CASE("A full disk is an IoError, leaves no file and crashes nothing", "[output]") {
  const Scratch scratch;
  const auto check_none = [&](rlim_t limit, const std::function<void()>& write) {
    INFO("limit " << limit);
    CHECK(status_with_file_limit(limit, write) == 3);
    CHECK(files_in(scratch.folder()) == 0);
  };
  // 512² doubles are 2 MiB: the limits cut the file at its beginning, within the data and just
  // before their end.
  for (const rlim_t limit : {0, 100, 1 << 10, 1 << 20, 3 << 19, (2 << 20) + 100}) {
    check_none(limit, [&] { write_surface(scratch / "surface.h5", flat(512)); });
    if (limit < (2 << 20)) {
      check_none(limit, [&] { write_surface(scratch / "surface.npy", flat(512)); });
      check_none(limit / 4, [&] { write_surface(scratch / "surface.txt", flat(512)); });
    }
  }
  check_none(3 << 20, [&] {
    ResultFile results(scratch / "results.h5", {});
    const std::vector<double> values(20000, 1.0);
    for (int i = 0; i < 100; ++i) {
      ResultGroup group = results.group("realisations/" + std::to_string(i));
      group.coordinate("pressure", values, "Pa", "pressure");
      group.attribute("note", std::string(1000, 'x'));
    }
    results.commit();
  });
  CHECK(status_with_file_limit(16 << 20,
                               [&] { write_surface(scratch / "surface.h5", flat(512)); }) == 0);
  CHECK(files_in(scratch.folder()) == 1);
}
