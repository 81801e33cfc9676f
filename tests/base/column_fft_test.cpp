// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/column_fft.hpp"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstring>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/fft.hpp"
#include "ranks_in_threads.hpp"

using namespace salebra;
using salebra::testing::run_ranks;
using salebra::testing::stop_one;

namespace {

// The half-spectrum of a random field, truncated to its first columns.
std::vector<std::complex<double>> some_modes(Index nx, Index ny, Index columns) {
  RealFft2D<double> fft(nx, ny);
  std::vector<std::complex<double>> modes(std::size_t(nx * fft.modes_y()));
  const Field field = Field::Random(nx, ny);
  fft.forward(field.data(), modes.data());
  for (Index i = 0; i < nx; ++i)
    for (Index j = columns; j < fft.modes_y(); ++j) modes[std::size_t(i * fft.modes_y() + j)] = 0;
  return modes;
}

// Whether a process has its rows of a field that a single process made, bit by bit.
bool has_its_rows(const Field& mine, const Field& whole, const RowPartition& rows) {
  return mine.rows() == rows.count() && mine.cols() == whole.cols() &&
         (mine.size() == 0 ||
          std::memcmp(mine.data(), whole.data() + rows.begin() * whole.cols(),
                      static_cast<std::size_t>(mine.size()) * sizeof(double)) == 0);
}

}  // namespace

TEST_CASE("A spectrum given by columns transforms as one given whole", "[fft]") {
  const auto [nx, ny] = GENERATE(std::pair<Index, Index>{24, 80}, std::pair<Index, Index>{25, 81},
                                 std::pair<Index, Index>{1, 6}, std::pair<Index, Index>{7, 1},
                                 std::pair<Index, Index>{130, 2});
  const Index all = ny / 2 + 1;
  for (const Index columns : {Index{1}, (all + 1) / 2, all - 1, all}) {
    if (columns < 1) continue;
    std::vector<std::complex<double>> modes = some_modes(nx, ny, columns);
    const auto column = [&, nx = nx](Index j, std::span<std::complex<double>> out) {
      for (Index i = 0; i < nx; ++i) out[std::size_t(i)] = modes[std::size_t(i * all + j)];
    };
    parallel::set_threads(1);
    const Field serial = backward_by_columns(nx, ny, columns, column);
    parallel::set_threads(3);
    const Field parallel_result = backward_by_columns(nx, ny, columns, column);
    parallel::set_threads(0);
    CHECK((serial == parallel_result).all());
    Field whole(nx, ny);
    RealFft2D<double>(nx, ny).backward(modes.data(), whole.data());
    // The rounding error of both is eps·log n times the rms of the result, which is at most nx·ny
    // times that of the random field.
    CHECK((serial - whole).abs().maxCoeff() < 1e-14 * double(nx * ny));
  }
}

TEST_CASE("A number of columns that the grid does not have is refused", "[fft]") {
  const auto zeros = [](Index, std::span<std::complex<double>> out) {
    std::fill(out.begin(), out.end(), 0.0);
  };
  CHECK_THROWS_AS(backward_by_columns(8, 8, 6, zeros), InvalidInput);
  CHECK_THROWS_AS(backward_by_columns(8, 8, 0, zeros), InvalidInput);
}

TEST_CASE("Columns of several processes transform to the bits of one process", "[fft][share]") {
  // Even and odd sizes; no rows for the last processes; columns for only some processes. The last
  // two sizes have several batches, the last of them not full, and several groups per batch.
  const auto [nx, ny] =
      GENERATE(std::pair<Index, Index>{64, 64}, std::pair<Index, Index>{96, 50},
               std::pair<Index, Index>{101, 64}, std::pair<Index, Index>{16, 16},
               std::pair<Index, Index>{25, 81}, std::pair<Index, Index>{7, 1},
               std::pair<Index, Index>{33, 1000}, std::pair<Index, Index>{50, 999});
  const Index all = ny / 2 + 1;
  for (const Index columns : {Index{1}, (all + 1) / 2, all - 1, all}) {
    if (columns < 1) continue;
    const auto modes = some_modes(nx, ny, columns);
    const auto column = [&, nx = nx](Index j, std::span<std::complex<double>> out) {
      for (Index i = 0; i < nx; ++i) out[std::size_t(i)] = modes[std::size_t(i * all + j)];
    };
    const Field whole = backward_by_columns(nx, ny, columns, column);
    for (const int ranks : {1, 2, 3, 8})
      for (const int threads : ranks % 2 == 1 ? std::vector{1, 2} : std::vector{1}) {
        CAPTURE(nx, ny, columns, ranks, threads);
        parallel::set_threads(threads);
        std::atomic<Index> made = 0;
        std::atomic<int> right = 0, right_of_any = 0;
        const auto counted = [&](Index j, std::span<std::complex<double>> out) {
          ++made;
          column(j, out);
        };
        run_ranks(ranks, [&, nx = nx, ny = ny](const Communicator& together) {
          const RowPartition rows(together, nx);
          right +=
              has_its_rows(backward_by_columns(nx, ny, columns, counted, {}, rows), whole, rows);
          // Shares need not be blocks, and the first process may have no rows.
          std::vector<Index> begins(static_cast<std::size_t>(ranks) + 1, nx);
          for (std::size_t k = 0; k + 1 < begins.size(); ++k)
            begins[k] = k < 2 ? 0 : std::min<Index>(nx, 5 * Index(k) - 7);
          const RowPartition any(together, begins);
          right_of_any +=
              has_its_rows(backward_by_columns(nx, ny, columns, column, {}, any), whole, any);
        });
        CHECK(right == ranks);
        CHECK(right_of_any == ranks);
        // Each column is made by one process.
        CHECK(made == columns);
      }
    parallel::set_threads(0);
  }
}

