// SPDX-License-Identifier: GPL-3.0-or-later
// Interpolates heights on a finer grid: by Fourier modes if periodic, otherwise by a periodic
// bicubic spline.
#include "refine.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <vector>

#include "base/fft.hpp"
#include "base/memory.hpp"

namespace salebra {
namespace {

using Modes = std::vector<std::complex<double>>;

Modes modes_of(const Field& heights) {
  RealFft2D<double> transform(heights.rows(), heights.cols());
  Modes modes(static_cast<std::size_t>(transform.nx() * transform.modes_y()));
  transform.forward(heights.data(), modes.data());
  return modes;
}

Field heights_of(Modes& modes, Index nx, Index ny) {
  Field heights(nx, ny);
  RealFft2D<double>(nx, ny).backward(modes.data(), heights.data());
  return heights;
}

Field fourier(const Field& heights, Index factor) {
  const Index nx = heights.rows(), ny = heights.cols(), fine_nx = factor * nx;
  const Index width = ny / 2 + 1, fine_width = factor * ny / 2 + 1;
  const Modes coarse = modes_of(heights);
  Modes fine(static_cast<std::size_t>(fine_nx * fine_width));
  const double points = static_cast<double>(heights.size());
  for (Index i = 0; i < nx; ++i) {
    const Index wave = 2 * i <= nx ? i : i - nx;
    for (Index j = 0; j < width; ++j) {
      std::complex<double> mode = coarse[static_cast<std::size_t>(i * width + j)] / points;
      // A mode at the Nyquist frequency of x stands for both signs of the wave number. For y, the
      // half-spectrum of the fine grid implies the opposite sign.
      const bool middle_x = 2 * i == nx, middle_y = 2 * j == ny;
      if (middle_x) mode /= 2;
      if (middle_y) mode /= 2;
      const auto put = [&](Index at) {
        fine[static_cast<std::size_t>((at + fine_nx) % fine_nx * fine_width + j)] += mode;
      };
      put(wave);
      if (middle_x) put(-wave);
    }
  }
  return heights_of(fine, fine_nx, factor * ny);
}

// Coefficients c of the cubic B-splines whose sum passes through the heights h: (c₋ + 4c + c₊)/6 =
// h along each axis, with the neighbouring coefficients c₋ and c₊.
Field spline_coefficients(const Field& heights) {
  const Index nx = heights.rows(), ny = heights.cols(), width = ny / 2 + 1;
  Modes modes = modes_of(heights);
  const auto gain = [](Index wave, Index count) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(wave) / static_cast<double>(count);
    return (2 + std::cos(angle)) / 3;
  };
  for (Index i = 0; i < nx; ++i)
    for (Index j = 0; j < width; ++j)
      modes[static_cast<std::size_t>(i * width + j)] /=
          gain(i, nx) * gain(j, ny) * static_cast<double>(heights.size());
  return heights_of(modes, nx, ny);
}

// Interpolates along x: row k of the result lies k/factor coarse rows after the first row.
Field spline_rows(const Field& coefficients, Index factor) {
  const Index rows = coefficients.rows();
  Field fine(rows * factor, coefficients.cols());
  for (Index part = 0; part < factor; ++part) {
    const double t = static_cast<double>(part) / static_cast<double>(factor), s = 1 - t;
    const std::array<double, 4> weights{s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                                        (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
    for (Index row = 0; row < rows; ++row) {
      auto here = fine.row(row * factor + part);
      here.setZero();
      for (Index k = 0; k < 4; ++k)
        here +=
            weights[static_cast<std::size_t>(k)] * coefficients.row((row + k - 1 + rows) % rows);
    }
  }
  return fine;
}

Field spline(const Field& heights, Index factor) {
  const Field along_x = spline_rows(spline_coefficients(heights), factor);
  return spline_rows(along_x.transpose(), factor).transpose();
}

}  // namespace

Surface refined(const Surface& surface, Index factor) {
  const Communicator& communicator = surface.communicator;
  collectively(communicator, [&] { surface.require_complete_rows("refinement"); });
  require(factor >= 1, "factor", factor, "must be >= 1");
  const double fine_points =
      static_cast<double>(surface.grid.points()) * static_cast<double>(factor * factor);
  require_memory(surface.grid, communicator.is_root() ? 24 * fine_points : 0,
                 "its refinement (a smaller factor needs less)", communicator);
  if (factor == 1) return surface;
  Surface fine{surface.grid, gathered(surface.partition(), surface.heights), surface.periodic,
               surface.origin, communicator};
  fine.grid.nx *= factor;
  fine.grid.ny *= factor;
  collectively(communicator, [&] {
    if (communicator.is_root())
      fine.heights = fine.periodic ? fourier(fine.heights, factor) : spline(fine.heights, factor);
  });
  if (!communicator.alone()) fine.heights = scattered(fine.partition(), fine.grid.ny, fine.heights);
  return fine;
}

}  // namespace salebra
