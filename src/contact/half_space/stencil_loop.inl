// SPDX-License-Identifier: GPL-3.0-or-later
// Included once for each instruction set, with SALEBRA_SIMD naming it: a stencil applied to the 16
// cells of a tile.
#include "tile.hpp"

#ifndef SALEBRA_INLINE
#define SALEBRA_INLINE inline __attribute__((always_inline))
#endif

namespace salebra::detail::SALEBRA_SIMD {

// A vector type wider than the registers compiles to code that is several times slower than no
// vectors at all.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

// Σ weight(i, j) x(i, j) over |i|, |j| <= radius around each of 16 cells of a field with a halo. The
// weights, (2 radius + 1)², are symmetric about both axes.
#if defined(__AVX512F__)
// Reads whole cache lines: rows above and below are added before they are weighted, and neighbours
// in a row come from two registers by one permutation, which is cheaper than a load that crosses a
// line.
template <class Real, int radius>
struct StencilLoop {
  typedef Real Vector __attribute__((vector_size(register_bytes)));
  static constexpr int lanes = register_bytes / static_cast<int>(sizeof(Real)),
                       registers = tile_width / lanes;

  // The numbers that begin `shift` places after the first of low, where high follows low.
  template <int shift>
  static SALEBRA_INLINE Vector shifted(Vector low, Vector high) {
    if constexpr (lanes == 16) {
      return __builtin_shufflevector(low, high, shift, shift + 1, shift + 2, shift + 3, shift + 4,
                                     shift + 5, shift + 6, shift + 7, shift + 8, shift + 9,
                                     shift + 10, shift + 11, shift + 12, shift + 13, shift + 14,
                                     shift + 15);
    } else {
      return __builtin_shufflevector(low, high, shift, shift + 1, shift + 2, shift + 3, shift + 4,
                                     shift + 5, shift + 6, shift + 7);
    }
  }
  template <int shift>
  static SALEBRA_INLINE Vector beside(Vector before, Vector here, Vector after) {
    return shifted<shift>(here, after) + shifted<lanes - shift>(before, here);
  }

  static SALEBRA_INLINE void apply(const Real* centre, std::ptrdiff_t stride, const Real* weights,
                                   Real* sums) {
    static_assert(radius == 2 || radius == 3);
    Vector total[registers] = {};
#pragma GCC unroll 4
    for (int i = 0; i <= radius; ++i) {
      Vector row[registers + 2];
      for (int k = 0; k < registers + 2; ++k) {
        const Real* index = centre + (k - 1) * lanes;
        __builtin_memcpy(&row[k], index + i * stride, sizeof(Vector));
        if (i > 0) {
          Vector other;
          __builtin_memcpy(&other, index - i * stride, sizeof(Vector));
          row[k] += other;
        }
      }
      const Real* weight = weights + (radius + i) * (2 * radius + 1) + radius;
      for (int k = 1; k <= registers; ++k) {
        Vector& sum = total[k - 1];
        sum += weight[0] * row[k];
        sum += weight[1] * beside<1>(row[k - 1], row[k], row[k + 1]);
        sum += weight[2] * beside<2>(row[k - 1], row[k], row[k + 1]);
        if constexpr (radius == 3) sum += weight[3] * beside<3>(row[k - 1], row[k], row[k + 1]);
      }
    }
    for (int k = 0; k < registers; ++k)
      __builtin_memcpy(sums + k * lanes, &total[k], sizeof(Vector));
  }
};
#else
// In as many registers as 16 sums need, in two chains so that additions overlap.
template <class Real, int radius>
struct StencilLoop {
  static SALEBRA_INLINE void apply(const Real* centre, std::ptrdiff_t stride, const Real* weights,
                                   Real* sums) {
    typedef Real Vector __attribute__((vector_size(register_bytes)));
    constexpr int lanes = register_bytes / static_cast<int>(sizeof(Real)),
                  registers = tile_width / lanes;
    Vector chain[2][registers] = {};
    for (int i = -radius; i <= radius; ++i) {
      const Real* row = centre + i * stride;
      const Real* weight = weights + (i + radius) * (2 * radius + 1) + radius;
#pragma GCC unroll 7
      for (int j = -radius; j <= radius; ++j)
#pragma GCC unroll 8
        for (int k = 0; k < registers; ++k) {
          Vector neighbour;
          __builtin_memcpy(&neighbour, row + j + k * lanes, sizeof(neighbour));
          chain[j & 1][k] += weight[j] * neighbour;
        }
    }
    for (int k = 0; k < registers; ++k) {
      const Vector total = chain[0][k] + chain[1][k];
      __builtin_memcpy(sums + k * lanes, &total, sizeof(total));
    }
  }
};
#endif

}  // namespace salebra::detail::SALEBRA_SIMD
