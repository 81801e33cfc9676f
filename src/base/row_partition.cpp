// SPDX-License-Identifier: GPL-3.0-or-later
// Distribution of the rows of a field over processes, exchange of rows, and sums over all
// processes.
#include <algorithm>
#include <complex>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>

#include "memory.hpp"

namespace salebra {
namespace {

constexpr Index min_unit = 16;  // transforms pair rows within a block of this size

std::vector<Index> block_begins(int processes, Index rows, Index least) {
  const Index unit = std::max(min_unit, parallel::block_rows(rows)),
              blocks = (rows + unit - 1) / unit,
              in_use = std::clamp<Index>(rows / std::max(least, unit), 1, processes);
  std::vector<Index> begins;
  for (Index rank = 0; rank <= processes; ++rank)
    begins.push_back(rank < in_use ? std::min(rows, unit * (blocks * rank / in_use)) : rows);
  return begins;
}

}  // namespace

RowPartition::RowPartition(const Communicator& communicator, Index rows, Index least)
    : communicator_(communicator), begins_(block_begins(communicator.size(), rows, least)) {}

RowPartition::RowPartition(const Communicator& communicator, std::vector<Index> begins)
    : communicator_(communicator), begins_(std::move(begins)) {}

int RowPartition::owner(Index row) const {
  return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end() - 1, row) -
                          begins_.begin()) -
         1;
}

RowExchange::RowExchange(const RowPartition& from, const std::function<Window(int rank)>& wanted,
                         Edge edge)
    : communicator_(from.communicator()) {
  const Index rows = from.rows();
  const int me = communicator_.rank(), count = communicator_.size();
  sent_counts_.assign(static_cast<std::size_t>(count), 0);
  received_counts_ = sent_counts_;
  // Index of the field's row that serves as a row of the window (wrapped or clamped at the edge);
  // −1 if there is none.
  const auto row_of = [&](Index row) {
    if (row >= 0 && row < rows) return row;
    if (edge == Edge::none || rows == 0) return Index(-1);
    return edge == Edge::clamp ? std::clamp<Index>(row, 0, rows - 1) : (row % rows + rows) % rows;
  };
  std::vector<std::vector<Index>> from_each(static_cast<std::size_t>(count));
  for (int rank = 0; rank < count; ++rank) {
    const Window window = wanted(rank);
    if (rank == me) count_ = window.count;
    for (Index k = 0; k < window.count; ++k) {
      const Index row = row_of(window.first + k);
      if (row < 0) continue;
      const int owner = from.owner(row);
      if (rank == me && owner == me) {
        own_.push_back({row - from.begin(), k});
      } else if (owner == me) {
        sent_.push_back(row - from.begin());
        ++sent_counts_[static_cast<std::size_t>(rank)];
      } else if (rank == me) {
        from_each[static_cast<std::size_t>(owner)].push_back(k);
      }
    }
  }
  for (std::size_t rank = 0; rank < from_each.size(); ++rank) {
    received_counts_[rank] = static_cast<std::int64_t>(from_each[rank].size());
    received_.insert(received_.end(), from_each[rank].begin(), from_each[rank].end());
  }
}

namespace {

template <class Byte>
Byte* row_at(Byte* field, Index row, std::size_t stride) {
  return field + static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(stride);
}

}  // namespace

std::vector<std::byte> RowExchange::receive(const void* rows, std::size_t row_stride,
                                            std::size_t row_bytes) const {
  if (communicator_.alone()) return {};
  const auto* from = static_cast<const std::byte*>(rows);
  std::vector<std::byte> sent(sent_.size() * row_bytes), received(received_.size() * row_bytes);
  for (std::size_t k = 0; k < sent_.size(); ++k)
    std::memcpy(sent.data() + k * row_bytes, row_at(from, sent_[k], row_stride), row_bytes);
  communicator_.exchange({row_bytes, sent_counts_, received_counts_}, sent.data(), received.data());
  return received;
}

void RowExchange::operator()(const void* rows, std::size_t row_stride, void* window,
                             std::size_t window_stride, std::size_t row_bytes) const {
  const auto received = receive(rows, row_stride, row_bytes);
  auto* to = static_cast<std::byte*>(window);
  for (const Move& move : own_) {
    const std::byte* source = row_at(static_cast<const std::byte*>(rows), move.from, row_stride);
    std::byte* target = row_at(to, move.to, window_stride);
    if (source != target) std::memcpy(target, source, row_bytes);
  }
  for (std::size_t k = 0; k < received_.size(); ++k)
    std::memcpy(row_at(to, received_[k], window_stride), received.data() + k * row_bytes,
                row_bytes);
}

std::vector<const void*> RowExchange::fetch(const void* rows, std::size_t row_stride,
                                            std::size_t row_bytes,
                                            std::vector<std::byte>& buffer) const {
  buffer = receive(rows, row_stride, row_bytes);
  std::vector<const void*> offsets(static_cast<std::size_t>(count_), nullptr);
  for (const Move& move : own_)
    offsets[static_cast<std::size_t>(move.to)] =
        row_at(static_cast<const std::byte*>(rows), move.from, row_stride);
  for (std::size_t k = 0; k < received_.size(); ++k)
    offsets[static_cast<std::size_t>(received_[k])] = buffer.data() + k * row_bytes;
  return offsets;
}

