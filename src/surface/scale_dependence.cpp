// SPDX-License-Identifier: GPL-3.0-or-later
// RMS slope and curvature over distance, and the shortest wavelength that is reliable.
#include <algorithm>
#include <cmath>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/scale_dependence.hpp>

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
};

/// All differences over `lag` points along an axis.
Sums differences(const Surface& surface, Axis axis, Index lag) {
  const Grid2D& grid = surface.grid;
  const Field& h = surface.heights;
  const Index n = axis == Axis::x ? grid.nx : grid.ny;
  const auto blocks = parallel::map_blocks<Sums>(grid.nx, [&](Index begin, Index end) {
    Sums sums;
    for (Index ix = begin; ix < end; ++ix) {
      for (Index iy = 0; iy < grid.ny; ++iy) {
        const Index here = axis == Axis::x ? ix : iy;
        const bool ahead = surface.periodic || here + lag < n;
        const bool behind = surface.periodic || here >= lag;
        const auto at = [&](Index place) {
          const Index wrapped = (place + n) % n;
          return axis == Axis::x ? h(wrapped, iy) : h(ix, wrapped);
        };
        if (!ahead) continue;
        const double rise = at(here + lag) - h(ix, iy);
        sums.add_slope(rise);
        if (behind) sums.add_curvature(rise - (h(ix, iy) - at(here - lag)));
      }
    }
    return sums;
  });
  Sums total;
  for (const Sums& block : blocks) {
    total.slope += block.slope;
    total.curvature += block.curvature;
    total.least = std::min(total.least, block.least);
    total.slopes += block.slopes;
    total.curvatures += block.curvatures;
  }
  return total;
}

}  // namespace

ScaleDependence scale_dependence(const Surface& surface, Axis axis) {
  detail::require_shape(surface);
  const Index n = axis == Axis::x ? surface.grid.nx : surface.grid.ny;
  const double step = axis == Axis::x ? surface.grid.dx() : surface.grid.dy();
  ScaleDependence result;
  for (Index lag = 1; lag == 1 || 4 * lag <= n; lag += std::max<Index>(1, lag / 10)) {
    const Sums sums = differences(surface, axis, std::min(lag, n));
    if (sums.curvatures == 0) break;
    const double spacing = static_cast<double>(lag) * step;
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
  surface.require_whole("a limit of reliability");
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
