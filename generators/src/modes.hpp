// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <complex>
#include <cstdint>
#include <salebra/generators/spectrum.hpp>
#include <span>
#include <vector>

namespace salebra::detail {

/// Which modes of a grid a spectrum can fill: a half-plane 0 <= j <= j_max, the other half being
/// conjugate, and in its column j the waves |i| <= i_max(j). The pair ±nx/2 is one mode of the
/// grid; +nx/2 names it.
class CarriedModes {
 public:
  /// Both arguments must outlive the object. Throws as Spectrum::require_carried_by.
  CarriedModes(const Grid2D& grid, const Spectrum& spectrum);

  Index j_max() const { return j_max_; }
  Index i_max(Index j) const;
  /// Columns that are their own mirror image: (i, j) and (−i, j) are conjugates.
  bool own_mirror(Index j) const { return j == 0 || 2 * j == grid_->ny; }
  /// Waves that are their own conjugate, in a column that is its own mirror image.
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
      // |q|, with an allowance for rounding; the density decides about waves on the limit
      highest_;
  Index j_max_;
};

/// visit(qx, qy, power, pair) for the modes of column j without the zero mode, one of each pair of
/// conjugates: the mean power of the mode, and whether it has a conjugate.
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

/// What chance decides: the whole complex amplitude, or its phase alone.
enum class Chance { gaussian_amplitude, phase };

/// Amplitudes a(i, j) of one surface, Fourier coefficients of a real field: h(x) = Σ a(q) e^{iq·x}.
class RandomModes {
 public:
  RandomModes(const CarriedModes& carried, std::uint64_t seed, Chance chance)
      : carried_(carried), seed_(seed), chance_(chance) {}

  /// column[i mod nx] = a(i, j) for all i, zeros included; 0 <= j <= j_max, nx entries.
  void column(Index j, std::span<std::complex<double>> column) const;

 private:
  void draw(Index i, Index j, std::span<std::complex<double>> factors) const;
  double real_factor(Index i, Index j) const;

  const CarriedModes& carried_;
  std::uint64_t seed_;
  Chance chance_;
};

}  // namespace salebra::detail
