// SPDX-License-Identifier: GPL-3.0-or-later
// Doubts of heights: slopes that no surface has.
#include "plausibility.hpp"

#include <fmt/format.h>

#include <cmath>
#include <salebra/base/parallel.hpp>
#include <salebra/base/share.hpp>
#include <utility>

#include "neighbour_rows.hpp"

namespace salebra {
namespace {

/// Mean and mean square of the differences of neighbours, over those that are defined.
struct Differences {
  double sum = 0, squares = 0, count = 0;

  /// Each of the values less the one at its place in `others`. Eight sums side by side: one after
  /// another they would take longer than the heights take from the disk's cache.
  void add(const double* values, const double* others, Index size) {
    double differences = 0, their_squares = 0, defined = 0;
#pragma omp simd simdlen(8) reduction(+ : differences, their_squares, defined)
    for (Index i = 0; i < size; ++i) {
      const double difference = values[i] - others[i];
      const double one = difference == difference ? 1 : 0, known = one > 0 ? difference : 0;
      differences += known;
      their_squares += known * known;
      defined += one;
    }
    sum += differences;
    squares += their_squares;
    count += defined;
  }
  void add(const Differences& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
  }
  /// Mean square of the slope about its mean; NaN where there is no pair.
  double variance(double step) const {
    const double mean = sum / count;
    return (squares / count - mean * mean) / (step * step);
  }
};

}  // namespace

std::optional<std::string> doubt_of_slope(double rms_slope, double unit) {
  constexpr double most = 1;
  if (!(rms_slope > most)) return {};
  // A slope that is hardly too large is that of a steep surface or of spikes: any unit would make
  // it far too small. The units leave a thousandfold range between them, down to polished surfaces.
  constexpr double least_error = 10, least = 1e-3;
  if (rms_slope >= least_error)
    for (const auto& [name, metres] : {std::pair("mm", 1e-3), {"\u00b5m", 1e-6}, {"nm", 1e-9}})
      if (const double slope = rms_slope * metres / unit; slope >= least && slope <= most)
        return fmt::format("rms slope {:.3g} is above 1: heights in {}? rms slope would be {:.2g}",
                           rms_slope, name, slope);
  return fmt::format(
      "rms slope {:.3g} is above 1, beyond linear elasticity; check the unit of the heights, and "
      "single points far from their neighbours",
      rms_slope);
}

std::optional<std::string> doubt_of_heights(const Surface& surface, double unit) {
  const Grid2D& grid = surface.grid;
  const detail::NeighbourRows rows(surface);
  struct Both {
    Differences x, y;
  };
  Both total;
  for (const Both& block : parallel::map_blocks<Both>(
           surface.share(),
           [&](Index begin, Index end) {
             Both sums;
             for (Index ix = begin; ix < end; ++ix) {
               const double *here = rows[ix], *next = rows[ix + 1];
               if (next) sums.x.add(next, here, grid.ny);
               sums.y.add(here + 1, here, grid.ny - 1);
             }
             return sums;
           },
           grid.points())) {
    total.x.add(block.x);
    total.y.add(block.y);
  }
  // A profile has neighbours along one axis.
  const auto variance = [](const Differences& differences, double step) {
    return differences.count > 0 ? differences.variance(step) : 0;
  };
  const bool profile = grid.nx == 1 || grid.ny == 1;
  return doubt_of_slope(profile
                            ? std::sqrt(variance(total.x, grid.dx()) + variance(total.y, grid.dy()))
                            : std::sqrt(total.x.variance(grid.dx()) + total.y.variance(grid.dy())),
                        unit);
}

}  // namespace salebra
