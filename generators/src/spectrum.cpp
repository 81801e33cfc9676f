// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/spectrum.hpp>
#include <sstream>
#include <vector>

#include "modes.hpp"

namespace salebra {
namespace {

constexpr double pi = std::numbers::pi;

void add(SpectralMoments& sum, const SpectralMoments& term) {
  sum.moment0 += term.moment0;
  sum.moment2_x += term.moment2_x;
  sum.moment2_y += term.moment2_y;
  sum.moment4_x += term.moment4_x;
  sum.moment4_y += term.moment4_y;
}

SpectralMoments moments_of_wave(double qx, double qy, double power) {
  const double x2 = qx * qx, y2 = qy * qy;
  return {power, x2 * power, y2 * power, x2 * x2 * power, y2 * y2 * power};
}

}  // namespace

void Spectrum::require_carried_by(const Grid2D& grid) const {
  grid.validate();
  const double shortest = 2 * pi / highest_wavenumber();
  const double cell = std::max(grid.dx(), grid.dy());
  std::ostringstream two_cells;
  two_cells << "must be at least two cells, " << 2 * cell
            << " m; use more points or a longer short_cutoff";
  require(shortest >= 2 * cell * (1 - 1e-9), "short_cutoff", shortest, two_cells.str());
  std::ostringstream size;
  size << "must fit into the cell, " << std::max(grid.lx, grid.ly)
       << " m; use a larger cell or a shorter short_cutoff";
  require(shortest <= std::max(grid.lx, grid.ly) * (1 + 1e-9), "short_cutoff", shortest,
          size.str());
}

SpectralMoments Spectrum::lattice_moments(const Grid2D& grid) const {
  require_carried_by(grid);
  const detail::CarriedModes carried = detail::carried_modes(grid, *this);
  const double step_x = 2 * pi / grid.lx, step_y = 2 * pi / grid.ly;
  std::vector<SpectralMoments> columns(static_cast<std::size_t>(carried.j_max + 1));
  parallel::for_slabs(carried.j_max + 1, [&](Index begin, Index end) {
    for (Index j = begin; j < end; ++j) {
      const bool own_mirror_y = j == 0 || 2 * j == grid.ny;
      const bool nyquist_x = 2 * carried.i_max == grid.nx;
      const Index first = own_mirror_y ? 0 : nyquist_x ? 1 - carried.i_max : -carried.i_max;
      for (Index i = first; i <= carried.i_max; ++i) {
        if (i == 0 && j == 0) continue;
        const bool own_conjugate = own_mirror_y && (i == 0 || 2 * i == grid.nx);
        const double qx = static_cast<double>(i) * step_x, qy = static_cast<double>(j) * step_y;
        const double power = (own_conjugate ? 1 : 2) * density(qx, qy) * step_x * step_y;
        add(columns[static_cast<std::size_t>(j)], moments_of_wave(qx, qy, power));
      }
    }
  });
  SpectralMoments sum;
  for (const SpectralMoments& column : columns) add(sum, column);
  return sum;
}

}  // namespace salebra
