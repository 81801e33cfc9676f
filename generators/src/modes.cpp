// SPDX-License-Identifier: GPL-3.0-or-later
#include "modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/random.hpp>

namespace salebra::detail {
namespace {

std::int32_t key(Index wave) { return static_cast<std::int32_t>(wave); }

}  // namespace

CarriedModes carried_modes(const Grid2D& grid, const Spectrum& spectrum) {
  // A wave on the limit is in, whatever the rounding of its wave number; its density decides.
  const double limit = spectrum.highest_wavenumber() * (1 + 1e-9) / (2 * std::numbers::pi);
  const auto within = [limit](double length, Index points) {
    return static_cast<Index>(
        std::min(std::floor(limit * length), static_cast<double>(points / 2)));
  };
  return {within(grid.lx, grid.nx), within(grid.ly, grid.ny)};
}

Modes::Modes(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Chance chance)
    : grid_(grid), spectrum_(spectrum), seed_(seed), chance_(chance) {
  spectrum.require_carried_by(grid);
  carried_ = carried_modes(grid, spectrum);
}

void Modes::draw(Index i, Index j, std::span<std::complex<double>> factors) const {
  if (chance_ == Chance::phase) {
    fill_phase_factors(seed_, key(i), key(j), factors);
    return;
  }
  fill_gaussian(seed_, key(i), key(j), factors);
  // ⟨|x + iy|²⟩ = 2 for two standard normal variables.
  for (std::complex<double>& factor : factors) factor *= std::numbers::sqrt2 / 2;
}

double Modes::amplitude(Index i, Index j) const {
  const double step_x = 2 * std::numbers::pi / grid_.lx;
  const double step_y = 2 * std::numbers::pi / grid_.ly;
  const double density =
      spectrum_.density(static_cast<double>(i) * step_x, static_cast<double>(j) * step_y);
  return std::sqrt(density * (step_x * step_y));
}

// A wave that is its own conjugate has one real degree of freedom, which carries the whole power.
std::complex<double> Modes::real_mode(Index i, Index j) const {
  if (i == 0 && j == 0) return 0;
  if (chance_ == Chance::gaussian_amplitude)
    return amplitude(i, j) * gaussian_pair(seed_, key(i), key(j)).first;
  std::complex<double> factor;
  fill_phase_factors(seed_, key(i), key(j), {&factor, 1});
  return std::copysign(amplitude(i, j), factor.real());
}

void Modes::column(Index j, std::span<std::complex<double>> column) const {
  const Index nx = grid_.nx;
  std::fill(column.begin(), column.end(), 0.0);
  // ±nx/2 are one mode of the grid; + names it. Any pair of conjugates is drawn once, from the one with j > 0 or, on the lines
  // that are their own mirror image, i > 0.
  const bool nyquist_x = 2 * carried_.i_max == nx;
  if (j == 0 || 2 * j == grid_.ny) {
    const Index last = nyquist_x ? carried_.i_max - 1 : carried_.i_max;
    const auto positive = column.subspan(1, static_cast<std::size_t>(last));
    draw(1, j, positive);
    for (Index i = 1; i <= last; ++i) {
      std::complex<double>& mode = column[static_cast<std::size_t>(i)];
      mode *= amplitude(i, j);
      column[static_cast<std::size_t>(nx - i)] = std::conj(mode);
    }
    column[0] = real_mode(0, j);
    if (nyquist_x) column[static_cast<std::size_t>(nx / 2)] = real_mode(nx / 2, j);
    return;
  }
  const Index negative = nyquist_x ? carried_.i_max - 1 : carried_.i_max;
  draw(0, j, column.first(static_cast<std::size_t>(carried_.i_max + 1)));
  draw(-negative, j, column.last(static_cast<std::size_t>(negative)));
  for (Index i = 0; i <= carried_.i_max; ++i)
    column[static_cast<std::size_t>(i)] *= amplitude(i, j);
  for (Index i = 1; i <= negative; ++i)
    column[static_cast<std::size_t>(nx - i)] *= amplitude(-i, j);
}

}  // namespace salebra::detail
