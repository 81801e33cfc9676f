// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/generators/shapes.hpp>

using namespace salebra;

TEST_CASE("A scaled surface has the rms value asked and zero mean", "[generators][exact_rms]") {
  const Grid2D grid{48, 35, 1e-3, 2e-3};
  Surface waves = sinusoid_surface(grid, 1e-6, 5, 3);
  waves.heights += 7e-6;
  const Surface by_height = scale_to_rms(waves, Rms::height, 3e-6);
  // Heights of 7e-6 are rounded to 1e-21 and then scaled by six.
  CHECK(std::abs(by_height.heights.mean()) < 1e-19);
  CHECK(std::sqrt(by_height.heights.square().mean()) == Approx(3e-6).epsilon(1e-13));
  // A cos·cos wave of amplitude A has ⟨|∇h|²⟩ = A²(q_x² + q_y²)/4.
  const Surface by_slope = scale_to_rms(waves, Rms::slope, 0.1);
  const double qx = 2 * std::numbers::pi * 5 / 1e-3, qy = 2 * std::numbers::pi * 3 / 2e-3;
  CHECK(by_slope.heights(0, 0) == Approx(0.2 / std::hypot(qx, qy)).epsilon(1e-12));
}

TEST_CASE("Exact rms meets the continuum's value on a lattice that has another",
          "[generators][exact_rms]") {
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.long_cutoff = 1e-3, .short_cutoff = 1e-4, .rms_height = 1e-6});
  REQUIRE(spectrum.lattice_moments(grid).rms_height() > 1.2e-6);
  const Surface surface = exact_rms(grid, spectrum, 4);
  CHECK(std::sqrt(surface.heights.square().mean()) == Approx(1e-6).epsilon(1e-13));
  const Surface plain = random_phase(grid, spectrum, 4);
  const double factor = surface.heights(3, 5) / plain.heights(3, 5);
  CHECK((surface.heights - factor * plain.heights).abs().maxCoeff() < 1e-13 * 1e-6);
  // The factor is the same at another resolution, so the long waves stay the same.
  const Surface fine = exact_rms({128, 128, 1e-3, 1e-3}, spectrum, 4);
  CHECK(fine.heights(6, 10) == Approx(surface.heights(3, 5)).epsilon(1e-11));
}

TEST_CASE("What has no rms value is not scaled", "[generators][exact_rms]") {
  const Grid2D grid{16, 16, 1.0, 1.0};
  Surface flat{grid, Field::Constant(16, 16, 2.0), true, "flat"};
  CHECK_THROWS_AS(scale_to_rms(flat, Rms::height, 1.0), InvalidInput);
  CHECK_THROWS_AS(scale_to_rms(flat, Rms::slope, 1.0), InvalidInput);
  CHECK_THROWS_AS(scale_to_rms(paraboloid_surface(grid, 1), Rms::slope, 1.0), InvalidInput);
  CHECK_THROWS_AS(scale_to_rms(paraboloid_surface(grid, 1), Rms::height, 0.0), InvalidInput);
  flat.heights(0, 0) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(scale_to_rms(flat, Rms::height, 1.0), InvalidInput);
}

TEST_CASE("A wave of two cells has the slope π/dy of its amplitude", "[generators][exact_rms]") {
  // A wave sampled at its crests is self-conjugate; test the axes and the corner of the spectrum.
  const Grid2D grid{8, 6, 4.0, 1.5};
  const bool along_x = GENERATE(false, true), along_y = GENERATE(false, true);
  if (!along_x && !along_y) return;
  Surface wave{grid, Field(8, 6), true, "two cells"};
  for (Index ix = 0; ix < 8; ++ix)
    for (Index iy = 0; iy < 6; ++iy)
      wave.heights(ix, iy) = ((along_x ? ix : 0) + (along_y ? iy : 0)) % 2 == 0 ? 1 : -1;
  const double slope =
      std::numbers::pi * std::hypot(along_x ? 1 / grid.dx() : 0.0, along_y ? 1 / grid.dy() : 0.0);
  const Surface scaled = scale_to_rms(wave, Rms::slope, 0.1);
  CHECK(scaled.heights(0, 0) == Approx(0.1 / slope).epsilon(1e-13));
}
