// SPDX-License-Identifier: GPL-3.0-or-later
// Random surface scaled to an exact RMS height or RMS slope.
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

namespace salebra {
namespace {

double sum_of(const Field& heights, double (*term)(double height, double mean), double mean) {
  return parallel::sum_blocks(heights.rows(), [&](Index begin, Index end) {
    double sum = 0;
    for (Index ix = begin; ix < end; ++ix)
      for (Index iy = 0; iy < heights.cols(); ++iy) sum += term(heights(ix, iy), mean);
    return sum;
  });
}

// √Σ|q|²|a|² over the whole spectrum; a Nyquist mode has |q| = π/dx.
double rms_slope_of(const Surface& surface) {
  const Grid2D& grid = surface.grid;
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(surface.heights.data(), modes.data());
  const double step_x = 2 * std::numbers::pi / grid.lx, step_y = 2 * std::numbers::pi / grid.ly;
  const double sum = parallel::sum_blocks(grid.nx, [&](Index begin, Index end) {
    double of_rows = 0;
    for (Index row = begin; row < end; ++row) {
      const double qx = step_x * static_cast<double>(2 * row > grid.nx ? row - grid.nx : row);
      for (Index j = 0; j < fft.modes_y(); ++j) {
        const double qy = step_y * static_cast<double>(j);
        const double twins = j == 0 || 2 * j == grid.ny ? 1 : 2;
        of_rows += twins * (qx * qx + qy * qy) *
                   std::norm(modes[static_cast<std::size_t>(row * fft.modes_y() + j)]);
      }
    }
    return of_rows;
  });
  return std::sqrt(sum) / static_cast<double>(grid.points());
}

}  // namespace

Surface scale_to_rms(Surface surface, Rms which, double target) {
  require_positive(target, which == Rms::height ? "rms_height" : "rms_slope");
  surface.require_complete("scaling to an rms value");
  const auto points = static_cast<double>(surface.grid.points());
  const double mean = sum_of(
                          surface.heights, [](double h, double) { return h; }, 0) /
                      points;
  double present = 0;
  if (which == Rms::height) {
    const auto square = [](double h, double middle) { return (h - middle) * (h - middle); };
    present = std::sqrt(sum_of(surface.heights, square, mean) / points);
  } else {
    require(surface.periodic, "surface", "not periodic",
            "and has no rms slope by Fourier differentiation; scale its rms height");
    present = rms_slope_of(surface);
  }
  require(present > 0, "surface", "flat", "and cannot be scaled to an rms value");
  const double factor = target / present;
  parallel::for_slabs(surface.grid.nx, [&](Index begin, Index end) {
    auto rows = surface.heights.middleRows(begin, end - begin);
    rows = (rows - mean) * factor;
  });
  return surface;
}

Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Rms which,
                  const Progress& progress) {
  const SpectralMoments moments = spectrum.moments();
  Surface surface = scale_to_rms(random_phase(grid, spectrum, seed, progress), which,
                                 which == Rms::height ? moments.rms_height() : moments.rms_slope());
  if (progress && !progress({.stage = "surface", .fraction = 1}))
    throw Interrupted("surface: interrupted");
  surface.origin =
      (which == Rms::height ? "exact rms height, " : "exact rms slope, ") + surface.origin;
  return surface;
}

}  // namespace salebra
