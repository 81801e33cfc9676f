// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Programs that salebra calls: gnuplot, and what imports files of instruments.
namespace salebra::detail {

/// The program of that name in the folders of PATH; empty where there is none. Folders that depend on
/// the current one, where a stranger's files may lie, are left out.
std::string found_on_path(const std::string& program);

/// What a child may take before it is ended.
struct ChildLimits {
  std::chrono::seconds time{600};
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< of its data, bytes
  std::function<bool()> stopped = {};             ///< asked while it runs: whether to end it
};

/// What became of a child process.
struct ChildRun {
  int start_error = 0;  ///< errno where it could not be started
  int signal = 0;       ///< that ended it
  int status = 0;       ///< of its exit
  bool late = false;    ///< it was ended because its time was over
  std::string output, errors;
};

/// Runs words[0], found by found_on_path(), with these arguments and this text as its standard input,
/// and waits for its end, within the limits; it leaves no core file. Its streams are files in
/// memory: it neither blocks on a full pipe nor leaves anything behind. Throws IoError where the system has no room for them, Interrupted where it was
/// stopped.
ChildRun run_child(std::vector<std::string> words, std::string_view input = "",
                   const ChildLimits& limits = {});

}  // namespace salebra::detail
