// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "memory.hpp"

namespace salebra::detail {

/// available_memory() of the machine whose files lie under root, "/" for this one: the minimum of
///   MemAvailable of /proc/meminfo;
///   for each memory cgroup from that of the process up to the root of its mount, v1 and v2: its
///   limit (memory.max and memory.high; memory.limit_in_bytes) less what its processes use, of
///   which the file cache can be had back; RLIMIT_AS and RLIMIT_DATA less what the process has.
/// Empty where none of them is known. Source: kernel documentation, admin-guide/cgroup-v1/memory
/// and cgroup-v2; proc(5), getrlimit(2).
std::optional<std::uint64_t> memory_left(const std::filesystem::path& root);

/// Memory without the limits of the process: what the processes of a machine share.
std::optional<std::uint64_t> shared_memory_left(const std::filesystem::path& root);

/// What one process says of its memory, bytes. 0: not known.
struct ProcessMemory {
  std::string node;   ///< name of its machine
  double needed = 0;  ///< in addition to what it has
  double shared = 0;  ///< available to all processes of the machine together
  double own = 0;     ///< available to it alone
};

/// memory_of_nodes() of these processes.
NodeMemory shortest_memory(const std::vector<ProcessMemory>& processes);

}  // namespace salebra::detail
