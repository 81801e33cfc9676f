// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>

#include "contact/half_space/multilevel_passes.hpp"

// The passes of the multilevel kernel in their plainest form, cell by cell. The tests compare the
// fast passes with these; a reader should begin here.
namespace salebra::detail::reference {

// The cubic B-spline at a distance of k cells of the finer grid.
inline float spline_tap(std::ptrdiff_t k) {
  constexpr std::array<float, 3> taps = {0.75f, 0.5f, 0.125f};
  const auto distance = static_cast<std::size_t>(std::abs(k));
  return distance < taps.size() ? taps[distance] : 0.0f;
}

template <class Body>
void for_tile_cells(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end, std::ptrdiff_t ny,
                    const Body& body) {
  for (std::ptrdiff_t t = begin; t < end; ++t)
    for (std::ptrdiff_t j = tiles[t].column;
         j < std::min<std::ptrdiff_t>(tiles[t].column + tile_width, ny); ++j)
      body(std::ptrdiff_t(tiles[t].row), j);
}

inline void restriction(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                        const HaloView& fine, const Shift& shift, const HaloView& coarse) {
  for_tile_cells(tiles, begin, end, coarse.ny, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    float sum = 0;
    for (std::ptrdiff_t a = -2; a <= 2; ++a)
      for (std::ptrdiff_t b = -2; b <= 2; ++b)
        sum += spline_tap(a) * spline_tap(b) *
               fine.first[(2 * i - shift.x + a) * fine.stride + 2 * j - shift.y + b];
    coarse.first[i * coarse.stride + j] = sum;
  });
}

// T source + P coarse at one cell.
inline float ascended(const Ascent& sum, int radius, std::ptrdiff_t i, std::ptrdiff_t j) {
  const auto& [source, stencil, coarse, shift] = sum;
  float near = 0, far = 0;
  for (int a = -radius; a <= radius; ++a)
    for (int b = -radius; b <= radius; ++b)
      near += stencil[(a + radius) * (2 * radius + 1) + b + radius] *
              source.first[(i + a) * source.stride + j + b];
  const std::ptrdiff_t x = i + shift.x, y = j + shift.y;
  for (std::ptrdiff_t a = x / 2 - 1; a <= x / 2 + 1; ++a)
    for (std::ptrdiff_t b = y / 2 - 1; b <= y / 2 + 1; ++b)
      far += spline_tap(2 * a - x) * spline_tap(2 * b - y) * coarse.first[a * coarse.stride + b];
  return near + far;
}

inline void ascent(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end, const Ascent& sum,
                   const HaloView& image) {
  for_tile_cells(tiles, begin, end, image.ny, [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    image.first[i * image.stride + j] = ascended(sum, 2, i, j);
  });
}

inline void last_ascent(const Tile* tiles, std::ptrdiff_t begin, std::ptrdiff_t end,
                        const Ascent& sum, float* row) {
  for_tile_cells(tiles, begin, end, sum.source.ny,
                 [&](std::ptrdiff_t i, std::ptrdiff_t j) { row[j] = ascended(sum, 3, i, j); });
}

inline void at_cells(const double* field, std::ptrdiff_t stride, const double* stencil,
                     const std::ptrdiff_t* cells, std::ptrdiff_t begin, std::ptrdiff_t end,
                     double* sums) {
  for (std::ptrdiff_t k = begin; k < end; ++k) {
    sums[k] = 0;
    for (int a = -halo; a <= halo; ++a)
      for (int b = -halo; b <= halo; ++b)
        sums[k] +=
            stencil[(a + halo) * (2 * halo + 1) + b + halo] * field[cells[k] + a * stride + b];
  }
}

inline MultilevelKernels multilevel_table() { return {restriction, ascent, last_ascent, at_cells}; }

}  // namespace salebra::detail::reference
