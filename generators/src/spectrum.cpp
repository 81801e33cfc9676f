// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral moments of the modes that a grid can represent, and the check that it can represent a
// spectrum.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/generators/spectrum.hpp>
#include <sstream>
#include <vector>

#include "base/loop_progress.hpp"
#include "modes.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

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
            << " m; use more points or a longer `short_cutoff`";
  require(shortest >= 2 * cell * (1 - 1e-9), "short_cutoff", shortest, two_cells.str());
  std::ostringstream size;
  size << "must fit into the cell, " << std::max(grid.lx, grid.ly)
       << " m; use a larger cell or a shorter `short_cutoff`";
  require(shortest <= std::max(grid.lx, grid.ly) * (1 + 1e-9), "short_cutoff", shortest,
          size.str());
}

double IsotropicSpectrum::density(double qx, double qy) const {
  return radial_density(std::sqrt(qx * qx + qy * qy));
}

void Spectrum::density_row(Index first, double step_x, double qy,
                           std::span<double> densities) const {
  for (std::size_t k = 0; k < densities.size(); ++k) {
    const Index i = first + static_cast<Index>(k);
    densities[k] = i == 0 && qy == 0 ? 0 : density(static_cast<double>(i) * step_x, qy);
  }
}

SpectralMoments Spectrum::lattice_moments(const Grid2D& grid, const Progress& progress,
                                          const Communicator& communicator) const {
  const detail::CarriedModes carried(grid, *this);
  const RowPartition columns(communicator, carried.j_max() + 1);
  std::vector<SpectralMoments> own, all;
  LoopProgress loop(progress, "moments", columns.count());
  collectively(communicator, [&] {
    own.resize(static_cast<std::size_t>(columns.count()));
    all.resize(static_cast<std::size_t>(columns.rows()));
    parallel::for_slabs(columns.count(), [&](Index begin, Index end) {
      for (Index j = begin; j < end && loop.advance(); ++j)
        detail::for_each_mode_of_column(carried, columns.begin() + j,
                                        [&](double qx, double qy, double power, bool pair) {
                                          add(own[static_cast<std::size_t>(j)],
                                              moments_of_wave(qx, qy, pair ? 2 * power : power));
                                        });
    });
    loop.finish();
  });
  std::vector<std::size_t> bytes;
  for (int rank = 0; rank < communicator.size(); ++rank)
    bytes.push_back(static_cast<std::size_t>(columns.end_of(rank) - columns.begin_of(rank)) *
                    sizeof(SpectralMoments));
  communicator.gather_all(own.data(), bytes, all.data());
  SpectralMoments sum;
  for (const SpectralMoments& column : all) add(sum, column);
  return sum;
}

}  // namespace salebra
