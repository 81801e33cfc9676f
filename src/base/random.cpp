// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers keyed by seed and wave vector: Philox 4x32-10, Box-Muller, random phases.
#include "random.hpp"

#include <Random123/philox.h>

#include "elementary.hpp"

namespace salebra {
namespace {

struct Words {
  std::uint32_t w0, w1, w2, w3;
};

// Computes the random bits of Random123's philox4x32_R(10, …), with single variables in place of
// its array of four words, because compilers do not vectorise a loop over that array. A test
// compares this function with Random123's.
SALEBRA_INLINE Words philox(std::uint64_t seed, std::int32_t i, std::int32_t j,
                            std::uint32_t stream) {
  Words w{static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), stream, 0};
  auto key0 = static_cast<std::uint32_t>(seed);
  auto key1 = static_cast<std::uint32_t>(seed >> 32);
#pragma GCC unroll 10
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{PHILOX_M4x32_0} * w.w0;
    const std::uint64_t product1 = std::uint64_t{PHILOX_M4x32_1} * w.w2;
    w = {static_cast<std::uint32_t>(product1 >> 32) ^ w.w1 ^ key0,
         static_cast<std::uint32_t>(product1),
         static_cast<std::uint32_t>(product0 >> 32) ^ w.w3 ^ key1,
         static_cast<std::uint32_t>(product0)};
    key0 += PHILOX_W32_0;
    key1 += PHILOX_W32_1;
  }
  return w;
}

// Uses the upper 52 bits as the mantissa of a number in [1, 2), subtracts 1 and adds half a step;
// every operation is exact.
SALEBRA_INLINE double open_unit_interval(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t word = static_cast<std::uint64_t>(high) << 32 | low;
  return (std::bit_cast<double>(word >> 12 | 0x3FF0000000000000u) - 1.0) + 0x1p-53;
}

// cos 2πu and sin 2πu for u in (0, 1). The nearest multiple of a quarter turn is split off exactly;
// the remaining angle, at most an eighth of a turn, goes into Taylor series truncated below 1e-16.
SALEBRA_INLINE RandomPair turn(double u) {
  const double lifted = 4.0 * u + detail::round_by_adding;
  const std::uint64_t quarter = std::bit_cast<std::uint64_t>(lifted);
  const double x = 2.0 * std::numbers::pi * (u - 0.25 * (lifted - detail::round_by_adding));
  const double square = x * x;
  double sine = -1.0 / 1307674368000;
  sine = sine * square + 1.0 / 6227020800;
  sine = sine * square - 1.0 / 39916800;
  sine = sine * square + 1.0 / 362880;
  sine = sine * square - 1.0 / 5040;
  sine = sine * square + 1.0 / 120;
  sine = sine * square - 1.0 / 6;
  sine = x + x * (square * sine);
  double cosine = 1.0 / 20922789888000;
  cosine = cosine * square - 1.0 / 87178291200;
  cosine = cosine * square + 1.0 / 479001600;
  cosine = cosine * square - 1.0 / 3628800;
  cosine = cosine * square + 1.0 / 40320;
  cosine = cosine * square - 1.0 / 720;
  cosine = cosine * square + 1.0 / 24;
  cosine = 1.0 - square * 0.5 + square * square * cosine;
  const bool odd = quarter & 1;
  const std::uint64_t cosine_sign = ((quarter + 1) & 2) << 62;
  const std::uint64_t sine_sign = (quarter & 2) << 62;
  return {std::bit_cast<double>(std::bit_cast<std::uint64_t>(odd ? sine : cosine) ^ cosine_sign),
          std::bit_cast<double>(std::bit_cast<std::uint64_t>(odd ? cosine : sine) ^ sine_sign)};
}

SALEBRA_INLINE RandomPair box_muller(Words bits) {
  const double radius =
      __builtin_sqrt(-2.0 * detail::natural_log(open_unit_interval(bits.w0, bits.w1)));
  const RandomPair direction = turn(open_unit_interval(bits.w2, bits.w3));
  return {radius * direction.first, radius * direction.second};
}

SALEBRA_VECTOR_WIDTHS
void fill_gaussian_numbers(std::uint64_t seed, std::int32_t i, std::int32_t j, std::uint32_t stream,
                           double* numbers, std::int32_t count) {
#pragma omp simd
  for (std::int32_t k = 0; k < count; ++k) {
    const RandomPair pair = box_muller(philox(seed, i + k, j, stream));
    numbers[2 * k] = pair.first;
    numbers[2 * k + 1] = pair.second;
  }
}

SALEBRA_VECTOR_WIDTHS
void fill_phase_numbers(std::uint64_t seed, std::int32_t i, std::int32_t j, std::uint32_t stream,
                        double* numbers, std::int32_t count) {
#pragma omp simd
  for (std::int32_t k = 0; k < count; ++k) {
    const Words bits = philox(seed, i + k, j, stream);
    const RandomPair pair = turn(open_unit_interval(bits.w2, bits.w3));
    numbers[2 * k] = pair.first;
    numbers[2 * k + 1] = pair.second;
  }
}

SALEBRA_VECTOR_WIDTHS
void fill_indices(std::uint64_t seed, std::int32_t i, std::int32_t j, std::uint32_t stream,
                  double count, std::span<std::int32_t> draws) {
  std::int32_t* const indices = draws.data();
  const auto length = static_cast<std::int32_t>(draws.size());
#pragma omp simd
  for (std::int32_t k = 0; k < length; ++k) {
    const Words bits = philox(seed, i, j + k, stream);
    indices[k] = static_cast<std::int32_t>(open_unit_interval(bits.w0, bits.w1) * count);
  }
}

}  // namespace

std::array<std::uint32_t, 4> random_bits(std::uint64_t seed, std::int32_t i, std::int32_t j,
                                         std::uint32_t stream) {
  const Words bits = philox(seed, i, j, stream);
  return {bits.w0, bits.w1, bits.w2, bits.w3};
}

RandomPair uniform_pair(std::uint64_t seed, std::int32_t i, std::int32_t j, std::uint32_t stream) {
  const Words bits = philox(seed, i, j, stream);
  return {open_unit_interval(bits.w0, bits.w1), open_unit_interval(bits.w2, bits.w3)};
}

RandomPair gaussian_pair(std::uint64_t seed, std::int32_t i, std::int32_t j, std::uint32_t stream) {
  return box_muller(philox(seed, i, j, stream));
}

void fill_gaussian(std::uint64_t seed, std::int32_t i, std::int32_t j,
                   std::span<std::complex<double>> pairs, std::uint32_t stream) {
  fill_gaussian_numbers(seed, i, j, stream, reinterpret_cast<double*>(pairs.data()),
                        static_cast<std::int32_t>(pairs.size()));
}

void fill_phase_factors(std::uint64_t seed, std::int32_t i, std::int32_t j,
                        std::span<std::complex<double>> factors, std::uint32_t stream) {
  fill_phase_numbers(seed, i, j, stream, reinterpret_cast<double*>(factors.data()),
                     static_cast<std::int32_t>(factors.size()));
}

void fill_draws(std::uint64_t seed, std::int32_t i, std::int32_t j, std::int32_t count,
                std::span<std::int32_t> indices, std::uint32_t stream) {
  fill_indices(seed, i, j, stream, count, indices);
}

}  // namespace salebra
