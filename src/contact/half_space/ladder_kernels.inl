// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, with SALEBRA_SIMD naming it.
#include "ladder_kernels.hpp"
#include "stencil_loop.inl"

namespace salebra::detail::SALEBRA_SIMD {

using Length = std::ptrdiff_t;

typedef float Floats __attribute__((vector_size(register_bytes)));
typedef int Places __attribute__((vector_size(register_bytes)));
inline constexpr int lane_count = register_bytes / 4, registers_of_tile = tile_width / lane_count;

// Of a framed field: rows of another tile are not predicted by the processor's prefetcher.
inline constexpr Length tiles_ahead = 8;

SALEBRA_INLINE const float* cell(const FramedView& field, Length row, Length column) {
  return field.first + row * field.stride + column;
}

SALEBRA_INLINE Floats load(const float* place) {
  Floats numbers;
  __builtin_memcpy(&numbers, place, sizeof(numbers));
  return numbers;
}

// Stores the part of 16 numbers that lies within the row.
SALEBRA_INLINE void store(const float* numbers, Length width, float* place) {
  if (width >= tile_width) {
    __builtin_memcpy(place, numbers, tile_width * sizeof(float));
  } else {
    for (Length k = 0; k < width; ++k) place[k] = numbers[k];
  }
}

// first + step·lane of each lane.
SALEBRA_INLINE Places places(int first, int step) {
  Places result{};
  for (int lane = 0; lane < lane_count; ++lane) result[lane] = first + step * lane;
  return result;
}

void restriction(const Tile* tiles, Length begin, Length end, const FramedView& fine,
                 const Shift& shift, const FramedView& coarse) {
  const auto column_sum = [&](const float* centre) {
    const Length stride = fine.stride;
    return 0.125f * (load(centre - 2 * stride) + load(centre + 2 * stride)) +
           0.5f * (load(centre - stride) + load(centre + stride)) + 0.75f * load(centre);
  };
  // Of two registers one after the other: every second number, from the first and from the second …
  const Places evens = places(0, 2), odds = places(1, 2);
  // … and the evens or odds that begin one or two later, the last from the register after: its numbers 0 and 2, or 1.
  Places second_even = places(1, 1), third_even = places(2, 1), second_odd = places(1, 1);
  second_odd[lane_count - 1] = lane_count + 1;
  third_even[lane_count - 1] = lane_count + 2;
  for (Length t = begin; t < end; ++t) {
    const Length row = tiles[t].row, column = tiles[t].column;
    const float* centre = cell(fine, 2 * row - shift.x, 2 * column - shift.y - 2);
    float result[tile_width];
    Floats sum = column_sum(centre);
    for (int k = 0; k < registers_of_tile; ++k) {
      const Floats next = column_sum(centre + (2 * k + 1) * lane_count),
                   after = column_sum(centre + (2 * k + 2) * lane_count);
      const Floats even = __builtin_shuffle(sum, next, evens),
                   odd = __builtin_shuffle(sum, next, odds);
      const Floats here = 0.125f * (even + __builtin_shuffle(even, after, third_even)) +
                          0.5f * (odd + __builtin_shuffle(odd, after, second_odd)) +
                          0.75f * __builtin_shuffle(even, after, second_even);
      __builtin_memcpy(result + k * lane_count, &here, sizeof(here));
      sum = after;
    }
    store(result, coarse.ny - column, coarse.first + row * coarse.stride + column);
  }
}

// 16 cells of P coarse. Cell 2m of the row takes ⅛, ¾, ⅛ of the coarse cells m − 1, m, m + 1, cell 2m + 1 half of m and of m + 1.
SALEBRA_INLINE void interpolated(const FramedView& coarse, const Shift& shift, const Tile& tile,
                                 float* result) {
  const Length x = tile.row + shift.x, y = tile.column + shift.y;
  const float* centre = cell(coarse, x / 2, y / 2 - 1);
  Places first{};
  Floats before_weight{}, weight{};
  for (int lane = 0; lane < lane_count; ++lane) {
    first[lane] = lane / 2;
    before_weight[lane] = lane % 2 == 0 ? 0.125f : 0.0f;
    weight[lane] = lane % 2 == 0 ? 0.75f : 0.5f;
  }
  const Floats after_weight = 1.0f - before_weight - weight;
  for (int k = 0; k < registers_of_tile; ++k) {
    const float* place = centre + k * (lane_count / 2);
    const Floats here = load(place), after = load(place + coarse.stride);
    const Floats sum = x % 2 != 0
                           ? 0.5f * (here + after)
                           : 0.125f * (load(place - coarse.stride) + after) + 0.75f * here;
    const Floats numbers = before_weight * __builtin_shuffle(sum, first) +
                           weight * __builtin_shuffle(sum, first + 1) +
                           after_weight * __builtin_shuffle(sum, first + 2);
    __builtin_memcpy(result + k * lane_count, &numbers, sizeof(numbers));
  }
}

template <int radius>
SALEBRA_INLINE void ascend(const FramedView& source, const float* stencil, const FramedView& coarse,
                           const Shift& shift, const Tile& tile, float* result) {
  float far[tile_width], near[tile_width];
  interpolated(coarse, shift, tile, far);
  StencilLoop<float, radius>::apply(cell(source, tile.row, tile.column), source.stride, stencil,
                                    near);
  for (int k = 0; k < tile_width; ++k) result[k] = far[k] + near[k];
}

void ascent(const Tile* tiles, Length begin, Length end, const FramedView& source,
            const float* stencil, const FramedView& coarse, const Shift& shift,
            const FramedView& image) {
  for (Length t = begin; t < end; ++t) {
    float result[tile_width];
    ascend<2>(source, stencil, coarse, shift, tiles[t], result);
    store(result, image.ny - tiles[t].column,
          image.first + tiles[t].row * image.stride + tiles[t].column);
  }
}

void last_ascent(const Tile* tiles, Length begin, Length end, const FramedView& source,
                 const float* stencil, const FramedView& coarse, const Shift& shift, float* row) {
  for (Length t = begin; t < end; ++t) {
    if (t + tiles_ahead < end) {
      const Tile& next = tiles[t + tiles_ahead];
      __builtin_prefetch(cell(source, next.row + frame, next.column));
    }
    float result[tile_width];
    ascend<3>(source, stencil, coarse, shift, tiles[t], result);
    store(result, source.ny - tiles[t].column, row + tiles[t].column);
  }
}

LadderKernels ladder_table() { return {restriction, ascent, last_ascent}; }

}  // namespace salebra::detail::SALEBRA_SIMD
