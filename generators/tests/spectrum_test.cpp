// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/spectrum.hpp>

using namespace salebra;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

// 2π∫ q^{order+1} C dq by Simpson's rule in ln q, separately between the limits because no panel
// may cross a kink.
double radial_integral(const Spectrum& spectrum, int order, double from, double to) {
  const int panels = 2000;
  const double step = std::log(to / from) / panels;
  double sum = 0;
  for (int k = 0; k <= panels; ++k) {
    const double q = from * std::exp(k * step);
    const double weight = k == 0 || k == panels ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * std::pow(q, order + 2) * spectrum.density(q * 0.6, q * 0.8);
  }
  return 2 * pi * sum * step / 3;
}

SelfAffineParameters valid_parameters() {
  return {
      .hurst = 0.8, .long_cutoff = 1e-3, .rolloff = 2e-4, .short_cutoff = 1e-5, .rms_height = 1e-6};
}

}  // namespace

TEST_CASE("Moments in closed form are the integrals over the spectrum", "[generators][spectrum]") {
  const double hurst = GENERATE(0.05, 0.5, 0.8, 1.0);
  const double rolloff = GENERATE(1e-3, 2e-4, 1e-5);
  const SelfAffineSpectrum spectrum({.hurst = hurst,
                                     .long_cutoff = 1e-3,
                                     .rolloff = rolloff,
                                     .short_cutoff = 1e-5,
                                     .rms_height = 3e-6});
  const double q_long = 2 * pi / 1e-3, q_rolloff = 2 * pi / rolloff, q_short = 2 * pi / 1e-5;
  const auto integral = [&](int order) {
    return radial_integral(spectrum, order, q_long, q_rolloff) +
           radial_integral(spectrum, order, q_rolloff, q_short);
  };
  const SpectralMoments moments = spectrum.moments();
  // The error of Simpson's rule with 2000 panels over less than five in ln q is (5/2000)⁴·4⁴/180,
  // below 1e-10.
  CHECK(moments.moment0 == Approx(integral(0)).epsilon(1e-9));
  CHECK(moments.moment2() == Approx(integral(2) / 2).epsilon(1e-9));
  CHECK(moments.moment4() == Approx(integral(4) * 3 / 8).epsilon(1e-9));
  CHECK(moments.rms_height() == Approx(3e-6).epsilon(1e-14));
}

TEST_CASE("The rms slope asked is the one that the continuum has", "[generators][spectrum]") {
  auto parameters = valid_parameters();
  parameters.rms_height.reset();
  parameters.rms_slope = 0.1;
  CHECK(SelfAffineSpectrum(parameters).moments().rms_slope() == Approx(0.1).epsilon(1e-14));
}

TEST_CASE("Moments are continuous at a Hurst exponent of one", "[generators][spectrum]") {
  auto parameters = valid_parameters();
  parameters.hurst = 1;
  const double at_one = SelfAffineSpectrum(parameters).moments().moment2();
  parameters.hurst = 1 - 1e-12;
  // d ln m2/dH is about ln(q_s/q_r) = 3; a formula with 1/(2−2H) would lose twelve digits here.
  CHECK(SelfAffineSpectrum(parameters).moments().moment2() == Approx(at_one).epsilon(1e-10));
}

TEST_CASE("Without a long cut-off the plateau reaches down to every wave of the cell",
          "[generators][spectrum]") {
  const SelfAffineSpectrum spectrum({.rolloff = 1e-4, .short_cutoff = 1e-5, .rms_height = 1e-6});
  CHECK(spectrum.density(1e-3, 0) == spectrum.plateau());
  const Grid2D grid{256, 256, 8e-4, 8e-4};
  // The lattice lacks only the zero mode, one of the π 8² modes on the plateau. The discrete edge
  // of a disc of radius 8 adds 1 % of noise.
  CHECK(spectrum.lattice_moments(grid).rms_height() == Approx(1e-6).epsilon(0.01));
}

