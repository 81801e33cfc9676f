// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of a field over processes: who holds which, their way to other processes, and sums over all of them.
#include <algorithm>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/share.hpp>

namespace salebra {
namespace {

constexpr Index least_unit = 16;  // the rows that a transform pairs

std::vector<Index> block_begins(int ranks, Index rows, Index least) {
  const Index unit = std::max(least_unit, parallel::block_rows(rows)),
              blocks = (rows + unit - 1) / unit,
              in_use = std::clamp<Index>(rows / std::max(least, unit), 1, ranks);
  std::vector<Index> begins;
  for (Index rank = 0; rank <= ranks; ++rank)
    begins.push_back(rank < in_use ? std::min(rows, unit * (blocks * rank / in_use)) : rows);
  return begins;
}

}  // namespace

Share::Share(const Communicator& ranks, Index rows, Index least)
    : ranks_(ranks), begins_(block_begins(ranks.ranks(), rows, least)) {}

Share::Share(const Communicator& ranks, std::vector<Index> begins)
    : ranks_(ranks), begins_(std::move(begins)) {}

int Share::owner(Index row) const {
  return static_cast<int>(std::upper_bound(begins_.begin(), begins_.end() - 1, row) -
                          begins_.begin()) -
         1;
}

RowExchange::RowExchange(const Share& from, const std::function<Window(int rank)>& wanted,
                         Edge edge)
    : ranks_(from.ranks()) {
  const Index rows = from.rows();
  const int me = ranks_.rank(), count = ranks_.ranks();
  sent_counts_.assign(static_cast<std::size_t>(count), 0);
  received_counts_ = sent_counts_;
  // The row of the field that stands for one of a window; −1: none.
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
  if (ranks_.alone()) return {};
  const auto* from = static_cast<const std::byte*>(rows);
  std::vector<std::byte> sent(sent_.size() * row_bytes), received(received_.size() * row_bytes);
  for (std::size_t k = 0; k < sent_.size(); ++k)
    std::memcpy(sent.data() + k * row_bytes, row_at(from, sent_[k], row_stride), row_bytes);
  ranks_.exchange({row_bytes, sent_counts_, received_counts_}, sent.data(), received.data());
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
                                            std::vector<std::byte>& room) const {
  room = receive(rows, row_stride, row_bytes);
  std::vector<const void*> places(static_cast<std::size_t>(count_), nullptr);
  for (const Move& move : own_)
    places[static_cast<std::size_t>(move.to)] =
        row_at(static_cast<const std::byte*>(rows), move.from, row_stride);
  for (std::size_t k = 0; k < received_.size(); ++k)
    places[static_cast<std::size_t>(received_[k])] = room.data() + k * row_bytes;
  return places;
}

Field gathered(const Share& rows, const Field& mine, int root) {
  const Communicator& ranks = rows.ranks();
  require(root >= 0 && root < ranks.ranks(), "root", root,
          "must be one of the processes, counted from 0");
  const bool here = ranks.rank() == root;
  Field whole;
  collectively(ranks, [&] {
    require(mine.rows() == rows.count(), "rows", mine.rows(), "do not match the grid");
    whole.resize(here ? rows.rows() : 0, mine.cols());
  });
  std::vector<std::int64_t> sent(static_cast<std::size_t>(ranks.ranks()), 0), received = sent;
  sent[static_cast<std::size_t>(root)] = rows.count();
  if (here)
    for (int rank = 0; rank < ranks.ranks(); ++rank)
      received[static_cast<std::size_t>(rank)] = rows.end_of(rank) - rows.begin_of(rank);
  const std::size_t row_bytes = static_cast<std::size_t>(mine.cols()) * sizeof(double);
  ranks.exchange({row_bytes, std::move(sent), std::move(received)}, mine.data(), whole.data());
  return whole;
}

namespace parallel {

double sum_blocks(const Share& share, const std::function<double(Index, Index)>& body, Index work) {
  double sum = 0;
  for (const double value : map_blocks<double>(share, body, work)) sum += value;
  return sum;
}

}  // namespace parallel
}  // namespace salebra
