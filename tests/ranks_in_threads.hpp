// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <salebra/base/communicator.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/progress.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

// Processes as threads of the test: the transport that holds the distributed code to its promises
// without MPI. Ranks that call different collectives, or the same one with sizes that do not fit,
// fail with a message instead of waiting for ever, and so do those that wait for a rank which has
// ended. Copies are made in a random order.
namespace salebra::testing {

class ThreadTransport;

inline std::vector<std::size_t> shuffled(std::size_t ranks, std::minstd_rand& chance) {
  std::vector<std::size_t> order(ranks);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), chance);
  return order;
}

// What the ranks share: where they wait for each other, and what each has brought to the present
// call.
class Meeting {
 public:
  explicit Meeting(int ranks)
      : calls_(static_cast<std::size_t>(ranks)), copies_(calls_.size()), failures_(calls_.size()) {}

  struct Call {
    std::string name;  // with whatever must agree
    const void* from = nullptr;
    const std::int64_t* counts = nullptr;
    const std::int64_t* offsets = nullptr;
    std::uint64_t bytes_sent = 0;
  };

  using Copy = std::function<void(const std::vector<Call>&)>;

  // Waits for all ranks. The last to come runs what each has to copy, in any order, with the calls
  // of all: of threads that are more than the processors, waiting for a second time would cost more
  // than all else.
  void meet(int rank, const Call& call, const Copy& copy) {
    const auto me = static_cast<std::size_t>(rank);
    calls_[me] = call;
    copies_[me] = &copy;
    const int turn = turn_ & ~one_has_left;
    if (++waiting_ == static_cast<int>(calls_.size())) {
      waiting_ = 0;
      copy_for_all();
      ++turn_;
      turn_.notify_all();
    }
    for (int now = turn_; (now & ~one_has_left) == turn; now = turn_) {
      if (now & one_has_left) throw std::logic_error("a rank waits for one that has ended");
      turn_.wait(now);
    }
    if (failures_[me]) std::rethrow_exception(std::exchange(failures_[me], nullptr));
  }
  // A rank has left: nobody may wait for it.
  void leave() {
    turn_ |= one_has_left;
    turn_.notify_all();
  }

 private:
  static constexpr int one_has_left = 1 << 30;

  void copy_for_all() {
    for (const std::size_t rank : shuffled(calls_.size(), chance_)) {
      try {
        for (const Call& other : calls_)
          if (other.name != calls_[rank].name)
            throw std::logic_error("ranks call different collectives: " + calls_[rank].name +
                                   " in rank " + std::to_string(rank) + ", " + other.name +
                                   " in another");
        (*copies_[rank])(calls_);
      } catch (...) {
        failures_[rank] = std::current_exception();
      }
    }
  }

  std::vector<Call> calls_;
  std::vector<const Copy*> copies_;
  std::vector<std::exception_ptr> failures_;
  std::minstd_rand chance_;
  std::atomic<int> waiting_ = 0, turn_ = 0;
};

class ThreadTransport : public detail::Transport {
 public:
  ThreadTransport(std::shared_ptr<Meeting> meeting, int rank, int ranks)
      : meeting_(std::move(meeting)),
        rank_(rank),
        ranks_(ranks),
        chance_(static_cast<unsigned>(rank)) {}
  ThreadTransport(const ThreadTransport&) = delete;
  ThreadTransport& operator=(const ThreadTransport&) = delete;
  // Nobody may wait for a rank that has let go of a group.
  ~ThreadTransport() override {
    if (of_group_) meeting_->leave();
  }

  int rank() const override { return rank_; }
  int size() const override { return ranks_; }

