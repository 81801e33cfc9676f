// SPDX-License-Identifier: GPL-3.0-or-later
// RMS slope and curvature against distance, and the shortest reliable wavelength.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <span>
#include <vector>

#include "base/elementary.hpp"
#include "base/special_values.hpp"
#include "profiles.hpp"
#include "shape.hpp"

namespace salebra {
namespace {

struct Sums {
  double slope = 0, curvature = 0, least = std::numeric_limits<double>::infinity();
  Index slopes = 0, curvatures = 0;

  void add(const Sums& other) {
    slope += other.slope;
    curvature += other.curvature;
    least = std::min(least, other.least);
    slopes += other.slopes;
    curvatures += other.curvatures;
  }
};

// Partial sums over the positions 0 … 3 and 4 … 7 of each eight points. They are added in pairs at
// the end, which gives the same bits for every vector width.
using Four [[gnu::vector_size(32)]] = double;
using FourCounts [[gnu::vector_size(32)]] = std::int64_t;

struct Lanes {
  Four slope{}, curvature{}, least = Four{} + std::numeric_limits<double>::infinity();
  FourCounts slopes{}, curvatures{};

  template <bool tested>
  SALEBRA_INLINE void add(const double* here, std::ptrdiff_t lag) {
    Four behind, middle, ahead;
    std::memcpy(&behind, here - lag, sizeof behind);
    std::memcpy(&middle, here, sizeof middle);
    std::memcpy(&ahead, here + lag, sizeof ahead);
    const Four rise = ahead - middle, second = rise - (middle - behind);
    least = second < least ? second : least;
    if constexpr (tested) {
      const auto is_slope = rise == rise, is_curvature = second == second;
      slope += is_slope ? rise * rise : Four{};
      curvature += is_curvature ? second * second : Four{};
      slopes -= is_slope;
      curvatures -= is_curvature;
    } else {
      slope += rise * rise;
      curvature += second * second;
    }
  }
  Sums sums() const {
    return {(slope[0] + slope[1]) + (slope[2] + slope[3]),
            (curvature[0] + curvature[1]) + (curvature[2] + curvature[3]),
            std::min(std::min(least[0], least[1]), std::min(least[2], least[3])),
            slopes[0] + slopes[1] + slopes[2] + slopes[3],
            curvatures[0] + curvatures[1] + curvatures[2] + curvatures[3]};
  }
};

template <bool tested>
SALEBRA_INLINE Sums stencils(const double* heights, std::ptrdiff_t count, std::ptrdiff_t lag) {
  Lanes left, right;
  std::ptrdiff_t here = 0;
  for (; here + 8 <= count; here += 8) {
    left.add<tested>(heights + here, lag);
    right.add<tested>(heights + here + 4, lag);
  }
  Sums sums = left.sums();
  sums.add(right.sums());
  if constexpr (!tested) sums.slopes = sums.curvatures = here;
  for (; here < count; ++here) {
    const double rise = heights[here + lag] - heights[here],
                 second = rise - (heights[here] - heights[here - lag]);
    if (!std::isnan(rise)) sums.add({.slope = rise * rise, .slopes = 1});
    if (!std::isnan(second))
      sums.add({.curvature = second * second, .least = second, .curvatures = 1});
  }
  return sums;
}

/// Sums over all first and second differences of a profile at a distance of `lag` points; the
/// profile continues by at least `lag` points on both sides. tested: whether some heights are
/// undefined.
SALEBRA_VECTOR_WIDTHS
Sums differences(const double* heights, std::ptrdiff_t count, std::ptrdiff_t lag, bool tested) {
  return tested ? stencils<true>(heights, count, lag) : stencils<false>(heights, count, lag);
}

}  // namespace

ScaleDependence scale_dependence(const Surface& surface, Axis axis) {
  collectively(surface.communicator, [&] { detail::require_shape_of_rows(surface); });
  const Index n = axis == Axis::x ? surface.grid.nx : surface.grid.ny;
  const double step = axis == Axis::x ? surface.grid.dx() : surface.grid.dy();
  std::vector<Index> lags;
  for (Index lag = 1; lag == 1 || 4 * lag <= n; lag += std::max<Index>(1, lag / 10))
    lags.push_back(std::min(lag, n));
  const auto blocks = detail::map_profiles(
      surface, axis, std::vector<Sums>(lags.size()),
      [&](std::vector<Sums>& sums, std::span<const double> heights) {
        const auto reach = static_cast<std::size_t>(lags.back());
        std::vector<double> longer(heights.size() + 2 * reach, detail::unknown);
        std::ranges::copy(heights, longer.begin() + lags.back());
        if (surface.periodic) {
          std::ranges::copy(heights.last(reach), longer.begin());
          std::ranges::copy(heights.first(reach), longer.end() - lags.back());
        }
        const bool tested = std::ranges::any_of(longer, [](double h) { return std::isnan(h); });
        for (std::size_t k = 0; k < lags.size(); ++k)
          sums[k].add(differences(longer.data() + reach, n, lags[k], tested));
      });
  ScaleDependence result;
  std::vector<Sums> mine(blocks.size());
  for (std::size_t k = 0; k < lags.size(); ++k) {
    for (std::size_t block = 0; block < blocks.size(); ++block) mine[block] = blocks[block][k];
    Sums sums;
    for (const Sums& of_block : parallel::gather_blocks(detail::profiles_of(surface, axis), mine))
      sums.add(of_block);
    if (sums.curvatures == 0) break;
    const double spacing = static_cast<double>(lags[k]) * step;
    result.spacing.push_back(spacing);
    result.profile_slope.push_back(std::sqrt(sums.slope / static_cast<double>(sums.slopes)) /
                                   spacing);
    result.profile_curvature.push_back(
        std::sqrt(sums.curvature / static_cast<double>(sums.curvatures)) / (spacing * spacing));
    result.min_curvature.push_back(sums.least / (spacing * spacing));
    result.stencils.push_back(sums.curvatures);
  }
  require(!result.spacing.empty() && n >= 3, "heights", axis == Axis::x ? "along x" : "along y",
          "do not have three defined neighbours; fill or crop them");
  return result;
}

double ReliabilityLimit::wavelength() const {
  return std::max({pixel, tip.value_or(0), resolution.value_or(0)});
}

ReliabilityLimit short_wavelength_limit(const Surface& surface, const ReliabilityOptions& options) {
  require_positive(options.safety_factor, "safety_factor");
  ReliabilityLimit limit;
  limit.pixel = 2 * (surface.grid.ny == 1 ? surface.grid.dx()
                                          : std::max(surface.grid.dx(), surface.grid.dy()));
  if (options.resolution) {
    require_positive(*options.resolution, "resolution");
    limit.resolution = options.resolution;
  }
  if (!options.tip_radius) return limit;
  require_positive(*options.tip_radius, "tip_radius");
  const double sharpest = -options.safety_factor / *options.tip_radius;
  limit.tip = 0;
  for (const Axis axis : {Axis::x, Axis::y}) {
    if (axis == Axis::y && surface.grid.ny == 1) continue;  // a line profile
    const ScaleDependence scales = scale_dependence(surface, axis);
    std::size_t k = scales.spacing.size();
    while (k > 0 && scales.min_curvature[k - 1] >= sharpest) --k;
    if (k == 0) continue;
    double length = std::numeric_limits<double>::infinity();
    if (k < scales.spacing.size()) {
      // The curvature passes the limit between two spacings; interpolate linearly between them.
      const double low = scales.min_curvature[k - 1], high = scales.min_curvature[k];
      const double part = (sharpest - low) / (high - low);
      length = 2 * (scales.spacing[k - 1] + part * (scales.spacing[k] - scales.spacing[k - 1]));
    }
    limit.tip = std::max(*limit.tip, length);
  }
  return limit;
}

}  // namespace salebra
