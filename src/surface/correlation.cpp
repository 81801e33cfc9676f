// SPDX-License-Identifier: GPL-3.0-or-later
// Autocorrelation map of a surface, its profiles along the axes and its radial mean.
#include <algorithm>
#include <cmath>
#include <complex>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>

#include "base/convolution.hpp"
#include "base/fft.hpp"
#include "base/memory.hpp"
#include "base/special_values.hpp"
#include "ring_means.hpp"

namespace salebra {
namespace {

using Modes = std::vector<std::complex<double>>;

using detail::unknown;

/// Sums over pairs of points at each distance vector, as circular correlations of a grid that is
/// padded where it is not periodic.
class PairSums {
 public:
  PairSums(Index nx, Index ny) : fft_(nx, ny), buffer_(nx, ny) {}

  Modes transform(const Field& values) {
    buffer_.setZero();
    buffer_.topLeftCorner(values.rows(), values.cols()) = values;
    Modes modes(static_cast<std::size_t>(fft_.nx() * fft_.modes_y()));
    fft_.forward(buffer_.data(), modes.data());
    return modes;
  }

  /// ½ Σ_x [a(x) b(x+r) + b(x) a(x+r)] for the vectors of a map of such a grid.
  Field correlate(const Modes& a, const Modes& b, const Grid2D& grid) {
    Modes product(a.size());
    std::ranges::transform(a, b, product.begin(), [](const auto& left, const auto& right) {
      return std::complex<double>(std::real(std::conj(left) * right), 0);
    });
    fft_.backward(product.data(), buffer_.data());
    const double scale = 1 / static_cast<double>(fft_.nx() * fft_.ny());
    const Index origin = grid.nx / 2;
    Field sums(2 * origin + 1, grid.ny / 2 + 1);
    for (Index row = 0; row < sums.rows(); ++row) {
      const Index lag = row - origin;
      sums.row(row) = scale * buffer_.row((lag + fft_.nx()) % fft_.nx()).head(sums.cols());
    }
    return sums;
  }

 private:
  RealFft2D<double> fft_;
  Field buffer_;
};

Index padded(Index n, bool periodic) { return periodic ? n : fast_transform_size(n + n / 2); }

}  // namespace

CorrelationMap correlation_map(const Surface& surface) {
  surface.require_whole("a correlation map");
  const double mean = height_statistics(surface).mean;
  const Grid2D& grid = surface.grid;
  // Two fields of the grid, and two sets of complex modes of its pairs, which are four times as
  // many where it is not periodic.
  require_memory(grid, (surface.periodic ? 32 : 80) * static_cast<double>(grid.points()),
                 "a correlation map");
  PairSums sums(padded(grid.nx, surface.periodic), padded(grid.ny, surface.periodic));
  const Field defined =
      surface.heights.unaryExpr([](double height) { return std::isnan(height) ? 0.0 : 1.0; });
  const Field heights = surface.heights.unaryExpr(
      [&](double height) { return std::isnan(height) ? 0.0 : height - mean; });
  const Modes height_modes = sums.transform(heights);

  CorrelationMap map{grid, sums.correlate(height_modes, height_modes, grid), {}, {}};
  if (surface.periodic && surface.undefined_points() == 0) {
    map.pairs = Field::Constant(map.autocorrelation.rows(), map.autocorrelation.cols(),
                                static_cast<double>(grid.points()));
    map.autocorrelation /= map.pairs;
    map.structure = 2 * (map.autocorrelation(map.origin(), 0) - map.autocorrelation);
  } else {
    const Modes defined_modes = sums.transform(defined);
    map.pairs = sums.correlate(defined_modes, defined_modes, grid).round();
    const Field squares = sums.correlate(defined_modes, sums.transform(heights.square()), grid);
    map.structure = 2 * (squares - map.autocorrelation);
    map.structure = (map.pairs > 0).select(map.structure / map.pairs, unknown);
    map.autocorrelation = (map.pairs > 0).select(map.autocorrelation / map.pairs, unknown);
  }
  // Rounding leaves a trace of either sign where there is nothing.
  map.structure = map.structure.isNaN().select(map.structure, map.structure.max(0.0));
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
  std::vector<double> sums(rings.size(), 0.0);
  for (Index row = 0; row < map.pairs.rows(); ++row) {
    for (Index column = 0; column < map.pairs.cols(); ++column) {
      const double pairs = map.pairs(row, column);
      const double distance = std::hypot(map.lag_x(row), map.lag_y(column));
      if (!(pairs > 0) || distance > longest * (1 + 1e-12)) continue;
      rings.add(distance, pairs, {map.autocorrelation(row, column), map.structure(row, column)},
                sums);
    }
  }
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
