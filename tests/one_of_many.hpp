// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>
#include <salebra/base/communicator.hpp>
#include <stdexcept>

namespace salebra::testing {

/// One rank of a communicator whose other ranks do not exist: what it would send is counted, and
/// what it would receive is zero. Plans of any number of processes can be made and measured so,
/// without their memory.
class OneOfMany : public detail::Transport {
 public:
  struct Count {
    long calls = 0, messages = 0;
    double sent = 0;  ///< bytes
  };
  OneOfMany(int rank, int ranks) : rank_(rank), ranks_(ranks) {}

  Count exchanged, gathered;

  int rank() const override { return rank_; }
  int size() const override { return ranks_; }
  void broadcast(void* bytes, std::size_t count, int from) override {
    if (from != rank_) std::memset(bytes, 0, count);
  }
  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) override {
    ++gathered.calls;
    auto* to = static_cast<char*>(all);
    for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
      if (bytes[rank] == 0) continue;
      if (static_cast<int>(rank) == rank_) {
        std::memcpy(to, mine, bytes[rank]);
        gathered.sent += static_cast<double>(bytes[rank]);
      } else {
        std::memset(to, 0, bytes[rank]);
      }
      to += bytes[rank];
    }
  }
  void exchange(std::size_t unit, const void*, const Parts& sent, void* to,
                const Parts& received) override {
    ++exchanged.calls;
    for (std::size_t rank = 0; rank < static_cast<std::size_t>(ranks_); ++rank) {
      if (static_cast<int>(rank) != rank_ && sent.counts[rank] > 0) {
        ++exchanged.messages;
        exchanged.sent += static_cast<double>(sent.counts[rank]) * static_cast<double>(unit);
      }
      if (received.counts[rank] > 0)
        std::memset(
            static_cast<char*>(to) + static_cast<std::size_t>(received.offsets[rank]) * unit, 0,
            static_cast<std::size_t>(received.counts[rank]) * unit);
    }
  }
  std::shared_ptr<Transport> split(int) override {
    throw std::logic_error("one of many ranks does not know the groups of the others");
  }

 private:
  int rank_, ranks_;
};

}  // namespace salebra::testing
