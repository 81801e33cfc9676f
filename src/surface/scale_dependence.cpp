// SPDX-License-Identifier: GPL-3.0-or-later
// RMS slope and curvature over distance, and the shortest wavelength that is reliable.
#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/share.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <span>
#include <vector>

#include "profiles.hpp"
#include "shape.hpp"

namespace salebra {
namespace {

struct Sums {
  double slope = 0, curvature = 0, least = std::numeric_limits<double>::infinity();
  Index slopes = 0, curvatures = 0;

  void add_slope(double difference) {
    if (std::isnan(difference)) return;
    slope += difference * difference;
    ++slopes;
  }
  void add_curvature(double second) {
    if (std::isnan(second)) return;
    curvature += second * second;
    least = std::min(least, second);
    ++curvatures;
  }
  void add(const Sums& other) {
    slope += other.slope;
    curvature += other.curvature;
    least = std::min(least, other.least);
    slopes += other.slopes;
    curvatures += other.curvatures;
  }
};

/// All differences of a profile over `lag` points.
void add_differences(std::span<const double> h, bool periodic, std::size_t lag, Sums& sums) {
  const std::size_t n = h.size();
  for (std::size_t here = 0; here < n; ++here) {
    const bool ahead = periodic || here + lag < n, behind = periodic || here >= lag;
    if (!ahead) break;
    const double rise = h[here + lag < n ? here + lag : here + lag - n] - h[here];
    sums.add_slope(rise);
    if (behind) sums.add_curvature(rise - (h[here] - h[here >= lag ? here - lag : here + n - lag]));
  }
}

}  // namespace

ScaleDependence scale_dependence(const Surface& surface, Axis axis) {
  collectively(surface.ranks, [&] { detail::require_shape_of_rows(surface); });
  const Index n = axis == Axis::x ? surface.grid.nx : surface.grid.ny;
  const double step = axis == Axis::x ? surface.grid.dx() : surface.grid.dy();
  std::vector<Index> lags;
  for (Index lag = 1; lag == 1 || 4 * lag <= n; lag += std::max<Index>(1, lag / 10))
    lags.push_back(std::min(lag, n));
  const auto blocks = detail::map_profiles(
      surface, axis, std::vector<Sums>(lags.size()),
      [&](std::vector<Sums>& sums, std::span<const double> heights) {
        for (std::size_t k = 0; k < lags.size(); ++k)
          add_differences(heights, surface.periodic, static_cast<std::size_t>(lags[k]), sums[k]);
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
          "have no three neighbours that are defined; fill or crop them");
  return result;
}

double ReliabilityLimit::wavelength() const {
  return std::max({pixel, tip.value_or(0), resolution.value_or(0)});
}

ReliabilityLimit short_wavelength_limit(const Surface& surface, const ReliabilityOptions& options) {
  require_positive(options.safety_factor, "safety_factor");
  ReliabilityLimit limit;
  limit.pixel = 2 * std::max(surface.grid.dx(), surface.grid.dy());
  if (options.resolution) {
    require_positive(*options.resolution, "resolution");
    limit.resolution = options.resolution;
  }
  if (!options.tip_radius) return limit;
  require_positive(*options.tip_radius, "tip_radius");
  const double sharpest = -options.safety_factor / *options.tip_radius;
  limit.tip = 0;
  for (const Axis axis : {Axis::x, Axis::y}) {
    const ScaleDependence scales = scale_dependence(surface, axis);
    std::size_t k = scales.spacing.size();
    while (k > 0 && scales.min_curvature[k - 1] >= sharpest) --k;
    if (k == 0) continue;
    double length = std::numeric_limits<double>::infinity();
    if (k < scales.spacing.size()) {
      // The curvature passes the limit between two spacings: straight between them.
      const double low = scales.min_curvature[k - 1], high = scales.min_curvature[k];
      const double part = (sharpest - low) / (high - low);
      length = 2 * (scales.spacing[k - 1] + part * (scales.spacing[k] - scales.spacing[k - 1]));
    }
    limit.tip = std::max(*limit.tip, length);
  }
  return limit;
}

}  // namespace salebra
