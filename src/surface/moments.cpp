// SPDX-License-Identifier: GPL-3.0-or-later
// Height statistics and spectral moments of a surface, by spectrum and by finite differences.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/axis.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

#include "base/fft.hpp"
#include "base/memory.hpp"
#include "neighbour_rows.hpp"
#include "profiles.hpp"
#include "shape.hpp"
#include "spectrum_lattice.hpp"

namespace salebra {
namespace {

/// Calls add(sums, height) for the defined heights of all processes and returns the sums over them.
template <class Sums, class Add>
Sums sum_defined(const Surface& surface, const Add& add) {
  Sums total;
  for (const Sums& block :
       parallel::map_blocks<Sums>(surface.partition(), [&](Index begin, Index end) {
         Sums sums;
         for (Index k = begin * surface.grid.ny; k < end * surface.grid.ny; ++k)
           if (const double height = surface.heights.data()[k]; !std::isnan(height))
             add(sums, height);
         return sums;
       }))
    total.add(block);
  return total;
}

/// Sum of squares of the values of a finite-difference stencil, over all points where the stencil
/// has no undefined heights; an undefined height makes the value of its stencil NaN.
struct Squares {
  double sum = 0;
  Index count = 0;

  void add(double value) {
    if (std::isnan(value)) return;
    sum += value * value;
    ++count;
  }
  void add(const Squares& other) {
    sum += other.sum;
    count += other.count;
  }
  double mean_over(double unit) const {
    require(count > 0, "heights", "no stencil", "is free of undefined points; fill or crop them");
    return sum / static_cast<double>(count) / (unit * unit);
  }
};

/// Sums over the defined heights.
struct HeightSums {
  double sum = 0, minimum = std::numeric_limits<double>::infinity(), maximum = -minimum;
  Index count = 0;
  void add(const HeightSums& other) {
    sum += other.sum;
    minimum = std::min(minimum, other.minimum);
    maximum = std::max(maximum, other.maximum);
    count += other.count;
  }
  double mean() const {
    require(count > 0, "heights", "all points", "are undefined, so there is nothing to measure");
    const double mean = sum / static_cast<double>(count);
    require(std::isfinite(mean), "heights", "infinity", "cannot be averaged; correct it");
    return mean;
  }
};

HeightSums sums_of_heights(const Surface& surface) {
  collectively(surface.communicator, [&] { detail::require_shape_of_rows(surface); });
  return sum_defined<HeightSums>(
      surface, [](HeightSums& sums, double height) { sums.add({height, height, height, 1}); });
}

struct ProfileMoments {
  double zeroth = 0;  // mean of Σ |h|²; along y only
  double second = 0, fourth = 0;
};

/// Means over all profiles along an axis of Σ |h|², Σ q² |ĥ|² and Σ q⁴ |ĥ|², with the modes ĥ of a
/// profile at the wave numbers q. By Parseval's theorem for the direction across the profiles, they
/// equal sums over the two-dimensional spectrum, which would take as much memory as the heights.
ProfileMoments profile_moments(const Surface& surface, Axis axis, double mean) {
  const Grid2D& grid = surface.grid;
  const bool along_x = axis == Axis::x;
  const Index n = along_x ? grid.nx : grid.ny;
  const double length = along_x ? grid.lx : grid.ly;
  RealFft2D<double> fft(1, n);
  // For each mode of a profile, the weight of its power in the second moment, and q² times this
  // weight for the fourth moment.
  const auto count = static_cast<std::size_t>(fft.modes_y());
  std::vector<double> weights(count), squares(count);
  for (std::size_t k = 0; k < count; ++k) {
    const double q = detail::wavenumber(static_cast<Index>(k), n, length);
    weights[k] = detail::multiplicity(static_cast<Index>(k), n) * q * q;
    squares[k] = q * q;
  }
  const std::vector<ProfileMoments> blocks = detail::map_profiles(
      surface, axis, ProfileMoments{}, [&](ProfileMoments& sum, std::span<double> heights) {
        Eigen::Map<Eigen::ArrayXd> profile(heights.data(), static_cast<Index>(heights.size()));
        profile -= mean;
        if (!along_x) sum.zeroth += profile.square().sum();
        const auto modes = large_array<std::complex<double>>(count);
        fft.forward(heights.data(), modes.get());
        for (std::size_t k = 1; k < count; ++k) {
          const double slope = weights[k] * std::norm(modes[k]);
          sum.second += slope;
          sum.fourth += squares[k] * slope;
        }
      });
  const double scale = 1 / (static_cast<double>(n) * static_cast<double>(grid.points()));
  ProfileMoments total;
  for (const ProfileMoments& block :
       parallel::gather_blocks(detail::profiles_of(surface, axis), blocks)) {
    total.zeroth += block.zeroth;
    total.second += block.second * scale;
    total.fourth += block.fourth * scale;
  }
  total.zeroth /= static_cast<double>(grid.points());
  return total;
}

}  // namespace

HeightStatistics height_statistics(const Surface& surface) {
  const HeightSums range = sums_of_heights(surface);
  HeightStatistics result;
  result.defined_points = range.count;
  result.mean = range.mean();
  const double count = static_cast<double>(range.count);
  struct Powers {
    double second = 0, third = 0, fourth = 0;
    void add(const Powers& other) {
      second += other.second;
      third += other.third;
      fourth += other.fourth;
    }
  };
  const auto powers = sum_defined<Powers>(surface, [&](Powers& sums, double height) {
    const double z = height - result.mean;
    sums.add({z * z, z * z * z, z * z * z * z});
  });
  const double second = powers.second / count;
  result.rms_height = std::sqrt(second);
  result.skewness = powers.third / count / (second * result.rms_height);
  result.kurtosis = powers.fourth / count / (second * second);
  result.minimum = range.minimum;
  result.maximum = range.maximum;
  return result;
}

SpectralMoments spectral_moments(const Surface& surface) {
  const HeightSums range = sums_of_heights(surface);
  const bool complete = range.count == surface.grid.points() && std::isfinite(range.sum);
  if (!complete)
    collectively(surface.communicator, [&] { surface.require_complete_rows("spectral moments"); });
  require(surface.periodic, "surface", surface.origin.empty() ? "not periodic" : surface.origin,
          "is not periodic, so it has no spectral moments; use moments by finite differences");
  const ProfileMoments along_x = profile_moments(surface, Axis::x, range.mean());
  const ProfileMoments along_y = profile_moments(surface, Axis::y, range.mean());
  SpectralMoments moments;
  moments.moment0 = along_y.zeroth;
  moments.moment2_x = along_x.second;
  moments.moment2_y = along_y.second;
  moments.moment4_x = along_x.fourth;
  moments.moment4_y = along_y.fourth;
  return moments;
}

SpectralMoments difference_moments(const Surface& surface) {
  collectively(surface.communicator, [&] { detail::require_shape_of_rows(surface); });
  const Grid2D& grid = surface.grid;
  require(grid.nx >= 3, "nx", grid.nx, "must be >= 3 for second differences");
  require(grid.ny >= 3, "ny", grid.ny, "must be >= 3 for second differences");
  struct Sums {
    Squares slope_x, slope_y, curvature_x, curvature_y;
  };
  const detail::NeighbourRows rows(surface);
  Sums total;
  for (const Sums& block :
       parallel::map_blocks<Sums>(surface.partition(), [&](Index begin, Index end) {
         Sums sums;
         for (Index ix = begin; ix < end; ++ix) {
           const double *left = rows[ix - 1], *here = rows[ix], *right = rows[ix + 1];
           for (Index iy = 0; iy < grid.ny; ++iy) {
             const Index up = iy + 1 < grid.ny ? iy + 1 : 0, down = iy > 0 ? iy - 1 : grid.ny - 1;
             const bool has_up = surface.periodic || iy + 1 < grid.ny;
             const bool has_down = surface.periodic || iy > 0;
             const double height = here[iy];
             if (right && has_up) {
               const double along_x = right[iy] - height, along_y = here[up] - height;
               if (!std::isnan(along_x + along_y)) {
                 sums.slope_x.add(along_x);
                 sums.slope_y.add(along_y);
               }
             }
             if (right && left) sums.curvature_x.add((right[iy] - height) - (height - left[iy]));
             if (has_up && has_down)
               sums.curvature_y.add((here[up] - height) - (height - here[down]));
           }
         }
         return sums;
       })) {
    total.slope_x.add(block.slope_x);
    total.slope_y.add(block.slope_y);
    total.curvature_x.add(block.curvature_x);
    total.curvature_y.add(block.curvature_y);
  }
  const double rms_height = height_statistics(surface).rms_height;
  SpectralMoments moments;
  moments.moment0 = rms_height * rms_height;
  moments.moment2_x = total.slope_x.mean_over(grid.dx());
  moments.moment2_y = total.slope_y.mean_over(grid.dy());
  moments.moment4_x = total.curvature_x.mean_over(grid.dx() * grid.dx());
  moments.moment4_y = total.curvature_y.mean_over(grid.dy() * grid.dy());
  return moments;
}

SpectralMoments surface_moments(const Surface& surface) {
  return surface.periodic ? spectral_moments(surface) : difference_moments(surface);
}

}  // namespace salebra
