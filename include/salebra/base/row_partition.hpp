// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <salebra/base/communicator.hpp>
#include <salebra/base/grid.hpp>
#include <salebra/base/parallel.hpp>
#include <span>
#include <type_traits>
#include <vector>

namespace salebra {

/// Distribution of the rows of a field over the processes of a communicator, e.g. `Share(ranks,
/// grid.nx)`. Each process has consecutive rows, in the order of the processes, in whole blocks of
/// 16 rows or of the block size of parallel::map_blocks. Transforms pair rows, and sums add them,
/// within a block, so results have the same bits for any number of processes.
class RowPartition {
 public:
  RowPartition() : RowPartition(0) {}
  /// Keeps all rows in this process.
  explicit RowPartition(Index rows) : RowPartition(Communicator(), rows) {}
  /// least: minimum number of rows per process; if there are too few rows, the last processes have
  /// none.
  RowPartition(const Communicator& communicator, Index rows, Index least = 16);
  /// begins[r]: the first row of process r; begins[ranks]: the number of rows.
  RowPartition(const Communicator& communicator, std::vector<Index> begins);

  const Communicator& communicator() const { return communicator_; }
  Index rows() const { return begins_.back(); }  ///< total over all processes
  Index begin() const { return begin_of(communicator_.rank()); }
  Index end() const { return end_of(communicator_.rank()); }
  Index count() const { return end() - begin(); }
  Index begin_of(int rank) const { return begins_[static_cast<std::size_t>(rank)]; }
  Index end_of(int rank) const { return begins_[static_cast<std::size_t>(rank) + 1]; }
  int owner(Index row) const;

 private:
  Communicator communicator_;
  std::vector<Index> begins_;
};

/// Sends rows of a field from the processes that have them to those that need them. Collective.
class RowExchange {
 public:
  /// Rows first … first + count − 1 of a field, which may be outside its edges.
  struct Window {
    Index first = 0, count = 0;
  };
  /// Replacement for rows outside the edges: those of the opposite edge, the row at the edge, or
  /// none, which leaves them unchanged.
  enum class Edge { repeat, clamp, none };

  /// wanted(rank): the window of each process. It must return the same on every process.
  RowExchange(const RowPartition& from, const std::function<Window(int rank)>& wanted, Edge edge);

  /// Fills a window. rows: the first row of this process; window: the first row of its window.
  /// Strides and row length are in bytes. Rows of the window that this process has itself may
  /// already be there.
  void operator()(const void* rows, std::size_t row_stride, void* window, std::size_t window_stride,
                  std::size_t row_bytes) const;

  /// Returns a pointer to each row of the window: into the rows of this process, into the buffer
  /// `room`, or nullptr for a row that is left unchanged.
  std::vector<const void*> fetch(const void* rows, std::size_t row_stride, std::size_t row_bytes,
                                 std::vector<std::byte>& buffer) const;

 private:
  struct Move {
    Index from, to;  // row of this process, row of its window
  };
  // Rows from other processes, in the order of received_.
  std::vector<std::byte> receive(const void* rows, std::size_t row_stride,
                                 std::size_t row_bytes) const;

  Communicator communicator_;
  Index count_ = 0;  // rows of the window of this process
  std::vector<std::int64_t> sent_counts_, received_counts_;
  std::vector<Index> sent_;      // rows of this process, in the order of the receivers
  std::vector<Index> received_;  // rows of the window, in the order of the senders
  std::vector<Move> own_;
};

/// Gathers the whole field in the process `root`; the others get no rows. mine: the rows of this
/// process. Collective; a failure in one process is thrown on all. The root needs memory for the
/// whole field.
Field gathered(const RowPartition& rows, const Field& mine, int root = 0);
/// Does the inverse: distributes the rows of a field with this number of columns that the first
/// process has. Collective.
Field scattered(const RowPartition& rows, Index columns, const Field& whole);

/// Assembles the columns of a field whose rows are distributed over processes, and passes each to
/// the process that owns it. The columns of a block of parallel::map_blocks are passed in order by
/// one thread; several threads handle blocks at once. Value: double or its complex.
/// columns  ownership of columns; whole blocks of them if sums are made by blocks
/// read     writes the numbers first … first + count − 1 of a row of this process; called from
///          several threads at once
/// visit    takes a column, counted over all processes, of rows.rows() numbers, which it may
///          change: they are aligned to 64 bytes
/// throws   what read or visit throws in any process, in all of them
/// cost     collective; each number is sent once, some columns at a time, with buffers of at most
///          as much memory as the numbers of a process, or 32 columns per process if that is more
template <class Value>
void visit_columns(const RowPartition& rows, const RowPartition& columns,
                   const std::function<void(Index row, Index first, Index count, Value* to)>& read,
                   const std::function<void(Index column, std::span<Value> values)>& visit);

namespace parallel {

/// Combines the values of the blocks of this process, from map_blocks, to those of all processes,
/// in row order. Collective.
template <class Value>
std::vector<Value> gather_blocks(const RowPartition& partition, const std::vector<Value>& mine) {
  static_assert(std::is_trivially_copyable_v<Value>);
  if (partition.communicator().alone()) return mine;
  const Index size = block_rows(partition.rows());
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < partition.communicator().size(); ++rank)
    bytes.push_back(
        static_cast<std::size_t>((partition.end_of(rank) - partition.begin_of(rank) + size - 1) / size) *
        sizeof(Value));
  std::vector<Value> all(static_cast<std::size_t>(block_count(partition.rows())));
  partition.communicator().gather_all(mine.data(), bytes, all.data());
  return all;
}

/// Returns the values of body(begin, end) over the blocks of all processes, in row order. begin and
/// end count the rows of this process. Collective.
template <class Value, class Body>
std::vector<Value> map_blocks(const RowPartition& partition, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return gather_blocks(partition,
                       map_blocks_of<Value>(block_rows(partition.rows()), partition.count(), body, work));
}

/// Returns the sum of body(begin, end) over the blocks of all processes, added in their order.
double sum_blocks(const RowPartition& partition, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

/// Returns sums of `count` numbers over the blocks of all processes, added in their order. mine:
/// those of each block of this process, one block after the other.
std::vector<double> add_blocks(const RowPartition& partition, std::size_t count,
                               const std::vector<double>& mine);
/// Does the same; body(begin, end, sums) adds to the sums of a block, which start at zero. The
/// first process determines count.
std::vector<double> sum_blocks(const RowPartition& partition, std::size_t count,
                               const std::function<void(Index, Index, std::span<double>)>& body);

}  // namespace parallel
}  // namespace salebra
