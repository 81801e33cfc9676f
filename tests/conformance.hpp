// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <string>
#include <vector>

#include "base/convolution.hpp"

// What every transport must do: the same checks for threads of a test and for MPI. Each throws
// Error where the transport does not.
namespace salebra::testing {

inline void expect(bool ok, const std::string& what) {
  if (!ok) throw Error(what);
}

// Byte k that process `rank` has to give; a number of bytes that differs between processes, and is
// 0 in one.
inline char byte_of(int rank, std::size_t k) {
  return static_cast<char>(31 * rank + 7 * static_cast<int>(k % 1009));
}
inline std::size_t length_of(int rank) { return static_cast<std::size_t>(rank * rank * 100); }

inline std::string text_of(int rank, std::size_t length) {
  std::string text;
  for (std::size_t k = 0; k < length; ++k) text += byte_of(rank, k);
  return text;
}

inline void check_broadcast(const Communicator& ranks) {
  for (int from = 0; from < ranks.size(); ++from)
    for (const std::size_t length : {0, 1, 1000, 1 << 20}) {
      std::string text = ranks.rank() == from ? text_of(from, length) : std::string(length, '?');
      ranks.broadcast(text.data(), text.size(), from);
      expect(text == text_of(from, length), "broadcast: other bytes");
    }
}

inline void check_gathers(const Communicator& ranks) {
  const std::vector<std::string> texts =
      ranks.gather_all(text_of(ranks.rank(), length_of(ranks.rank())));
  for (int rank = 0; rank < ranks.size(); ++rank)
    expect(texts[static_cast<std::size_t>(rank)] == text_of(rank, length_of(rank)),
           "gather: other bytes");
}

// Process r sends 3r + s + 1 units to process s, and none to itself where it is odd.
inline std::int64_t units_between(int from, int to) {
  return from == to && from % 2 == 1 ? 0 : 3 * from + to + 1;
}

inline void check_exchange(const Communicator& ranks) {
  const int me = ranks.rank();
  for (const std::size_t unit : {1, 8, 64, 128, 5000}) {
    std::vector<std::int64_t> sent, received;
    std::string from;
    for (int other = 0; other < ranks.size(); ++other) {
      sent.push_back(units_between(me, other));
      received.push_back(units_between(other, me));
      from += text_of(100 * me + other, unit * static_cast<std::size_t>(sent.back()));
    }
    const Exchange plan(unit, sent, received);
    std::string to(unit * static_cast<std::size_t>(plan.received_units()), '?');
    ranks.exchange(plan, from.data(), to.data());
    for (int other = 0; other < ranks.size(); ++other) {
      const std::size_t length =
          unit * static_cast<std::size_t>(received[static_cast<std::size_t>(other)]);
      expect(to.substr(unit * static_cast<std::size_t>(plan.received_offset(other)), length) ==
                 text_of(100 * other + me, length),
             "exchange: other bytes");
    }
  }
}

inline void check_rows(const Communicator& ranks) {
  const Index rows = 100, ny = 5;
  const RowPartition partition(ranks, rows);
  std::vector<double> mine;
  for (Index k = partition.begin() * ny; k < partition.end() * ny; ++k)
    mine.push_back(static_cast<double>(k));
  const auto wanted = [&](int rank) {
    return RowExchange::Window{partition.begin_of(rank) - 2,
                               partition.end_of(rank) - partition.begin_of(rank) + 4};
  };
  std::vector<double> window(static_cast<std::size_t>((partition.count() + 4) * ny), -1);
  RowExchange(partition, wanted, RowExchange::Edge::repeat)(
      mine.data(), ny * sizeof(double), window.data(), ny * sizeof(double), ny * sizeof(double));
  for (Index k = 0; k < partition.count() + 4; ++k)
    for (Index j = 0; j < ny; ++j) {
      const Index row = (partition.begin() - 2 + k + rows) % rows;
      expect(window[static_cast<std::size_t>(k * ny + j)] == static_cast<double>(row * ny + j),
             "rows: a wrong one");
    }
}

template <class Real>
void check_convolution(const Communicator& ranks, Index nx, Index ny) {
  const auto convolved = [&](const RowPartition& rows) {
    Convolution2D<Real> convolution({nx, ny, nx, ny}, 1, rows);
    convolution.set_symbol(0, 0, [](Index i, Index j) {
      return 1 / (1 + static_cast<double>(i * i) + 0.5 * static_cast<double>(j * j));
    });
    std::vector<Real> field, result;
    for (Index k = rows.begin() * ny; k < rows.end() * ny; ++k)
      field.push_back(static_cast<Real>(std::sin(1e3 * static_cast<double>(k * k % 7919))));
    result.resize(field.size());
    convolution.apply(field.data(), result.data());
    return result;
  };
  const std::vector<Real> alone = convolved(RowPartition(nx));
  const RowPartition rows(ranks, nx);
  const std::vector<Real> together = convolved(rows);
  expect(together.empty() || std::memcmp(together.data(), alone.data() + rows.begin() * ny,
                                         together.size() * sizeof(Real)) == 0,
         "convolution: other bits than one process");
}

inline void check_failure(const Communicator& ranks) {
  const int failing = ranks.size() - 1;
  try {
    collectively(ranks, [&] {
      if (ranks.rank() == failing) throw InvalidInput("FILE", "x.h5", "must exist; name another");
    });
  } catch (const InvalidInput& error) {
    return expect(error.value() == "x.h5", "failure: another message");
  }
  expect(false, "failure: not thrown everywhere");
}

// Every third process is of one group; the processes of a group talk among themselves, groups of
// other sizes at once.
inline void check_split(const Communicator& ranks) {
  const Communicator group = ranks.split(ranks.rank() % 3 == 0 ? 1 : 0);
  int members = 0, place = 0;
  for (int rank = 0; rank < ranks.size(); ++rank)
    if ((rank % 3 == 0) == (ranks.rank() % 3 == 0)) {
      if (rank < ranks.rank()) ++place;
      ++members;
    }
  expect(group.size() == members && group.rank() == place, "split: another group");
  check_broadcast(group);
  check_gathers(group);
  check_exchange(group);
}

inline void check_groups(const Communicator& ranks) {
  for (int count = 1; count <= ranks.size(); ++count) {
    const Groups groups(ranks, count);
    const std::vector<std::string> places =
        ranks.gather_all(std::string(1, static_cast<char>('a' + groups.index())));
    const std::string mine(1, static_cast<char>('a' + groups.index()));
    expect(std::is_sorted(places.begin(), places.end()) && places.front() == "a" &&
               places.back()[0] == static_cast<char>('a' + count - 1),
           "groups: not of consecutive processes");
    const auto size = std::count(places.begin(), places.end(), mine);
    expect(size == groups.own().size() && size >= ranks.size() / count &&
               size <= ranks.size() / count + 1,
           "groups: of another size");
    check_gathers(groups.own());
  }
}

inline void check_conformance(const Communicator& ranks) {
  check_broadcast(ranks);
  check_gathers(ranks);
  check_exchange(ranks);
  check_rows(ranks);
  check_convolution<float>(ranks, 64, 64);
  check_convolution<double>(ranks, 96, 50);
  check_convolution<float>(ranks, 101, 64);  // odd, and a last block that is not full
  check_convolution<double>(ranks, 16, 16);  // all but one process without rows
  check_failure(ranks);
  check_split(ranks);
  check_groups(ranks);
}

}  // namespace salebra::testing
