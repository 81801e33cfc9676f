// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/random.hpp"

#include <Random123/philox.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace salebra;

TEST_CASE("Random bits are those of Philox4x32-10", "[random]") {
  for (int k = 0; k < 1000; ++k) {
    const std::uint64_t seed = 0x9E3779B97F4A7C15u * std::uint64_t(k);
    const int i = k - 500, j = 7 * k - 3000;
    const std::uint32_t stream = k % 3;
    const philox4x32_ctr_t counter{{std::uint32_t(i), std::uint32_t(j), stream, 0}};
    const philox4x32_key_t key{{std::uint32_t(seed), std::uint32_t(seed >> 32)}};
    const philox4x32_ctr_t expected = philox4x32(counter, key);
    REQUIRE(
        random_bits(seed, i, j, stream) ==
        std::array<std::uint32_t, 4>{expected.v[0], expected.v[1], expected.v[2], expected.v[3]});
  }
  // The first of Random123's published known answers (kat_vectors).
  CHECK(random_bits(0, 0, 0) ==
        std::array<std::uint32_t, 4>{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(random_bits(1, 0, 0) != random_bits(std::uint64_t{1} << 32, 0, 0));
  CHECK(random_bits(0, 1, 2) != random_bits(0, 2, 1));
  CHECK(random_bits(0, 1, 2) != random_bits(0, -1, -2));
  CHECK(random_bits(0, 1, 0, 0) != random_bits(0, 0, 0, 1));
}

TEST_CASE("Gaussian pairs follow Box and Muller's formula", "[random]") {
  double worst = 0;
  for (int i = -200; i < 200; ++i)
    for (int j = -50; j < 50; ++j) {
      const auto [u1, u2] = uniform_pair(11, i, j);
      REQUIRE((u1 > 0 && u1 < 1 && u2 > 0 && u2 < 1));
      const auto [x, y] = gaussian_pair(11, i, j);
      const double radius = std::sqrt(-2 * std::log(u1));
      const double angle = 2 * std::numbers::pi * u2;
      worst = std::max({worst, std::abs(x - radius * std::cos(angle)) / radius,
                        std::abs(y - radius * std::sin(angle)) / radius});
    }
  // The reference rounds its angle, up to 2π, by 4e-16; log and sine add a few units in the last
  // place.
  CHECK(worst < 3e-15);
}

TEST_CASE("Numbers filled in a row are the single ones, bit for bit", "[random]") {
  std::vector<std::complex<double>> gaussian(37), phase(37);
  fill_gaussian(99, -12, 5, gaussian, 3);
  fill_phase_factors(99, -12, 5, phase, 3);
  for (std::size_t k = 0; k < gaussian.size(); ++k) {
    const auto [x, y] = gaussian_pair(99, -12 + int(k), 5, 3);
    CHECK(gaussian[k] == std::complex<double>(x, y));
    // Both have the same angle; the product with the radius is rounded once more.
    CHECK(std::abs(std::arg(gaussian[k] / phase[k])) < 1e-15);
    CHECK(std::abs(std::abs(phase[k]) - 1) < 1e-15);
  }
}

TEST_CASE("Draws with replacement are the uniform numbers of their places", "[random]") {
  for (const std::int32_t count : {1, 6, 12345, std::numeric_limits<std::int32_t>::max()}) {
    std::vector<std::int32_t> draws(101);
    fill_draws(5, 7, 3, count, draws, 9);
    for (std::int32_t k = 0; k < 101; ++k) {
      const double uniform = uniform_pair(5, 7, 3 + k, 9).first;
      CHECK(draws[std::size_t(k)] == std::int32_t(std::floor(uniform * double(count))));
    }
  }
}

TEST_CASE("Gaussian numbers have the moments of a standard normal distribution", "[random]") {
  const int rows = 400, columns = 500;
  const double n = 2.0 * rows * columns;
  std::vector<std::complex<double>> pairs(columns);
  double sum = 0, square = 0, cube = 0, fourth = 0, product = 0, neighbour = 0, tail = 0;
  for (int j = 0; j < rows; ++j) {
    fill_gaussian(2026, 0, j, pairs);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      product += pairs[k].real() * pairs[k].imag();
      neighbour += pairs[k].real() * pairs[(k + 1) % pairs.size()].real();
      for (const double x : {pairs[k].real(), pairs[k].imag()}) {
        sum += x;
        square += x * x;
        cube += x * x * x;
        fourth += x * x * x * x;
        tail += std::abs(x) > 3;
      }
    }
  }
  // The standard deviations of the means of x … x⁴ are 1, √2, √15, √96 over √n. The seed is fixed:
  // the limits of 4.5 deviations guard against a wrong transform, not against chance.
  CHECK(std::abs(sum / n) < 4.5 / std::sqrt(n));
  CHECK(std::abs(square / n - 1) < 4.5 * std::sqrt(2 / n));
  CHECK(std::abs(cube / n) < 4.5 * std::sqrt(15 / n));
  CHECK(std::abs(fourth / n - 3) < 4.5 * std::sqrt(96 / n));
  CHECK(std::abs(product / (n / 2)) < 4.5 / std::sqrt(n / 2));
  CHECK(std::abs(neighbour / (n / 2)) < 4.5 / std::sqrt(n / 2));
  const double beyond = std::erfc(3 / std::sqrt(2.0));
  CHECK(std::abs(tail / n - beyond) < 4.5 * std::sqrt(beyond / n));
}
