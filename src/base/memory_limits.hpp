// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "memory.hpp"

namespace salebra::detail {

/// available_memory() of the machine whose file system is at root ("/" for this machine). It is the
/// minimum of
/// - MemAvailable of /proc/meminfo;
/// - for each memory cgroup (v1 and v2) from that of the process up to the root of its mount: its
///   limit (memory.max and memory.high; memory.limit_in_bytes) less the use of its processes,
///   without their file cache, which can be reclaimed;
/// - RLIMIT_AS and RLIMIT_DATA less the use of the process.
/// Empty if none of them is known. Source: kernel documentation, admin-guide/cgroup-v1/memory and
/// cgroup-v2; proc(5), getrlimit(2).
std::optional<std::uint64_t> memory_left(const std::filesystem::path& root);

/// Memory that the processes of a machine share, without the limits of the single process. root:
/// see memory_left(). Empty if unknown.
std::optional<std::uint64_t> shared_memory_left(const std::filesystem::path& root);

/// Memory as one process sees it, in bytes; 0: not known.
struct ProcessMemory {
  std::string node;   ///< name of its node
  double needed = 0;  ///< bytes beyond what it already has
  double shared = 0;  ///< available to all processes of the node together
  double own = 0;     ///< available to this process
};

/// Finds the node that lacks most memory, for memory_of_nodes(), from the data of all processes.
NodeMemory shortest_memory(const std::vector<ProcessMemory>& processes);

}  // namespace salebra::detail
