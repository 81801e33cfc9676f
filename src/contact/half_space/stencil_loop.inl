// SPDX-License-Identifier: GPL-3.0-or-later
// Applies a stencil to the 16 cells of a tile. Included once for each instruction set, which
// SALEBRA_SIMD names.
#include "tile.hpp"

#ifndef SALEBRA_INLINE
#define SALEBRA_INLINE inline __attribute__((always_inline))
#endif

namespace salebra::detail::SALEBRA_SIMD {

// Bytes of a vector register. A vector type wider than the processor's registers compiles to code
// that is several times slower than code without vectors.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

// Computes Σ weight(i, j) x(a + i, b + j) over |i|, |j| <= radius for each of 16 cells (a, b) of a
// field x with a halo. The (2 radius + 1)² weights are symmetric about both axes.
#if defined(__AVX512F__)
// Version for AVX-512. Reads whole cache lines: rows above and below are added before they are
// weighted, and neighbours in a row are taken from two registers by one permutation, which is
// cheaper than a load that crosses a cache line.
template <class Real, int radius>
struct StencilLoop {
  typedef Real Vector __attribute__((vector_size(register_bytes)));
  static constexpr int lanes = register_bytes / static_cast<int>(sizeof(Real)),
                       registers = tile_width / lanes;

  // Returns consecutive numbers, starting with number `shift` of `low` and continuing in `high`.
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
// Version for narrower registers. Uses as many registers as 16 sums need, in two chains so that
// additions overlap in time.
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
