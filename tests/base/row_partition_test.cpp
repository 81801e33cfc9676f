// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>

#include "base/convolution.hpp"
#include "conformance.hpp"
#include "one_of_many.hpp"
#include "ranks_in_threads.hpp"

using namespace salebra;
using salebra::testing::run_ranks;

namespace {

// Irregular values, whose sum depends on the order.
double scattered(Index k) { return std::sin(1e3 * static_cast<double>(k * k % 7919)) + 0.3; }

// Rows of a field of such values.
template <class Real>
std::vector<Real> rows_of(Index begin, Index end, Index ny) {
  std::vector<Real> values;
  for (Index k = begin * ny; k < end * ny; ++k) values.push_back(static_cast<Real>(scattered(k)));
  return values;
}

bool same_bits(const void* a, const void* b, std::size_t bytes) {
  return bytes == 0 || std::memcmp(a, b, bytes) == 0;
}

}  // namespace

TEST_CASE("A share gives whole blocks of rows to each process, in order", "[share]") {
  const Index rows = GENERATE(1, 15, 16, 96, 101, 1024, 1025, 40000);
  const int ranks = GENERATE(1, 2, 3, 5, 8);
  run_ranks(ranks, [&](const Communicator& all) {
    const RowPartition partition(all, rows);
    if (partition.rows() != rows || partition.begin_of(0) != 0 ||
        partition.end_of(ranks - 1) != rows)
      throw Error("rows are lost");
    const Index unit = std::max<Index>(16, parallel::block_rows(rows));
    for (int rank = 0; rank < ranks; ++rank) {
      const Index begin = partition.begin_of(rank), end = partition.end_of(rank);
      if (begin > end || (begin < rows && begin % unit != 0)) throw Error("a block is divided");
      for (Index row = begin; row < end; ++row)
        if (partition.owner(row) != rank) throw Error("another owner");
    }
  });
}

TEST_CASE("Sums over processes have the bits of one process", "[share]") {
  const Index rows = GENERATE(1, 17, 96, 1500), ny = 7;
  const auto sum = [&](const RowPartition& partition) {
    return parallel::sum_blocks(partition, [&](Index begin, Index end) {
      double part = 0;
      for (Index k = (partition.begin() + begin) * ny; k < (partition.begin() + end) * ny; ++k)
        part += scattered(k);
      return part;
    });
  };
  const double alone = sum(RowPartition(rows));
  const int ranks = GENERATE(2, 3, 8);
  run_ranks(ranks, [&](const Communicator& all) {
    const double together = sum(RowPartition(all, rows));
    if (std::memcmp(&alone, &together, sizeof alone) != 0) throw Error("other bits");
  });
}

TEST_CASE("Rows travel to their windows, repeated, clamped or left alone beyond the edges",
          "[share]") {
  const Index rows = 50, ny = 3;
  const auto edge =
      GENERATE(RowExchange::Edge::repeat, RowExchange::Edge::clamp, RowExchange::Edge::none);
  const int ranks = GENERATE(1, 2, 4, 8);
  run_ranks(ranks, [&](const Communicator& all) {
    const RowPartition from(all, rows), to(all, rows, 32);
    const auto wanted = [&](int rank) {
      return RowExchange::Window{to.begin_of(rank) - 3, to.end_of(rank) - to.begin_of(rank) + 6};
    };
    const auto mine = rows_of<double>(from.begin(), from.end(), ny);
    const auto window = wanted(all.rank());
    std::vector<double> got(static_cast<std::size_t>(window.count * ny), -1);
    RowExchange(from, wanted, edge)(mine.data(), ny * sizeof(double), got.data(),
                                    ny * sizeof(double), ny * sizeof(double));
    for (Index k = 0; k < window.count; ++k) {
      Index row = window.first + k;
      if (edge == RowExchange::Edge::repeat) row = (row + rows) % rows;
      if (edge == RowExchange::Edge::clamp) row = std::clamp<Index>(row, 0, rows - 1);
      for (Index j = 0; j < ny; ++j) {
        const double expected = row < 0 || row >= rows ? -1 : scattered(row * ny + j);
        if (got[static_cast<std::size_t>(k * ny + j)] != expected) throw Error("a wrong row");
      }
    }
  });
}

