// SPDX-License-Identifier: GPL-3.0-or-later
// The child process that reads HDF5: whatever it does, its parent reads, refuses or says that it
// could not try.
#include "confinement/confinement.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <salebra/base/error.hpp>
#include <salebra/io/result_file.hpp>
#include <thread>
#include <vector>

#include "io/scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

using HandOver = std::function<void(std::span<const std::byte>)>;

/// A reading whose child does some work; what it hands over is kept as text.
struct Tried {
  explicit Tried(std::function<void(const HandOver&)> work) {
    reading.file = "a.h5";
    reading.descriptor = open("/dev/null", O_RDONLY | O_CLOEXEC);
    reading.memory = std::uint64_t{64} << 20;
    reading.seconds = 1;
    reading.read = std::move(work);
    reading.location = [this](std::size_t count) {
      if (count > 1 << 20) throw InvalidInput("a.h5", "hands over too much");
      text.resize(text.size() + count);
      return std::as_writable_bytes(std::span(text)).last(count);
    };
    reading.alone = [](const std::function<void()>& call) { call(); };
  }
  Tried(const Tried&) = delete;
  Tried& operator=(const Tried&) = delete;
  ~Tried() { close(reading.descriptor); }

  void run() const { confinement::run_confined(reading); }

  Hdf5Reading reading;
  std::string text;
};

void say(const HandOver& hand_over, const std::string& text) {
  hand_over(std::as_bytes(std::span(text)));
}

void write_small(const std::filesystem::path& file) {
  ResultFile results(file, {}, {.overwrite = true});
  ResultGroup group = results.group("g");
  group.index("x", 20000, "large enough to be read apart");
  results.commit();
}

}  // namespace

TEST_CASE("What a child hands over arrives in order, and nothing else of it stays",
          "[confinement]") {
  int value = 1;
  Tried tried([&](const HandOver& hand_over) {
    value = 2;
    for (int i = 0; i < 1000; ++i) say(hand_over, std::to_string(i) + "\n");
  });
  tried.run();
  std::string expected;
  for (int i = 0; i < 1000; ++i) expected += std::to_string(i) + "\n";
  CHECK(tried.text == expected);
  CHECK(value == 1);
}

TEST_CASE("A child that dies, runs on, fills the memory or lies is the file's fault",
          "[confinement]") {
  for (const int sign : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE}) {
    const Tried dies([=](const HandOver&) {
      std::signal(sign, SIG_DFL);
      kill(getpid(), sign);
      std::raise(sign);
      __builtin_trap();
    });
    CHECK_THROWS_WITH(dies.run(), Contains("a.h5: makes the HDF5 library crash"));
  }
  volatile bool endless = true;
  const Tried runs_on([&](const HandOver&) {
    while (endless) {
    }
  });
  CHECK_THROWS_WITH(runs_on.run(), Contains("a.h5: keeps the HDF5 library busy without end"));
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const Tried fills([](const HandOver& hand_over) {
    const std::vector<char> much(std::size_t{1} << 30, 'x');
    say(hand_over, std::string(1, much[much.size() / 2]));
  });
  CHECK_THROWS_WITH(fills.run(), Contains("a.h5: takes more memory"));
#endif
  const Tried refuses([](const HandOver&) { throw InvalidInput("a.h5", "is damaged"); });
  CHECK_THROWS_WITH(refuses.run(), "a.h5: is damaged");
  const Tried lies([](const HandOver& hand_over) { say(hand_over, std::string(2 << 20, 'x')); });
  CHECK_THROWS_WITH(lies.run(), "a.h5: hands over too much");
}

TEST_CASE("A child opens no file, writes none and has no descriptor of its parent",
          "[confinement]") {
  const Scratch scratch;
  const std::string there = scratch.file("there.txt", "secret").string(),
                    absent = (scratch / "absent.txt").string();
  const int inherited = open(there.c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(inherited >= 0);
  Tried tried([&](const HandOver& hand_over) {
    char byte;
    say(hand_over, open(there.c_str(), O_RDONLY) < 0 ? "closed " : "open ");
    say(hand_over, open(absent.c_str(), O_WRONLY | O_CREAT, 0600) < 0 ? "closed " : "open ");
    say(hand_over, pread(inherited, &byte, 1, 0) < 0 ? "closed " : "open ");
    say(hand_over, socket(AF_UNIX, SOCK_STREAM, 0) < 0 ? "closed" : "open");
  });
  tried.run();
  close(inherited);
  CHECK(tried.text == "closed closed closed closed");
  CHECK_FALSE(std::filesystem::exists(absent));
}

TEST_CASE("Files are read whatever the parent does with SIGCHLD", "[confinement]") {
  const Scratch scratch;
  write_small(scratch / "a.h5");
  confinement::install();
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  CHECK(ResultReader(scratch / "a.h5").numbers("g/x").size() == 20000);
  const Tried dies([](const HandOver&) { __builtin_trap(); });
  CHECK_THROWS_WITH(dies.run(), Contains("a.h5: makes the HDF5 library crash"));
  std::signal(SIGCHLD, before);
  set_hdf5_runner(nullptr);
}

TEST_CASE("Where the system grants no process, nothing is read and the message says so",
          "[confinement]") {
  const Scratch scratch;
  write_small(scratch / "a.h5");
  // Root may start processes without limit: the test is of a child that has given that up.
  const pid_t child = fork();
  if (child == 0) {
    confinement::install();
    std::filesystem::permissions(scratch.folder(), std::filesystem::perms::all);
    const rlimit none{0, 0};
    setrlimit(RLIMIT_NPROC, &none);
    if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) _exit(3);
    try {
      ResultReader(scratch / "a.h5");
      _exit(1);
    } catch (const IoError& error) {
      _exit(std::strstr(error.what(), "grants no process") ? 0 : 2);
    } catch (...) {
      _exit(4);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("Files are read while other threads write with the same HDF5 library", "[confinement]") {
  const Scratch scratch;
  write_small(scratch / "a.h5");
  confinement::install();
  std::atomic<bool> done = false;
  std::thread writer([&] {
    while (!done) write_small(scratch / "b.h5");
  });
  // A child forked while the other thread is inside HDF5 would wait for it until it is given up.
  for (int i = 0; i < 200; ++i)
    REQUIRE(ResultReader(scratch / "a.h5").numbers("g/x").back() == 19999);
  done = true;
  writer.join();
  set_hdf5_runner(nullptr);
}
