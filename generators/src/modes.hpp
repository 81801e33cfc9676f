// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstdint>
#include <salebra/generators/spectrum.hpp>
#include <span>
#include <vector>

namespace salebra::detail {

/// The modes of a grid that a spectrum can fill: the columns 0 <= j <= j_max of the wave vectors
/// (modes with j < 0 are their conjugates), and in column j the waves |i| <= i_max(j). The waves i
/// = ±nx/2 are a single mode of the grid, called +nx/2.
class CarriedModes {
 public:
  /// grid, spectrum: must outlive the object. Throws like Spectrum::require_carried_by().
  CarriedModes(const Grid2D& grid, const Spectrum& spectrum);

  Index j_max() const { return j_max_; }
  Index i_max(Index j) const;
  /// Whether column j is its own mirror image: (i, j) and (−i, j) are conjugates.
  bool own_mirror(Index j) const { return j == 0 || 2 * j == grid_->ny; }
  /// Whether wave i is its own conjugate, if its column is its own mirror image.
  bool own_conjugate(Index i) const { return i == 0 || 2 * i == grid_->nx; }

  double step_x() const { return step_x_; }  ///< 2π/lx, rad/m
  double step_y() const { return step_y_; }
  const Grid2D& grid() const { return *grid_; }
  const Spectrum& spectrum() const { return *spectrum_; }

 private:
  const Grid2D* grid_;
  const Spectrum* spectrum_;
  double step_x_, step_y_;
  double
      // maximum wave number |q|, with a margin for rounding; the density decides about waves at the
      // limit
      highest_;
  Index j_max_;
};

/// Calls visit(qx, qy, power, pair) for the modes of column j, one of each conjugate pair, without
/// the mode q = 0. power is the mean power of the mode; pair says whether it has a conjugate that
/// is not visited.
template <class Visit>
void for_each_mode_of_column(const CarriedModes& carried, Index j, Visit visit) {
  const Index nx = carried.grid().nx, last = carried.i_max(j);
  const bool mirror = carried.own_mirror(j);
  const Index first = mirror ? 0 : 2 * last == nx ? 1 - last : -last;
  std::vector<double> densities(static_cast<std::size_t>(last - first + 1));
  const double qy = static_cast<double>(j) * carried.step_y();
  carried.spectrum().density_row(first, carried.step_x(), qy, densities);
  const double mode_area = carried.step_x() * carried.step_y();
  for (Index i = first; i <= last; ++i)
    if (i != 0 || j != 0)
      visit(static_cast<double>(i) * carried.step_x(), qy,
            densities[static_cast<std::size_t>(i - first)] * mode_area,
            !(mirror && carried.own_conjugate(i)));
}

/// The random part of an amplitude: the whole complex number, or only its phase.
enum class Chance { gaussian_amplitude, phase };

/// Random amplitudes a(i, j) of one surface, the Fourier coefficients of a real field h(x) = Σ a(q)
/// e^{iq·x} over the wave vectors q.
class RandomModes {
 public:
  RandomModes(const CarriedModes& carried, std::uint64_t seed, Chance chance)
      : carried_(carried), seed_(seed), chance_(chance) {}

  /// Sets column[i mod nx] = a(i, j) for all i, including amplitudes of zero; 0 <= j <= j_max.
  /// `column` has nx elements.
  void column(Index j, std::span<std::complex<double>> column) const;

 private:
  void draw(Index i, Index j, std::span<std::complex<double>> factors) const;
  double real_factor(Index i, Index j) const;

  const CarriedModes& carried_;
  std::uint64_t seed_;
  Chance chance_;
};

}  // namespace salebra::detail
