// SPDX-License-Identifier: GPL-3.0-or-later
// Autocorrelation map of a surface, its profiles along the axes and its radial mean.
#include <algorithm>
#include <cmath>
#include <complex>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>

#include "base/column_fft.hpp"
#include "base/convolution.hpp"
#include "base/memory.hpp"
#include "base/special_values.hpp"
#include "ring_means.hpp"

namespace salebra {
namespace {

using PairModes = LargeArray<std::complex<double>>;

using detail::unknown;

/// Sums over pairs of points at each distance vector, as circular correlations on a grid padded
/// with zeros along axes that are not periodic.
class PairSums {
 public:
  PairSums(Index nx, Index ny) : nx_(nx), ny_(ny) {}

  /// Fourier transform of value(height) for all points, stored column by column.
  template <class Value>
  PairModes transform(const Field& heights, const Value& value) const {
    const Index columns = ny_ / 2 + 1;
    PairModes modes = large_array<std::complex<double>>(static_cast<std::size_t>(nx_ * columns));
    forward_by_columns(
        nx_, ny_,
        [&](Index row, std::span<double> to) {
          const Index count = row < heights.rows() ? heights.cols() : 0;
          const double* from = heights.data() + row * count;
          std::fill(std::transform(from, from + count, to.begin(), value), to.end(), 0.0);
        },
        [&](Index j, std::span<std::complex<double>> column) {
          std::ranges::copy(column, modes.get() + j * nx_);
        },
        RowPartition(nx_), RowPartition(columns));
    return modes;
  }

  /// ½ Σ_x [a(x) b(x+r) + b(x) a(x+r)] over the points x, for all distance vectors r of a map of
  /// the grid.
  Field correlate(const PairModes& a, const PairModes& b, const Grid2D& grid) const {
    const Field buffer = backward_by_columns(
        nx_, ny_, ny_ / 2 + 1, [&](Index j, std::span<std::complex<double>> column) {
          const std::complex<double>*of_a = a.get() + j * nx_, *of_b = b.get() + j * nx_;
          for (std::size_t i = 0; i < column.size(); ++i)
            column[i] = of_a[i].real() * of_b[i].real() + of_a[i].imag() * of_b[i].imag();
        });
    const double scale = 1 / static_cast<double>(nx_ * ny_);
    const Index origin = grid.nx / 2;
    Field sums = uninitialised_field(2 * origin + 1, grid.ny / 2 + 1);
    parallel::for_slabs(sums.rows(), [&](Index begin, Index end) {
      for (Index row = begin; row < end; ++row) {
        const Index lag = row - origin;
        sums.row(row) = scale * buffer.row((lag + nx_) % nx_).head(sums.cols());
      }
    });
    return sums;
  }

 private:
  Index nx_, ny_;
};

Index padded(Index n, bool periodic) { return periodic ? n : fast_transform_size(n + n / 2); }

}  // namespace

CorrelationMap correlation_map(const Surface& surface) {
  surface.require_whole("a correlation map");
  const double mean = height_statistics(surface).mean;
  const Grid2D& grid = surface.grid;
  // Memory: two fields of the grid, and two sets of complex modes on the padded grid, which has
  // four times as many points as the grid if the surface is not periodic.
  require_memory(grid, (surface.periodic ? 32 : 80) * static_cast<double>(grid.points()),
                 "a correlation map");
  const PairSums sums(padded(grid.nx, surface.periodic), padded(grid.ny, surface.periodic));
  const PairModes height_modes = sums.transform(
      surface.heights, [&](double height) { return std::isnan(height) ? 0.0 : height - mean; });
  CorrelationMap map{grid, sums.correlate(height_modes, height_modes, grid), {}, {}};
  Field& correlation = map.autocorrelation;
  map.structure = uninitialised_field(correlation.rows(), correlation.cols());
  const bool all_alike = surface.periodic && surface.undefined_points() == 0;
  Field squares;
  if (all_alike) {
    map.pairs = uninitialised_field(correlation.rows(), correlation.cols());
  } else {
    const PairModes defined = sums.transform(
        surface.heights, [](double height) { return std::isnan(height) ? 0.0 : 1.0; });
    map.pairs = sums.correlate(defined, defined, grid).round();
    squares = sums.correlate(
        defined,
        sums.transform(surface.heights,
                       [&](double height) {
                         return std::isnan(height) ? 0.0 : (height - mean) * (height - mean);
                       }),
        grid);
  }
  const double variance = correlation(map.origin(), 0) / static_cast<double>(grid.points());
  parallel::for_slabs(correlation.rows(), [&](Index begin, Index end) {
    for (Index row = begin; row < end; ++row) {
      auto of_row = correlation.row(row), structure = map.structure.row(row),
           pairs = map.pairs.row(row);
      if (all_alike) {
        pairs.setConstant(static_cast<double>(grid.points()));
        of_row /= pairs;
        structure = 2 * (variance - of_row);
      } else {
        structure = (pairs > 0).select(2 * (squares.row(row) - of_row) / pairs, unknown);
        of_row = (pairs > 0).select(of_row / pairs, unknown);
      }
      // Where the structure function is zero, rounding leaves a small positive or negative number.
      structure = structure.isNaN().select(structure, structure.max(0.0));
    }
  });
  map.structure(map.origin(), 0) = 0;
  return map;
}

Correlation profile_correlation(const CorrelationMap& map, Axis axis) {
  const bool along_x = axis == Axis::x;
  const Index lags = along_x ? map.grid.nx / 2 : map.grid.ny / 2;
  const double step = along_x ? map.grid.dx() : map.grid.dy();
  Correlation result;
  for (Index lag = 0; lag <= lags; ++lag) {
    const Index row = map.origin() + (along_x ? lag : 0), column = along_x ? 0 : lag;
    if (!(map.pairs(row, column) > 0)) continue;
    result.distance.push_back(static_cast<double>(lag) * step);
    result.autocorrelation.push_back(map.autocorrelation(row, column));
    result.structure.push_back(map.structure(row, column));
    result.pairs.push_back(map.pairs(row, column));
  }
  return result;
}

Correlation radial_correlation(const CorrelationMap& map, int bins_per_octave) {
  const double longest = std::min(map.grid.lx, map.grid.ly) / 2;
  const detail::RingMeans<2> rings(std::min(map.grid.dx(), map.grid.dy()), longest,
                                   bins_per_octave);
  const std::vector<double> sums = parallel::sum_blocks(
      RowPartition(map.pairs.rows()), rings.size(),
      [&](Index begin, Index end, std::span<double> of_block) {
        for (Index row = begin; row < end; ++row) {
          std::size_t ring = 0;
          for (Index column = 0; column < map.pairs.cols(); ++column) {
            const double pairs = map.pairs(row, column);
            const double distance = detail::length_of(map.lag_x(row), map.lag_y(column));
            if (!(pairs > 0) || distance > longest * (1 + 1e-12)) continue;
            rings.add(distance, pairs,
                      {map.autocorrelation(row, column), map.structure(row, column)}, of_block,
                      ring);
          }
        }
      });
  Correlation radial;
  for (const auto& ring : rings.rings(sums)) {
    radial.distance.push_back(ring.radius);
    radial.autocorrelation.push_back(ring.mean[0]);
    radial.structure.push_back(ring.mean[1]);
    radial.pairs.push_back(ring.weight);
  }
  return radial;
}

}  // namespace salebra
