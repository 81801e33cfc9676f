// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ctime>
#include <fstream>
#include <sstream>
#include <string>

// What a process has used so far, for the programs that compare.py times.
namespace bench {

// Largest resident memory. Not getrusage's: that one begins with the size of the process which
// started this one.
inline long peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) {
      long kilobytes = 0;
      std::istringstream(line.substr(6)) >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

inline double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace bench
