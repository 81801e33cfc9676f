// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/fourier_modes.hpp>

using namespace salebra;

TEST_CASE("A surface of Fourier coefficients is the sum of its waves", "[modes]") {
  const Grid2D grid{12, 10, 3, 2};
  const std::vector<FourierMode> modes{
      {0, 0, 0.5}, {2, 0, {0.3, -0.1}}, {-3, 2, {0.2, 0.7}}, {1, -4, {-0.4, 0.6}}};
  const Surface surface = surface_of_modes(grid, modes);
  for (Index a = 0; a < grid.nx; ++a)
    for (Index b = 0; b < grid.ny; ++b) {
      double sum = 0;
      for (const FourierMode& mode : modes) {
        const double phase =
            2 * std::numbers::pi *
            (double(mode.i * a) / double(grid.nx) + double(mode.j * b) / double(grid.ny));
        const double wave =
            mode.amplitude.real() * std::cos(phase) - mode.amplitude.imag() * std::sin(phase);
        sum += mode.i == 0 && mode.j == 0 ? wave : 2 * wave;  // including the opposite wave
      }
      CHECK(surface.heights(a, b) == Approx(sum).margin(1e-14));
    }
  // Listing the opposite waves too changes nothing; a finer grid has the same waves.
  std::vector<FourierMode> both = modes;
  for (const FourierMode& mode : modes)
    both.push_back({-mode.i, -mode.j, std::conj(mode.amplitude)});
  CHECK((surface_of_modes(grid, both).heights == surface.heights).all());
  CHECK(surface_of_modes({24, 20, 3, 2}, modes).heights(6, 14) ==
        Approx(surface.heights(3, 7)).margin(1e-14));
  CHECK_THROWS_AS(surface_of_modes(grid, {{6, 0, 1.0}}), InvalidInput);
  CHECK_THROWS_AS(surface_of_modes(grid, {{1, 1, 1.0}, {-1, -1, 2.0}}), InvalidInput);
}
