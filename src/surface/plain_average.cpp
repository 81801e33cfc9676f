// SPDX-License-Identifier: GPL-3.0-or-later
// Plain mean of the power spectra of the profiles of several scans.
#include <cmath>
#include <complex>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/plain_average.hpp>

#include "base/fft.hpp"
#include "base/memory.hpp"

namespace salebra {

using std::numbers::pi;

PlainSpectrum plain_spectrum(const Field& heights, const Grid2D& grid) {
  grid.validate();
  require(grid.nx >= 4, "grid", grid.nx, "points along x given; give 4 or more");
  require_that(heights.rows() == grid.nx && heights.cols() == grid.ny, "heights",
               "do not have the shape of the grid");
  require_that(heights.allFinite(), "heights", "have undefined points; fill or crop them");
  const Index nx = grid.nx, ny = grid.ny, columns = ny / 2 + 1;
  Field windowed = heights;
  for (Index i = 0; i < nx; ++i)
    windowed.row(i) *= std::sqrt(8.0 / 3) / 2 *
                       (1 - std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(nx)));
  RealFft2D<double> transform(nx, ny);
  const auto modes = large_array<std::complex<double>>(static_cast<std::size_t>(nx) *
                                                       static_cast<std::size_t>(columns));
  transform.forward(windowed.data(), modes.get());

  // By Parseval's theorem, a mean over profiles along x is a sum over the wave numbers q_y; real
  // heights have equal power at q_x and −q_x.
  const double scale = grid.dx() * grid.dx() / (2 * pi * grid.lx) / static_cast<double>(ny * ny);
  const Index last = nx / 2 - 1;
  const double step = 2 * pi / grid.lx;
  const double low = std::floor(std::log10(step)),
               high = std::ceil(std::log10(step * static_cast<double>(last)));
  constexpr double bins_per_decade = 10, margin = 0.01;
  const double bins = (high - low) * bins_per_decade,
               width = (high - low + 2 * margin) / bins;  // decades
  const Index first_bin = static_cast<Index>(low * bins_per_decade);
  PlainSpectrum spectrum;
  std::vector<double> waves;
  for (Index k = 1; k <= last; ++k) {
    double power = 0;
    for (const Index row : {k, nx - k})
      for (Index j = 0; j < columns; ++j)
        power += (j == 0 || 2 * j == ny ? 0.5 : 1) *
                 std::norm(modes[static_cast<std::size_t>(row * columns + j)]);
    const double q = step * static_cast<double>(k);
    // A wave number at a limit of two bins belongs to the lower bin.
    const auto bin =
        first_bin + static_cast<Index>(std::ceil((std::log10(q) - low + margin) / width)) - 1;
    if (spectrum.bin.empty() || spectrum.bin.back() != bin) {
      spectrum.bin.push_back(bin);
      spectrum.wavenumber.push_back(0);
      spectrum.psd.push_back(0);
      spectrum.scans.push_back(1);
      waves.push_back(0);
    }
    spectrum.wavenumber.back() += q;
    spectrum.psd.back() += scale * power;
    waves.back() += 1;
  }
  for (std::size_t at = 0; at < waves.size(); ++at) {
    spectrum.wavenumber[at] /= waves[at];
    spectrum.psd[at] /= waves[at];
  }
  return spectrum;
}

PlainSpectrum plain_average(const std::vector<PlainSpectrum>& scans) {
  require_that(!scans.empty(), "scans", "none given; give at least one");
  struct Sums {
    double wavenumber = 0, psd = 0;
    Index scans = 0;
  };
  std::map<Index, Sums> sums;
  for (const PlainSpectrum& scan : scans)
    for (std::size_t at = 0; at < scan.bin.size(); ++at) {
      Sums& sum = sums[scan.bin[at]];
      sum.wavenumber += scan.wavenumber[at];
      sum.psd += scan.psd[at];
      ++sum.scans;
    }
  PlainSpectrum mean;
  for (const auto& [bin, sum] : sums) {
    mean.bin.push_back(bin);
    mean.wavenumber.push_back(sum.wavenumber / static_cast<double>(sum.scans));
    mean.psd.push_back(sum.psd / static_cast<double>(sum.scans));
    mean.scans.push_back(sum.scans);
  }
  return mean;
}

}  // namespace salebra
