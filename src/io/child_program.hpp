// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Runs other programs: gnuplot, and the importer of instrument files.
namespace salebra::detail {

/// Path of the program with this name in the folders of the environment variable PATH; empty if
/// there is none. Relative folders in PATH are skipped, since the current folder may contain
/// programs of somebody else.
std::string found_on_path(const std::string& program);

/// Limits of a child process. It is killed when its time has passed.
struct ChildLimits {
  std::chrono::seconds time{600};
  std::uint64_t memory = std::uint64_t{4} << 30;  ///< largest data segment, bytes
  /// Called while the child runs; if it returns true the child is killed.
  std::function<bool()> stopped = {};
};

/// How a child process ended.
struct ChildRun {
  int start_error = 0;  ///< errno if the child could not be started; otherwise 0
  int signal = 0;       ///< the signal that ended the child; 0: none
  int status = 0;       ///< exit status of the child
  bool late = false;    ///< the child was killed because its time had passed
  std::string output, errors;
};

/// Runs the program words[0], found by found_on_path(), with the other words as arguments and
/// `input` as standard input, and waits for its end within the limits. The child leaves no core
/// file. Its streams are files in memory, so it never blocks on a full pipe and leaves no files
/// behind. Throws IoError if the system has no memory for the streams, and Interrupted if
/// limits.stopped() returned true.
ChildRun run_child(std::vector<std::string> words, std::string_view input = "",
                   const ChildLimits& limits = {});

}  // namespace salebra::detail
