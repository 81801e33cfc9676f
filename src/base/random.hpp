// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <span>

/// Random numbers without a state: each is a function of a seed and of the lattice point (i, j)
/// that it belongs to. It does not depend on the order of drawing, the number of threads or the
/// size of the grid.
///
/// The bits are those of Philox4x32 with 10 rounds of Salmon et al. (2011): key = the two halves of
/// the seed, counter = (i, j, stream, 0), i and j in two's complement. Different streams of one
/// seed are independent. Logarithm, sine and cosine are computed here, to about 2 units in the last
/// place and without fused operations, so the numbers have the same bits on every machine with IEEE
/// arithmetic.
namespace salebra {

/// Two independent random numbers.
struct RandomPair {
  double first = 0;
  double second = 0;
};

/// The 128 random bits of a lattice point (i, j).
std::array<std::uint32_t, 4> random_bits(std::uint64_t seed, std::int32_t i, std::int32_t j,
                                         std::uint32_t stream = 0);

/// Uniform in the open interval (0, 1), in odd multiples of 2⁻⁵³: never 0, never 1.
RandomPair uniform_pair(std::uint64_t seed, std::int32_t i, std::int32_t j,
                        std::uint32_t stream = 0);

/// Two standard normal numbers, √(−2 ln u₁) cos 2πu₂ and √(−2 ln u₁) sin 2πu₂ (Box and Muller),
/// where (u₁, u₂) is the uniform_pair() of the same arguments. Maximum magnitude: 8.57.
RandomPair gaussian_pair(std::uint64_t seed, std::int32_t i, std::int32_t j,
                         std::uint32_t stream = 0);

/// pairs[k] = gaussian_pair(seed, i + k, j) as real and imaginary part, vectorised.
void fill_gaussian(std::uint64_t seed, std::int32_t i, std::int32_t j,
                   std::span<std::complex<double>> pairs, std::uint32_t stream = 0);

/// factors[k] = exp(2πi u₂) with the second number u₂ of uniform_pair(seed, i + k, j), vectorised.
/// The k-th number of fill_gaussian() has this phase.
void fill_phase_factors(std::uint64_t seed, std::int32_t i, std::int32_t j,
                        std::span<std::complex<double>> factors, std::uint32_t stream = 0);

/// indices[k] = ⌊count u₁⌋ with the first number u₁ of uniform_pair(seed, i, j + k), vectorised:
/// draws with replacement from 0 … count − 1. count: 1 to 2³¹ − 1.
void fill_draws(std::uint64_t seed, std::int32_t i, std::int32_t j, std::int32_t count,
                std::span<std::int32_t> indices, std::uint32_t stream = 0);

}  // namespace salebra
