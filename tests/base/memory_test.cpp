// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the memory left by machine, cgroups and resource limits, with synthetic trees of /proc
// and /sys.
#include "base/memory.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <salebra/base/error.hpp>

#include "base/memory_limits.hpp"
#include "io/scratch.hpp"
#include "ranks_in_threads.hpp"

using namespace salebra;
using detail::memory_left;
namespace fs = std::filesystem;

namespace {

/// The root of a machine with 8 GB available; tests add cgroups.
class Machine {
 public:
  Machine() {
    write(
        "proc/meminfo",
        "MemTotal:       16000000 kB\nMemFree:         1000000 kB\nMemAvailable:    8000000 kB\n");
    write("proc/self/status", "Name:\tsalebra\nVmSize:\t 2000000 kB\nVmData:\t  500000 kB\n");
    write("proc/self/limits",
          "Limit                     Soft Limit           Hard Limit           Units     \n"
          "Max data size             unlimited            unlimited            bytes     \n"
          "Max address space         unlimited            unlimited            bytes     \n");
  }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((scratch_ / file).parent_path());
    std::ofstream(scratch_ / file) << text;
  }
  /// A memory cgroup of version 1 or 2 with its use; `cached` bytes of it are file cache.
  void group1(const std::string& path, const std::string& limit, long used, long cached) const {
    const std::string folder = "sys/fs/cgroup/memory" + path + "/";
    write(folder + "memory.limit_in_bytes", limit + "\n");
    write(folder + "memory.usage_in_bytes", std::to_string(used) + "\n");
    // The plain names count the group without its children.
    write(folder + "memory.stat", "inactive_file 1\nactive_file 1\ntotal_inactive_file " +
                                      std::to_string(cached - 1000) + "\ntotal_active_file 1000\n");
  }
  void group2(const std::string& path, const std::string& max, const std::string& high, long used,
              long cached) const {
    const std::string folder = "sys/fs/cgroup" + path + "/";
    write(folder + "memory.max", max + "\n");
    write(folder + "memory.high", high + "\n");
    write(folder + "memory.current", std::to_string(used) + "\n");
    write(folder + "memory.stat", "anon 5\nfile 77\ninactive_file " +
                                      std::to_string(cached - 1000) + "\nactive_file 1000\n");
  }
  double left() const { return double(memory_left(scratch_.folder()).value()); }

 private:
  Scratch scratch_;
};

const std::string mount1 =
    "30 24 0:26 / /sys/fs/cgroup/cpu rw,nosuid - cgroup cgroup rw,cpu,cpuacct\n"
    "31 24 0:27 / /sys/fs/cgroup/memory rw,nosuid shared:9 - cgroup cgroup rw,memory\n";
const std::string mount2 =
    "29 24 0:26 / /sys/fs/cgroup rw,nosuid shared:4 master:1 - cgroup2 cgroup2 rw,nsdelegate\n";

}  // namespace

TEST_CASE("Without cgroups the machine's available memory counts", "[memory]") {
  const Machine machine;
  CHECK(machine.left() == 8000000.0 * 1024);
  // A kernel without a memory controller.
  machine.write("proc/self/mountinfo",
                "30 24 0:26 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n");
  machine.write("proc/self/cgroup", "2:cpu:/\n");
  CHECK(machine.left() == 8000000.0 * 1024);
  const Scratch nothing;
  CHECK_FALSE(memory_left(nothing.folder()).has_value());
}

TEST_CASE("A cgroup of version 2 leaves its limit less what is used, file cache excepted",
          "[memory]") {
  const Machine machine;
  machine.write("proc/self/mountinfo", mount2);
  machine.write("proc/self/cgroup", "0::/batch/job\n");
  machine.group2("/batch/job", "max", "max", 100, 1000);
  CHECK(machine.left() == 8000000.0 * 1024);
  machine.group2("/batch/job", "600000000", "max", 150000000, 50000000);
  CHECK(machine.left() == 500e6);
  // Above memory.high the kernel slows a process down to a standstill.
  machine.group2("/batch/job", "600000000", "400000000", 150000000, 50000000);
  CHECK(machine.left() == 300e6);
  machine.group2("/batch/job", "600000000", "max", 700000000, 50000000);
  CHECK(machine.left() == 0);
}

TEST_CASE("The closest limit on the way to the root of the cgroups counts", "[memory]") {
  const Machine machine;
  machine.write("proc/self/mountinfo", mount2);
  machine.write("proc/self/cgroup", "0::/batch/user/job\n");
  machine.group2("/batch/user/job", "3000000000", "max", 2000000, 1000000);
  // The parent's use includes all its children.
  machine.group2("/batch", "2000000000", "max", 1500000000, 100000000);
  CHECK(machine.left() == 600e6);
  machine.group2("/batch/user", "1000000000", "max", 601000000, 1000000);
  CHECK(machine.left() == 400e6);
  // A sibling has no influence.
  machine.group2("/batch/other", "1000", "max", 0, 1000);
  CHECK(machine.left() == 400e6);
}

