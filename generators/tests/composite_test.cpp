// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/shapes.hpp>

using namespace salebra;

TEST_CASE("A composite surface adds the powers of two independent ones",
          "[generators][composite]") {
  const Grid2D grid{256, 256, 1.0, 1.0};
  const SelfAffineSpectrum spectrum({.rolloff = 0.03, .short_cutoff = 0.01, .rms_height = 1.0});
  const Surface first = filtered_noise(grid, spectrum, 1),
                second = filtered_noise(grid, spectrum, 2);
  const Surface sum = composite_surface(first, second);
  CHECK(sum.periodic);
  CHECK(sum.heights(3, 4) == first.heights(3, 4) + second.heights(3, 4));
  const double expected = first.heights.square().mean() + second.heights.square().mean();
  // With about 2000 modes on the plateau, chance correlates the surfaces by 2 %.
  CHECK(sum.heights.square().mean() == Approx(expected).epsilon(0.1));
  CHECK_THROWS_AS(composite_surface(first, paraboloid_surface({256, 255, 1.0, 1.0}, 1.0)),
                  InvalidInput);
  CHECK_FALSE(composite_surface(first, paraboloid_surface(grid, 1.0)).periodic);
}

TEST_CASE("A crop keeps heights and cell size, and may pass the edge of a periodic surface",
          "[generators][composite]") {
  const Grid2D grid{12, 10, 6.0, 20.0};
  const Surface waves = sinusoid_surface(grid, 1.0, 2, 1, {0.3, 0.4});
  const Surface part = crop_surface(waves, 10, 7, 5, 6);
  CHECK(part.grid == Grid2D{5, 6, 2.5, 12.0});
  CHECK_FALSE(part.periodic);
  for (Index x = 0; x < 5; ++x)
    for (Index y = 0; y < 6; ++y)
      CHECK(part.heights(x, y) == waves.heights((10 + x) % 12, (7 + y) % 10));
  const Surface hill = paraboloid_surface(grid, 1.0);
  CHECK((crop_surface(hill, 0, 0, 12, 10).heights == hill.heights).all());
  CHECK_THROWS_AS(crop_surface(hill, 10, 0, 3, 3), InvalidInput);
  CHECK_THROWS_AS(crop_surface(waves, 0, 0, 13, 3), InvalidInput);
  CHECK_THROWS_AS(crop_surface(waves, -1, 0, 3, 3), InvalidInput);
}