Field gathered(const RowPartition& rows, const Field& mine, int root) {
  const Communicator& communicator = rows.communicator();
  require(root >= 0 && root < communicator.size(), "root", root,
          "must be one of the processes, counted from 0");
  const bool here = communicator.rank() == root;
  Field whole;
  collectively(communicator, [&] {
    require(mine.rows() == rows.count(), "rows", mine.rows(), "do not match the grid");
    whole.resize(here ? rows.rows() : 0, mine.cols());
  });
  std::vector<std::int64_t> sent(static_cast<std::size_t>(communicator.size()), 0), received = sent;
  sent[static_cast<std::size_t>(root)] = rows.count();
  if (here)
    for (int rank = 0; rank < communicator.size(); ++rank)
      received[static_cast<std::size_t>(rank)] = rows.end_of(rank) - rows.begin_of(rank);
  const std::size_t row_bytes = static_cast<std::size_t>(mine.cols()) * sizeof(double);
  communicator.exchange({row_bytes, std::move(sent), std::move(received)}, mine.data(),
                        whole.data());
  return whole;
}

Field scattered(const RowPartition& rows, Index columns, const Field& whole) {
  const Communicator& communicator = rows.communicator();
  std::vector<Index> begins(static_cast<std::size_t>(communicator.size()) + 1, rows.rows());
  begins.front() = 0;
  Field mine;
  collectively(communicator, [&] {
    if (communicator.is_root())
      require(whole.rows() == rows.rows(), "rows", whole.rows(), "do not match the grid");
    mine = uninitialised_field(rows.count(), columns);
  });
  const auto row_bytes = static_cast<std::size_t>(columns) * sizeof(double);
  RowExchange(
      RowPartition(communicator, begins),
      [&](int rank) {
        return RowExchange::Window{rows.begin_of(rank), rows.end_of(rank) - rows.begin_of(rank)};
      },
      RowExchange::Edge::none)(whole.data(), row_bytes, mine.data(), row_bytes, row_bytes);
  return mine;
}

namespace {

// Divides the columns of each process into batches.
struct Batches {
  const RowPartition& rows;
  const RowPartition& columns;
  Index group, at_once, count = 0;

  Batches(const RowPartition& of_rows, const RowPartition& of_columns)
      : rows(of_rows),
        columns(of_columns),
        group(std::max<Index>(16, parallel::block_rows(columns.rows()))) {
    const Index ranks = rows.communicator().size();
    // A batch is limited by the buffers for the columns sent and received, and to 64 groups, which
    // suffice to keep all threads busy.
    at_once = group * std::clamp<Index>(columns.rows() / (2 * ranks * group), 1,
                                        rows.communicator().alone() ? 1 : 64);
    for (int rank = 0; rank < ranks; ++rank)
      count =
          std::max(count, (columns.end_of(rank) - columns.begin_of(rank) + at_once - 1) / at_once);
  }
  Index first(int rank, Index batch) const {
    return std::min(columns.begin_of(rank) + batch * at_once, columns.end_of(rank));
  }
  Index width(int rank, Index batch) const { return first(rank, batch + 1) - first(rank, batch); }
  Index rows_of(int rank) const { return rows.end_of(rank) - rows.begin_of(rank); }
  template <class Value>
  Exchange exchange(Index batch) const {
    std::vector<std::int64_t> sent, received;
    for (int rank = 0; rank < rows.communicator().size(); ++rank) {
      sent.push_back(rows.count() * width(rank, batch));
      received.push_back(rows_of(rank) * width(rows.communicator().rank(), batch));
    }
    return {sizeof(Value), std::move(sent), std::move(received)};
  }
};

// Calls visit for the columns first … first + width − 1 of this process. part(row among those of
// all processes, first column, number of columns, buffer) returns the numbers of a row.
template <class Value, class Part, class Visit>
void visit_groups(const Batches& batches, Index first, Index width, const Part& part,
                  const Visit& visit) {
  const Index rows = batches.rows.rows(), in_line = 64 / static_cast<Index>(sizeof(Value)),
              pitch = (rows + in_line - 1) / in_line * in_line, group = batches.group;
  parallel::for_slabs((width + group - 1) / group, [&](Index begin, Index end) {
    const auto columns = large_array<Value>(static_cast<std::size_t>(group * pitch));
    const auto buffer = large_array<Value>(static_cast<std::size_t>(group));
    for (Index k = begin; k < end; ++k) {
      const Index offset = k * group, count = std::min(group, width - offset);
      for (Index row = 0; row < rows; ++row) {
        const Value* values = part(row, offset, count, buffer.get());
        for (Index j = 0; j < count; ++j)
          columns[static_cast<std::size_t>(j * pitch + row)] = values[j];
      }
      for (Index j = 0; j < count; ++j)
        visit(first + offset + j,
              std::span<Value>(columns.get() + j * pitch, static_cast<std::size_t>(rows)));
    }
  });
}

}  // namespace

