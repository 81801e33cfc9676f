// SPDX-License-Identifier: GPL-3.0-or-later
// Random surface scaled to an exact RMS height or RMS slope.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "base/convolution.hpp"
#include "base/memory.hpp"

namespace salebra {
namespace {

double mean_of(const Surface& surface, double (*term)(double height, double mean), double mean) {
  const Field& heights = surface.heights;
  const double sum = parallel::sum_blocks(surface.partition(), [&](Index begin, Index end) {
    double of_block = 0;
    for (Index ix = begin; ix < end; ++ix)
      for (Index iy = 0; iy < heights.cols(); ++iy) of_block += term(heights(ix, iy), mean);
    return of_block;
  });
  return sum / static_cast<double>(surface.grid.points());
}

// The rms slope √Σ|q|²|a|² over the modes a of the whole spectrum, computed as √⟨h·(−∇²h)⟩, a mean
// over the points; a mode at the Nyquist frequency of x has |q_x| = π/dx. The convolution that
// gives −∇²h can be distributed over processes and takes less memory than the spectrum.
double rms_slope_of(const Surface& surface, double mean) {
  const Grid2D& grid = surface.grid;
  const double step_x = 2 * std::numbers::pi / grid.lx, step_y = 2 * std::numbers::pi / grid.ly;
  std::optional<Convolution2D<double>> laplacian;
  LargeArray<std::byte> spectrum;
  std::vector<double> of_rows;
  collectively(surface.communicator, [&] {
    laplacian.emplace(Convolution2D<double>::Shape{grid.nx, grid.ny, grid.nx, grid.ny}, 1,
                      surface.partition());
    laplacian->set_symbol(0, 0, [=](Index i, Index j) {
      const double qx = step_x * static_cast<double>(i), qy = step_y * static_cast<double>(j);
      return qx * qx + qy * qy;
    });
    spectrum = large_array<std::byte>(laplacian->spectrum_bytes());
    laplacian->keep_spectrum_in(spectrum.get());
    of_rows.resize(static_cast<std::size_t>(surface.heights.rows()));
  });
  laplacian->apply(
      [&](int, Index row, double* buffer) -> const double* {
        for (Index iy = 0; iy < grid.ny; ++iy) buffer[iy] = surface.heights(row, iy) - mean;
        return buffer;
      },
      [&](int, Index row, const double* values) {
        double sum = 0;
        for (Index iy = 0; iy < grid.ny; ++iy)
          sum += (surface.heights(row, iy) - mean) * values[iy];
        of_rows[static_cast<std::size_t>(row)] = sum;
      });
  const double sum = parallel::sum_blocks(surface.partition(), [&](Index begin, Index end) {
    double of_block = 0;
    for (Index row = begin; row < end; ++row) of_block += of_rows[static_cast<std::size_t>(row)];
    return of_block;
  });
  return std::sqrt(sum / static_cast<double>(grid.points()));
}

Surface scaled(Surface surface, double mean, double present, double target) {
  require(present > 0, "surface", "flat", "and cannot be scaled to an rms value");
  const double factor = target / present;
  parallel::for_slabs(surface.heights.rows(), [&](Index begin, Index end) {
    auto rows = surface.heights.middleRows(begin, end - begin);
    rows = (rows - mean) * factor;
  });
  return surface;
}

}  // namespace

Surface scale_to_rms(Surface surface, Rms which, double target) {
  require_positive(target, which == Rms::height ? "rms_height" : "rms_slope");
  collectively(surface.communicator,
               [&] { surface.require_complete_rows("scaling to an rms value"); });
  const double mean = mean_of(surface, [](double h, double) { return h; }, 0);
  double present = 0;
  if (which == Rms::height) {
    const auto square = [](double h, double middle) { return (h - middle) * (h - middle); };
    present = std::sqrt(mean_of(surface, square, mean));
  } else {
    require(surface.periodic, "surface", "not periodic",
            "and has no rms slope by Fourier differentiation; scale its rms height");
    present = rms_slope_of(surface, mean);
  }
  return scaled(std::move(surface), mean, present, target);
}

Surface exact_rms(const Grid2D& grid, const Spectrum& spectrum, std::uint64_t seed, Rms which,
                  const Progress& progress, const Communicator& communicator) {
  const SpectralMoments moments = spectrum.moments();
  Surface surface = random_phase(grid, spectrum, seed, progress, communicator);
  const auto keep_going = [&] {
    return !progress || progress({.stage = "surface", .fraction = 1});
  };
  if (which == Rms::height) {
    surface = scale_to_rms(std::move(surface), which, moments.rms_height());
  } else {
    // A surface with only random phases has exactly the spectral moments of the grid's modes.
    const SpectralMoments lattice = spectrum.lattice_moments(
        grid, [&](const ProgressReport&) { return keep_going(); }, communicator);
    require_positive(moments.rms_slope(), "rms_slope");
    surface = scaled(std::move(surface), 0, lattice.rms_slope(), moments.rms_slope());
  }
  collectively(communicator, [&] {
    if (!keep_going()) throw Interrupted("surface: interrupted");
  });
  surface.origin =
      (which == Rms::height ? "exact rms height, " : "exact rms slope, ") + surface.origin;
  return surface;
}

}  // namespace salebra
