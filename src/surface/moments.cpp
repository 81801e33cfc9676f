// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

#include "shape.hpp"
#include "spectrum_lattice.hpp"

namespace salebra {
namespace {

/// Sum of term(height) over the defined heights.
template <class Term>
double sum_defined(const Surface& surface, const Term& term) {
  return parallel::sum_slabs(surface.grid.nx, [&](Index begin, Index end) {
    double sum = 0;
    for (Index ix = begin; ix < end; ++ix)
      for (Index iy = 0; iy < surface.grid.ny; ++iy)
        if (const double height = surface.heights(ix, iy); !std::isnan(height)) sum += term(height);
    return sum;
  });
}

/// Mean square over the stencils that touch no undefined point; a NaN of any of their points makes
/// the value NaN.
class MeanSquare {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    sum_ += value * value;
    ++count_;
  }
  double over(double unit) const {
    require(count_ > 0, "heights", "no stencil", "is free of undefined points; fill or crop them");
    return sum_ / static_cast<double>(count_) / (unit * unit);
  }

 private:
  double sum_ = 0;
  Index count_ = 0;
};

}  // namespace

HeightStatistics height_statistics(const Surface& surface) {
  detail::require_shape(surface);
  HeightStatistics result;
  result.defined_points = surface.grid.points() - surface.undefined_points();
  require(result.defined_points > 0, "heights", "all points",
          "are undefined; there is nothing to measure");
  const double count = static_cast<double>(result.defined_points);
  result.mean = sum_defined(surface, [](double height) { return height; }) / count;
  require(std::isfinite(result.mean), "heights", "infinity", "cannot be averaged; correct it");
  const auto central = [&](auto power) {
    return sum_defined(surface, [&](double height) { return power(height - result.mean); }) / count;
  };
  const double second = central([](double z) { return z * z; });
  result.rms_height = std::sqrt(second);
  result.skewness = central([](double z) { return z * z * z; }) / (second * result.rms_height);
  result.kurtosis = central([](double z) { return z * z * z * z; }) / (second * second);
  result.minimum = std::numeric_limits<double>::infinity();
  result.maximum = -result.minimum;
  for (const double height : surface.heights.reshaped<Eigen::RowMajor>()) {
    if (std::isnan(height)) continue;
    result.minimum = std::min(result.minimum, height);
    result.maximum = std::max(result.maximum, height);
  }
  return result;
}

SpectralMoments spectral_moments(const Surface& surface) {
  surface.require_complete("spectral moments");
  require(surface.periodic, "surface", surface.origin.empty() ? "not periodic" : surface.origin,
          "is not periodic and has no spectral moments; use moments by finite differences");
  const Grid2D& grid = surface.grid;
  const double mean = height_statistics(surface).mean;
  const Field fluctuation = surface.heights - mean;
  RealFft2D<double> fft(grid.nx, grid.ny);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(grid.nx * fft.modes_y()));
  fft.forward(fluctuation.data(), modes.data());

  const auto sum = [&](int power_x, int power_y) {
    const double total = parallel::sum_slabs(grid.nx, [&](Index begin, Index end) {
      double slab = 0;
      for (Index i = begin; i < end; ++i) {
        const double factor_x = std::pow(detail::wavenumber(i, grid.nx, grid.lx), power_x);
        for (Index j = 0; j < fft.modes_y(); ++j) {
          if (i == 0 && j == 0) continue;
          const double factor_y = std::pow(detail::wavenumber(j, grid.ny, grid.ly), power_y);
          slab += detail::multiplicity(j, grid.ny) * factor_x * factor_y *
                  std::norm(modes[static_cast<std::size_t>(i * fft.modes_y() + j)]);
        }
      }
      return slab;
    });
    const double points = static_cast<double>(grid.points());
    return total / (points * points);
  };
  SpectralMoments moments;
  moments.moment0 = sum(0, 0);
  moments.moment2_x = sum(2, 0);
  moments.moment2_y = sum(0, 2);
  moments.moment4_x = sum(4, 0);
  moments.moment4_y = sum(0, 4);
  return moments;
}

SpectralMoments difference_moments(const Surface& surface) {
  detail::require_shape(surface);
  const Grid2D& grid = surface.grid;
  require(grid.nx >= 3, "nx", grid.nx, "must be >= 3 for second differences");
  require(grid.ny >= 3, "ny", grid.ny, "must be >= 3 for second differences");
  MeanSquare slope_x, slope_y, curvature_x, curvature_y;
  const Field& heights = surface.heights;
  for (Index ix = 0; ix < grid.nx; ++ix) {
    const Index right = (ix + 1) % grid.nx, left = (ix + grid.nx - 1) % grid.nx;
    const bool has_right = surface.periodic || ix + 1 < grid.nx;
    const bool has_left = surface.periodic || ix > 0;
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const Index up = (iy + 1) % grid.ny, down = (iy + grid.ny - 1) % grid.ny;
      const bool has_up = surface.periodic || iy + 1 < grid.ny;
      const bool has_down = surface.periodic || iy > 0;
      const double height = heights(ix, iy);
      if (has_right && has_up) {
        const double along_x = heights(right, iy) - height, along_y = heights(ix, up) - height;
        if (!std::isnan(along_x + along_y)) {
          slope_x.add(along_x);
          slope_y.add(along_y);
        }
      }
      if (has_right && has_left)
        curvature_x.add((heights(right, iy) - height) - (height - heights(left, iy)));
      if (has_up && has_down)
        curvature_y.add((heights(ix, up) - height) - (height - heights(ix, down)));
    }
  }
  const double rms_height = height_statistics(surface).rms_height;
  SpectralMoments moments;
  moments.moment0 = rms_height * rms_height;
  moments.moment2_x = slope_x.over(grid.dx());
  moments.moment2_y = slope_y.over(grid.dy());
  moments.moment4_x = curvature_x.over(grid.dx() * grid.dx());
  moments.moment4_y = curvature_y.over(grid.dy() * grid.dy());
  return moments;
}

SpectralMoments surface_moments(const Surface& surface) {
  return surface.periodic ? spectral_moments(surface) : difference_moments(surface);
}

}  // namespace salebra
