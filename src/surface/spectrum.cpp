// SPDX-License-Identifier: GPL-3.0-or-later
// Power spectral density with windows: two-dimensional, radial, and of profiles.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>

#include "base/column_fft.hpp"
#include "base/fft.hpp"
#include "base/memory.hpp"
#include "profiles.hpp"
#include "ring_means.hpp"
#include "spectrum_lattice.hpp"
#include "surface/asymmetry.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

Window chosen(Window window, const Surface& surface) {
  if (window != Window::automatic) return window;
  return surface.periodic ? Window::none : Window::hann;
}

/// Weights w of a window along one axis, normalised to a mean of w² of 1.
Eigen::ArrayXd profile_weights(Window window, Index points) {
  if (window == Window::none) return Eigen::ArrayXd::Ones(points);
  const auto index = Eigen::ArrayXd::LinSpaced(points, 0.5, static_cast<double>(points) - 0.5);
  const Eigen::ArrayXd turn = 2 * pi / static_cast<double>(points) * index;
  const Eigen::ArrayXd weights = window == Window::blackman
                                     ? (0.42 - 0.5 * turn.cos() + 0.08 * (2 * turn).cos()).eval()
                                 : window == Window::welch ? (1 - (turn / pi - 1).square()).eval()
                                                           : (0.5 * (1 - turn.cos())).eval();
  return weights / std::sqrt(weights.square().mean());
}

/// Weights w of a window at all points of a surface, normalised to a mean of w² of 1.
class Weights {
 public:
  Weights(Window window, const Surface& surface)
      : grid_(surface.grid), rows_(surface.partition()), radial_(window == Window::radial_hann) {
    if (!radial_) {
      along_x_ = profile_weights(window, grid_.nx);
      along_y_ = profile_weights(window, grid_.ny);
      return;
    }
    const double sum =
        sum_rows([](const Eigen::ArrayXd& weights, Index) { return weights.square().sum(); });
    scale_ = 1 / std::sqrt(sum / static_cast<double>(grid_.points()));
  }

  /// The weights of a row of this process.
  Eigen::ArrayXd row(Index row) const {
    const Index ix = rows_.begin() + row;
    if (!radial_) return along_x_(ix) * along_y_;
    const double radius = std::min(grid_.lx, grid_.ly) / 2;
    const double x = static_cast<double>(ix - grid_.nx / 2) * grid_.dx();
    Eigen::ArrayXd weights(grid_.ny);
    for (Index iy = 0; iy < grid_.ny; ++iy) {
      const double r = std::hypot(x, static_cast<double>(iy - grid_.ny / 2) * grid_.dy());
      weights(iy) = r > radius ? 0 : scale_ * 0.5 * (1 + std::cos(pi * r / radius));
    }
    return weights;
  }

  /// Sum of term(weights of a row, index of the row in this process) over the rows of all
  /// processes.
  template <class Term>
  double sum_rows(const Term& term) const {
    return parallel::sum_blocks(rows_, [&](Index begin, Index end) {
      double sum = 0;
      for (Index k = begin; k < end; ++k) sum += term(row(k), k);
      return sum;
    });
  }

 private:
  Grid2D grid_;
  RowPartition rows_;
  bool radial_;
  double scale_ = 1;
  Eigen::ArrayXd along_x_, along_y_;
};

}  // namespace

double PowerSpectrum::wavenumber_x(Index i) const {
  return detail::wavenumber(i, grid.nx, grid.lx);
}
double PowerSpectrum::wavenumber_y(Index j) const {
  return detail::wavenumber(j, grid.ny, grid.ly);
}
std::vector<double> PowerSpectrum::wavenumbers_x() const {
  std::vector<double> all;
  for (Index i = 0; i < grid.nx; ++i) all.push_back(wavenumber_x(i));
  return all;
}
std::vector<double> PowerSpectrum::wavenumbers_y() const {
  std::vector<double> all;
  for (Index j = columns().begin(); j < columns().end(); ++j) all.push_back(wavenumber_y(j));
  return all;
}
double PowerSpectrum::multiplicity(Index j) const { return detail::multiplicity(j, grid.ny); }
double PowerSpectrum::cell() const { return 4 * pi * pi / grid.area(); }

double ProfilePsd::step() const { return 2 * pi / length; }