  void broadcast(void* bytes, std::size_t count, int from) override {
    meeting_->meet(
        rank_, {"broadcast of " + std::to_string(count) + " from " + std::to_string(from), bytes},
        [&](const auto& calls) {
          if (rank_ != from) std::memcpy(bytes, calls[static_cast<std::size_t>(from)].from, count);
        });
  }

  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) override {
    std::string sizes;
    std::vector<std::size_t> offsets;
    std::size_t place = 0;
    for (const std::size_t size : bytes) {
      sizes += ' ' + std::to_string(size);
      offsets.push_back(place);
      place += size;
    }
    meeting_->meet(rank_, {"gather of" + sizes, mine}, [&](const auto& calls) {
      for (const std::size_t from : shuffled())
        if (bytes[from] > 0)
          std::memcpy(static_cast<char*>(all) + offsets[from], calls[from].from, bytes[from]);
    });
  }

  void exchange(std::size_t unit, const void* from, const Parts& sent, void* to,
                const Parts& received) override {
    Meeting::Call call{"exchange of units of " + std::to_string(unit), from, sent.counts.data(),
                       sent.offsets.data()};
    meeting_->meet(rank_, call, [&](const auto& calls) {
      for (const std::size_t other : shuffled()) {
        const auto me = static_cast<std::size_t>(rank_);
        if (calls[other].counts[me] != received.counts[other])
          throw std::logic_error("rank " + std::to_string(other) + " sends " +
                                 std::to_string(calls[other].counts[me]) + " units to rank " +
                                 std::to_string(rank_) + ", which expects " +
                                 std::to_string(received.counts[other]));
        const auto bytes = static_cast<std::size_t>(received.counts[other]) * unit;
        if (bytes > 0)
          std::memcpy(
              static_cast<char*>(to) + static_cast<std::size_t>(received.offsets[other]) * unit,
              static_cast<const char*>(calls[other].from) +
                  static_cast<std::size_t>(calls[other].offsets[me]) * unit,
              bytes);
      }
    });
  }

  std::shared_ptr<Transport> split(int group) override {
    const std::int64_t mine = group;
    std::vector<std::int64_t> groups(static_cast<std::size_t>(ranks_));
    gather_all(&mine, std::vector<std::size_t>(groups.size(), sizeof mine), groups.data());
    const auto first = static_cast<int>(std::ranges::find(groups, mine) - groups.begin());
    const auto members = static_cast<int>(std::ranges::count(groups, mine));
    // The meeting of the first rank of a group is the group's.
    const auto made = std::make_shared<Meeting>(members);
    std::shared_ptr<Meeting> meeting;
    meeting_->meet(rank_, {"split", &made}, [&](const auto& calls) {
      meeting = *static_cast<const std::shared_ptr<Meeting>*>(
          calls[static_cast<std::size_t>(first)].from);
    });
    const auto place = static_cast<int>(std::count(groups.begin(), groups.begin() + rank_, mine));
    auto transport = std::make_shared<ThreadTransport>(meeting, place, members);
    transport->of_group_ = true;
    return transport;
  }

 private:
  std::vector<std::size_t> shuffled() {
    return testing::shuffled(static_cast<std::size_t>(ranks_), chance_);
  }

  std::shared_ptr<Meeting> meeting_;
  int rank_, ranks_;
  bool of_group_ = false;
  std::minstd_rand chance_;
};

// Runs body(communicator) on so many ranks at once. Throws what the first rank that failed threw.
inline void run_ranks(int ranks, const std::function<void(const Communicator&)>& body) {
  const auto meeting = std::make_shared<Meeting>(ranks);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(ranks));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      try {
        body(Communicator(std::make_shared<ThreadTransport>(meeting, rank, ranks)));
      } catch (...) {
        failures[static_cast<std::size_t>(rank)] = std::current_exception();
      }
      meeting->leave();
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

struct ReportedStop {
  int reports = 0;      // to the one rank that listens
  int interrupted = 0;  // ranks that threw Interrupted
};

// Runs work on so many ranks, of which one listens and says stop at its report number `stop`; 0:
// never.
inline ReportedStop stop_one(
    int ranks, int listener, int stop,
    const std::function<void(const Communicator&, const Progress&)>& work) {
  ReportedStop result;
  std::atomic<int> interrupted = 0;
  run_ranks(ranks, [&](const Communicator& together) {
    const auto told = [&](const ProgressReport&) { return ++result.reports != stop; };
    try {
      work(together, together.rank() == listener ? Progress(told) : Progress());
    } catch (const Interrupted&) {
      ++interrupted;
    }
  });
  result.interrupted = interrupted;
  return result;
}

}  // namespace salebra::testing
