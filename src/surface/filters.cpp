// SPDX-License-Identifier: GPL-3.0-or-later
// Gaussian S- and L-filters of ISO 16610.
#include <algorithm>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/surface/filters.hpp>
#include <salebra/surface/moments.hpp>
#include <tuple>

#include "base/convolution.hpp"
#include "base/memory.hpp"
#include "base/special_values.hpp"
#include "gaussian.hpp"

namespace salebra {
namespace {

using detail::FilterAxes;

/// Points of the transform along an axis. The weights of a Gaussian are below 1e-14 beyond 1.5
/// cut-offs. On the waves that a grid carries, the kernel of a cut-off of few cells also has ripples
/// with amplitudes below 0.1/k² at k cells; beyond 32 cells they change no height by more than 1e-4
/// of the heights at the opposite edge.
Index period(Index points, double step, double cutoff, bool periodic) {
  if (periodic || cutoff == 0) return points;
  return fast_transform_size(points + std::max<Index>(32, Index(std::ceil(1.5 * cutoff / step))));
}

/// The heights smoothed by the Gaussian with this cut-off.
Field smooth(const Surface& surface, double cutoff, FilterAxes axes) {
  const Grid2D& grid = surface.grid;
  const double along_x = axes.x && grid.nx > 1 ? cutoff : 0,
               along_y = axes.y && grid.ny > 1 ? cutoff : 0;
  const Index period_x = period(grid.nx, grid.dx(), along_x, surface.periodic),
              period_y = period(grid.ny, grid.dy(), along_y, surface.periodic);
  require_memory(grid, 24 * static_cast<double>(period_x * period_y), "a filter");
  Convolution2D<double> convolution({grid.nx, grid.ny, period_x, period_y});
  convolution.set_symbol(0, 0, [&](Index i, Index j) {
    const double x = along_x * double(i) / (double(period_x) * grid.dx()),
                 y = along_y * double(j) / (double(period_y) * grid.dy());
    return std::exp2(-(x * x + y * y));
  });
  // Heights far from zero would lose digits in the transforms.
  const double mean = height_statistics(surface).mean;
  const auto defined = (!surface.heights.isNaN()).eval();
  Field sums = defined.select(surface.heights - mean, 0.0);
  convolution.apply(sums.data(), sums.data());
  if (!surface.periodic || !defined.all()) {
    Field weights = defined.cast<double>();
    convolution.apply(weights.data(), weights.data());
    sums /= weights;
  }
  return defined.select(sums + mean, detail::unknown);
}

void require_cutoff(const Grid2D& grid, FilterAxes axes, const char* field, double cutoff) {
  require_positive(cutoff, field);
  for (const auto& [points, step, filters] :
       {std::tuple(grid.nx, grid.dx(), axes.x), {grid.ny, grid.dy(), axes.y}}) {
    if (points == 1 || !filters) continue;
    require(cutoff >= 2 * step, field, cutoff,
            "m is shorter than two cells; the surface carries no shorter waves");
    require(cutoff <= static_cast<double>(points) * step, field, cutoff,
            "m is longer than the surface; take a shorter cut-off or a larger map");
  }
}

}  // namespace

Surface detail::filtered_along(Surface surface, const GaussianFilters& filters, FilterAxes axes) {
  if (!filters.given()) return surface;
  surface.require_whole("a filter");
  surface.grid.validate();
  if (filters.s_filter) require_cutoff(surface.grid, axes, "s_filter", *filters.s_filter);
  if (filters.l_filter) require_cutoff(surface.grid, axes, "l_filter", *filters.l_filter);
  if (filters.s_filter && filters.l_filter)
    require(*filters.s_filter < *filters.l_filter, "s_filter", *filters.s_filter,
            "m must be shorter than `l_filter`; no wave would be left");
  if (filters.s_filter) surface.heights = smooth(surface, *filters.s_filter, axes);
  if (filters.l_filter) surface.heights -= smooth(surface, *filters.l_filter, axes);
  return surface;
}

Surface filtered(Surface surface, const GaussianFilters& filters) {
  return detail::filtered_along(std::move(surface), filters, {});
}

}  // namespace salebra
