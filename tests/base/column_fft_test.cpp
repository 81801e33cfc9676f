// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <salebra/base/column_fft.hpp>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <vector>

using namespace salebra;

namespace {

// The half-spectrum of a random field, cut to its first columns.
std::vector<std::complex<double>> some_modes(Index nx, Index ny, Index columns) {
  RealFft2D<double> fft(nx, ny);
  std::vector<std::complex<double>> modes(std::size_t(nx * fft.modes_y()));
  const Field field = Field::Random(nx, ny);
  fft.forward(field.data(), modes.data());
  for (Index i = 0; i < nx; ++i)
    for (Index j = columns; j < fft.modes_y(); ++j) modes[std::size_t(i * fft.modes_y() + j)] = 0;
  return modes;
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
    // Both round like eps·log n times the rms of the result, which is at most nx·ny times that of the random field.
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
