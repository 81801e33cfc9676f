// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <salebra/base/grid.hpp>
#include <vector>

#include "base/fft.hpp"

namespace salebra::test {

struct PolonskyKeerResult {
  Field pressure, gap;
  double residual = 0;  // e_c
  int iterations = 0;
};

// u(q) = 2 p(q)/(E*|q|), mean zero, by a plain transform of the whole field.
inline Field half_space_displacement(const Field& pressure, const Grid2D& grid,
                                     double contact_modulus) {
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(pressure.data(), modes.data());
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < fft.modes_y(); ++j) {
      const double q = 2 * std::numbers::pi *
                       std::hypot(static_cast<double>(std::min(i, grid.nx - i)) / grid.lx,
                                  static_cast<double>(j) / grid.ly);
      modes[static_cast<std::size_t>(i * fft.modes_y() + j)] *=
          q == 0 ? 0 : 2 / (contact_modulus * q * static_cast<double>(grid.points()));
    }
  Field displacement(grid.nx, grid.ny);
  fft.backward(modes.data(), displacement.data());
  return displacement;
}

// The constrained conjugate gradients of Polonsky and Keer (1999), as their paper states them:
// steepest descent after each change of the contact set by overlap, no preconditioner, no coarser
// grids. It is slow and simple, and serves as a second route to every result.
inline PolonskyKeerResult polonsky_keer(const Surface& surface, double contact_modulus,
                                        double nominal_pressure, double tolerance,
                                        int max_iterations = 20000) {
  const Grid2D& grid = surface.grid;
  const double rms = std::sqrt((surface.heights - surface.heights.mean()).square().mean());
  PolonskyKeerResult result;
  Field& p = result.pressure;
  p = Field::Constant(grid.nx, grid.ny, nominal_pressure);
  Field direction = Field::Zero(grid.nx, grid.ny);
  double old_norm = 1;
  bool restart = true;
  for (; result.iterations < max_iterations; ++result.iterations) {
    Field gap = half_space_displacement(p, grid, contact_modulus) - surface.heights;
    const double least = gap.minCoeff();
    result.residual = (p * (gap - least)).sum() / (p.sum() * rms);
    result.gap = gap - least;
    if (result.residual < tolerance) break;
    const Field contact = (p > 0).cast<double>();
    gap -= (gap * contact).sum() / contact.sum();
    const double norm = (gap.square() * contact).sum();
    direction = contact * (gap + (restart ? 0.0 : norm / old_norm) * direction);
    old_norm = norm;
    Field image = half_space_displacement(direction, grid, contact_modulus);
    image -= (image * contact).sum() / contact.sum();
    const double step = (gap * direction).sum() / (image * direction).sum();
    p = (p - step * direction).max(0.0);
    // Cells without pressure that overlap come into contact, and CG restarts.
    const Field overlap = (p == 0 && gap < 0).cast<double>();
    restart = overlap.sum() > 0;
    p -= step * overlap * gap;
    p *= nominal_pressure / p.mean();
  }
  return result;
}

}  // namespace salebra::test
