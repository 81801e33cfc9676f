// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/fft.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

using namespace salebra;

TEST_CASE("A plane wave transforms into its own mode alone", "[fft]") {
  const auto [nx, ny] = GENERATE(std::pair<Index, Index>{8, 12}, std::pair<Index, Index>{7, 9},
                                 std::pair<Index, Index>{1, 6}, std::pair<Index, Index>{5, 1});
  const Index i = nx > 2 ? 2 : 0, j = ny > 3 ? 1 : 0;
  Field wave(nx, ny);
  for (Index a = 0; a < nx; ++a)
    for (Index b = 0; b < ny; ++b)
      wave(a, b) = std::cos(2 * std::numbers::pi *
                            (double(i * a) / double(nx) + double(j * b) / double(ny)));
  RealFft2D<double> fft(nx, ny);
  std::vector<std::complex<double>> modes(std::size_t(nx * fft.modes_y()));
  fft.forward(wave.data(), modes.data());
  const bool self_conjugate = i == 0 && j == 0;
  const double expected = double(nx * ny) * (self_conjugate ? 1.0 : 0.5);
  for (Index a = 0; a < nx; ++a)
    for (Index b = 0; b < fft.modes_y(); ++b) {
      const bool here = (a == i && b == j) || (j == 0 && a == (nx - i) % nx && b == 0);
      // The rounding error of an FFT of n points grows like eps·log n; 1e-12 leaves two decades.
      CHECK(std::abs(modes[std::size_t(a * fft.modes_y() + b)] - (here ? expected : 0.0)) <
            1e-12 * expected);
    }
}

TEST_CASE("Backward after forward multiplies by the number of points", "[fft]") {
  const Index nx = 15, ny = 22;
  const Field field = Field::Random(nx, ny);
  RealFft2D<double> fft(nx, ny);
  std::vector<std::complex<double>> modes(std::size_t(nx * fft.modes_y()));
  Field back(nx, ny);
  fft.forward(field.data(), modes.data());
  fft.backward(modes.data(), back.data());
  CHECK((back / double(nx * ny) - field).abs().maxCoeff() < 1e-14);
}
