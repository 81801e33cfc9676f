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

/// Rows of a field that are spread over the processes of a communicator, consecutive rows to each
/// in the order of the processes. A process holds whole blocks of rows, 16 rows or as many as a
/// block of parallel::map_blocks has. Transforms pair rows, and sums add them, within a block, so
/// that results have the same bits for every number of processes.
class Share {
 public:
  Share() : Share(0) {}
  /// All rows in this process.
  explicit Share(Index rows) : Share(Communicator(), rows) {}
  /// least: rows that a process has at least; where there are too few rows for that, the last
  /// processes have none.
  Share(const Communicator& ranks, Index rows, Index least = 16);
  /// begins[r]: the first row of process r; begins[ranks]: the number of rows.
  Share(const Communicator& ranks, std::vector<Index> begins);

  const Communicator& ranks() const { return ranks_; }
  Index rows() const { return begins_.back(); }  ///< of all processes
  Index begin() const { return begin_of(ranks_.rank()); }
  Index end() const { return end_of(ranks_.rank()); }
  Index count() const { return end() - begin(); }
  Index begin_of(int rank) const { return begins_[static_cast<std::size_t>(rank)]; }
  Index end_of(int rank) const { return begins_[static_cast<std::size_t>(rank) + 1]; }
  int owner(Index row) const;

 private:
  Communicator ranks_;
  std::vector<Index> begins_;
};

/// Hands rows of a field from the processes that hold them to those that need them. Collective.
class RowExchange {
 public:
  /// Rows first … first + count − 1 of a field, which may lie beyond its edges.
  struct Window {
    Index first = 0, count = 0;
  };
  /// What stands for rows beyond the edges: those of the opposite edge, the row at the edge, or
  /// nothing: they are left alone.
  enum class Edge { repeat, clamp, none };

  /// wanted(rank): the window of each process. Every process must give the same answers.
  RowExchange(const Share& from, const std::function<Window(int rank)>& wanted, Edge edge);

  /// rows: the first row that this process holds; window: the first row of its window. Strides and
  /// the length of a row are in bytes. Rows of the window that this process holds itself may be in
  /// their place already.
  void operator()(const void* rows, std::size_t row_stride, void* window, std::size_t window_stride,
                  std::size_t row_bytes) const;

  /// Where each row of the window is: among the rows of this process, in `room`, or nullptr for one
  /// that is left alone.
  std::vector<const void*> fetch(const void* rows, std::size_t row_stride, std::size_t row_bytes,
                                 std::vector<std::byte>& room) const;

 private:
  struct Move {
    Index from, to;  // row of this process, row of its window
  };
  // Rows from other processes, in the order of received_.
  std::vector<std::byte> receive(const void* rows, std::size_t row_stride,
                                 std::size_t row_bytes) const;

  Communicator ranks_;
  Index count_ = 0;  // rows of the window of this process
  std::vector<std::int64_t> sent_counts_, received_counts_;
  std::vector<Index> sent_;      // rows of this process, in the order of the receivers
  std::vector<Index> received_;  // rows of the window, in the order of the senders
  std::vector<Move> own_;
};

/// The whole field in the process `root`, and no rows in the others. mine: the rows of this
/// process. Collective; what fails in one process is thrown on all. Memory of the root: the whole
/// field in addition.
Field gathered(const Share& rows, const Field& mine, int root = 0);
/// The inverse: the rows of each process of a field of so many columns that the first process has
/// whole. Collective.
Field scattered(const Share& rows, Index columns, const Field& whole);

/// Brings the columns of a field together, whose rows are spread over processes, and hands each to
/// the process that owns it. The columns of a block of parallel::map_blocks come in order and in
/// one thread; blocks come from several threads at once. Value: double or its complex.
/// columns  who owns which; whole blocks of them where sums are made by blocks
/// read     writes the numbers first … first + count − 1 of a row of this process; called from
///          several threads at once
/// visit    takes a column, counted over all processes, of rows.rows() numbers, which it may
///          change: they lie on a boundary of 64 bytes
/// throws   what read or visit throws in any process, in all of them
/// cost     collective; each number is sent once, some columns at a time, by buffers of at most as
///          much memory as the numbers of a process, or 32 columns for each process where that is
///          more
template <class Value>
void visit_columns(const Share& rows, const Share& columns,
                   const std::function<void(Index row, Index first, Index count, Value* to)>& read,
                   const std::function<void(Index column, std::span<Value> values)>& visit);

namespace parallel {

/// Values of the blocks of this process, as map_blocks gives them, to those of all processes, in
/// the order of the rows. Collective.
template <class Value>
std::vector<Value> gather_blocks(const Share& share, const std::vector<Value>& mine) {
  static_assert(std::is_trivially_copyable_v<Value>);
  if (share.ranks().alone()) return mine;
  const Index size = block_rows(share.rows());
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < share.ranks().ranks(); ++rank)
    bytes.push_back(
        static_cast<std::size_t>((share.end_of(rank) - share.begin_of(rank) + size - 1) / size) *
        sizeof(Value));
  std::vector<Value> all(static_cast<std::size_t>(block_count(share.rows())));
  share.ranks().gather_all(mine.data(), bytes, all.data());
  return all;
}

/// The values of body(begin, end) over the blocks of all processes, in the order of the rows. begin
/// and end count the rows that this process holds. Collective.
template <class Value, class Body>
std::vector<Value> map_blocks(const Share& share, const Body& body,
                              Index work = std::numeric_limits<Index>::max()) {
  return gather_blocks(share,
                       map_blocks_of<Value>(block_rows(share.rows()), share.count(), body, work));
}

/// Sum of body(begin, end) over the blocks of all processes, added in their order.
double sum_blocks(const Share& share, const std::function<double(Index, Index)>& body,
                  Index work = std::numeric_limits<Index>::max());

/// Sums of `count` numbers over the blocks of all processes, added in their order. mine: those of
/// each block of this process, one block after the other.
std::vector<double> add_blocks(const Share& share, std::size_t count,
                               const std::vector<double>& mine);
/// Here body(begin, end, sums) adds to the sums of a block, which are zero at first. count is that
/// of the first process.
std::vector<double> sum_blocks(const Share& share, std::size_t count,
                               const std::function<void(Index, Index, std::span<double>)>& body);

}  // namespace parallel
}  // namespace salebra
