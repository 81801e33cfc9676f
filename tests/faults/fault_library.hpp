// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <string_view>

/// What the driver and the preloaded library say to each other, in a file that both have mapped.
namespace salebra::faults {

enum class Kind { write, sync, rename, space, open, close, read, memory };
constexpr std::size_t kinds = 8;

constexpr std::array<std::string_view, kinds> kind_names{"write", "fsync", "rename", "space",
                                                         "open",  "close", "read",   "memory"};

/// What is done in place of an error: half of the bytes are written; SIGKILL before the call.
constexpr int short_write = -1, killed = -2;

struct Plan {
  std::array<char, 512> folder{};                ///< calls on files below it count
  Kind kind = Kind::write;                       ///< of the calls that fail
  long first = 0;                                ///< the call that fails, from 1 on; 0: none
  bool for_good = false;                         ///< and all after it
  int error = 0;                                 ///< errno, short_write or killed
  std::array<std::atomic<long>, kinds> calls{};  ///< counted so far
  std::atomic<long> failed = 0;
};

}  // namespace salebra::faults
