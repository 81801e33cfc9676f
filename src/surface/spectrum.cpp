// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>

#include "spectrum_lattice.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

Eigen::ArrayXd hann(Index points) {
  const auto place = Eigen::ArrayXd::LinSpaced(points, 0.5, static_cast<double>(points) - 0.5);
  return 0.5 * (1 - (2 * pi / static_cast<double>(points) * place).cos());
}

/// Multiplies by the window, normalised to ⟨w²⟩ = 1.
void fade_out(Field& heights) {
  const Eigen::ArrayXd along_x = hann(heights.rows()), along_y = hann(heights.cols());
  const double scale = 1 / std::sqrt(along_x.square().mean() * along_y.square().mean());
  const Eigen::ArrayXd rows = (heights.rowwise() * along_y.transpose()).rowwise().sum();
  const double mean = (along_x * rows).sum() / (along_x.sum() * along_y.sum());
  heights -= mean;
  heights.colwise() *= scale * along_x;
  heights.rowwise() *= along_y.transpose();
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

PowerSpectrum power_spectrum(const Surface& surface) {
  surface.require_complete("a power spectrum");
  const Grid2D& grid = surface.grid;
  Field heights = surface.heights;
  if (surface.periodic)
    heights -= height_statistics(surface).mean;
  else
    fade_out(heights);
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(heights.data(), modes.data());

  PowerSpectrum spectrum{grid, Field(grid.nx, fft.modes_y()), !surface.periodic};
  const double points = static_cast<double>(grid.points());
  const double scale = 1 / (points * points * spectrum.cell());
  for (Index k = 0; k < spectrum.density.size(); ++k)
    spectrum.density.data()[k] = scale * std::norm(modes[static_cast<std::size_t>(k)]);
  spectrum.density(0, 0) = 0;
  return spectrum;
}

RadialSpectrum radial_spectrum(const PowerSpectrum& spectrum, int bins_per_octave) {
  require(bins_per_octave >= 1, "bins_per_octave", bins_per_octave, "must be >= 1");
  const Grid2D& grid = spectrum.grid;
  const double longest = 2 * pi / std::max(grid.lx, grid.ly);
  struct Bin {
    double modes = 0, wavenumber = 0, density = 0;
  };
  std::vector<Bin> bins;
  for (Index i = 0; i < grid.nx; ++i) {
    for (Index j = 0; j < spectrum.density.cols(); ++j) {
      if (i == 0 && j == 0) continue;
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      // Half a bin below the longest wave: no mode but for rounding lies on a limit.
      const auto number = static_cast<std::size_t>(std::log2(q / longest) * bins_per_octave + 0.5);
      if (number >= bins.size()) bins.resize(number + 1);
      const double multiplicity = spectrum.multiplicity(j);
      bins[number].modes += multiplicity;
      bins[number].wavenumber += multiplicity * q;
      bins[number].density += multiplicity * spectrum.density(i, j);
    }
  }
  RadialSpectrum radial;
  for (const Bin& bin : bins) {
    if (bin.modes == 0) continue;
    radial.wavenumber.push_back(bin.wavenumber / bin.modes);
    radial.density.push_back(bin.density / bin.modes);
    radial.modes.push_back(static_cast<Index>(bin.modes));
  }
  return radial;
}

}  // namespace salebra
