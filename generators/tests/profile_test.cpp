// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/profile.hpp>
#include <salebra/generators/random_phase.hpp>

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi;

double mean_square(const Profile& profile) {
  double sum = 0;
  for (const double height : profile.heights) sum += height * height;
  return sum / double(profile.heights.size());
}

// One Fourier coefficient, computed by its definition.
std::complex<double> coefficient(const Profile& profile, Index wave) {
  const double n = double(profile.heights.size());
  std::complex<double> sum = 0;
  for (std::size_t k = 0; k < profile.heights.size(); ++k)
    sum += profile.heights[k] * std::polar(1.0, -2 * pi * double(wave) * double(k) / n);
  return sum / n;
}

}  // namespace

TEST_CASE("A profile of random phase has its target power in every mode", "[generators][profile]") {
  const Index points = GENERATE(64, 63, 32, 33);
  const double length = 2.0;
  const SelfAffineProfileSpectrum spectrum({.hurst = 0.7,
                                            .rolloff = 0.5,
                                            .short_cutoff = 2 * length / double(points),
                                            .rms_height = 1e-6});
  const Profile profile = random_phase_profile(points, length, spectrum, 3);
  REQUIRE(Index(profile.heights.size()) == points);
  CHECK(std::abs(coefficient(profile, 0)) < 1e-20);
  for (Index i = 1; 2 * i <= points; ++i)
    CHECK(std::norm(coefficient(profile, i)) ==
          Approx(spectrum.density(2 * pi * double(i) / length) * 2 * pi / length).epsilon(1e-10));
  CHECK(mean_square(profile) ==
        Approx(spectrum.lattice_moments(points, length).moment0).epsilon(1e-12));
}

TEST_CASE("The moments of a profile's spectrum are its sums over a long line",
          "[generators][profile]") {
  const double hurst = GENERATE(0.3, 0.5, 1.0);
  const SelfAffineProfileSpectrum spectrum(
      {.hurst = hurst, .long_cutoff = 2.0, .rolloff = 1.0, .short_cutoff = 0.05, .rms_slope = 0.1});
  const SpectralMoments continuum = spectrum.moments();
  CHECK(continuum.rms_slope() == Approx(0.1).epsilon(1e-13));
  const SpectralMoments line = spectrum.lattice_moments(160000, 2000.0);
  // The sum counts its end terms in full; its steps are 1e-3 of the narrowest feature.
  CHECK(line.moment0 == Approx(continuum.moment0).epsilon(2e-3));
  CHECK(line.moment2_x == Approx(continuum.moment2_x).epsilon(2e-3));
  CHECK(line.moment4_x == Approx(continuum.moment4_x).epsilon(2e-3));
}

TEST_CASE(
    "Noise profiles have their mean square in the mean, and their long waves at any resolution",
    "[generators][profile]") {
  const SelfAffineProfileSpectrum spectrum(
      {.rolloff = 0.25, .short_cutoff = 0.05, .rms_height = 1.0});
  const double expected = spectrum.lattice_moments(64, 1.0).moment0;
  double sum = 0, scatter = 0;
  const int seeds = 400;
  for (int seed = 0; seed < seeds; ++seed)
    sum += mean_square(filtered_noise_profile(64, 1.0, spectrum, std::uint64_t(seed))) / expected;
  for (Index i = 1; i <= 20; ++i)
    scatter += std::pow(2 * spectrum.density(2 * pi * double(i)) * 2 * pi / expected, 2);
  CHECK(std::abs(sum / seeds - 1) < 3 * std::sqrt(scatter / seeds));

  const Profile coarse = filtered_noise_profile(45, 1.0, spectrum, 9);
  const Profile fine = filtered_noise_profile(180, 1.0, spectrum, 9);
  for (std::size_t k = 0; k < coarse.heights.size(); ++k)
    CHECK(fine.heights[4 * k] == Approx(coarse.heights[k]).margin(1e-13));
}

TEST_CASE("A line that does not carry its spectrum is refused", "[generators][profile]") {
  const SelfAffineProfileSpectrum spectrum(
      {.rolloff = 0.25, .short_cutoff = 0.05, .rms_height = 1.0});
  CHECK_NOTHROW(filtered_noise_profile(40, 1.0, spectrum, 1));
  CHECK_THROWS_AS(filtered_noise_profile(39, 1.0, spectrum, 1), InvalidInput);
  CHECK_THROWS_AS(filtered_noise_profile(40, 0.04, spectrum, 1), InvalidInput);
  CHECK_THROWS_AS(SelfAffineProfileSpectrum({.hurst = 2}), InvalidInput);
}

TEST_CASE("A profile has nothing in common with the surface of its seed", "[generators][profile]") {
  // The waves along x of a surface are those of its mean over y. If surface and profile used the
  // same random numbers, these waves would be correlated. For a dozen equal waves, the chance
  // correlation has a standard deviation of 1/√24 = 0.2, and its mean over 8 seeds 0.07.
  const SelfAffineParameters parameters{
      .long_cutoff = 1, .rolloff = 1.0 / 12, .short_cutoff = 1.0 / 12, .rms_height = 1};
  const Grid2D grid{64, 64, 1, 1};
  const SelfAffineSpectrum of_surface(parameters);
  const SelfAffineProfileSpectrum of_profile(parameters);
  const bool noise = GENERATE(false, true);
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Surface surface = noise ? filtered_noise(grid, of_surface, seed, {})
                                  : random_phase(grid, of_surface, seed, {});
    const Profile profile = noise ? filtered_noise_profile(64, 1, of_profile, seed)
                                  : random_phase_profile(64, 1, of_profile, seed);
    double product = 0, first = 0, second = 0;
    for (Index ix = 0; ix < 64; ++ix) {
      const double along = surface.heights.row(ix).mean(),
                   height = profile.heights[std::size_t(ix)];
      product += along * height;
      first += along * along;
      second += height * height;
    }
    mean += product / std::sqrt(first * second) / 8;
  }
  CHECK(std::abs(mean) < 0.35);
}