TEMPLATE_TEST_CASE("A convolution over processes has the bits of one process", "[share]", float,
                   double) {
  struct Case {
    Index nx, ny, period_x, period_y;
  };
  // Even and odd sizes, a last block that is not full, a zero-padded period, and fewer blocks than
  // processes.
  const auto shape = GENERATE(Case{64, 64, 64, 64}, Case{96, 50, 96, 50}, Case{101, 64, 101, 64},
                              Case{101, 33, 216, 75}, Case{16, 16, 16, 16}, Case{40, 1, 40, 1});
  const int components = GENERATE(1, 2);
  const auto symbol = [](double scale) {
    return [=](Index i, Index j) {
      return scale / (1 + static_cast<double>(i * i) + 0.5 * static_cast<double>(j * j));
    };
  };
  const auto convolve = [&](const RowPartition& rows,
                            std::array<std::vector<TestType>, 2>& results) {
    Convolution2D<TestType> convolution({shape.nx, shape.ny, shape.period_x, shape.period_y},
                                        components, rows);
    convolution.set_symbol(0, 0, symbol(1));
    if (components == 2) {
      convolution.set_symbol(0, 1, symbol(0.3), Parity::odd);
      convolution.set_symbol(1, 1, symbol(0.8));
    }
    const auto field = rows_of<TestType>(rows.begin(), rows.end(), shape.ny);
    for (auto& result : results) result.resize(field.size());
    convolution.apply(
        [&](int component, Index row, TestType* room) -> const TestType* {
          // Empty rows are given as nullptr, all others in the buffer.
          if ((row + rows.begin()) % 5 == 0) return nullptr;
          for (Index j = 0; j < shape.ny; ++j)
            room[j] = field[static_cast<std::size_t>(row * shape.ny + j)] +
                      static_cast<TestType>(component);
          return room;
        },
        [&](int component, Index row, const TestType* values) {
          std::copy_n(values, shape.ny,
                      results[static_cast<std::size_t>(component)].begin() + row * shape.ny);
        });
  };
  std::array<std::vector<TestType>, 2> alone;
  convolve(RowPartition(shape.nx), alone);
  const int ranks = GENERATE(1, 2, 3, 4, 5, 8);
  run_ranks(ranks, [&](const Communicator& all) {
    const RowPartition rows(all, shape.nx);
    std::array<std::vector<TestType>, 2> together;
    convolve(rows, together);
    for (std::size_t component = 0; component < static_cast<std::size_t>(components); ++component)
      if (!same_bits(alone[component].data() + rows.begin() * shape.ny, together[component].data(),
                     together[component].size() * sizeof(TestType)))
        throw Error("other bits");
  });
}

TEST_CASE("A failure of one process is thrown on all", "[share]") {
  run_ranks(3, [](const Communicator& all) {
    try {
      collectively(all, [&] {
        if (all.rank() == 1) throw InvalidInput("FILE", "x.h5", "must exist; name another");
      });
      throw Error("no failure");
    } catch (const InvalidInput& error) {
      if (error.field() != "FILE" || error.value() != "x.h5" ||
          error.constraint() != "must exist" || error.remedy() != "name another")
        throw Error("another message: " + std::string(error.what()));
    }
    try {
      collectively(all, [&] {
        if (all.rank() == 2) throw std::bad_alloc();
      });
      throw Error("no failure");
    } catch (const std::bad_alloc&) {
    }
  });
}

