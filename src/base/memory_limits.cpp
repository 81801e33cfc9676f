// SPDX-License-Identifier: GPL-3.0-or-later
// Memory left by the machine, the cgroups of this process and its resource limits.
#include "memory_limits.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace salebra::detail {
namespace {

namespace fs = std::filesystem;
using Bytes = std::optional<std::uint64_t>;

/// The first word of a file as a number; "max" or a missing file mean no limit.
Bytes number_in(const fs::path& file) {
  std::ifstream stream(file);
  std::uint64_t number = 0;
  if (stream >> number) return number;
  return {};
}

/// The number that follows `name`, in the line of the file that begins with `name`.
Bytes value_of(const fs::path& file, std::string_view name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(name)) continue;
    std::istringstream rest(line.substr(name.size()));
    std::uint64_t number = 0;
    if (rest >> number) return number;
  }
  return {};
}

std::uint64_t difference(std::uint64_t limit, std::uint64_t used) {
  return limit > used ? limit - used : 0;
}

/// Names of the files of one version of cgroups.
struct Dialect {
  std::vector<const char*> limits;
  const char* usage;
  std::vector<const char*> file_cache;  // names of lines in memory.stat
};
const Dialect version1{{"memory.limit_in_bytes"},
                       "memory.usage_in_bytes",
                       {"total_inactive_file ", "total_active_file "}};
const Dialect version2{
    {"memory.max", "memory.high"}, "memory.current", {"inactive_file ", "active_file "}};

Bytes left_in(const fs::path& group, const Dialect& dialect) {
  Bytes limit;
  for (const char* name : dialect.limits)
    if (const Bytes own = number_in(group / name)) limit = std::min(limit.value_or(*own), *own);
  if (!limit) return {};
  std::uint64_t used = number_in(group / dialect.usage).value_or(0);
  for (const char* name : dialect.file_cache)
    used = difference(used, value_of(group / "memory.stat", name).value_or(0));
  return difference(*limit, used);
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

/// Mount point of the cgroup file system that controls memory, and the folder of the cgroup
/// hierarchy that is mounted there: a container sees only its own folder.
struct Mount {
  const Dialect* dialect;
  std::string root, point;
};

// Columns of /proc/self/mountinfo by proc_pid_mountinfo(5): number, parent, device, root, mount
// point, options, optional fields, "-", type, source, options of the type.
std::vector<Mount> memory_mounts(const fs::path& proc) {
  std::vector<Mount> mounts;
  std::ifstream stream(proc / "self/mountinfo");
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> fields = split(line, ' ');
    const auto dash = std::ranges::find(fields, "-");
    if (fields.size() < 5 || fields.end() - dash < 4) continue;
    if (dash[1] == "cgroup2") {
      mounts.push_back({&version2, fields[3], fields[4]});
    } else if (dash[1] == "cgroup" && contains(split(dash[3], ','), "memory")) {
      mounts.push_back({&version1, fields[3], fields[4]});
    }
  }
  return mounts;
}

/// The cgroup of this process from /proc/self/cgroup: "4:memory:/path" in version 1, "0::/path" in
/// version 2.
std::string group_of(const fs::path& proc, const Dialect& dialect) {
  std::ifstream stream(proc / "self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool own = &dialect == &version2 ? line.starts_with("0::")
                                           : contains(split(controllers, ','), "memory");
    if (own) return line.substr(second + 1);
  }
  return "/";
}

void take_groups(const fs::path& root, std::vector<std::uint64_t>& left) {
  for (const Mount& mount : memory_mounts(root / "proc")) {
    fs::path group = group_of(root / "proc", *mount.dialect);
    // In a container the group may lie outside the mounted folder; then only the mounted folder can
    // be read.
    const fs::path below = group.lexically_relative(mount.root);
    group = below.empty() || *below.begin() == ".." ? fs::path() : below;
    const fs::path point = root / fs::path(mount.point).relative_path();
    for (group = group == "." ? fs::path() : group;; group = group.parent_path()) {
      if (const Bytes own = left_in(point / group, *mount.dialect)) left.push_back(*own);
      if (group.empty()) break;
    }
  }
}

/// Appends to `left` what RLIMIT_AS and RLIMIT_DATA leave to the process, in bytes. In the files of
/// /proc these limits and the memory that they limit have other names.
void take_process_limits(const fs::path& proc, std::vector<std::uint64_t>& left) {
  for (const auto& [limit, used] :
       {std::pair{"Max address space", "VmSize:"}, {"Max data size", "VmData:"}})
    if (const Bytes bytes = value_of(proc / "self/limits", limit))
      left.push_back(difference(*bytes, 1024 * value_of(proc / "self/status", used).value_or(0)));
}

}  // namespace

std::optional<std::uint64_t> shared_memory_left(const fs::path& root) {
  std::vector<std::uint64_t> left;
  if (const Bytes kibibytes = value_of(root / "proc/meminfo", "MemAvailable:"))
    left.push_back(1024 * *kibibytes);
  take_groups(root, left);
  if (left.empty()) return {};
  return std::ranges::min(left);
}

std::optional<std::uint64_t> memory_left(const fs::path& root) {
  std::vector<std::uint64_t> left;
  if (const Bytes shared = shared_memory_left(root)) left.push_back(*shared);
  take_process_limits(root / "proc", left);
  if (left.empty()) return {};
  return std::ranges::min(left);
}

NodeMemory shortest_memory(const std::vector<ProcessMemory>& processes) {
  std::map<std::string, double> needed;
  for (const ProcessMemory& process : processes) needed[process.node] += process.needed;
  NodeMemory shortest;
  double most = -1;  // maximum of needed/available memory
  for (const ProcessMemory& process : processes) {
    const double of_node = needed[process.node];
    double available = process.shared;
    // If the limit of one process is below the memory shared by its node, assume that limit for all
    // processes of the node.
    if (process.own > 0 && process.needed > 0)
      available = std::min(available > 0 ? available : std::numeric_limits<double>::infinity(),
                           process.own * of_node / process.needed);
    const double part = available > 0 ? of_node / available : 0;
    if (part <= most) continue;
    most = part;
    shortest = {process.node, static_cast<int>(needed.size()), of_node, available};
  }
  return shortest;
}

}  // namespace salebra::detail
