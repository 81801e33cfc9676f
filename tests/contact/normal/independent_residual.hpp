// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <numbers>
#include <vector>

#include "base/fft.hpp"
#include "contact/half_space/half_space.hpp"
#include "polonsky_keer.hpp"

namespace salebra::test {

// Love's displacement of an isolated half-space, by plain transforms of a field padded with as many
// empty cells along each axis.
inline Field free_displacement(const Field& pressure, const Grid2D& grid, double contact_modulus) {
  const Index nx = 2 * grid.nx, ny = 2 * grid.ny;
  RealFft2D<double> fft(nx, ny);
  const auto size = static_cast<std::size_t>(nx * fft.modes_y());
  std::vector<std::complex<double>> modes(size), kernel_modes(size);
  Field padded = Field::Zero(nx, ny), kernel(nx, ny);
  padded.topLeftCorner(grid.nx, grid.ny) = pressure;
  for (Index i = 0; i < nx; ++i)
    for (Index j = 0; j < ny; ++j)
      kernel(i, j) = cell_integrals(static_cast<double>(i < grid.nx ? i : i - nx) * grid.dx(),
                                    static_cast<double>(j < grid.ny ? j : j - ny) * grid.dy(),
                                    grid.dx(), grid.dy())
                         .inverse_distance /
                     (std::numbers::pi * contact_modulus);
  fft.forward(padded.data(), modes.data());
  fft.forward(kernel.data(), kernel_modes.data());
  for (std::size_t k = 0; k < size; ++k) modes[k] *= kernel_modes[k] / static_cast<double>(nx * ny);
  fft.backward(modes.data(), padded.data());
  return padded.topLeftCorner(grid.nx, grid.ny);
}

// Computes e_c from the pressure field alone, by transforms that share no code with the solver's.
inline double independent_residual(const Field& pressure, const Surface& surface,
                                   double contact_modulus, Boundary boundary = Boundary::periodic) {
  const Field displacement = boundary == Boundary::periodic
                                 ? half_space_displacement(pressure, surface.grid, contact_modulus)
                                 : free_displacement(pressure, surface.grid, contact_modulus);
  const Field gap = displacement - surface.heights;
  const double rms = std::sqrt((surface.heights - surface.heights.mean()).square().mean());
  return (pressure * (gap - gap.minCoeff())).sum() / (pressure.sum() * rms);
}

}  // namespace salebra::test
