// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <numbers>
#include <vector>

#include "base/fft.hpp"

/// Fourier coefficients of a surface, h(x) = Σ a(i, j) exp(2πi(ix/lx + jy/ly)), for any integers i,
/// j.
class FourierCoefficients {
 public:
  explicit FourierCoefficients(const salebra::Surface& surface) : grid_(surface.grid) {
    salebra::RealFft2D<double> fft(grid_.nx, grid_.ny);
    columns_ = fft.modes_y();
    half_.resize(std::size_t(grid_.nx * columns_));
    fft.forward(surface.heights.data(), half_.data());
    for (auto& mode : half_) mode /= double(grid_.points());
  }

  std::complex<double> operator()(salebra::Index i, salebra::Index j) const {
    const salebra::Index a = ((i % grid_.nx) + grid_.nx) % grid_.nx;
    const salebra::Index b = ((j % grid_.ny) + grid_.ny) % grid_.ny;
    if (b < columns_) return half_[std::size_t(a * columns_ + b)];
    return std::conj(half_[std::size_t((grid_.nx - a) % grid_.nx * columns_ + grid_.ny - b)]);
  }

 private:
  salebra::Grid2D grid_;
  salebra::Index columns_ = 0;
  std::vector<std::complex<double>> half_;
};

/// Signed wave number of a grid of n points: −n/2 < i <= n/2.
inline salebra::Index signed_wave(salebra::Index index, salebra::Index n) {
  return 2 * index > n ? index - n : index;
}
