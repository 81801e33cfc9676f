// SPDX-License-Identifier: GPL-3.0-or-later
// Wave vectors of a spectrum that a grid can represent, and their random complex amplitudes.
#include "modes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"

namespace salebra::detail {
namespace {

std::int32_t key(Index wave) { return static_cast<std::int32_t>(wave); }
std::size_t at(Index index) { return static_cast<std::size_t>(index); }

Index waves_within(double wavenumber, double step, Index points) {
  return static_cast<Index>(std::min(wavenumber / step, static_cast<double>(points / 2)));
}

}  // namespace

CarriedModes::CarriedModes(const Grid2D& grid, const Spectrum& spectrum)
    : grid_(&grid),
      spectrum_(&spectrum),
      step_x_(2 * std::numbers::pi / grid.lx),
      step_y_(2 * std::numbers::pi / grid.ly),
      highest_(spectrum.highest_wavenumber() * (1 + 2e-9)),
      j_max_(waves_within(highest_, step_y_, grid.ny)) {
  spectrum.require_carried_by(grid);
}

Index CarriedModes::i_max(Index j) const {
  const double qy = static_cast<double>(j) * step_y_;
  return waves_within(std::sqrt(std::max(highest_ * highest_ - qy * qy, 0.0)), step_x_, grid_->nx);
}

void RandomModes::draw(Index i, Index j, std::span<std::complex<double>> factors) const {
  if (chance_ == Chance::phase)
    fill_phase_factors(seed_, key(i), key(j), factors);
  else
    fill_gaussian(seed_, key(i), key(j), factors);
}

// Random factor of a wave that is its own conjugate. It has one real degree of freedom, which
// carries the whole power.
double RandomModes::real_factor(Index i, Index j) const {
  if (chance_ == Chance::gaussian_amplitude) return gaussian_pair(seed_, key(i), key(j)).first;
  std::complex<double> factor;
  fill_phase_factors(seed_, key(i), key(j), {&factor, 1});
  return std::copysign(1.0, factor.real());
}

void RandomModes::column(Index j, std::span<std::complex<double>> column) const {
  const Index nx = carried_.grid().nx;
  const Index i_max = carried_.i_max(j);
  const bool mirror = carried_.own_mirror(j);
  // Only one of two conjugate waves (i, j) and (−i, −j) is drawn: the one with j > 0 or, in a
  // column that is its own mirror image, the one with i > 0.
  const Index first = mirror ? 0 : 2 * i_max == nx ? 1 - i_max : -i_max;
  std::vector<double> amplitudes(at(i_max - first + 1));
  const double qy = static_cast<double>(j) * carried_.step_y();
  carried_.spectrum().density_row(first, carried_.step_x(), qy, amplitudes);
  const double mode_area = carried_.step_x() * carried_.step_y();
  // For two standard normal variables x and y, the mean of |x + iy|² is 2.
  const double scale = chance_ == Chance::phase ? 1 : 0.5;
  for (double& amplitude : amplitudes) amplitude = std::sqrt(amplitude * mode_area * scale);
  const auto amplitude = [&](Index i) { return amplitudes[at(i - first)]; };

  const auto positive = column.first(at(i_max + 1));
  draw(0, j, positive);
  for (Index i = 0; i <= i_max; ++i) positive[at(i)] *= amplitude(i);
  std::fill(column.begin() + i_max + 1, column.end() + std::min<Index>(first, 0), 0.0);
  if (!mirror) {
    draw(first, j, column.last(at(-first)));
    for (Index i = first; i < 0; ++i) column[at(nx + i)] *= amplitude(i);
    return;
  }
  for (const Index i : {Index{0}, i_max})
    if (carried_.own_conjugate(i))
      column[at(i)] = real_factor(i, j) * amplitude(i) / std::sqrt(scale);
  if (j == 0) column[0] = 0;
  for (Index i = 1; 2 * i < nx && i <= i_max; ++i) column[at(nx - i)] = std::conj(column[at(i)]);
}

}  // namespace salebra::detail
