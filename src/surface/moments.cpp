// SPDX-License-Identifier: GPL-3.0-or-later
// Height statistics and spectral moments of a surface, by spectrum and by finite differences.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/share.hpp>
#include <salebra/surface/axis.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

#include "shape.hpp"
#include "spectrum_lattice.hpp"

namespace salebra {
namespace {

/// Sum of term(height) over the defined heights of all processes.
template <class Term>
double sum_defined(const Surface& surface, const Term& term) {
  return parallel::sum_blocks(surface.share(), [&](Index begin, Index end) {
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

struct ProfileMoments {
  double second = 0, fourth = 0;
};

/// Σ q² |ĥ|² and Σ q⁴ |ĥ|² of the profiles along an axis, in the mean over all of them. By Parseval's theorem across the profiles that is
/// the sum over the spectrum of the surface, which would take twice the memory of the heights.
ProfileMoments profile_moments(const Surface& surface, Axis axis, double mean) {
  const Grid2D& grid = surface.grid;
  const bool along_x = axis == Axis::x;
  const Index n = along_x ? grid.nx : grid.ny, profiles = along_x ? grid.ny : grid.nx;
  const double length = along_x ? grid.lx : grid.ly;
  // Profiles of a block are copied together, which reads columns by lines of the cache.
  const Index size = parallel::block_rows(profiles);
  std::vector<ProfileMoments> blocks(static_cast<std::size_t>(parallel::block_count(profiles)));
  parallel::for_slabs(parallel::block_count(profiles), [&](Index begin, Index end) {
    RealFft2D<double> fft(1, n);
    std::vector<std::complex<double>> modes(static_cast<std::size_t>(fft.modes_y()));
    Field lines(size, n);
    for (Index block = begin; block < end; ++block) {
      ProfileMoments& sum = blocks[static_cast<std::size_t>(block)];
      const Index first = block * size, count = std::min(size, profiles - first);
      if (along_x)
        lines.topRows(count) = surface.heights.middleCols(first, count).transpose() - mean;
      else
        lines.topRows(count) = surface.heights.middleRows(first, count) - mean;
      for (Index line = 0; line < count; ++line) {
        fft.forward(lines.row(line).data(), modes.data());
        for (Index k = 1; k < fft.modes_y(); ++k) {
          const double q = detail::wavenumber(k, n, length);
          const double slope =
              detail::multiplicity(k, n) * q * q * std::norm(modes[static_cast<std::size_t>(k)]);
          sum.second += slope;
          sum.fourth += q * q * slope;
        }
      }
    }
  });
  const double scale = 1 / (static_cast<double>(n) * static_cast<double>(grid.points()));
  ProfileMoments total;
  for (const ProfileMoments& block : blocks) {
    total.second += block.second * scale;
    total.fourth += block.fourth * scale;
  }
  return total;
}

}  // namespace

HeightStatistics height_statistics(const Surface& surface) {
  collectively(surface.ranks, [&] { detail::require_shape_of_rows(surface); });
  HeightStatistics result;
  result.defined_points = static_cast<Index>(sum_defined(surface, [](double) { return 1.0; }));
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
  struct Range {
    double minimum = std::numeric_limits<double>::infinity(), maximum = -minimum;
    void add(const Range& other) {
      minimum = std::min(minimum, other.minimum);
      maximum = std::max(maximum, other.maximum);
    }
  };
  Range range;
  for (const Range& block :
       parallel::map_blocks<Range>(surface.share(), [&](Index begin, Index end) {
         Range found;
         for (Index k = begin * surface.grid.ny; k < end * surface.grid.ny; ++k)
           if (const double height = surface.heights.data()[k]; !std::isnan(height))
             found.add({height, height});
         return found;
       }))
    range.add(block);
  result.minimum = range.minimum;
  result.maximum = range.maximum;
  return result;
}

SpectralMoments spectral_moments(const Surface& surface) {
  surface.require_complete("spectral moments");
  require(surface.periodic, "surface", surface.origin.empty() ? "not periodic" : surface.origin,
          "is not periodic and has no spectral moments; use moments by finite differences");
  const HeightStatistics heights = height_statistics(surface);
  const ProfileMoments along_x = profile_moments(surface, Axis::x, heights.mean);
  const ProfileMoments along_y = profile_moments(surface, Axis::y, heights.mean);
  SpectralMoments moments;
  moments.moment0 = heights.rms_height * heights.rms_height;
  moments.moment2_x = along_x.second;
  moments.moment2_y = along_y.second;
  moments.moment4_x = along_x.fourth;
  moments.moment4_y = along_y.fourth;
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
