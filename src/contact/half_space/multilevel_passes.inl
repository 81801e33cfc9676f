// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, which SALEBRA_SIMD names.
#include "multilevel_passes.hpp"
#include "stencil_loop.inl"

namespace salebra::detail::SALEBRA_SIMD {

using Length = std::ptrdiff_t;

typedef float Floats __attribute__((vector_size(register_bytes)));
inline constexpr int lane_count = register_bytes / 4, registers_of_tile = tile_width / lane_count;

// Number of tiles to prefetch ahead in a field with a halo: the processor does not predict that the
// next tile may lie in another row.
inline constexpr Length tiles_ahead = 8;

SALEBRA_INLINE const float* cell(const HaloView& field, Length row, Length column) {
  return field.first + row * field.stride + column;
}

SALEBRA_INLINE Floats load(const float* from) {
  Floats numbers;
  __builtin_memcpy(&numbers, from, sizeof(numbers));
  return numbers;
}

// Stores at `index` those of 16 numbers that lie within the row, of which `width` cells remain.
SALEBRA_INLINE void store(const float* numbers, Length width, float* to) {
  if (width >= tile_width) {
    __builtin_memcpy(to, numbers, tile_width * sizeof(float));
  } else {
    for (Length k = 0; k < width; ++k) to[k] = numbers[k];
  }
}

// The lane numbers 0, 1, 2 and so on of a register as template arguments: both compilers require
// constants as the indices of a shuffle, and these can then be formulas of `lane`.
template <int... lane>
struct Each {};
template <int count, int... lane>
struct Counted : Counted<count - 1, count - 1, lane...> {};
template <int... lane>
struct Counted<0, lane...> {
  using Lanes = Each<lane...>;
};
using EachLane = Counted<lane_count>::Lanes;

// Returns every second number of two successive registers, starting with number `first`.
template <int first, int... lane>
SALEBRA_INLINE Floats every_second(Floats low, Floats high, Each<lane...>) {
  return __builtin_shufflevector(low, high, (2 * lane + first)...);
}
// Returns `every`, which holds every second number of a sequence, without its first `first`
// numbers. The free lanes at the end are filled with the numbers at `parity`, parity + 2 and so on
// of `after`, the next register of the sequence.
template <int first, int parity, int... lane>
SALEBRA_INLINE Floats onwards(Floats every, Floats after, Each<lane...>) {
  return __builtin_shufflevector(
      every, after,
      (lane + first < lane_count ? lane + first
                                 : lane_count + 2 * (lane + first - lane_count) + parity)...);
}
// Returns each number twice, starting with number `first`.
template <int first, int... lane>
SALEBRA_INLINE Floats twice(Floats numbers, Each<lane...>) {
  return __builtin_shufflevector(numbers, numbers, (lane / 2 + first)...);
}

void restriction(const Tile* tiles, Length begin, Length end, const HaloView& fine,
                 const Shift& shift, const HaloView& coarse) {
  const auto column_sum = [&](const float* centre) {
    const Length stride = fine.stride;
    return 0.125f * (load(centre - 2 * stride) + load(centre + 2 * stride)) +
           0.5f * (load(centre - stride) + load(centre + stride)) + 0.75f * load(centre);
  };
  for (Length t = begin; t < end; ++t) {
    const Length row = tiles[t].row, column = tiles[t].column;
    const float* centre = cell(fine, 2 * row - shift.x, 2 * column - shift.y - 2);
    float result[tile_width];
    Floats sum = column_sum(centre);
    for (int k = 0; k < registers_of_tile; ++k) {
      const Floats next = column_sum(centre + (2 * k + 1) * lane_count),
                   after = column_sum(centre + (2 * k + 2) * lane_count);
      const Floats even = every_second<0>(sum, next, EachLane{}),
                   odd = every_second<1>(sum, next, EachLane{});
      const Floats here = 0.125f * (even + onwards<2, 0>(even, after, EachLane{})) +
                          0.5f * (odd + onwards<1, 1>(odd, after, EachLane{})) +
                          0.75f * onwards<1, 0>(even, after, EachLane{});
      __builtin_memcpy(result + k * lane_count, &here, sizeof(here));
      sum = after;
    }
    store(result, coarse.ny - column, coarse.first + row * coarse.stride + column);
  }
}

// Computes 16 cells of the interpolation P coarse. Along the row, cell 2m of the finer grid takes
// ⅛, ¾ and ⅛ of the coarse cells m − 1, m and m + 1; cell 2m + 1 takes half of the coarse cell m
// and half of m + 1.
SALEBRA_INLINE void interpolated(const HaloView& coarse, const Shift& shift, const Tile& tile,
                                 float* result) {
  const Length x = tile.row + shift.x, y = tile.column + shift.y;
  const float* centre = cell(coarse, x / 2, y / 2 - 1);
  Floats before_weight{}, weight{};
  for (int lane = 0; lane < lane_count; ++lane) {
    before_weight[lane] = lane % 2 == 0 ? 0.125f : 0.0f;
    weight[lane] = lane % 2 == 0 ? 0.75f : 0.5f;
  }
  const Floats after_weight = 1.0f - before_weight - weight;
  for (int k = 0; k < registers_of_tile; ++k) {
    const float* from = centre + k * (lane_count / 2);
    const Floats here = load(from), after = load(from + coarse.stride);
    const Floats sum = x % 2 != 0 ? 0.5f * (here + after)
                                  : 0.125f * (load(from - coarse.stride) + after) + 0.75f * here;
    const Floats numbers = before_weight * twice<0>(sum, EachLane{}) +
                           weight * twice<1>(sum, EachLane{}) +
                           after_weight * twice<2>(sum, EachLane{});
    __builtin_memcpy(result + k * lane_count, &numbers, sizeof(numbers));
  }
}

template <int radius>
SALEBRA_INLINE void ascend(const Ascent& sum, const Tile& tile, float* result) {
  float far[tile_width], near[tile_width];
  interpolated(sum.coarse, sum.shift, tile, far);
  StencilLoop<float, radius>::apply(cell(sum.source, tile.row, tile.column), sum.source.stride,
                                    sum.stencil, near);
  for (int k = 0; k < tile_width; ++k) result[k] = far[k] + near[k];
}

void ascent(const Tile* tiles, Length begin, Length end, const Ascent& sum, const HaloView& image) {
  for (Length t = begin; t < end; ++t) {
    float result[tile_width];
    ascend<2>(sum, tiles[t], result);
    store(result, image.ny - tiles[t].column,
          image.first + tiles[t].row * image.stride + tiles[t].column);
  }
}

void last_ascent(const Tile* tiles, Length begin, Length end, const Ascent& sum, float* row) {
  for (Length t = begin; t < end; ++t) {
    if (t + tiles_ahead < end) {
      const Tile& next = tiles[t + tiles_ahead];
      __builtin_prefetch(cell(sum.source, next.row + halo, next.column));
    }
    float result[tile_width];
    ascend<3>(sum, tiles[t], result);
    store(result, sum.source.ny - tiles[t].column, row + tiles[t].column);
  }
}

// Most cells have neighbours in their row, so 16 cells are computed together. The sum of a cell has
// the same bits at each position among the 16.
void at_cells(const double* field, Length stride, const double* stencil, const Length* cells,
              Length begin, Length end, double* sums) {
  for (Length k = begin; k < end;) {
    const Length first = cells[k];
    double together[tile_width];
    StencilLoop<double, halo>::apply(field + first, stride, stencil, together);
    for (; k < end && cells[k] - first < tile_width; ++k) sums[k] = together[cells[k] - first];
  }
}

MultilevelKernels multilevel_table() { return {restriction, ascent, last_ascent, at_cells}; }

}  // namespace salebra::detail::SALEBRA_SIMD
