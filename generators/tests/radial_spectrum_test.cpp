// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>

using namespace salebra;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

TEST_CASE("A self-affine spectrum given as a function makes the same surface",
          "[generators][radial]") {
  const SelfAffineSpectrum reference(
      {.hurst = 0.6, .long_cutoff = 1.0, .rolloff = 0.3, .short_cutoff = 0.05, .rms_height = 1.0});
  const FunctionSpectrum spectrum([&](double q) { return reference.radial_density(q); }, 2 * pi,
                                  2 * pi / 0.05, "test");
  // The kink at the roll-off lies inside a panel; after 30 halvings its error is within the
  // tolerance.
  CHECK(spectrum.moments().moment0 == Approx(reference.moments().moment0).epsilon(1e-9));
  CHECK(spectrum.moments().moment4_x == Approx(reference.moments().moment4_x).epsilon(1e-9));
  const Grid2D grid{48, 50, 1.0, 1.0};
  const Field difference =
      filtered_noise(grid, spectrum, 3).heights - filtered_noise(grid, reference, 3).heights;
  // Both compute the same power in different ways, with differences of 1e-14 of each amplitude.
  CHECK(difference.abs().maxCoeff() < 1e-12);
}

TEST_CASE("A table of a power law is the power law", "[generators][radial]") {
  const SelfAffineSpectrum reference(
      {.hurst = 0.6, .long_cutoff = 1.0, .rolloff = 0.3, .short_cutoff = 0.05, .rms_height = 1.0});
  std::vector<double> wavenumbers{2 * pi, 2 * pi / 0.3, 2 * pi / 0.11, 2 * pi / 0.05};
  std::vector<double> densities;
  for (const double q : wavenumbers) densities.push_back(reference.radial_density(q));
  const TabulatedSpectrum table(wavenumbers, densities);
  CHECK(table.moments().moment0 == Approx(1.0).epsilon(1e-13));
  CHECK(table.moments().moment2_x == Approx(reference.moments().moment2_x).epsilon(1e-13));
  CHECK(table.moments().moment4_x == Approx(reference.moments().moment4_x).epsilon(1e-13));
  for (const double q : {7.0, 20.0, 21.0, 60.0, 100.0})
    CHECK(table.radial_density(q) == Approx(reference.radial_density(q)).epsilon(1e-13));
  CHECK(table.radial_density(2 * pi * 0.99) == 0);
  CHECK(table.radial_density(2 * pi / 0.05 * 1.01) == 0);
}

TEST_CASE("Gaussian correlation has its moments and its correlation", "[generators][radial]") {
  const double length = 0.02, rms = 1e-6;
  const FunctionSpectrum spectrum = gaussian_correlation_spectrum(rms, length);
  const SpectralMoments moments = spectrum.moments();
  CHECK(moments.rms_height() == Approx(rms).epsilon(1e-10));
  // m2 = −R''(0) = 2 h²/ℓ², m4 = R''''(0) = 12 h²/ℓ⁴.
  CHECK(moments.moment2_x == Approx(2 * rms * rms / (length * length)).epsilon(1e-10));
  CHECK(moments.moment4_x == Approx(12 * rms * rms / std::pow(length, 4)).epsilon(1e-9));
  CHECK(moments.nayak() == Approx(3).epsilon(1e-9));
  // A random-phase surface has exactly the autocorrelation of the lattice. It equals that of the
  // plane, because the cell is 50 ℓ wide, except for the missing zero mode, the constant
  // h²·π(ℓ/L)² = 1e-3 h².
  const Grid2D grid{512, 512, 1.0, 1.0};
  const Field heights = random_phase(grid, spectrum, 2).heights;
  for (const Index shift : {0, 5, 10, 30}) {
    double sum = 0;
    for (Index x = 0; x < 512; ++x) sum += (heights.row(x) * heights.row((x + shift) % 512)).sum();
    const double distance = double(shift) / 512 / length;
    CHECK(sum / double(grid.points()) / (rms * rms) ==
          Approx(std::exp(-distance * distance)).margin(1.5e-3));
  }
}

TEST_CASE("Densities below the least normal number are integrated in the usual time",
          "[generators][radial]") {
  // A tolerance of 0 would halve every panel to the maximum depth, 2³⁰ times.
  const FunctionSpectrum spectrum([](double q) { return 1e-320 * std::exp(-q * q); }, 0, 6,
                                  "faint");
  CHECK(spectrum.moments().moment0 < std::numeric_limits<double>::min());
  CHECK_THROWS_AS(gaussian_correlation_spectrum(1e-170, 0.02), InvalidInput);
}

TEST_CASE("Exponential correlation keeps its rms height for every cut-off",
          "[generators][radial]") {
  const double short_cutoff = GENERATE(1e-2, 1e-4);
  const FunctionSpectrum spectrum = exponential_correlation_spectrum(1e-6, 0.02, short_cutoff);
  CHECK(spectrum.moments().rms_height() == Approx(1e-6).epsilon(1e-9));
  // Far above the roll-off the density falls like q⁻³, the self-affine law with H = 1/2.
  CHECK(spectrum.radial_density(500) / spectrum.radial_density(250) ==
        Approx(1.0 / 8).epsilon(0.05));
}

TEST_CASE("Spectra that are none are refused", "[generators][radial]") {
  const auto one = [](double) { return 1.0; };
  CHECK_THROWS_AS(FunctionSpectrum(one, 2, 1, "test"), InvalidInput);
  CHECK_THROWS_AS(FunctionSpectrum(one, -1, 1, "test"), InvalidInput);
  CHECK_THROWS_WITH(FunctionSpectrum([](double q) { return 1 - q; }, 0, 2, "test"),
                    Contains("density: -"));
  CHECK_THROWS_AS(TabulatedSpectrum({1}, {1}), InvalidInput);
  CHECK_THROWS_WITH(TabulatedSpectrum({1, 2, 2}, {1, 1, 1}), Contains("wavenumbers[2]: 2 must"));
  CHECK_THROWS_WITH(TabulatedSpectrum({1, 2, 3}, {1, 0, 1}), Contains("densities[1]: 0 must"));
  CHECK_THROWS_AS(TabulatedSpectrum({1, 2, 3}, {1, 1}), InvalidInput);
}
