// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/normal/tile_kernels.hpp"

// The tile kernels in their plainest form, cell by cell, without the vectors, lanes and prefetches
// of tile_kernels.inl. The tests compare the fast kernels with these; a reader should begin here.
namespace salebra::detail::reference {

// One cell of a tile: its indices in a packed array, in the residual with its halo, and in its row.
struct Cell {
  std::ptrdiff_t tile, packed, with_halo, column;
};

// Calls body(cell) for the cells of the tiles [begin, end) that lie within their row.
template <class Real, class Body>
void for_cells(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
               const Body& body) {
  for (std::ptrdiff_t k = begin; k < end; ++k) {
    const Tile& tile = a.tiles[k];
    for (std::ptrdiff_t i = 0; i < tile_width && tile.column + i < a.ny; ++i)
      body(Cell{k, k * tile_width + i,
                (tile.row + halo) * a.halo_stride + side_halo + tile.column + i, tile.column + i});
  }
}

// A quiet tile has no free and no loaded cell, so it adds nothing to a sum over free or loaded
// cells.
template <class Real, class Body>
void for_active_cells(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
                      const Body& body) {
  for_cells(a, begin, end, [&](const Cell& c) {
    if (!a.quiet[c.tile]) body(c);
  });
}

template <class Real>
void residual(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
              double plane_height) {
  for_cells(a, begin, end, [&](const Cell& c) {
    a.r[c.with_halo] =
        a.quiet[c.tile] ? Real(0) : a.m[c.packed] * static_cast<Real>(a.g[c.packed] - plane_height);
  });
}

// z = m (S r), S the stencil of 7 × 7 weights.
template <class Real>
PreconditionSums precondition(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end) {
  PreconditionSums sums;
  for_active_cells(a, begin, end, [&](const Cell& c) {
    Real smoothed = 0;
    for (int i = -halo; i <= halo; ++i)
      for (int j = -halo; j <= halo; ++j)
        smoothed += a.stencil[(i + halo) * (2 * halo + 1) + j + halo] *
                    a.r[c.with_halo + i * a.halo_stride + j];
    a.z[c.packed] = a.m[c.packed] * smoothed;
    const double z = a.z[c.packed], m = a.m[c.packed], t = m * double(a.t[c.packed]),
                 w = a.w[c.packed], r = a.r[c.with_halo];
    sums.z += z;
    sums.zw += z * w;
    sums.zz += z * z;
    sums.t += t;
    sums.w += m * w;
    sums.r += r;
    sums.zr += z * r;
    sums.tr += t * r;
  });
  return sums;
}

template <class Real>
void direct(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
            const NewDirection& direction, Real* row) {
  const double z_mean = direction.z_mean, beta = direction.beta, t_mean = direction.t_mean;
  for_active_cells(a, begin, end, [&](const Cell& c) {
    const double t = double(a.m[c.packed]) *
                     (double(a.z[c.packed]) - z_mean + beta * (double(a.t[c.packed]) - t_mean));
    a.t[c.packed] = row[c.column] = static_cast<Real>(t);
  });
}

template <class Real>
CurvatureSums take_image(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const Real* row) {
  CurvatureSums sums;
  for_cells(a, begin, end, [&](const Cell& c) {
    a.w[c.packed] = row[c.column];
    if (a.quiet[c.tile]) return;
    sums.tw += double(a.t[c.packed]) * double(a.w[c.packed]);
    sums.w += double(a.m[c.packed]) * double(a.w[c.packed]);
  });
  return sums;
}

template <class Real>
StepSums step(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end, double alpha,
              double plane_height) {
  StepSums sums;
  sums.least = std::numeric_limits<double>::infinity();
  for_cells(a, begin, end, [&](const Cell& c) {
    double &p = a.p[c.packed], &g = a.g[c.packed];
    const double m = a.m[c.packed];
    p -= alpha * double(a.t[c.packed]);
    g -= alpha * double(a.w[c.packed]);
    if (!a.quiet[c.tile]) a.r[c.with_halo] = static_cast<Real>(m * (g - plane_height));
    const double clipped = std::clamp(p, 0.0, a.bound), beyond = p - clipped;
    const bool saturated = clipped >= a.bound;
    sums.outside += beyond * beyond;
    sums.clipped += std::abs(beyond);
    // A held cell is wrong if its gap requires a change: below the plane without load, or above it
    // at the bound.
    const double wrong =
        saturated ? std::max(g - plane_height, 0.0) : std::max(plane_height - g, 0.0);
    sums.wrong += (1 - m) * wrong * wrong;
    if (saturated) {
      sums.saturated += 1;
      sums.misfit += a.bound * std::max(g - plane_height, 0.0);
      sums.signed_misfit += a.bound * std::max(g - plane_height, 0.0);
    } else {
      sums.pressure += clipped;
      sums.misfit += clipped * std::abs(g - plane_height);
      sums.signed_misfit += clipped * (g - plane_height);
      sums.least = std::min(sums.least, g);
    }
  });
  return sums;
}

// A free cell stays free while its pressure is within its bounds; a held cell becomes free if its
// gap has the wrong sign.
inline bool becomes_free(bool free, double p, double g, double plane_height, double bound) {
  if (free) return p >= 0 && p <= bound;
  return p > 0 ? g > plane_height : g < plane_height;
}

// Whether any cell of a tile lies below the plane; a quiet tile then becomes active.
template <class Real>
bool any_below(const TileArrays<Real>& a, std::ptrdiff_t k, double plane_height) {
  bool below = false;
  for_cells(a, k, k + 1, [&](const Cell& c) { below = below || a.g[c.packed] < plane_height; });
  return below;
}

// A tile without free and loaded cells becomes quiet, with t = 0.
template <class Real>
void rest(const TileArrays<Real>& a, std::ptrdiff_t k) {
  bool active = false;
  for_cells(a, k, k + 1,
            [&](const Cell& c) { active = active || a.m[c.packed] != 0 || a.p[c.packed] != 0; });
  if (active) return;
  a.quiet[k] = 1;
  for_cells(a, k, k + 1, [&](const Cell& c) { a.t[c.packed] = 0; });
}

template <class Real>
SetSums change_set(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
                   double plane_height) {
  SetSums sums;
  for (std::ptrdiff_t k = begin; k < end; ++k) {
    if (a.quiet[k] && !any_below(a, k, plane_height)) continue;
    a.quiet[k] = 0;
    for_cells(a, k, k + 1, [&](const Cell& c) {
      const bool free =
          becomes_free(a.m[c.packed] != 0, a.p[c.packed], a.g[c.packed], plane_height, a.bound);
      a.m[c.packed] = free;
      sums.count += free;
      sums.g += free ? a.g[c.packed] : 0;
    });
    rest(a, k);
  }
  return sums;
}

template <class Real>
void truncate(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
              double plane_height, const Truncation& correction) {
  const double scale = correction.scale, shift = correction.shift, full_from = correction.full_from;
  for (std::ptrdiff_t k = begin; k < end; ++k) {
    if (a.quiet[k] && shift == 0 && !any_below(a, k, plane_height)) continue;
    a.quiet[k] = 0;
    for_cells(a, k, k + 1, [&](const Cell& c) {
      double& p = a.p[c.packed];
      const double corrected =
          p >= full_from ? a.bound : std::min(scale * std::max(p, 0.0) + shift, a.bound);
      const bool inside = corrected > 0 && corrected < a.bound;
      a.m[c.packed] =
          inside || becomes_free(a.m[c.packed] != 0, p, a.g[c.packed], plane_height, a.bound);
      a.z[c.packed] = static_cast<Real>(corrected - p);
      p = corrected;
    });
  }
}

template <class Real>
void spread_change(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end, Real* row) {
  for_active_cells(a, begin, end, [&](const Cell& c) { row[c.column] = a.z[c.packed]; });
}

template <class Real>
SetSums add_displacement(const TileArrays<Real>& a, std::ptrdiff_t begin, std::ptrdiff_t end,
                         const Real* row) {
  SetSums sums;
  for_cells(a, begin, end, [&](const Cell& c) {
    a.g[c.packed] += double(row[c.column]);
    if (a.quiet[c.tile]) return;
    sums.count += double(a.m[c.packed]);
    sums.g += double(a.m[c.packed]) * a.g[c.packed];
  });
  for (std::ptrdiff_t k = begin; k < end; ++k)
    if (!a.quiet[k]) rest(a, k);
  return sums;
}

template <class Displacement>
GapSums gap(const Displacement* u, const GapRow& row) {
  GapSums sums;
  sums.least = std::numeric_limits<double>::infinity();
  const auto g = [&](std::ptrdiff_t k) { return double(u[k]) - (row.heights[k] - row.zero); };
  const auto p = [&](std::ptrdiff_t k) {
    return row.in_use && !row.in_use[k / tile_width] ? 0 : row.p[k];
  };
  for (std::ptrdiff_t k = 0; k < row.count; ++k) {
    double& of_tile = row.nearest[k / tile_width];
    if (k % tile_width == 0) of_tile = std::numeric_limits<double>::infinity();
    sums.pressure += p(k);
    if (p(k) > 0 && p(k) < row.bound) {
      sums.count += 1;
      sums.g += g(k);
    }
    sums.misfit += p(k) * (g(k) - row.plane);
    sums.distance += std::abs(p(k) * (g(k) - row.plane));
    sums.saturated += !(p(k) < row.bound);
    sums.least = std::min(sums.least, g(k));
    of_tile = std::min(of_tile, p(k) > 0 ? -std::numeric_limits<double>::infinity() : g(k));
  }
  for (std::ptrdiff_t k = 0; k < row.count; ++k)
    if (row.nearest[k / tile_width] < row.kept_below) row.g[k] = g(k);
  return sums;
}

inline double clip(double* p, std::ptrdiff_t count, double bound) {
  double sum = 0;
  for (std::ptrdiff_t k = 0; k < count; ++k) sum += p[k] = std::clamp(p[k], 0.0, bound);
  return sum;
}

template <class Real>
TileKernels<Real> table() {
  return {residual<Real>,   precondition<Real>,  direct<Real>,
          take_image<Real>, step<Real>,          change_set<Real>,
          truncate<Real>,   spread_change<Real>, add_displacement<Real>,
          gap<Real>,        gap<double>,         clip};
}

}  // namespace salebra::detail::reference