TEST_CASE("A stop or a failure of one process ends the transform on all", "[fft][share]") {
  // The last process has columns but no rows.
  const Index nx = 32, ny = 200, columns = 101;
  const auto zeros = [](Index, std::span<std::complex<double>> out) {
    std::fill(out.begin(), out.end(), 0.0);
  };
  const int ranks = 3, culprit = GENERATE(0, 1, 2);
  // Reports of one process: their number, and whether they end at 1.
  std::atomic<int> reports = 0;
  std::atomic<bool> in_order = true;
  parallel::set_threads(1);
  const auto work = [&](const Communicator& together, const Progress& on_progress) {
    backward_by_columns(nx, ny, columns, zeros, on_progress, RowPartition(together, nx));
  };
  run_ranks(ranks, [&](const Communicator& together) {
    double last = 0;
    const auto told = [&](const ProgressReport& report) {
      ++reports;
      if (!(report.fraction >= last && report.stage == "surface")) in_order = false;
      last = report.fraction;
      return true;
    };
    work(together, together.rank() == culprit ? Progress(told) : Progress());
    if (together.rank() == culprit && last != 1) in_order = false;
  });
  CHECK(in_order);
  REQUIRE(reports > 2);
  for (int stop = 1; stop <= reports; ++stop)
    CHECK(stop_one(ranks, culprit, stop, work).interrupted == ranks);
  // Each process in turn has no memory for one of its columns.
  for (Index failing = 0; failing < columns; failing += 7) {
    std::atomic<int> failed = 0;
    run_ranks(ranks, [&](const Communicator& together) {
      try {
        backward_by_columns(
            nx, ny, columns,
            [&](Index j, std::span<std::complex<double>> out) {
              if (j == failing) throw std::bad_alloc();
              zeros(j, out);
            },
            {}, RowPartition(together, nx));
      } catch (const std::bad_alloc&) {
        ++failed;
      }
    });
    CHECK(failed == ranks);
  }
  parallel::set_threads(0);
}

TEST_CASE(
    "Memory of a transform by columns is that of the rows of a process, and as much for a batch",
    "[fft][share]") {
  const Index n = 4096;
  const int ranks = GENERATE(1, 2, 4, 16);
  parallel::set_threads(2);
  std::atomic<int> right = 0;
  run_ranks(ranks, [&](const Communicator& together) {
    const RowPartition rows(together, n);
    const double of_rows = double(rows.count() * n) * sizeof(double),
                 memory = double(column_fft_memory(n, n, rows));
    // Up to 4 % for rows and columns of two threads; with several processes, also a batch as large
    // as the rows.
    right += memory > of_rows && memory < (ranks == 1 ? 1.04 : 2.04) * of_rows;
  });
  CHECK(right == ranks);
  parallel::set_threads(0);
}

TEST_CASE("The columns of a spectrum are those of RealFft2D, for any number of processes",
          "[fft][share]") {
  const auto [nx, ny] = GENERATE(std::pair<Index, Index>{64, 64}, std::pair<Index, Index>{96, 50},
                                 std::pair<Index, Index>{101, 64}, std::pair<Index, Index>{16, 16},
                                 std::pair<Index, Index>{48, 2100});
  const Field field = Field::Random(nx, ny);
  const Index all = ny / 2 + 1;
  using Complex = std::complex<double>;
  using Modes = std::vector<Complex>;
  const auto modes_of = [&, nx = nx, ny = ny](const Communicator& together, Modes& modes) {
    const RowPartition rows(together, nx), columns(together, all);
    std::atomic<Index> wrong = 0;
    forward_by_columns(
        nx, ny,
        [&](Index row, std::span<double> values) {
          for (Index iy = 0; iy < ny; ++iy) values[std::size_t(iy)] = field(rows.begin() + row, iy);
        },
        [&](Index j, std::span<Complex> column) {
          wrong += j < columns.begin() || j >= columns.end();
          for (Index i = 0; i < nx; ++i) modes[std::size_t(i * all + j)] = column[std::size_t(i)];
        },
        rows, columns);
    return wrong == 0;
  };
  Modes whole(std::size_t(nx * all)), alone(whole.size());
  RealFft2D<double>(nx, ny).forward(field.data(), whole.data());
  CHECK(modes_of({}, alone));
  // The rounding error of both is eps·log n times the largest mode, which is at least √(nx·ny)/2
  // for random heights.
  double largest = 0, difference = 0;
  for (std::size_t k = 0; k < whole.size(); ++k) {
    largest = std::max(largest, std::abs(whole[k]));
    difference = std::max(difference, std::abs(whole[k] - alone[k]));
  }
  CHECK(difference < 1e-14 * largest);
  for (const int ranks : {1, 2, 3, 4, 5, 8})
    for (const int threads : {1, 2}) {
      CAPTURE(nx, ny, ranks, threads);
      parallel::set_threads(threads);
      Modes spread(whole.size());
      std::atomic<int> right = 0;
      run_ranks(ranks, [&](const Communicator& together) { right += modes_of(together, spread); });
      CHECK(right == ranks);
      CHECK(std::memcmp(spread.data(), alone.data(), alone.size() * sizeof(Complex)) == 0);
    }
  parallel::set_threads(0);
}
