// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_parameters.hpp>

#include "test_surfaces.hpp"

using namespace salebra;

namespace {
constexpr double pi = std::numbers::pi;
}

TEST_CASE("The parameters of a sine are 2A/π, A/√2, 2A and its wavelength",
          "[profile_parameters]") {
  // 10 waves of 100 points along x; amplitudes 1, 2 and 3 in three groups of profiles, on an offset
  // that is a waviness across the profiles.
  const double wavelength = 1e-4;
  const Surface waves = sampled({1000, 30, 1e-3, 3e-5}, false, [&](double x, double y) {
    const double number = std::floor(y / 1e-5 + 1e-9);
    return (number + 1) * std::sin(2 * pi * x / wavelength + 0.1) + 40 * number;
  });
  const ProfileParameters along = profile_parameters(waves, Axis::x);
  CHECK(along.profiles == 30);
  CHECK(along.sections == 1);
  // Sums over 100 points per wave differ from integrals by (2π/100)²/12, and the highest of 100
  // points from the crest by (π/100)²/2.
  CHECK(along.Ra == Approx(2 * 2 / pi).epsilon(5e-4));
  CHECK(along.Rq == Approx(2 / std::sqrt(2)).epsilon(5e-4));
  CHECK(along.Rz == Approx(4).epsilon(5e-4));
  CHECK(along.Rsm == Approx(wavelength).epsilon(1e-6));
  // Amplitudes 1, 2, 3 in groups of ten: the standard deviation is √(20/29).
  CHECK(along.Ra_deviation == Approx(2 / pi * std::sqrt(20. / 29)).epsilon(5e-4));
  CHECK(along.Rz_deviation == Approx(2 * std::sqrt(20. / 29)).epsilon(5e-4));
  CHECK(along.Rsm_deviation < 1e-9);
  // Across, a staircase without two rises.
  const ProfileParameters across = profile_parameters(waves, Axis::y);
  CHECK(across.profiles == 1000);
  CHECK(std::isnan(across.Rsm));
}

TEST_CASE("Rz of a known profile is the mean over its sections", "[profile_parameters]") {
  // Alternate heights ±1 carry the shortest wave, which an L-filter of 10 cells keeps: 1 - 2^-25.
  // In the middle of section k a pair of neighbours is at ±(1 + k).
  const Index points = 53;  // five sections of 10 points, and three that are left over
  Surface profile{{points, 1, double(points), 1}, Field(points, 1), false, "test"};
  for (Index i = 0; i < points; ++i) {
    const Index k = (i - 1) / 10, within = (i - 1) % 10;
    profile.heights(i, 0) =
        (i % 2 == 0 ? 1.0 : -1.0) * (within == 4 || within == 5 ? 1.0 + double(k) : 1);
  }
  const ProfileParameters found = profile_parameters(profile, Axis::x, {.l_filter = 10});
  CHECK(found.sections == 5);
  CHECK(found.profiles == 1);
  CHECK(std::isnan(found.Rz_deviation));
  // The filter removes less than a twentieth of the pairs, whose mean over 10 cells is small.
  CHECK(found.Rz == Approx(2 * (1 + 2 + 3 + 4 + 5) / 5.).epsilon(0.05));
  CHECK(profile_parameters(profile, Axis::x).Rz == Approx(10).epsilon(1e-12));
}

TEST_CASE("Small ripples are no profile elements", "[profile_parameters]") {
  // Ripples of 4 % of Rz cross the mean line several times near the zeros of the long wave.
  const Surface rippled = sampled({4000, 2, 8, 1}, false, [](double x, double) {
    return std::sin(2 * pi * x) + 0.08 * std::sin(2 * pi * 25.3 * x);
  });
  // The place of the first and the last rise is uncertain by the ripple: 1/25 of a wave in 7.
  CHECK(profile_parameters(rippled, Axis::x).Rsm == Approx(1).epsilon(0.01));
}

TEST_CASE("The L-filter of profiles acts along them only", "[profile_parameters]") {
  // A waviness of ten cut-offs along x and roughness of a tenth of a cut-off: 2^-0.01 of the waviness
  // is removed, and of the roughness nothing.
  const Surface surface = sampled({2000, 8, 20, 8}, true, [](double x, double y) {
    return std::sin(2 * pi * x / 10) + 0.1 * std::sin(2 * pi * x / 0.1) + 5 * y;
  });
  const GaussianFilters filters{.l_filter = 1};
  const ProfileParameters along = profile_parameters(surface, Axis::x, filters);
  const double waviness = 1 - std::exp2(-0.01);
  CHECK(along.Rq == Approx(std::sqrt((waviness * waviness + 0.01) / 2)).epsilon(1e-9));
  CHECK(along.sections == 20);
  CHECK(along.Rsm == Approx(0.1).epsilon(1e-3));
  // Along y the profiles are eight points of a slope; they have no length of 10 for a filter.
  CHECK_THROWS_AS(profile_parameters(surface, Axis::y, {.l_filter = 10}), InvalidInput);
}

TEST_CASE("Means over profiles agree with the statistics of the surface", "[profile_parameters]") {
  // Uniform heights have Ra = 1/2 and Rq = 1/√3; 300 profiles of 400 points scatter by 0.1 %.
  Surface noise = white({400, 300, 4, 3}, false);
  const ProfileParameters found = profile_parameters(noise, Axis::x);
  CHECK(found.Ra == Approx(0.5).epsilon(0.01));
  CHECK(found.Rq == Approx(height_statistics(noise).rms_height).epsilon(0.01));
  // A profile with a hole is left out.
  noise.heights(17, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK(profile_parameters(noise, Axis::x).profiles == 299);
  CHECK(profile_parameters(noise, Axis::y).profiles == 399);
}