PowerSpectrum power_spectrum(const Surface& surface, Window window) {
  const Grid2D& grid = surface.grid;
  window = chosen(window, surface);
  PowerSpectrum spectrum{grid, {}, window != Window::none};
  spectrum.communicator = surface.communicator;
  const RowPartition columns = spectrum.columns();
  collectively(surface.communicator, [&] {
    surface.require_complete_rows("a power spectrum");
    // Bytes per point: 8 for the complex modes of the half-spectrum, 4 for the density, and 8 that
    // processes send and receive.
    require_memory(
        grid,
        (surface.communicator.alone() ? 12 : 20) * static_cast<double>(surface.heights.size()),
        "a power spectrum");
    spectrum.psd = uninitialised_field(grid.nx, columns.count());
  });
  if (!surface.periodic) spectrum.asymmetric_wavelength = detail::asymmetric_wavelength(surface);
  double offset = height_statistics(surface).mean;
  std::optional<Weights> weights;
  const auto heights = [&](Index row) { return surface.heights.row(row).transpose() - offset; };
  if (spectrum.windowed) {
    weights.emplace(window, surface);
    const double sum =
        weights->sum_rows([](const Eigen::ArrayXd& of_row, Index) { return of_row.sum(); });
    offset += weights->sum_rows([&](const Eigen::ArrayXd& of_row, Index row) {
      return (of_row * heights(row)).sum();
    }) / sum;
    spectrum.correlated_modes = weights->sum_rows([](const Eigen::ArrayXd& of_row, Index) {
      return of_row.square().square().sum();
    }) / static_cast<double>(grid.points());
  }
  const double points = static_cast<double>(grid.points());
  const double scale = 1 / (points * points * spectrum.cell());
  forward_by_columns(
      grid.nx, grid.ny,
      [&](Index row, std::span<double> values) {
        Eigen::Map<Eigen::ArrayXd> to(values.data(), grid.ny);
        to = heights(row);
        if (weights) to *= weights->row(row);
      },
      [&](Index j, std::span<std::complex<double>> column) {
        for (Index i = 0; i < grid.nx; ++i)
          spectrum.psd(i, j - columns.begin()) =
              scale * std::norm(column[static_cast<std::size_t>(i)]);
      },
      surface.partition(), columns);
  // The mean height is removed before the transform; set the mode of the mean, which holds its
  // rounding error, to 0.
  if (columns.begin() == 0 && columns.count() > 0) spectrum.psd(0, 0) = 0;
  return spectrum;
}

ProfilePsd profile_psd(const Surface& surface, Axis axis, Window window) {
  collectively(surface.communicator, [&] { surface.require_complete_rows("a power spectrum"); });
  const Grid2D& grid = surface.grid;
  const bool along_x = axis == Axis::x;
  const Index n = along_x ? grid.nx : grid.ny;
  ProfilePsd psd;
  psd.profiles = along_x ? grid.ny : grid.nx;
  psd.length = along_x ? grid.lx : grid.ly;
  const Eigen::ArrayXd weights = profile_weights(chosen(window, surface), n);
  const double sum_of_weights = weights.sum();
  RealFft2D<double> fft(1, n);
  const auto modes_of_profile = static_cast<std::size_t>(fft.modes_y());
  std::vector<double> sums;
  for (const auto& block :
       detail::map_profiles(surface, axis, std::vector<double>(modes_of_profile, 0.0),
                            [&](std::vector<double>& power, std::span<double> values) {
                              Eigen::Map<Eigen::ArrayXd> heights(values.data(), n);
                              heights -= (weights * heights).sum() / sum_of_weights;
                              heights *= weights;
                              std::vector<std::complex<double>> modes(modes_of_profile);
                              fft.forward(heights.data(), modes.data());
                              for (std::size_t k = 0; k < power.size(); ++k)
                                power[k] += std::norm(modes[k]);
                            }))
    sums.insert(sums.end(), block.begin(), block.end());
  const std::vector<double> power =
      parallel::add_blocks(detail::profiles_of(surface, axis), modes_of_profile, sums);
  const double points = static_cast<double>(n);
  const double scale = 1 / (points * points * psd.step() * static_cast<double>(psd.profiles));
  for (std::size_t k = 1; k < power.size(); ++k) {
    psd.wavenumber.push_back(static_cast<double>(k) * psd.step());
    psd.psd.push_back(scale * power[k]);
    psd.modes.push_back(psd.profiles *
                        static_cast<Index>(detail::multiplicity(static_cast<Index>(k), n)));
  }
  return psd;
}

RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave) {
  const Grid2D& grid = spectrum.grid;
  const detail::RingMeans<1> rings(2 * pi / std::max(grid.lx, grid.ly),
                                   std::hypot(pi / grid.dx(), pi / grid.dy()), bins_per_octave);
  const RowPartition columns = spectrum.columns();
  const std::vector<double> sums = parallel::sum_blocks(
      columns, rings.size(), [&](Index begin, Index end, std::span<double> of_block) {
        for (Index i = 0; i < grid.nx; ++i) {
          const double qx = spectrum.wavenumber_x(i);
          std::size_t ring = 0;
          for (Index k = begin; k < end; ++k) {
            const Index j = columns.begin() + k;
            if (i == 0 && j == 0) continue;
            const double q = detail::length_of(qx, spectrum.wavenumber_y(j));
            rings.add(q, spectrum.multiplicity(j), {spectrum.psd(i, k)}, of_block, ring);
          }
        }
      });
  RadialSpectrum radial;
  for (const auto& ring : rings.rings(sums)) {
    radial.wavenumber.push_back(ring.radius);
    radial.psd.push_back(ring.mean[0]);
    radial.modes.push_back(static_cast<Index>(ring.weight));
  }
  return radial;
}

}  // namespace salebra
