// SPDX-License-Identifier: GPL-3.0-or-later
// Implements mpi.hpp: MPI as the transport of communicators; its initialisation and finalisation.
#include "mpi/mpi.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <salebra/base/error.hpp>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace salebra::mpi {
namespace {

constexpr std::int64_t most = std::numeric_limits<int>::max();

void check(int status, const char* call) {
  if (status == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(status, text.data(), &length);
  throw Error(std::string(call) + ": " +
              std::string(text.data(), static_cast<std::size_t>(length)));
}

/// Duplicates a communicator; MPI calls on the copy return errors instead of ending the program.
MPI_Comm copy_of(MPI_Comm processes) {
  MPI_Comm copy = MPI_COMM_NULL;
  check(MPI_Comm_dup(processes, &copy), "MPI_Comm_dup");
  check(MPI_Comm_set_errhandler(copy, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return copy;
}

/// Converts counts and indices to int, as MPI 3 requires; throws if one does not fit.
std::vector<int> narrowed(std::span<const std::int64_t> numbers) {
  std::vector<int> result;
  for (const std::int64_t number : numbers) {
    require(number >= 0 && number <= most, "exchange", number,
            "must not be beyond 2147483647 units; use more processes");
    result.push_back(static_cast<int>(number));
  }
  return result;
}

/// An MPI data type whose elements have the given number of bytes.
class Unit {
 public:
  explicit Unit(std::size_t bytes) {
    require(bytes >= 1 && bytes <= std::size_t{most}, "exchange", bytes,
            "bytes cannot be one unit; use smaller ones");
    check(MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &type_), "MPI_Type_contiguous");
    check(MPI_Type_commit(&type_), "MPI_Type_commit");
  }
  Unit(const Unit&) = delete;
  Unit& operator=(const Unit&) = delete;
  ~Unit() { MPI_Type_free(&type_); }
  operator MPI_Datatype() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

class MpiTransport : public detail::Transport {
 public:
  explicit MpiTransport(MPI_Comm processes) : processes_(copy_of(processes)) {
    check(MPI_Comm_rank(processes_, &rank_), "MPI_Comm_rank");
    check(MPI_Comm_size(processes_, &ranks_), "MPI_Comm_size");
  }
  MpiTransport(const MpiTransport&) = delete;
  MpiTransport& operator=(const MpiTransport&) = delete;
  ~MpiTransport() override {
    int finalized = 0;
    if (MPI_Finalized(&finalized) == MPI_SUCCESS && !finalized) MPI_Comm_free(&processes_);
  }

  int rank() const override { return rank_; }
  int size() const override { return ranks_; }

  void broadcast(void* bytes, std::size_t count, int from) override {
    // Sent in pieces, because MPI counts with int.
    constexpr std::size_t piece = 1 << 30;
    for (std::size_t done = 0; done < count; done += piece)
      check(MPI_Bcast(static_cast<char*>(bytes) + done,
                      static_cast<int>(std::min(piece, count - done)), MPI_BYTE, from, processes_),
            "MPI_Bcast");
  }

  void gather_all(const void* mine, std::span<const std::size_t> bytes, void* all) override {
    std::vector<std::int64_t> counts, offsets;
    std::int64_t end = 0;
    for (const std::size_t count : bytes) {
      counts.push_back(static_cast<std::int64_t>(count));
      offsets.push_back(end);
      end += counts.back();
    }
    if (end > most) return gather_in_turn(mine, counts, offsets, static_cast<char*>(all));
    const auto own = static_cast<int>(bytes[static_cast<std::size_t>(rank_)]);
    check(MPI_Allgatherv(mine, own, MPI_BYTE, all, narrowed(counts).data(),
                         narrowed(offsets).data(), MPI_BYTE, processes_),
          "MPI_Allgatherv");
  }

  void exchange(std::size_t unit, const void* from, const Parts& sent, void* to,
                const Parts& received) override {
    const auto count = static_cast<std::size_t>(ranks_);
    const Unit type(unit);
    check(MPI_Alltoallv(from, narrowed(sent.counts.first(count)).data(),
                        narrowed(sent.offsets.first(count)).data(), type, to,
                        narrowed(received.counts.first(count)).data(),
                        narrowed(received.offsets.first(count)).data(), type, processes_),
          "MPI_Alltoallv");
  }

  std::shared_ptr<Transport> split(int group) override {
    MPI_Comm part = MPI_COMM_NULL;
    check(MPI_Comm_split(processes_, group, rank_, &part), "MPI_Comm_split");
    auto transport = std::make_shared<MpiTransport>(part);
    MPI_Comm_free(&part);
    return transport;
  }

 private:
  /// Gathers more bytes than MPI can count with int: each process in turn broadcasts its part.
  void gather_in_turn(const void* mine, const std::vector<std::int64_t>& counts,
                      const std::vector<std::int64_t>& offsets, char* all) {
    for (std::size_t from = 0; from < counts.size(); ++from) {
      const auto count = static_cast<std::size_t>(counts[from]);
      if (static_cast<int>(from) == rank_ && count > 0)
        std::memcpy(all + offsets[from], mine, count);
      broadcast(all + offsets[from], count, static_cast<int>(from));
    }
  }

  MPI_Comm processes_;
  int rank_ = 0, ranks_ = 1;
};

}  // namespace

Communicator communicator(MPI_Comm processes) {
  return Communicator(std::make_shared<MpiTransport>(processes));
}

std::string library() {
  char words[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  check(MPI_Get_library_version(words, &length), "MPI_Get_library_version");
  const std::string_view text(words, static_cast<std::size_t>(length));
  return std::string(text.substr(0, text.find_first_of(",\n")));
}

Session::Session() {
  int granted = MPI_THREAD_SINGLE;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &granted), "MPI_Init_thread");
  if (granted < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    throw Error("MPI: this MPI library does not support programs with threads; use one that does");
  }
  meeting_ = copy_of(MPI_COMM_WORLD);
}

Session::~Session() {
  // The communicator of all_here() must not be freed while it is in use.
  MPI_Wait(&met_, MPI_STATUS_IGNORE);
  MPI_Comm_free(&meeting_);
  MPI_Finalize();
}

Communicator Session::communicator() const { return mpi::communicator(MPI_COMM_WORLD); }

Communicator Session::communicator_of_node() const {
  MPI_Comm node = MPI_COMM_NULL;
  check(MPI_Comm_split_type(meeting_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node),
        "MPI_Comm_split_type");
  Communicator of_node = mpi::communicator(node);
  MPI_Comm_free(&node);
  return of_node;
}

bool Session::all_here(std::chrono::milliseconds patience) {
  if (met_ == MPI_REQUEST_NULL && MPI_Ibarrier(meeting_, &met_) != MPI_SUCCESS) return false;
  const auto end = std::chrono::steady_clock::now() + patience;
  int done = 0;
  while (MPI_Test(&met_, &done, MPI_STATUS_IGNORE) == MPI_SUCCESS && !done) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return done != 0;
}

void Session::abort(int status) const {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

}  // namespace salebra::mpi
