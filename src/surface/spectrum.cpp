// SPDX-License-Identifier: GPL-3.0-or-later
// Power spectral density of a surface with windows: two-dimensional, radial, and of profiles.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/fft.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>

#include "ring_means.hpp"
#include "spectrum_lattice.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

Window chosen(Window window, const Surface& surface) {
  if (window != Window::automatic) return window;
  return surface.periodic ? Window::none : Window::hann;
}

/// Weights along one axis, normalised to ⟨w²⟩ = 1.
Eigen::ArrayXd profile_weights(Window window, Index points) {
  if (window == Window::none) return Eigen::ArrayXd::Ones(points);
  const auto place = Eigen::ArrayXd::LinSpaced(points, 0.5, static_cast<double>(points) - 0.5);
  const Eigen::ArrayXd turn = 2 * pi / static_cast<double>(points) * place;
  const Eigen::ArrayXd weights = window == Window::blackman
                                     ? (0.42 - 0.5 * turn.cos() + 0.08 * (2 * turn).cos()).eval()
                                     : (0.5 * (1 - turn.cos())).eval();
  return weights / std::sqrt(weights.square().mean());
}

/// Weights of all points, normalised to ⟨w²⟩ = 1.
Field surface_weights(Window window, const Grid2D& grid) {
  if (window != Window::radial_hann)
    return (profile_weights(window, grid.nx).matrix() *
            profile_weights(window, grid.ny).matrix().transpose())
        .array();
  Field weights(grid.nx, grid.ny);
  const double radius = std::min(grid.lx, grid.ly) / 2;
  for (Index ix = 0; ix < grid.nx; ++ix) {
    const double x = static_cast<double>(ix - grid.nx / 2) * grid.dx();
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double r = std::hypot(x, static_cast<double>(iy - grid.ny / 2) * grid.dy());
      weights(ix, iy) = r > radius ? 0 : 0.5 * (1 + std::cos(pi * r / radius));
    }
  }
  return weights / std::sqrt(weights.square().mean());
}

}  // namespace

double PowerSpectrum::wavenumber_x(Index i) const {
  return detail::wavenumber(i, grid.nx, grid.lx);
}
double PowerSpectrum::wavenumber_y(Index j) const {
  return detail::wavenumber(j, grid.ny, grid.ly);
}
double PowerSpectrum::multiplicity(Index j) const { return detail::multiplicity(j, grid.ny); }
double PowerSpectrum::cell() const { return 4 * pi * pi / grid.area(); }

double ProfilePsd::step() const { return 2 * pi / length; }

PowerSpectrum power_spectrum(const Surface& surface, Window window) {
  surface.require_complete("a power spectrum");
  const Grid2D& grid = surface.grid;
  // The heights less their mean, half as many complex modes, and the density of half of them again.
  require_memory(grid, 20 * static_cast<double>(grid.points()), "a power spectrum");
  window = chosen(window, surface);
  PowerSpectrum spectrum{grid, {}, window != Window::none};
  Field heights = surface.heights - height_statistics(surface).mean;
  if (spectrum.windowed) {
    const Field weights = surface_weights(window, grid);
    heights -= (weights * heights).sum() / weights.sum();
    heights *= weights;
    spectrum.correlated_modes = weights.square().square().mean();
  }
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(heights.data(), modes.data());

  spectrum.psd.resize(grid.nx, fft.modes_y());
  const double points = static_cast<double>(grid.points());
  const double scale = 1 / (points * points * spectrum.cell());
  for (Index k = 0; k < spectrum.psd.size(); ++k)
    spectrum.psd.data()[k] = scale * std::norm(modes[static_cast<std::size_t>(k)]);
  // What rounding left of the mean.
  spectrum.psd(0, 0) = 0;
  return spectrum;
}

ProfilePsd profile_psd(const Surface& surface, Axis axis, Window window) {
  surface.require_complete("a power spectrum");
  const Grid2D& grid = surface.grid;
  const bool along_x = axis == Axis::x;
  const Index n = along_x ? grid.nx : grid.ny;
  ProfilePsd psd;
  psd.profiles = along_x ? grid.ny : grid.nx;
  psd.length = along_x ? grid.lx : grid.ly;
  const Eigen::ArrayXd weights = profile_weights(chosen(window, surface), n);
  RealFft2D<double> fft(1, n);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(fft.modes_y()));
  Eigen::ArrayXd power = Eigen::ArrayXd::Zero(fft.modes_y());
  for (Index line = 0; line < psd.profiles; ++line) {
    Eigen::ArrayXd heights =
        along_x ? surface.heights.col(line).eval() : surface.heights.row(line).transpose().eval();
    heights -= (weights * heights).sum() / weights.sum();
    heights *= weights;
    fft.forward(heights.data(), modes.data());
    for (Index k = 0; k < power.size(); ++k)
      power(k) += std::norm(modes[static_cast<std::size_t>(k)]);
  }
  const double points = static_cast<double>(n);
  const double scale = 1 / (points * points * psd.step() * static_cast<double>(psd.profiles));
  for (Index k = 1; k < power.size(); ++k) {
    psd.wavenumber.push_back(static_cast<double>(k) * psd.step());
    psd.psd.push_back(scale * power(k));
    psd.modes.push_back(psd.profiles * static_cast<Index>(detail::multiplicity(k, n)));
  }
  return psd;
}

RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave) {
  const Grid2D& grid = spectrum.grid;
  detail::RingMeans<1> rings(2 * pi / std::max(grid.lx, grid.ly), bins_per_octave);
  for (Index i = 0; i < grid.nx; ++i) {
    for (Index j = 0; j < spectrum.psd.cols(); ++j) {
      if (i == 0 && j == 0) continue;
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      rings.add(q, spectrum.multiplicity(j), {spectrum.psd(i, j)});
    }
  }
  RadialSpectrum radial;
  for (const auto& ring : rings.rings()) {
    radial.wavenumber.push_back(ring.radius);
    radial.psd.push_back(ring.mean[0]);
    radial.modes.push_back(static_cast<Index>(ring.weight));
  }
  return radial;
}

}  // namespace salebra
