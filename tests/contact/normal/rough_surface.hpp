// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <salebra/base/grid.hpp>
#include <vector>

#include "base/fft.hpp"

namespace salebra::test {

// A fixed congruential generator: these surfaces must never change, even if the generators library
// does.
class Lcg {
 public:
  explicit Lcg(std::uint64_t seed) : state_(seed * 2 + 1) { uniform(); }
  double uniform() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return (static_cast<double>(state_ >> 11) + 0.5) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

struct RoughnessOfTest {
  double hurst = 0.8;
  double rolloff = 4;  // roll-off: waves per side
  double cutoff = 8;   // shortest wavelength in cells
  double rms_slope = 0.1;
  std::uint64_t seed = 1;
};

// Filtered white noise on any grid: power q^(−2−2H) above the roll-off, constant below it, nothing
// above the cut-off.
inline Surface rough_surface(const Grid2D& grid, const RoughnessOfTest& roughness = {}) {
  Surface surface{grid, Field(grid.nx, grid.ny), true, "test"};
  Lcg random(roughness.seed);
  for (Index k = 0; k < grid.points(); ++k) {
    const double radius = std::sqrt(-2 * std::log(random.uniform()));
    surface.heights.data()[k] = radius * std::cos(2 * std::numbers::pi * random.uniform());
  }
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(surface.heights.data(), modes.data());
  const double side = std::sqrt(grid.area()), cell = std::sqrt(grid.cell_area());
  const double q_rolloff = 2 * std::numbers::pi * roughness.rolloff / side;
  const double q_cutoff = 2 * std::numbers::pi / (roughness.cutoff * cell);
  double slope = 0;
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < fft.modes_y(); ++j) {
      auto& mode = modes[static_cast<std::size_t>(i * fft.modes_y() + j)];
      const double q = 2 * std::numbers::pi *
                       std::hypot(static_cast<double>(std::min(i, grid.nx - i)) / grid.lx,
                                  static_cast<double>(j) / grid.ly);
      mode *= q == 0 || q > q_cutoff ? 0
              : q < q_rolloff        ? 1
                                     : std::pow(q / q_rolloff, -1 - roughness.hurst);
      slope += (j == 0 || 2 * j == grid.ny ? 1 : 2) * q * q * std::norm(mode);
    }
  fft.backward(modes.data(), surface.heights.data());
  surface.heights *= roughness.rms_slope / std::sqrt(slope);
  return surface;
}

inline double rms_height(const Surface& surface) {
  return std::sqrt((surface.heights - surface.heights.mean()).square().mean());
}

// Makes heights from a function of the position in metres.
template <class Function>
Surface surface_of(const Grid2D& grid, const Function& height) {
  Surface surface{grid, Field(grid.nx, grid.ny), true, "test"};
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j)
      surface.heights(i, j) =
          height(static_cast<double>(i) * grid.dx(), static_cast<double>(j) * grid.dy());
  return surface;
}

}  // namespace salebra::test