TEST_CASE("A cgroup of version 1 counts with its parents, beside an empty one of version 2",
          "[memory]") {
  const Machine machine;
  machine.write("proc/self/mountinfo",
                mount1 + "32 24 0:28 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
  machine.write("proc/self/cgroup", "5:cpu,cpuacct:/else\n4:memory:/outer/inner\n0::/x\n");
  machine.group1("", "9223372036854771712", 5000000000, 1000000);
  machine.group1("/outer", "700000000", 251000000, 1000000);
  CHECK(machine.left() == 450e6);
  machine.group1("/outer/inner", "300000000", 101000000, 1000000);
  CHECK(machine.left() == 200e6);
}

TEST_CASE("A container sees its own cgroup where its mount is, whatever its path outside",
          "[memory]") {
  const Machine machine;
  machine.write("proc/self/mountinfo",
                "31 24 0:27 /docker/abc /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n");
  machine.group1("", "500000000", 101000000, 1000000);
  machine.write("proc/self/cgroup", "4:memory:/docker/abc\n");
  CHECK(machine.left() == 400e6);
  machine.group1("/job", "200000000", 101000000, 1000000);
  machine.write("proc/self/cgroup", "4:memory:/docker/abc/job\n");
  CHECK(machine.left() == 100e6);
  // A namespace of its own, and a namespace seen from a sibling.
  machine.write("proc/self/cgroup", "4:memory:/\n");
  CHECK(machine.left() == 400e6);
  machine.write("proc/self/cgroup", "4:memory:/../def\n");
  CHECK(machine.left() == 400e6);
}

TEST_CASE("Limits of the process on addresses and data count less what it has", "[memory]") {
  const Machine machine;
  machine.write("proc/self/limits",
                "Max data size             unlimited            unlimited   bytes\n"
                "Max address space         3048000000           unlimited   bytes\n");
  CHECK(machine.left() == 3048e6 - 2000000.0 * 1024);
  machine.write("proc/self/limits",
                "Max data size             812000000            unlimited   bytes\n"
                "Max address space         3048000000           unlimited   bytes\n");
  CHECK(machine.left() == 812e6 - 500000.0 * 1024);
}

TEST_CASE("Sizes of memory have three digits and a unit", "[memory]") {
  CHECK(memory_text(500) == "0.5 kB");
  CHECK(memory_text(64e6) == "64 MB");
  CHECK(memory_text(721.4e6) == "721 MB");
  CHECK(memory_text(999.6e6) == "1 GB");
  CHECK(memory_text(1.437e9) == "1.44 GB");
  CHECK(memory_text(2.81e14) == "281 TB");
  CHECK(memory_text(3e19) == "30 EB");
}

TEST_CASE("Processes of one machine share its memory", "[memory]") {
  using detail::shortest_memory;
  const double gb = 1e9;
  SECTION("which lacks what they need together") {
    const NodeMemory memory = shortest_memory({{"c01", 3 * gb, 8 * gb, 8 * gb},
                                               {"c02", 3 * gb, 8 * gb, 8 * gb},
                                               {"c01", 3 * gb, 7 * gb, 7 * gb},
                                               {"c02", 1 * gb, 8 * gb, 8 * gb}});
    CHECK(memory.node == "c01");
    CHECK(memory.nodes == 2);
    CHECK(memory.needed == 6 * gb);
    CHECK(memory.available == 7 * gb);
    CHECK(memory.suffices());
  }
  SECTION("but not their own limits, each of which must hold its part") {
    // 3 of 4 GB: treated as if the machine had 4/3 of what both processes need.
    NodeMemory memory =
        shortest_memory({{"c01", 3 * gb, 90 * gb, 4 * gb}, {"c01", 3 * gb, 90 * gb, 90 * gb}});
    CHECK(memory.available == 8 * gb);
    CHECK(memory.suffices());
    memory = shortest_memory({{"c01", 3 * gb, 90 * gb, 2 * gb}, {"c01", 3 * gb, 90 * gb, 90 * gb}});
    CHECK_FALSE(memory.suffices());
  }
  SECTION("and a machine that does not say has enough") {
    const NodeMemory memory = shortest_memory({{"c01", 3 * gb, 0, 0}, {"c02", 1 * gb, 0, 0}});
    CHECK(memory.available == 0);
    CHECK(memory.suffices());
  }
}

TEST_CASE("Two processes that each fit are refused where both do not", "[memory]") {
  const double available = static_cast<double>(available_memory());
  const auto require = [](const Communicator& ranks, double bytes) {
    require_memory({10, 20, 1, 2}, bytes, "a test", ranks);
  };
  // Far enough from a half that other programs on the machine do not matter.
  CHECK_NOTHROW(require({}, 0.65 * available));
  std::atomic<int> refused = 0;
  testing::run_ranks(2, [&](const Communicator& ranks) {
    require(ranks, 0.2 * available);
    // Both requests are added, even if they differ.
    try {
      require(ranks, ranks.is_root() ? 1.1 * available : 0.2 * available);
    } catch (const InvalidInput& error) {
      const std::string message = error.what();
      if (message.starts_with("points: 10 x 20 need ") &&
          message.ends_with(" are available; use 2 nodes, or fewer points"))
        ++refused;
    }
  });
  CHECK(refused == 2);
}

TEST_CASE("Work beyond a limit on this process is refused, and small work is not", "[memory]") {
  // A child process sets the limit, because a lowered hard limit cannot be raised again. Exit
  // status 0 means that all is as expected.
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &limit);
    const std::size_t before = available_memory();
    require_memory({10, 20, 1, 2}, 100e6, "a test");
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit small = limit;
    small.rlim_cur = pages * rlim_t(sysconf(_SC_PAGESIZE)) + 900000000;
    setrlimit(RLIMIT_AS, &small);
    const std::size_t after = available_memory();
    std::string message;
    try {
      require_memory({10, 20, 1, 2}, 2e9, "a test");
    } catch (const InvalidInput& error) {
      message = error.what();
    }
    const bool told = message.starts_with("points: 10 x 20 need 2 GB of memory for a test and ") &&
                      message.ends_with(" MB are available; use fewer points");
    require_memory({10, 20, 1, 2}, 60e6, "a small test");
    // In between, the process allocates only a page or two.
    _exit(before > after && after <= 900000000 && after > 890000000 && told ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(status == 0);
}
