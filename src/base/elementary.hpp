// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

// Elementary functions that a compiler can vectorise, unlike those of the standard library, with
// the same bits for every vector width. Sources that include this file are compiled without fused
// multiply-add operations (src/base/CMakeLists.txt).

// Compiles a function for each vector width; the program chooses the width at its start.
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define SALEBRA_VECTOR_WIDTHS __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define SALEBRA_VECTOR_WIDTHS
#endif
// Inlining is forced because a separate function would be compiled for the narrowest vectors.
#define SALEBRA_INLINE inline __attribute__((always_inline))

namespace salebra::detail {

// Adding this constant rounds a number below 2^51 to an integer in the lowest bits of the sum.
constexpr double round_by_adding = 0x1.8p52;

// ln x for normal x > 0: x = 2^e m with m in [√½, √2), ln m = 2 artanh s, s = (m−1)/(m+1),
// |s| < 0.172. The truncated terms of the series are below 3e-17 of the sum.
SALEBRA_INLINE double natural_log(double x) {
  constexpr std::uint64_t sqrt_half = 0x3FE6A09E667F3BCDu;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  const std::uint64_t shifted = bits - sqrt_half;
  // The exponent, biased to be positive, is converted to a double through the mantissa, because
  // 64-bit integers have no vector conversion before AVX-512.
  const std::uint64_t biased = ((shifted >> 52) + 2048) & 0xFFF;
  const double exponent = std::bit_cast<double>(biased | 0x4330000000000000u) - (0x1p52 + 2048.0);
  const double m = std::bit_cast<double>(bits - ((shifted >> 52) << 52));
  const double s = (m - 1.0) / (m + 1.0);
  const double square = s * s;
  double series = 1.0 / 19;
  series = series * square + 1.0 / 17;
  series = series * square + 1.0 / 15;
  series = series * square + 1.0 / 13;
  series = series * square + 1.0 / 11;
  series = series * square + 1.0 / 9;
  series = series * square + 1.0 / 7;
  series = series * square + 1.0 / 5;
  series = series * square + 1.0 / 3;
  const double log_m = 2.0 * s + 2.0 * s * (square * series);
  return exponent * std::numbers::ln2 + log_m;
}

// e^y for |y| < 700: y = k ln 2 + r with integer k and |r| <= ½ ln 2, hence e^y = 2^k e^r, and the
// Taylor series of e^r, truncated below 1e-17.
SALEBRA_INLINE double exponential(double y) {
  const double lifted = y * std::numbers::log2e + round_by_adding;
  const double k = lifted - round_by_adding;
  // ln 2 is split in two parts; the first has 32 bits, which makes its product with k exact.
  constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
  const double r = (y - k * ln2_high) - k * ln2_low;
  double series = 1.0 / 6227020800;
  series = series * r + 1.0 / 479001600;
  series = series * r + 1.0 / 39916800;
  series = series * r + 1.0 / 3628800;
  series = series * r + 1.0 / 362880;
  series = series * r + 1.0 / 40320;
  series = series * r + 1.0 / 5040;
  series = series * r + 1.0 / 720;
  series = series * r + 1.0 / 120;
  series = series * r + 1.0 / 24;
  series = series * r + 1.0 / 6;
  series = series * r + 0.5;
  series = 1.0 + (r + r * r * series);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(series) +
                               (std::bit_cast<std::uint64_t>(lifted) << 52));
}

}  // namespace salebra::detail
