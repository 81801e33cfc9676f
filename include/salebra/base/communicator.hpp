// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace salebra {

namespace detail {

/// Transfers bytes between the processes of a communicator. Each call is collective: all processes
/// make it, in the same order.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual void broadcast(void* bytes, std::size_t count, int from) = 0;
  /// Gathers bytes[r] bytes from each process r; `all` receives them in the order of the processes.
  virtual void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) = 0;
  /// Numbers and offsets of the units (of `unit` bytes) that this process sends to, or receives
  /// from, each process.
  struct Parts {
    std::span<const std::int64_t> counts, offsets;
  };
  virtual void exchange(std::size_t unit, const void* from, const Parts& sent, void* to,
                        const Parts& received) = 0;
  /// Returns a Transport between the processes that pass the same group, in the order of their
  /// ranks.
  virtual std::shared_ptr<Transport> split(int group) = 0;
};

}  // namespace detail

/// Plan of an all-to-all exchange, in units of a given number of bytes. Throws InvalidInput if a
/// count or an offset exceeds 2^31 − 1 units, the limit of MPI 3.
class Exchange {
 public:
  /// sent[r], received[r]: number of units sent to and received from process r. In the buffers, the
  /// units follow each other in the order of the processes.
  Exchange(std::size_t unit, std::vector<std::int64_t> sent, std::vector<std::int64_t> received);

  std::int64_t sent_units() const { return sent_offsets_.back(); }
  std::int64_t received_units() const { return received_offsets_.back(); }
  std::int64_t sent_offset(int rank) const { return sent_offsets_[static_cast<std::size_t>(rank)]; }
  std::int64_t received_offset(int rank) const {
    return received_offsets_[static_cast<std::size_t>(rank)];
  }

 private:
  friend class Communicator;
  std::size_t unit_;
  std::vector<std::int64_t> sent_, received_;
  std::vector<std::int64_t> sent_offsets_, received_offsets_;  // and behind the last
};

/// Processes that compute one surface together; a copy refers to the same processes. Every call
/// except rank(), size() and is_root() is collective: all processes make it, in the same order and
/// with the same sizes. This library contains only the communicator of a single process, which does
/// nothing; salebra-mpi provides communicators of several MPI processes.
///     const bool all_converged = communicator.all_agree(state.converged());
class Communicator {
 public:
  Communicator() = default;  ///< this process alone
  explicit Communicator(std::shared_ptr<detail::Transport> transport)
      : transport_(std::move(transport)) {}

  int rank() const { return transport_ ? transport_->rank() : 0; }
  int size() const { return transport_ ? transport_->size() : 1; }
  bool is_root() const { return rank() == 0; }
  bool alone() const { return size() == 1; }

  void broadcast(void* bytes, std::size_t count, int from = 0) const;
  /// Gathers bytes[r] bytes from each process r; `all` receives them in the order of the processes.
  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) const;
  std::vector<std::string> gather_all(const std::string& mine) const;
  /// Returns true if all processes pass true.
  bool all_agree(bool yes) const;
  /// Returns the minimum over all processes.
  double min_of(double mine) const;
  /// Exchanges units between all processes. from: the units that this process sends; to: receives
  /// the units for this process. The two buffers must not overlap.
  void exchange(const Exchange& plan, const void* from, void* to) const;
  /// Returns the communicator of the processes that pass the same `group`, >= 0, in the order of
  /// their ranks.
  Communicator split(int group) const;

 private:
  std::shared_ptr<detail::Transport> transport_;
};

/// Groups of consecutive processes of a communicator, whose sizes differ by at most one.
class Groups {
 public:
  Groups() = default;  ///< this process alone, one group
  /// Divides the processes of `all` into `count` groups. Collective. Throws InvalidInput unless
  /// count is between 1 and all.size().
  Groups(const Communicator& all, int count);

  const Communicator& all() const { return all_; }
  const Communicator& own() const { return own_; }  ///< the group of this process
  int count() const { return count_; }
  int index() const { return index_; }  ///< index of the group of this process, from 0

 private:
  Communicator all_, own_;
  int count_ = 1, index_ = 0;
};

/// Runs body on every process. If it throws on some processes, the exception of the first of them
/// is thrown on all processes, as InvalidInput, IoError, NotConverged, Interrupted, std::bad_alloc
/// or Error. body must not communicate. Collective.
void collectively(const Communicator& communicator, const std::function<void()>& body);

}  // namespace salebra
