// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, which SALEBRA_SIMD names.
#include "contact/half_space/stencil_loop.inl"
#include "tile_kernels.hpp"

namespace salebra::detail::SALEBRA_SIMD {

using Size = std::ptrdiff_t;

// One partial sum for each of the 16 cell positions of a tile. The 16 partial sums are added only
// at the end, because adding numbers within a vector register is slow.
struct Lanes {
  double value[tile_width] = {};
  double sum() const {
    double total = 0;
    for (int lane = 0; lane < tile_width; ++lane) total += value[lane];
    return total;
  }
  // The minimum of the 16 numbers; halves their count at each step, because that vectorises if the
  // counts are constants.
  double least() const { return least_of<tile_width>(value); }

 private:
  template <int count>
  static SALEBRA_INLINE double least_of(const double* numbers) {
    if constexpr (count == 1) {
      return numbers[0];
    } else {
      double less[count / 2];
      for (int lane = 0; lane < count / 2; ++lane)
        less[lane] = numbers[lane + count / 2] < numbers[lane] ? numbers[lane + count / 2]
                                                               : numbers[lane];
      return least_of<count / 2>(less);
    }
  }
};

struct FullWidth {
  constexpr operator Size() const { return tile_width; }
};

// The residual is read in strides that the processor's prefetcher does not predict: prefetch this
// many tiles ahead.
inline constexpr Size ahead = 16;

// Cells of the residual that a pass reads: no cell, the cells of the tile, or all cells within
// reach of the stencil.
enum class Reads { packed, residual, halo };

template <Reads reads, class Real>
SALEBRA_INLINE void fetch(const TileArrays<Real>& a, const Tile& tile) {
  if constexpr (reads == Reads::packed) return;
  const Real* r = a.r + (tile.row + halo) * a.halo_stride + tile.column + side_halo;
  if constexpr (reads == Reads::residual) __builtin_prefetch(r);
  if constexpr (reads == Reads::halo) __builtin_prefetch(r + halo * a.halo_stride);
}

// Indices of the first cell of a tile in packed arrays, in fields with a halo, and in its row.
struct Place {
  Size packed, with_halo, column;
};

// Calls body(index, width) for each tile that is not quiet and quiet_body(index, width) for each
// quiet tile (without free or loaded cells); width, the number of cells, is a compile-time constant
// except in the last tile of a row.
template <Reads reads, class Real, class Body, class QuietBody>
SALEBRA_INLINE void for_tiles(const TileArrays<Real>& a, Size begin, Size end, const Body& body,
                              const QuietBody& quiet_body) {
  for (Size k = begin; k < end; ++k) {
    const Size row = a.tiles[k].row, column = a.tiles[k].column;
    const Place index = {k * tile_width, (row + halo) * a.halo_stride + column + side_halo, column};
    const bool whole = a.ny - column >= tile_width;
    if (k + ahead < a.tile_count) fetch<reads>(a, a.tiles[k + ahead]);
    if (a.quiet[k]) {
      if (whole) {
        quiet_body(index, FullWidth{});
      } else {
        quiet_body(index, a.ny - column);
      }
    } else if (whole) {
      body(index, FullWidth{});
    } else {
      body(index, a.ny - column);
    }
  }
}

// Like for_tiles(), but skips quiet tiles, for passes to which quiet tiles add nothing and in which
// they do not change.
template <Reads reads, class Real, class Body>
SALEBRA_INLINE void for_active_tiles(const TileArrays<Real>& a, Size begin, Size end,
                                     const Body& body) {
  for_tiles<reads>(a, begin, end, body, [](const Place&, auto) {});
}

// Whether any number of a tile differs from +0. It compares bits, because testing each number would
// not vectorise.
template <class Number, class Width>
SALEBRA_INLINE bool any(const Number* tile, Width width) {
  unsigned long long bits = 0;
  if (width == tile_width) {
    constexpr int words = tile_width * static_cast<int>(sizeof(Number)) / 8;
    unsigned long long word[words];
    __builtin_memcpy(word, tile, sizeof(word));
    for (int i = 0; i < words; ++i) bits |= word[i];
  } else {
    for (Size i = 0; i < width; ++i) bits |= tile[i] != 0;
  }
  return bits != 0;
}

// Marks a tile as quiet if all its cells are held and without load.
template <class Real, class Width>
SALEBRA_INLINE void rest(const TileArrays<Real>& a, const Place& index, Width width) {
  if (any(a.m + index.packed, width) || any(a.p + index.packed, width)) return;
  a.quiet[index.packed / tile_width] = 1;
  for (Size i = 0; i < width; ++i) a.t[index.packed + i] = 0;
}

// Whether any cell of a tile without load lies below the contact plane.
template <class Width>
SALEBRA_INLINE bool any_below(const double* g, double plane_height, Width width) {
  int below = 0;
  for (Size i = 0; i < width; ++i) below |= g[i] < plane_height;
  return below != 0;
}

template <class Real>
void residual(const TileArrays<Real>& a, Size begin, Size end, double plane_height) {
  for_tiles<Reads::residual>(
      a, begin, end,
      [&](const Place& index, auto width) {
        const double* g = a.g + index.packed;
        const Real* m = a.m + index.packed;
        Real* r = a.r + index.with_halo;
        for (Size i = 0; i < width; ++i) r[i] = m[i] * static_cast<Real>(g[i] - plane_height);
      },
      [&](const Place& index, auto width) {
        for (Size i = 0; i < width; ++i) a.r[index.with_halo + i] = 0;
      });
}

template <class Real>
SALEBRA_INLINE void apply_stencil(const TileArrays<Real>& a, Size with_halo, FullWidth,
                                  Real* sums) {
  StencilLoop<Real, halo>::apply(a.r + with_halo, a.halo_stride, a.stencil, sums);
}

template <class Real>
SALEBRA_INLINE void apply_stencil(const TileArrays<Real>& a, Size with_halo, Size width,
                                  Real* sums) {
  for (Size c = 0; c < width; ++c) {
    Real sum = 0;
    for (int i = -halo; i <= halo; ++i)
      for (int j = -halo; j <= halo; ++j)
        sum += a.stencil[(i + halo) * (2 * halo + 1) + j + halo] *
               a.r[with_halo + i * a.halo_stride + j + c];
    sums[c] = sum;
  }
}

template <class Real>
PreconditionSums precondition(const TileArrays<Real>& a, Size begin, Size end) {
  Lanes sum_z, sum_zw, sum_zz, sum_t, sum_w, sum_r, sum_zr, sum_tr;
  for_active_tiles<Reads::halo>(a, begin, end, [&](const Place& index, auto width) {
    const Real *m = a.m + index.packed, *t = a.t + index.packed, *w = a.w + index.packed,
               *r = a.r + index.with_halo;
    Real* z = a.z + index.packed;
    apply_stencil(a, index.with_halo, width, z);
    for (Size i = 0; i < width; ++i) {
      const Real free = z[i] * m[i];
      z[i] = free;
      const double x = static_cast<double>(free), misfit = static_cast<double>(r[i]);
      const double along = static_cast<double>(m[i]) * static_cast<double>(t[i]);
      sum_z.value[i] += x;
      sum_zw.value[i] += x * static_cast<double>(w[i]);
      sum_zz.value[i] += x * x;
      sum_t.value[i] += along;
      sum_w.value[i] += static_cast<double>(m[i]) * static_cast<double>(w[i]);
      sum_r.value[i] += misfit;
      sum_zr.value[i] += x * misfit;
      sum_tr.value[i] += along * misfit;
    }
  });
  return {sum_z.sum(), sum_zw.sum(), sum_zz.sum(), sum_t.sum(),
          sum_w.sum(), sum_r.sum(),  sum_zr.sum(), sum_tr.sum()};
}

template <class Real>
void direct(const TileArrays<Real>& a, Size begin, Size end, const NewDirection& direction,
            Real* row) {
  // Local copies of the numbers: otherwise the compiler reloads them after each store.
  const double z_mean = direction.z_mean, beta = direction.beta, t_mean = direction.t_mean;
  for_active_tiles<Reads::packed>(a, begin, end, [&](const Place& index, auto width) {
    const Real *m = a.m + index.packed, *z = a.z + index.packed;
    Real *t = a.t + index.packed, *cells = row + index.column;
    for (Size i = 0; i < width; ++i) {
      const double x = static_cast<double>(m[i]) * (static_cast<double>(z[i]) - z_mean +
                                                    beta * (static_cast<double>(t[i]) - t_mean));
      t[i] = static_cast<Real>(x);
      cells[i] = static_cast<Real>(x);
    }
  });
}

template <class Real>
CurvatureSums take_image(const TileArrays<Real>& a, Size begin, Size end, const Real* row) {
  Lanes sum_tw, sum_w;
  for_tiles<Reads::packed>(
      a, begin, end,
      [&](const Place& index, auto width) {
        const Real *m = a.m + index.packed, *t = a.t + index.packed, *cells = row + index.column;
        Real* w = a.w + index.packed;
        for (Size i = 0; i < width; ++i) {
          const double y = static_cast<double>(cells[i]);
          w[i] = cells[i];
          sum_tw.value[i] += static_cast<double>(t[i]) * y;
          sum_w.value[i] += static_cast<double>(m[i]) * y;
        }
      },
      [&](const Place& index, auto width) {
        for (Size i = 0; i < width; ++i) a.w[index.packed + i] = row[index.column + i];
      });
  return {sum_tw.sum(), sum_w.sum()};
}

template <class Real>
StepSums step(const TileArrays<Real>& a, Size begin, Size end, double alpha, double plane_height) {
  Lanes outside, wrong, clipped, pressure, misfit, signed_misfit, saturated, least;
  for (int lane = 0; lane < tile_width; ++lane) least.value[lane] = __builtin_inf();
  const double bound = a.bound;
  for_tiles<Reads::residual>(
      a, begin, end,
      [&](const Place& index, auto width) {
        const Real *m = a.m + index.packed, *t = a.t + index.packed, *w = a.w + index.packed;
        double *p = a.p + index.packed, *g = a.g + index.packed;
        Real* r = a.r + index.with_halo;
        for (Size i = 0; i < width; ++i) {
          const double x = p[i] - alpha * static_cast<double>(t[i]);
          const double y = g[i] - alpha * static_cast<double>(w[i]);
          p[i] = x;
          g[i] = y;
          const double free = static_cast<double>(m[i]), apart = y - plane_height;
          r[i] = static_cast<Real>(free * apart);
          const double above = x < 0 ? 0 : x;
          const double held_in = above < bound ? above : bound;
          const double beyond = x - held_in;
          const bool full = held_in >= bound;
          const double below = full ? 0 : held_in;
          const double open = apart > 0 ? apart : 0, closed = apart < 0 ? -apart : 0;
          const double violation = (1 - free) * (full ? open : closed);
          outside.value[i] += beyond * beyond;
          wrong.value[i] += violation * violation;
          clipped.value[i] += beyond < 0 ? -beyond : beyond;
          pressure.value[i] += below;
          const double saturated_misfit = full ? held_in * open : 0;
          misfit.value[i] += below * (open + closed) + saturated_misfit;
          signed_misfit.value[i] += below * apart + saturated_misfit;
          saturated.value[i] += full ? 1 : 0;
          const double candidate = full ? __builtin_inf() : y;
          least.value[i] = candidate < least.value[i] ? candidate : least.value[i];
        }
      },
      [&](const Place& index, auto width) {
        const Real* w = a.w + index.packed;
        double* g = a.g + index.packed;
        for (Size i = 0; i < width; ++i) {
          const double y = g[i] - alpha * static_cast<double>(w[i]);
          g[i] = y;
          const double apart = y - plane_height, closed = apart < 0 ? -apart : 0;
          wrong.value[i] += closed * closed;
          least.value[i] = y < least.value[i] ? y : least.value[i];
        }
      });
  const double lowest = least.least();
  return {outside.sum(), wrong.sum(),         clipped.sum(),   pressure.sum(),
          misfit.sum(),  signed_misfit.sum(), saturated.sum(), lowest};
}

// Returns 1 for a cell that is free from now on, otherwise 0. Conditions are numbers instead of
// bool, because mixed comparisons of float and double do not vectorise.
SALEBRA_INLINE double freed(double free, double p, double g, double plane_height, double bound) {
  const double above = p < 0 ? 0.0 : 1.0, stays = p > bound ? 0.0 : above;
  const double open = g > plane_height ? 1.0 : 0.0, closed = g < plane_height ? 1.0 : 0.0;
  const double enters = p > 0 ? open : closed;
  return free * stays + (1 - free) * enters;
}

template <class Real>
SetSums change_set(const TileArrays<Real>& a, Size begin, Size end, double plane_height) {
  Lanes count, sum;
  const double bound = a.bound;
  const auto change = [&](const Place& index, auto width) {
    Real* m = a.m + index.packed;
    const double *p = a.p + index.packed, *g = a.g + index.packed;
    for (Size i = 0; i < width; ++i) {
      const double free = freed(static_cast<double>(m[i]), p[i], g[i], plane_height, bound);
      m[i] = static_cast<Real>(free);
      count.value[i] += free;
      sum.value[i] += free * g[i];
    }
    rest(a, index, width);
  };
  for_tiles<Reads::packed>(a, begin, end, change, [&](const Place& index, auto width) {
    if (!any_below(a.g + index.packed, plane_height, width)) return;
    a.quiet[index.packed / tile_width] = 0;
    change(index, width);
  });
  return {count.sum(), sum.sum()};
}

template <class Real>
void truncate(const TileArrays<Real>& a, Size begin, Size end, double plane_height,
              const Truncation& correction) {
  const double scale = correction.scale, shift = correction.shift, full_from = correction.full_from;
  const double bound = a.bound;
  const auto cut = [&](const Place& index, auto width) {
    Real *z = a.z + index.packed, *m = a.m + index.packed;
    double* p = a.p + index.packed;
    const double* g = a.g + index.packed;
    for (Size i = 0; i < width; ++i) {
      const double above = (p[i] < 0 ? 0 : p[i] * scale) + shift;
      const double within = above < bound ? above : bound;
      const double kept = p[i] < full_from ? within : bound;
      const double free = freed(static_cast<double>(m[i]), p[i], g[i], plane_height, bound);
      // A held cell that the load correction moved off its bound becomes free.
      const double loaded = kept > 0 ? 1.0 : 0.0, inside = kept < bound ? loaded : 0.0;
      m[i] = static_cast<Real>(inside > free ? inside : free);
      z[i] = static_cast<Real>(kept - p[i]);
      p[i] = kept;
    }
  };
  for_tiles<Reads::packed>(a, begin, end, cut, [&](const Place& index, auto width) {
    if (shift == 0 && !any_below(a.g + index.packed, plane_height, width)) return;
    a.quiet[index.packed / tile_width] = 0;
    cut(index, width);
  });
}

template <class Real>
void spread_change(const TileArrays<Real>& a, Size begin, Size end, Real* row) {
  for_active_tiles<Reads::packed>(a, begin, end, [&](const Place& index, auto width) {
    for (Size i = 0; i < width; ++i) row[index.column + i] = a.z[index.packed + i];
  });
}

template <class Real>
SetSums add_displacement(const TileArrays<Real>& a, Size begin, Size end, const Real* row) {
  Lanes count, sum;
  for_tiles<Reads::packed>(
      a, begin, end,
      [&](const Place& index, auto width) {
        double* g = a.g + index.packed;
        const Real *m = a.m + index.packed, *cells = row + index.column;
        for (Size i = 0; i < width; ++i) {
          g[i] += static_cast<double>(cells[i]);
          count.value[i] += static_cast<double>(m[i]);
          sum.value[i] += static_cast<double>(m[i]) * g[i];
        }
        rest(a, index, width);
      },
      [&](const Place& index, auto width) {
        double* g = a.g + index.packed;
        for (Size i = 0; i < width; ++i) g[i] += static_cast<double>(row[index.column + i]);
      });
  return {count.sum(), sum.sum()};
}

// Calls body(first, width) for each run of 16 of `count` cells, and for the cells that remain.
template <class Body>
SALEBRA_INLINE void for_runs(Size count, const Body& body) {
  Size first = 0;
  for (; first + tile_width <= count; first += tile_width) body(first, FullWidth{});
  if (first < count) body(first, count - first);
}

// Cells that gap() prefetches ahead.
inline constexpr Size prefetched = 256;

template <class Displacement>
GapSums gap(const Displacement* u, const GapRow& row) {
  Lanes pressure, free_count, free_g, misfit, distance, saturated, least;
  for (int lane = 0; lane < tile_width; ++lane) least.value[lane] = __builtin_inf();
  for_runs(row.count, [&](Size first, auto width) {
    // The transform delivers rows in an order that the processor does not predict.
    for (Size line = 0; line < tile_width; line += 8) {
      __builtin_prefetch(row.heights + first + prefetched + line);
      __builtin_prefetch(row.p + first + prefetched + line);
    }
    Lanes g, close;
    for (int lane = 0; lane < tile_width; ++lane) close.value[lane] = __builtin_inf();
    for (Size i = 0; i < width; ++i) {
      const double height = row.heights[first + i] - row.zero;
      const double y = static_cast<double>(u[first + i]) - height;
      g.value[i] = close.value[i] = y;
      least.value[i] = y < least.value[i] ? y : least.value[i];
    }
    if (!row.in_use || row.in_use[first / tile_width]) {
      for (Size i = 0; i < width; ++i) {
        const double x = row.p[first + i], y = g.value[i];
        const double loaded = x > 0 ? 1.0 : 0.0, free = x < row.bound ? loaded : 0.0;
        const double part = x * (y - row.plane);
        pressure.value[i] += x;
        free_count.value[i] += free;
        free_g.value[i] += free * y;
        misfit.value[i] += part;
        distance.value[i] += part < 0 ? -part : part;
        saturated.value[i] += x < row.bound ? 0.0 : 1.0;
        close.value[i] = x > 0 ? -__builtin_inf() : y;
      }
    }
    const double of_tile = close.least();
    row.nearest[first / tile_width] = of_tile;
    if (of_tile < row.kept_below)
      for (Size i = 0; i < width; ++i) row.g[first + i] = g.value[i];
  });
  const double lowest = least.least();
  return {pressure.sum(), free_count.sum(), free_g.sum(), misfit.sum(),
          distance.sum(), saturated.sum(),  lowest};
}

double clip(double* p, Size count, double bound) {
  Lanes sum;
  for_runs(count, [&](Size first, auto width) {
    for (Size i = 0; i < width; ++i) {
      const double above = p[first + i] < 0 ? 0.0 : p[first + i];
      const double kept = above < bound ? above : bound;
      p[first + i] = kept;
      sum.value[i] += kept;
    }
  });
  return sum.sum();
}

template <class Real>
TileKernels<Real> table() {
  return {residual<Real>,   precondition<Real>,  direct<Real>,
          take_image<Real>, step<Real>,          change_set<Real>,
          truncate<Real>,   spread_change<Real>, add_displacement<Real>,
          gap<Real>,        gap<double>,         clip};
}

TileKernels<float> table_float() { return table<float>(); }
TileKernels<double> table_double() { return table<double>(); }

}  // namespace salebra::detail::SALEBRA_SIMD
