// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/surface/moments.hpp>

#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;

namespace {

// Cells are 1 m wide and E* is 1 Pa, so lengths are in cells and pressures in E*.
constexpr Index points = 128;

Adhesion exponential(double work) {
  return {.potential = AdhesionPotential::exponential, .work = work, .range = 1.33};
}

/// Pastewka and Robbins' number, below which surfaces stick: E*h'ρ/(2w)·(h'²/(h''ρ))^{2/3}, with
/// h'' the rms of half the Laplacian [PNAS 111, 3298 (2014), Eq. (10), κ = 2, d = 4h'/h''].
double stickiness(const Surface& surface, const Adhesion& adhesion) {
  const Field& h = surface.heights;
  const Index n = h.rows();
  double slope = 0, curvature = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double east = h((i + 1) % n, j), west = h((i + n - 1) % n, j);
      const double north = h(i, (j + 1) % n), south = h(i, (j + n - 1) % n);
      slope += std::pow((east - west) / 2, 2) + std::pow((north - south) / 2, 2);
      curvature += std::pow((east + west + north + south - 4 * h(i, j)) / 2, 2);
    }
  slope = std::sqrt(slope / double(h.size())), curvature = std::sqrt(curvature / double(h.size()));
  return slope * adhesion.range / (2 * adhesion.work) *
         std::pow(slope * slope / (curvature * adhesion.range), 2.0 / 3);
}

/// Contact area fraction under a pressure, reached from the contact without adhesion.
double area_of(const Surface& surface, const Adhesion& adhesion, double pressure) {
  const AdhesiveContactState state = press_adhesive(surface, 1, at_pressure(pressure), adhesion);
  REQUIRE(state.converged());
  return state.detached ? 0 : state.contact_area_fraction;
}

Surface rough(double slope, std::uint64_t seed) {
  return rough_surface({points, points, points, points},
                       {.rolloff = 32, .cutoff = 16, .rms_slope = slope, .seed = seed});
}

}  // namespace

// The area of surfaces that do not stick is proportional to the load and vanishes without load;
// surfaces that stick keep an area without load. The number separates the two kinds only up to a
// factor of a few: with this potential, whose tension has a tail, surfaces at 3 keep a third of the
// area and surfaces at 9 a twentieth. Therefore the test uses 37 and 0.9.
TEST_CASE("Surfaces stick on one side of Pastewka and Robbins' number and not on the other",
          "[adhesion]") {
  const Adhesion weak = exponential(0.05), strong = exponential(0.2);
  double loaded = 0, half = 0, without = 0, dry_loaded = 0, dry_half = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const Surface steep = rough(1, seed), flat = rough(0.25, seed);
    CHECK(stickiness(steep, weak) > 30);
    loaded += area_of(steep, weak, 0.02), half += area_of(steep, weak, 0.01);
    without += area_of(steep, weak, 0);
    dry_loaded += press(steep, 1, at_pressure(0.02)).contact_area_fraction;
    dry_half += press(steep, 1, at_pressure(0.01)).contact_area_fraction;

    CHECK(stickiness(flat, strong) < 1);
    const double stuck = area_of(flat, strong, 0.02 * 0.25);
    CHECK(area_of(flat, strong, 0) > 0.9 * stuck);
    CHECK(stuck > 0.5);
  }
  // The few spots scatter by a fifth each, so means are compared; they are as proportional as
  // without adhesion.
  CHECK(loaded / half == Approx(dry_loaded / dry_half).epsilon(0.1));
  CHECK(without < 0.05 * loaded);
}
