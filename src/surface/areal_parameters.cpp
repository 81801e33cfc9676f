// SPDX-License-Identifier: GPL-3.0-or-later
// Areal texture parameters of ISO 25178-2.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/bearing.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/peaks.hpp>
#include <salebra/surface/spectrum.hpp>

#include "base/special_values.hpp"
#include "neighbour_rows.hpp"

namespace salebra {
namespace {

using std::numbers::pi;

using detail::unknown;
constexpr double correlation_level = 0.2;  ///< s of Sal and Str, default of ISO 25178
constexpr double pruning = 0.05;           ///< least prominence of peaks/Sz, by default
constexpr int directions = 720;            ///< number of directions in half a turn

/// Distance along a direction at which the autocorrelation first falls to the level, or up to which
/// it is known and stays above the level.
struct Fall {
  double distance;
  bool seen;
};

Fall fall_distance(const CorrelationMap& map, double angle, double level) {
  const double along_x = std::cos(angle), along_y = std::sin(angle);
  // Step along the direction, in metres: it is half a cell for cells of any shape.
  const double step = 0.5 / std::hypot(along_x / map.grid.dx(), along_y / map.grid.dy());
  const auto value = [&](double distance) {
    const double row = static_cast<double>(map.origin()) + distance * along_x / map.grid.dx();
    const double column = distance * along_y / map.grid.dy();
    const auto last_row = static_cast<double>(map.pairs.rows() - 1);
    const auto last_column = static_cast<double>(map.pairs.cols() - 1);
    if (!(row >= 0 && row <= last_row && column <= last_column)) return unknown;
    const double low_row = std::min(std::floor(row), std::max(last_row - 1, 0.0));
    const double low_column = std::min(std::floor(column), std::max(last_column - 1, 0.0));
    const auto i = static_cast<Index>(low_row), j = static_cast<Index>(low_column);
    const double u = row - low_row, v = column - low_column;
    const auto at = [&](Index a, Index b) {
      return map.autocorrelation(std::min(a, map.pairs.rows() - 1),
                                 std::min(b, map.pairs.cols() - 1));
    };
    return (1 - u) * ((1 - v) * at(i, j) + v * at(i, j + 1)) +
           u * ((1 - v) * at(i + 1, j) + v * at(i + 1, j + 1));
  };
  double before = value(0);
  for (double distance = step;; distance += step) {
    const double here = value(distance);
    if (std::isnan(here)) return {distance - step, false};
    if (here <= level) return {distance - step * (level - here) / (before - here), true};
    before = here;
  }
}

/// Returns of(angle) for all directions of half a turn.
template <class Value, class Of>
std::vector<Value> of_directions(const Of& of) {
  return parallel::map_blocks_of<Value>(
      1, directions, [&](Index k, Index) { return of(pi * static_cast<double>(k) / directions); });
}

void set_correlation_lengths(ArealParameters& result, const CorrelationMap& map) {
  const double variance = map.autocorrelation(map.origin(), 0);
  double shortest = std::numeric_limits<double>::infinity(), longest = 0;
  bool all_seen = true;
  for (const Fall& fall : of_directions<Fall>(
           [&](double angle) { return fall_distance(map, angle, correlation_level * variance); })) {
    if (fall.seen) shortest = std::min(shortest, fall.distance);
    longest = std::max(longest, fall.distance);
    all_seen = all_seen && fall.seen;
  }
  const bool falls = variance > 0 && std::isfinite(shortest);
  result.Sal = falls ? shortest : unknown;
  result.Str_max = falls ? std::min(1.0, shortest / longest) : unknown;
  result.Str = all_seen ? result.Str_max : unknown;
}

/// ∫ r C dr along a ray of the spectrum C in the direction `angle`, up to a factor common to all
/// rays. C is interpolated bilinearly between modes.
double ray_power(const PowerSpectrum& spectrum, double angle) {
  const Grid2D& grid = spectrum.grid;
  // Steps are measured in numbers of modes, scaled so that `angle` is the physical direction for
  // any shape of the surface.
  const double scale = std::min(grid.lx, grid.ly);
  const double along_x = std::cos(angle) * grid.lx / scale;
  const double along_y = std::sin(angle) * grid.ly / scale;
  const auto at = [&](Index i, Index j) {
    if (2 * std::abs(i) > grid.nx || j >= spectrum.psd.cols()) return 0.0;
    return spectrum.psd((i + grid.nx) % grid.nx, j);
  };
  double sum = 0;
  for (double r = 0.5;; r += 0.5) {
    const double x = r * along_x, y = r * along_y;
    // For extremely elongated surfaces a step can exceed the range of an index, so compare
    // floating-point numbers instead of indices.
    if (2 * std::abs(x) > static_cast<double>(grid.nx) ||
        y >= static_cast<double>(spectrum.psd.cols()))
      return sum;
    const double low_x = std::floor(x), low_y = std::floor(y);
    const auto i = static_cast<Index>(low_x), j = static_cast<Index>(low_y);
    const double u = x - low_x, v = y - low_y;
    sum += r * ((1 - u) * ((1 - v) * at(i, j) + v * at(i, j + 1)) +
                u * ((1 - v) * at(i + 1, j) + v * at(i + 1, j + 1)));
  }
}

double strongest_direction(const PowerSpectrum& spectrum) {
  const std::vector<double> powers =
      of_directions<double>([&](double angle) { return ray_power(spectrum, angle); });
  double best = 0, direction = unknown;
  for (int k = 0; k < directions; ++k) {
    if (const double power = powers[static_cast<std::size_t>(k)]; power > best * (1 + 1e-12)) {
      best = power;
      direction = pi * k / directions;
    }
  }
  return direction;
}

void set_gradients(ArealParameters& result, const Surface& surface) {
  const Grid2D& grid = surface.grid;
  const detail::NeighbourRows rows(surface);
  const double per_dx = 1 / grid.dx(), per_dy = 1 / grid.dy();
  struct Sums {
    double slope = 0, area = 0;
    Index triangles = 0;
  };
  const Index columns = surface.periodic ? grid.ny : grid.ny - 1;
  Sums total;
  for (const Sums& block :
       parallel::map_blocks<Sums>(surface.partition(), [&](Index begin, Index end) {
         Sums sums;
         for (Index ix = begin; ix < end; ++ix) {
           const double *here = rows[ix], *right = rows[ix + 1];
           if (!right) continue;
           for (Index iy = 0; iy < columns; ++iy) {
             const Index up = iy + 1 < grid.ny ? iy + 1 : 0;
             const std::array along_x{(right[iy] - here[iy]) * per_dx,
                                      (right[up] - here[up]) * per_dx};
             const std::array along_y{(here[up] - here[iy]) * per_dy,
                                      (right[up] - right[iy]) * per_dy};
             if (std::isnan(along_x[0] + along_x[1])) continue;
             for (const double x : along_x) {
               for (const double y : along_y) {
                 const double square = x * x + y * y;
                 sums.slope += square;
                 // √(1 + s) − 1 without cancellation for a small squared slope s.
                 sums.area += square / (std::sqrt(1 + square) + 1);
                 ++sums.triangles;
               }
             }
           }
         }
         return sums;
       })) {
    total.slope += block.slope;
    total.area += block.area;
    total.triangles += block.triangles;
  }
  const double triangles = static_cast<double>(total.triangles);
  result.Sdq = total.triangles > 0 ? std::sqrt(total.slope / triangles) : unknown;
  result.Sdr = total.triangles > 0 ? total.area / triangles : unknown;
}

/// Sets the parameters that need the order of all heights, or paths across the whole surface.
void set_of_whole(ArealParameters& result, const Surface& surface, const ArealParts& parts) {
  const std::vector<Peak> peaks = significant_peaks(surface, pruning * result.Sz);
  const double count = static_cast<double>(peaks.size());
  double curvature = 0;
  for (const Peak& peak : peaks) curvature += peak.mean_curvature;
  result.Spd = count / surface.grid.area();
  result.Spc = peaks.empty() ? unknown : curvature / count;

  // Parts that the caller has computed before are used in place: copying them would take longer
  // than using them.
  const auto use = [&](const auto* part, const auto& make, const auto& with) {
    part ? with(*part) : with(make(surface));
  };
  use(parts.correlation, correlation_map,
      [&](const CorrelationMap& map) { set_correlation_lengths(result, map); });
  result.Std = unknown;
  if (surface.undefined_points() == 0)
    use(
        parts.spectrum, [](const Surface& of) { return power_spectrum(of); },
        [&](const PowerSpectrum& spectrum) { result.Std = strongest_direction(spectrum); });
  CoreParameters core;
  use(
      parts.bearing, [](const Surface& of) { return BearingCurve(of); },
      [&](const BearingCurve& curve) { core = core_parameters(curve); });
  result.Sk = core.core_height;
  result.Spk = core.peak_height;
  result.Svk = core.valley_depth;
  result.Smr1 = core.peak_fraction;
  result.Smr2 = core.core_fraction;
}

}  // namespace

ArealParameters areal_parameters(const Surface& surface, const ArealParts& parts) {
  const HeightStatistics heights = height_statistics(surface);
  ArealParameters result;
  result.Sq = heights.rms_height;
  result.Ssk = heights.skewness;
  result.Sku = heights.kurtosis;
  result.Sp = heights.maximum - heights.mean;
  result.Sv = heights.mean - heights.minimum;
  result.Sz = heights.maximum - heights.minimum;
  result.Sa = parallel::sum_blocks(surface.partition(),
                                   [&](Index begin, Index end) {
                                     double sum = 0;
                                     for (Index ix = begin; ix < end; ++ix)
                                       for (Index iy = 0; iy < surface.grid.ny; ++iy)
                                         if (const double height = surface.heights(ix, iy);
                                             !std::isnan(height))
                                           sum += std::abs(height - heights.mean);
                                     return sum;
                                   }) /
              static_cast<double>(heights.defined_points);

  require(surface.grid.nx >= 3, "nx", surface.grid.nx, "must be >= 3 to have peaks");
  require(surface.grid.ny >= 3, "ny", surface.grid.ny, "must be >= 3 to have peaks");
  set_gradients(result, surface);
  if (surface.communicator.alone()) {
    set_of_whole(result, surface, parts);
  } else {
    for (double* parameter :
         {&result.Sal, &result.Str, &result.Str_max, &result.Std, &result.Sk, &result.Spk,
          &result.Svk, &result.Smr1, &result.Smr2, &result.Spd, &result.Spc})
      *parameter = unknown;
  }
  return result;
}

}  // namespace salebra