template <class Value>
void visit_columns(const RowPartition& rows, const RowPartition& columns,
                   const std::function<void(Index row, Index first, Index count, Value* to)>& read,
                   const std::function<void(Index column, std::span<Value> values)>& visit) {
  const Communicator& communicator = rows.communicator();
  if (communicator.alone())
    return visit_groups<Value>(
        Batches(rows, columns), 0, columns.rows(),
        [&](Index row, Index first, Index count, Value* buffer) {
          read(row, first, count, buffer);
          return buffer;
        },
        visit);
  const Batches batches(rows, columns);
  const int me = communicator.rank();
  LargeArray<Value> sent, received;
  for (Index batch = 0; batch < batches.count; ++batch) {
    const Exchange plan = batches.exchange<Value>(batch);
    collectively(communicator, [&] {
      if (batch == 0) {  // later batches are not larger
        sent = large_array<Value>(static_cast<std::size_t>(plan.sent_units()));
        received = large_array<Value>(static_cast<std::size_t>(plan.received_units()));
      }
      parallel::for_slabs(rows.count(), [&](Index begin, Index end) {
        for (int rank = 0; rank < communicator.size(); ++rank)
          if (const Index width = batches.width(rank, batch); width > 0)
            for (Index row = begin; row < end; ++row)
              read(row, batches.first(rank, batch), width,
                   sent.get() + plan.sent_offset(rank) + row * width);
      });
    });
    communicator.exchange(plan, sent.get(), received.get());
    collectively(communicator, [&] {
      // The parts of the processes follow each other in memory, so the rows are in order.
      const Index width = batches.width(me, batch);
      visit_groups<Value>(
          batches, batches.first(me, batch), width,
          [&](Index row, Index first, Index, Value*) {
            return received.get() + row * width + first;
          },
          visit);
    });
  }
}

template void visit_columns<double>(const RowPartition&, const RowPartition&,
                                    const std::function<void(Index, Index, Index, double*)>&,
                                    const std::function<void(Index, std::span<double>)>&);
template void visit_columns<std::complex<double>>(
    const RowPartition&, const RowPartition&,
    const std::function<void(Index, Index, Index, std::complex<double>*)>&,
    const std::function<void(Index, std::span<std::complex<double>>)>&);

namespace parallel {

double sum_blocks(const RowPartition& partition, const std::function<double(Index, Index)>& body,
                  Index work) {
  double sum = 0;
  for (const double value : map_blocks<double>(partition, body, work)) sum += value;
  return sum;
}

namespace {

Index own_blocks(const RowPartition& partition, Index rows) {
  const Index size = block_rows(partition.rows());
  return (rows + size - 1) / size;
}

}  // namespace

std::vector<double> add_blocks(const RowPartition& partition, std::size_t count,
                               const std::vector<double>& mine) {
  const Communicator& communicator = partition.communicator();
  const auto blocks = static_cast<std::size_t>(own_blocks(partition, partition.count())),
             blocks_of_all = static_cast<std::size_t>(block_count(partition.rows()));
  // To limit the memory, the numbers of the blocks are gathered from all processes in portions of
  // at most 32 MB.
  const std::size_t most =
      std::max<std::size_t>(1, (std::size_t{1} << 22) / std::max<std::size_t>(blocks_of_all, 1));
  std::vector<double> sums(count, 0.0), sent, gathered;
  for (std::size_t first = 0; first < count; first += most) {
    const std::size_t part = std::min(most, count - first);
    sent.clear();
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto from = mine.begin() + static_cast<std::ptrdiff_t>(block * count + first);
      sent.insert(sent.end(), from, from + static_cast<std::ptrdiff_t>(part));
    }
    std::vector<std::size_t> bytes;
    for (int rank = 0; rank < communicator.size(); ++rank)
      bytes.push_back(static_cast<std::size_t>(own_blocks(
                          partition, partition.end_of(rank) - partition.begin_of(rank))) *
                      part * sizeof(double));
    gathered.resize(blocks_of_all * part);
    communicator.gather_all(sent.data(), bytes, gathered.data());
    for (std::size_t k = 0; k < gathered.size(); ++k) sums[first + k % part] += gathered[k];
  }
  return sums;
}

std::vector<double> sum_blocks(const RowPartition& partition, std::size_t count,
                               const std::function<void(Index, Index, std::span<double>)>& body) {
  partition.communicator().broadcast(&count, sizeof count);
  const Index size = block_rows(partition.rows()),
              blocks = own_blocks(partition, partition.count());
  std::vector<double> mine(static_cast<std::size_t>(blocks) * count, 0.0);
  for_slabs(blocks, [&](Index begin, Index end) {
    for (Index block = begin; block < end; ++block)
      body(block * size, std::min(partition.count(), (block + 1) * size),
           std::span(mine).subspan(static_cast<std::size_t>(block) * count, count));
  });
  return add_blocks(partition, count, mine);
}

}  // namespace parallel
}  // namespace salebra
