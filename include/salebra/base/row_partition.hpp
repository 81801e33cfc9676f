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

/// Distribution of the rows of a field over the processes of a communicator, for example
/// `RowPartition(communicator, grid.nx)`. Each process has consecutive rows, in the order of the
/// processes, in whole blocks of 16 rows or of the block size of parallel::map_blocks. Transforms
/// combine rows in pairs, and sums add rows, only within a block, so results have the same bits for
/// any number of processes.
class RowPartition {
 public:
  RowPartition() : RowPartition(0) {}
  /// Keeps all rows in this process.
  explicit RowPartition(Index rows) : RowPartition(Communicator(), rows) {}
  /// least: smallest number of rows per process; if there are too few rows, the last processes have
  /// none.
  RowPartition(const Communicator& communicator, Index rows, Index least = 16);
  /// begins[r]: first row of process r; begins[communicator.size()]: total number of rows.
  RowPartition(const Communicator& communicator, std::vector<Index> begins);

  const Communicator& communicator() const { return communicator_; }
  Index rows() const { return begins_.back(); }  ///< total over all processes
  Index begin() const { return begin_of(communicator_.rank()); }
  Index end() const { return end_of(communicator_.rank()); }
  Index count() const { return end() - begin(); }
  Index begin_of(int rank) const { return begins_[static_cast<std::size_t>(rank)]; }
  Index end_of(int rank) const { return begins_[static_cast<std::size_t>(rank) + 1]; }
  /// Returns the rank of the process that has a row.
  int owner(Index row) const;

 private:
  Communicator communicator_;
  std::vector<Index> begins_;
};

/// Sends rows of a field from the processes that have them to the processes that need them.
/// Collective.
class RowExchange {
 public:
  /// The `count` consecutive rows of a field that start at row `first`; rows may lie outside the
  /// field.
  struct Window {
    Index first = 0, count = 0;
  };
  /// Replacement for rows outside the field. repeat: the field is continued periodically; clamp:
  /// the row at the nearest edge; none: these rows of the window are left unchanged.
  enum class Edge { repeat, clamp, none };

  /// wanted(rank): the window that process `rank` needs. The function must be the same on every
  /// process.
  RowExchange(const RowPartition& from, const std::function<Window(int rank)>& wanted, Edge edge);

  /// Fills the window of this process. rows: address of the first row of this process; window:
  /// address of the first row of its window. Strides and row length are in bytes. Rows of the
  /// window that this process has itself may already be in place.
  void operator()(const void* rows, std::size_t row_stride, void* window, std::size_t window_stride,
                  std::size_t row_bytes) const;

  /// Returns a pointer to each row of the window. It points into the rows of this process or into
  /// `buffer`, or is nullptr for a row outside the field with Edge::none.
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

/// Gathers the whole field in the process `root`; all other processes get an empty field. mine:
/// rows of this process. Collective; a failure in one process is thrown in all. The root needs
/// memory for the whole field.
Field gathered(const RowPartition& rows, const Field& mine, int root = 0);
/// Distributes the rows of a field `whole`, which the first process has, over the processes and
/// returns the rows of this process. columns: number of columns of the field. Collective.
Field scattered(const RowPartition& rows, Index columns, const Field& whole);

/// Assembles the columns of a field whose rows are distributed over processes, and passes each
/// column to `visit` in the process that owns the column. One thread visits the columns of a block
/// of parallel::map_blocks in order; several threads handle different blocks at once. Value: double
/// or std::complex<double>.
/// columns  distribution of the columns over the processes; in whole blocks if sums are made by
///          blocks
/// read     writes to `to` the `count` numbers, starting at column `first`, of a row of this
///          process; called from several threads at once
/// visit    receives a column (its index counts over all processes) with rows.rows() numbers,
///          aligned to 64 bytes, which it may change
/// throws   in all processes, what `read` or `visit` throws in any process
/// cost     collective; each number is sent once, some columns at a time; the buffers need at most
///          as much memory as the part of the field in a process, or 32 columns per process if that
///          is more
template <class Value>
void visit_columns(const RowPartition& rows, const RowPartition& columns,
                   const std::function<void(Index row, Index first, Index count, Value* to)>& read,
                   const std::function<void(Index column, std::span<Value> values)>& visit);

namespace parallel {

/// Gathers the values of the blocks of all processes in row order. mine: values of the blocks of
/// this process, from map_blocks. Collective.
template <class Value>
std::vector<Value> gather_blocks(const RowPartition& partition, const std::vector<Value>& mine) {
  static_assert(std::is_trivially_copyable_v<Value>);
  if (partition.communicator().alone()) return mine;
  const Index size = block_rows(partition.rows());
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < partition.communicator().size(); ++rank)
    bytes.push_back(static_cast<std::size_t>(
                        (partition.end_of(rank) - partition.begin_of(rank) + size - 1) / size) *
                    sizeof(Value));
  std::vector<Value> all(static_cast<std::size_t>(block_count(partition.rows())));
  partition.communicator().gather_all(mine.data(), bytes, all.data());
  return all;
}

/// Returns the values of body(begin, end) for the blocks of all processes, in row order. begin and
/// end count from the first row of this process. Collective.
template <class Value, class Body>
std::vector<Value> map_blocks(const RowPartition& partition, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return gather_blocks(
      partition, map_blocks_of<Value>(block_rows(partition.rows()), partition.count(), body, work));
}

/// Returns the sum of body(begin, end) over the blocks of all processes, added in row order.
double sum_blocks(const RowPartition& partition, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

/// Returns the sums of `count` numbers over the blocks of all processes, added in row order. mine:
/// the `count` numbers of each block of this process, one block after the other.
std::vector<double> add_blocks(const RowPartition& partition, std::size_t count,
                               const std::vector<double>& mine);
/// Returns the sums of `count` numbers over the blocks of all processes, added in row order.
/// body(begin, end, sums) adds the numbers of a block to `sums`, which start at zero. The first
/// process determines count.
std::vector<double> sum_blocks(const RowPartition& partition, std::size_t count,
                               const std::function<void(Index, Index, std::span<double>)>& body);

}  // namespace parallel
}  // namespace salebra
