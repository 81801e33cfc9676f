// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/anisotropic_spectrum.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<const IsotropicSpectrum> gaussian(double rms, double length) {
  return std::make_shared<FunctionSpectrum>(gaussian_correlation_spectrum(rms, length));
}

// ⟨h(x, y) h(x + a dx, y + b dy)⟩ of a periodic field.
double correlation(const Field& heights, Index a, Index b) {
  double sum = 0;
  for (Index x = 0; x < heights.rows(); ++x)
    for (Index y = 0; y < heights.cols(); ++y)
      sum += heights(x, y) * heights((x + a) % heights.rows(), (y + b) % heights.cols());
  return sum / double(heights.size());
}

}  // namespace

TEST_CASE("A stretched surface has the two correlation lengths along its angle",
          "[generators][anisotropic]") {
  const double unit = 0.01;
  // With tan(angle) = 3/4, both directions pass through lattice points.
  const Anisotropy anisotropy{.along = 6, .across = 2, .angle = std::atan2(3, 4)};
  const AnisotropicSpectrum spectrum(gaussian(1.0, unit), anisotropy);
  CHECK(anisotropy.peklenik() == 3);
  const Grid2D grid{300, 300, 1.5, 1.5};
  const Field heights = random_phase(grid, spectrum, 1).heights;
  // A random-phase surface has the correlation of the lattice; the missing zero mode lowers it by
  // π·6·2·(unit/1.5)² = 0.0017.
  for (const Index step : {1, 2, 3}) {
    const double distance = 5 * double(step) * grid.dx();
    CHECK(correlation(heights, 4 * step, 3 * step) ==
          Approx(std::exp(-std::pow(distance / (6 * unit), 2))).margin(3e-3));
    CHECK(correlation(heights, 300 - 3 * step, 4 * step) ==
          Approx(std::exp(-std::pow(distance / (2 * unit), 2))).margin(3e-3));
  }
}

TEST_CASE("Moments of a stretched spectrum are its sums over a dense lattice",
          "[generators][anisotropic]") {
  const Anisotropy anisotropy{.along = 3, .across = 1, .angle = 0.4};
  const AnisotropicSpectrum spectrum(gaussian(1.0, 0.02), anisotropy);
  const SpectralMoments continuum = spectrum.moments();
  const SpectralMoments lattice = spectrum.lattice_moments({256, 256, 1.0, 1.0});
  // On such a dense lattice the sum over a Gaussian equals its integral to machine precision,
  // except for the zero mode in m0; the cut at e⁻³⁶ leaves 1e-13 in m4.
  CHECK(lattice.moment0 == Approx(continuum.moment0).epsilon(5e-3));
  CHECK(lattice.moment2_x == Approx(continuum.moment2_x).epsilon(1e-8));
  CHECK(lattice.moment2_y == Approx(continuum.moment2_y).epsilon(1e-8));
  CHECK(lattice.moment4_x == Approx(continuum.moment4_x).epsilon(1e-8));
  CHECK(lattice.moment4_y == Approx(continuum.moment4_y).epsilon(1e-8));
}

TEST_CASE("Stretching by one in both directions changes nothing", "[generators][anisotropic]") {
  const auto isotropic = std::make_shared<SelfAffineSpectrum>(
      SelfAffineParameters{.rolloff = 0.3, .short_cutoff = 0.05, .rms_slope = 0.1});
  const AnisotropicSpectrum spectrum(isotropic, {.angle = 1.1});
  const Grid2D grid{40, 41, 1.0, 1.0};
  const Field difference =
      random_phase(grid, spectrum, 3).heights - random_phase(grid, *isotropic, 3).heights;
  CHECK(difference.abs().maxCoeff() < 1e-12 * spectrum.moments().rms_height());
}

TEST_CASE("An anisotropic surface is real and has its power on the Nyquist lines",
          "[generators][anisotropic]") {
  // The shortest wavelength across is two cells.
  const auto isotropic = std::make_shared<SelfAffineSpectrum>(
      SelfAffineParameters{.rolloff = 0.5, .short_cutoff = 2.0 / 16, .rms_height = 1.0});
  const AnisotropicSpectrum spectrum(isotropic, {.along = 2, .across = 1, .angle = pi / 3});
  for (const Grid2D& grid : {Grid2D{16, 16, 1.0, 1.0}, Grid2D{17, 16, 1.0, 1.0}}) {
    const Field heights = random_phase(grid, spectrum, 3).heights;
    // If a line were not Hermitian, part of its power would be lost in the imaginary part.
    CHECK(heights.square().mean() == Approx(spectrum.lattice_moments(grid).moment0).epsilon(1e-12));
  }
}

TEST_CASE("Anisotropy needs positive factors", "[generators][anisotropic]") {
  CHECK_THROWS_AS(AnisotropicSpectrum(gaussian(1, 1), {.along = 0}), InvalidInput);
  CHECK_THROWS_AS(AnisotropicSpectrum(gaussian(1, 1), {.angle = std::nan("")}), InvalidInput);
  CHECK_THROWS_AS(AnisotropicSpectrum(nullptr, {}), InvalidInput);
}