TEST_CASE("A field is gathered in the process that wants it", "[share]") {
  const int ranks = GENERATE(1, 2, 3, 5), root = GENERATE(0, 1);
  if (root >= ranks) return;
  const Field field = Field::Random(40, 7);  // fewer blocks of 16 rows than processes
  run_ranks(ranks, [&](const Communicator& all) {
    const RowPartition rows(all, field.rows());
    const Field whole = gathered(rows, Field(field.middleRows(rows.begin(), rows.count())), root);
    if (whole.rows() != (all.rank() == root ? 40 : 0)) throw Error("other rows");
    if (all.rank() == root && !(whole == field).all()) throw Error("other values");
    try {
      gathered(rows, Field(rows.count() + (all.rank() == ranks - 1), 7), root);
      throw Error("no failure");
    } catch (const InvalidInput& error) {
      if (error.field() != "rows") throw Error("another failure");
    }
  });
  const RowPartition alone(40);
  REQUIRE_THROWS_WITH(gathered(alone, field, 1), Catch::Contains("root"));
}

TEST_CASE("Ranks that part are told so instead of waiting", "[share]") {
  REQUIRE_THROWS_WITH(run_ranks(2,
                                [](const Communicator& all) {
                                  double number = 1;
                                  if (all.is_root()) {
                                    all.broadcast(&number, sizeof number);
                                  } else {
                                    all.gather_all(std::string("x"));
                                  }
                                }),
                      Catch::Contains("different collectives"));
  REQUIRE_THROWS_WITH(run_ranks(2,
                                [](const Communicator& all) {
                                  double number = 1;
                                  if (all.is_root()) all.broadcast(&number, sizeof number);
                                }),
                      Catch::Contains("has ended"));
}

TEST_CASE("The transform of 65 536 squared points over 1024 processes fits the counts of MPI",
          "[share]") {
  const int ranks = 1024;
  const Index n = 65536;
  for (const int rank : {0, 511, 1023}) {
    const auto transport = std::make_shared<salebra::testing::OneOfMany>(rank, ranks);
    const RowPartition rows(Communicator(transport), n);
    REQUIRE(rows.count() == 64);
    Convolution2D<float> convolution({n, n, n, n}, 1, rows);
    // Two buffers of 4 bytes for each cell of this process. The 32 769 columns of the half-spectrum
    // are not a multiple of 1024: the share of a process varies by one column, a thirty-second, and
    // column 0 is its own mirror image.
    const double bytes = 4.0 * static_cast<double>(n) * 64;
    CHECK(static_cast<double>(convolution.spectrum_bytes()) >= 2 * 0.96 * bytes);
    CHECK(static_cast<double>(convolution.spectrum_bytes()) <= 2 * 1.04 * bytes);
    convolution.apply([](int, Index, float*) -> const float* { return nullptr; },
                      [](int, Index, const float*) {});
    CHECK(transport->exchanged.calls == 2);
    CHECK(transport->exchanged.messages == 2 * (ranks - 1));
    // 8N²/P bytes for sending there and back.
    CHECK(transport->exchanged.sent >= 2 * bytes * (1 - 1.0 / ranks) * 0.99);
    CHECK(transport->exchanged.sent <= 2 * bytes * 1.04);
  }
  // Double precision with the period of an isolated surface sends the maximum at this size.
  const RowPartition rows(Communicator(std::make_shared<salebra::testing::OneOfMany>(0, ranks)), n);
  CHECK_NOTHROW(Convolution2D<double>({n, n, 2 * n, 2 * n}, 2, rows));
}

TEST_CASE("A plan of an exchange refuses more units than MPI counts", "[share]") {
  REQUIRE_THROWS_WITH(Exchange(1, {2147483647, 1}, {0, 0}), Catch::Contains("2147483647 units"));
  REQUIRE_NOTHROW(Exchange(1 << 20, {2147483646, 1}, {0, 0}));
}

TEST_CASE("The transport of threads conforms like that of MPI", "[share]") {
  run_ranks(GENERATE(1, 2, 3, 4), salebra::testing::check_conformance);
}