TEST_CASE("The lattice sum tends to the continuum as the cell grows", "[generators][spectrum]") {
  const SelfAffineSpectrum spectrum(
      {.long_cutoff = 2e-4, .rolloff = 1e-4, .short_cutoff = 2e-5, .rms_slope = 0.2});
  const double length = 64e-4;
  const Grid2D grid{768, 640, length, length};
  const SpectralMoments lattice = spectrum.lattice_moments(grid), continuum = spectrum.moments();
  // Modes fill a ring of radius 32 … 320. The lattice points on its rim cause an error of about
  // 32^{2/3}/(π 32²) < 1 %.
  CHECK(lattice.moment0 == Approx(continuum.moment0).epsilon(0.01));
  CHECK(lattice.moment2_x == Approx(continuum.moment2_x).epsilon(0.01));
  CHECK(lattice.moment2_y == Approx(continuum.moment2_y).epsilon(0.01));
  CHECK(lattice.moment4() == Approx(continuum.moment4()).epsilon(0.01));
}

TEST_CASE("Waves on a cut-off belong to the spectrum whatever the rounding",
          "[generators][spectrum]") {
  // q = 2πi/L and 2π/λ round differently; 0.1 and 0.3 have no finite binary representation.
  for (const double length : {0.1, 0.3, 7e-6, 1.7e-3})
    for (Index waves = 3; waves < 40; ++waves) {
      const SelfAffineSpectrum spectrum({.long_cutoff = length / 3,
                                         .short_cutoff = length / double(waves + 1),
                                         .rms_height = 1.0});
      CHECK(spectrum.density(2 * pi * 3 / length, 0) > 0);
      CHECK(spectrum.density(0, 2 * pi * double(waves + 1) / length) > 0);
      CHECK(spectrum.density(2 * pi * double(waves + 2) / length, 0) == 0);
      CHECK(spectrum.density(2 * pi * 2 / length, 0) == 0);
    }
}

TEST_CASE("The lattice sum does not depend on a resolution that carries the spectrum",
          "[generators][spectrum]") {
  const SelfAffineSpectrum spectrum({.rolloff = 1e-3, .short_cutoff = 5e-5, .rms_height = 1e-6});
  const auto coarse = spectrum.lattice_moments({64, 50, 1e-3, 7e-4});
  const auto fine = spectrum.lattice_moments({125, 128, 1e-3, 7e-4});
  // Both sums have the same terms; only the Nyquist index and the grouping into slabs differ.
  CHECK(coarse.moment0 == Approx(fine.moment0).epsilon(1e-13));
  CHECK(coarse.moment4_x == Approx(fine.moment4_x).epsilon(1e-13));
}

