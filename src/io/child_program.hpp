// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Programs that salebra calls: gnuplot, and what imports files of instruments.
namespace salebra::detail {

/// Whether a program of that name is in one of the folders of PATH.
bool on_path(const std::string& program);

/// What became of a child process.
struct ChildRun {
  int start_error = 0;  ///< errno where it could not be started
  int signal = 0;       ///< that ended it
  int status = 0;       ///< of its exit
  std::string output, errors;
};

/// Runs words[0], found by PATH, with these arguments and this text as its standard input, and waits
/// for its end. Its streams are files in memory: it neither blocks on a full pipe nor leaves
/// anything behind. Throws IoError where the system has no room for them.
ChildRun run_child(std::vector<std::string> words, std::string_view input = "");

}  // namespace salebra::detail