TEST_CASE("Bad spectra are refused by name", "[generators][spectrum]") {
  const auto message_of = [](auto change) {
    auto parameters = valid_parameters();
    change(parameters);
    try {
      SelfAffineSpectrum spectrum(parameters);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  using P = SelfAffineParameters;
  CHECK(message_of([](P&) {}) == "accepted");
  CHECK_THAT(message_of([](P& p) { p.hurst = 1.3; }), Contains("hurst: 1.3 must"));
  CHECK_THAT(message_of([](P& p) { p.hurst = 0; }), Contains("hurst: 0 must"));
  CHECK_THAT(message_of([](P& p) { p.hurst = std::nan(""); }), Contains("hurst: nan must"));
  CHECK_THAT(message_of([](P& p) { p.rolloff = 2e-3; }),
             Contains("rolloff: 0.002 must not exceed"));
  CHECK_THAT(message_of([](P& p) { p.short_cutoff = 3e-4; }),
             Contains("short_cutoff: 0.0003 must"));
  CHECK_THAT(message_of([](P& p) { p.short_cutoff = 0; }), Contains("short_cutoff: 0 must"));
  CHECK_THAT(message_of([](P& p) { p.long_cutoff = -1.0; }), Contains("long_cutoff: -1 must"));
  CHECK_THAT(message_of([](P& p) { p.rms_slope = 0.1; }), Contains("`rms_slope`; give one"));
  CHECK_THAT(message_of([](P& p) { p.rms_height.reset(); }), Contains("`rms_slope`; give one"));
  CHECK_THAT(message_of([](P& p) { p.rms_height = -1e-6; }), Contains("rms_height: -1e-06 must"));
  CHECK_THAT(message_of([](P& p) { p.long_cutoff.reset(), p.rolloff.reset(); }),
             Contains("rolloff: not given"));
}

TEST_CASE("A grid that would fold the spectrum is refused", "[generators][spectrum]") {
  const SelfAffineSpectrum spectrum(valid_parameters());
  CHECK_NOTHROW(spectrum.require_carried_by({200, 200, 1e-3, 1e-3}));
  CHECK_THROWS_WITH(spectrum.require_carried_by({199, 200, 1e-3, 1e-3}),
                    Contains("short_cutoff: 1e-05 must be at least two cells"));
  CHECK_THROWS_WITH(spectrum.require_carried_by({200, 199, 1e-3, 1e-3}), Contains("two cells"));
  CHECK_THROWS_WITH(spectrum.require_carried_by({64, 64, 9e-6, 9e-6}), Contains("must fit"));
  CHECK_THROWS_AS(spectrum.require_carried_by({0, 200, 1e-3, 1e-3}), InvalidInput);
}

TEST_CASE("The forecast warns where the grid makes something else of the spectrum",
          "[generators][forecast]") {
  const SelfAffineSpectrum spectrum({.rolloff = 1e-4, .short_cutoff = 1e-5, .rms_height = 1e-6});
  CHECK(forecast({1024, 1024, 1e-3, 1e-3}, spectrum).warnings.empty());
  const Forecast of_coarse = forecast({512, 512, 1e-3, 1e-3}, spectrum);
  REQUIRE(of_coarse.warnings.size() == 1);
  CHECK_THAT(of_coarse.warnings[0], Contains("has 5.12 cells"));
  // For oblong cells the longer side is relevant.
  const Forecast of_oblong = forecast({1024, 512, 1e-3, 1e-3}, spectrum);
  REQUIRE(of_oblong.warnings.size() == 1);
  CHECK_THAT(of_oblong.warnings[0], Contains("has 5.12 cells"));
  // With the long cut-off at the size of the cell, the continuum omits a disc of π modes, but the
  // lattice only one mode.
  const SelfAffineSpectrum few_waves(
      {.long_cutoff = 1e-4, .short_cutoff = 1e-5, .rms_height = 1e-6});
  const Forecast of_few = forecast({128, 128, 1e-4, 1e-4}, few_waves);
  REQUIRE(of_few.warnings.size() == 2);
  CHECK_THAT(of_few.warnings[0], Contains("times the requested rms height"));
  CHECK_THAT(of_few.warnings[1], Contains("scatters by"));
  CHECK(of_few.memory == generation_memory({128, 128, 1e-4, 1e-4}));
}

TEST_CASE("The forecast knows the scatter of filtered noise", "[generators][forecast]") {
  const Grid2D grid{32, 27, 1e-4, 1e-4};
  const SelfAffineSpectrum spectrum({.rolloff = 5e-5, .short_cutoff = 1e-5, .rms_height = 1e-6});
  const double expected = spectrum.lattice_moments(grid).moment0;
  double mean = 0, square = 0;
  const int seeds = 400;
  for (int seed = 0; seed < seeds; ++seed) {
    const double ratio =
        filtered_noise(grid, spectrum, std::uint64_t(seed)).heights.square().mean() / expected;
    mean += ratio / seeds;
    square += ratio * ratio / seeds;
  }
  // The mean square scatters twice as much as its root. A standard deviation from 400 samples has
  // an error of 1/√800, 3.5 %, and more for the heavy tail of a sum of a dozen exponentials.
  const double scatter = 2 * forecast(grid, spectrum).rms_height_scatter;
  CHECK(std::abs(mean - 1) < 3 * scatter / std::sqrt(seeds));
  CHECK(std::sqrt(square - mean * mean) == Approx(scatter).epsilon(0.15));
}

TEST_CASE("A surface that the memory cannot hold is refused before it is begun",
          "[generators][forecast]") {
  const Grid2D huge{8'000'000, 8'000'000, 1.0, 1.0};
  const SelfAffineSpectrum spectrum({.rolloff = 0.1, .short_cutoff = 0.01, .rms_height = 1e-6});
  CHECK_THROWS_WITH(filtered_noise(huge, spectrum, 1),
                    Contains("points: 8000000 x 8000000 need 512 TB"));
  CHECK(generation_memory({4096, 4096, 1.0, 1.0}) < 1.15 * 4096 * 4096 * sizeof(double));
}
