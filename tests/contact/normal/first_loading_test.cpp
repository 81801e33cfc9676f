// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/generators/shapes.hpp>
#include <vector>

#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

namespace {

constexpr double contact_modulus = 1e9;
constexpr double pressure = 1e7;

NormalContactOptions contact(Boundary boundary, double hardness) {
  NormalContactOptions options;
  options.boundary = boundary;
  options.tolerance = 1e-12;
  options.hardness = hardness;
  return options;
}

NormalContactOptions elastic(NormalContactOptions options) {
  options.hardness = std::numeric_limits<double>::infinity();
  return options;
}

Surface rough() { return rough_surface({64, 64, 1e-3, 1e-3}); }

/// The maximum elastic pressure of rough(), Pa.
double max_elastic_pressure(Boundary boundary) {
  return press(rough(), contact_modulus, at_pressure(pressure), elastic(contact(boundary, 1)))
      .contact_pressure.maxCoeff();
}

}  // namespace

TEST_CASE("Below the hardness nothing flows, and the surface keeps its bits", "[first_loading]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Surface surface = rough();
  const double amplitude = GENERATE(0.0, 1.0) * 0.01 * rms_height(surface);
  // An oscillation of a hundredth of the rms height raises the maximum pressure by less than a
  // fifth.
  const auto options = contact(boundary, 1.2 * max_elastic_pressure(boundary));
  const ResidualSurface residual =
      after_first_loading(surface, contact_modulus, pressure, options, amplitude);
  REQUIRE(residual.converged());
  CHECK((residual.surface.heights == surface.heights).all());
  CHECK_FALSE(residual.first_loading.yielded());
  CHECK(residual.first_loading.yielded_area_fraction == 0);
  CHECK(residual.first_loading.max_plastic_depth == 0);
  CHECK(residual.first_loading.mean_plastic_depth == 0);
  if (amplitude == 0)
    CHECK(residual.first_loading.pressure == Approx(pressure).epsilon(1e-10));
  else
    CHECK(residual.first_loading.pressure > 1.001 * pressure);
}

TEST_CASE("A first loading that flows less and less ends in the elastic contact",
          "[first_loading]") {
  const Surface surface = rough();
  const double largest = max_elastic_pressure(Boundary::periodic);
  const double step = GENERATE(0.04, 0.02, 0.01);
  const auto options = contact(Boundary::periodic, (1 - step) * largest);
  const ResidualSurface residual = after_first_loading(surface, contact_modulus, pressure, options);
  REQUIRE(residual.converged());
  CHECK(residual.first_loading.yielded());
  // The few cells at the limit yield by their own compliance: about a cell size times the pressure
  // that they lose, over E*.
  CHECK(residual.first_loading.max_plastic_depth <
        4 * step * largest / contact_modulus * surface.grid.dx());
  CHECK(residual.first_loading.mean_plastic_depth <
        residual.first_loading.max_plastic_depth * residual.first_loading.yielded_area_fraction);
}

TEST_CASE("The residual surface carries the first load by elasticity alone", "[first_loading]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const double share = GENERATE(0.6, 0.3, 0.1);
  const Surface surface = rough();
  const auto options = contact(boundary, share * max_elastic_pressure(boundary));
  const auto loaded = press(surface, contact_modulus, at_pressure(pressure), options);
  const ResidualSurface residual = after_first_loading(surface, contact_modulus, pressure, options);
  REQUIRE(residual.converged());
  const FirstLoading& first = residual.first_loading;
  CHECK(first.pressure == loaded.mean_pressure);
  CHECK(first.yielded());
  CHECK(first.yielded_area_fraction ==
        Approx(double((loaded.contact_pressure == options.hardness).count()) / 64 / 64));
  const Field depth = surface.heights - residual.surface.heights;
  CHECK((depth >= 0).all());
  CHECK(((depth == 0) || (loaded.contact_pressure == options.hardness)).all());
  CHECK(depth.mean() == Approx(first.mean_plastic_depth).epsilon(1e-9));
  CHECK(depth.maxCoeff() == Approx(first.max_plastic_depth).epsilon(1e-9));

  const auto unloading =
      press(residual.surface, contact_modulus, at_pressure(pressure), elastic(options));
  REQUIRE(unloading.converged());
  // e_c is a mean of gaps over the contact. The energy is of second order in the error of the
  // pressure and therefore accurate to e_c, pressures to its root, 1e-6. Gaps follow the
  // displacement.
  CHECK(((unloading.contact_pressure - loaded.contact_pressure).abs().maxCoeff() <
         1e-4 * options.hardness));
  CHECK(((unloading.gap - loaded.gap).abs().maxCoeff() < 1e-6 * rms_height(surface)));
  CHECK(unloading.force == Approx(loaded.force).epsilon(1e-10));
  CHECK(unloading.mean_gap == Approx(loaded.mean_gap).epsilon(1e-7));
  // The plane stays in place and the highest point is lower.
  CHECK(unloading.indentation == Approx(loaded.indentation - (surface.heights.maxCoeff() -
                                                              residual.surface.heights.maxCoeff()))
                                     .epsilon(1e-6));
}

TEST_CASE("Reloading follows the unloading curve up to the first load", "[first_loading]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const auto options = contact(boundary, 0.2 * max_elastic_pressure(boundary));
  const ResidualSurface first = after_first_loading(rough(), contact_modulus, pressure, options);
  REQUIRE(first.converged());
  REQUIRE(first.first_loading.max_plastic_depth > 0);
  for (const double share : {0.03, 0.3, 0.99, 1.0}) {
    const ResidualSurface again =
        after_first_loading(first.surface, contact_modulus, share * pressure, options);
    REQUIRE(again.converged());
    // At the same load the cells at the limit reach it again within the solver's tolerance.
    CHECK(again.first_loading.max_plastic_depth <=
          (share < 1 ? 0 : 1e-6) * first.first_loading.max_plastic_depth);
  }
  // A higher load causes further flow.
  const ResidualSurface more =
      after_first_loading(first.surface, contact_modulus, 1.2 * pressure, options);
  CHECK(more.first_loading.max_plastic_depth > 1e-2 * first.first_loading.max_plastic_depth);
}

TEST_CASE("A first loading in steps is a first loading at once", "[first_loading]") {
  const Surface surface = rough();
  const auto options = contact(Boundary::periodic, 0.2 * max_elastic_pressure(Boundary::periodic));
  const ResidualSurface at_once =
      after_first_loading(surface, contact_modulus, 2 * pressure, options);
  const ResidualSurface half = after_first_loading(surface, contact_modulus, pressure, options);
  const ResidualSurface then =
      after_first_loading(half.surface, contact_modulus, 2 * pressure, options);
  REQUIRE((at_once.converged() && half.converged() && then.converged()));
  const Field depth = surface.heights - at_once.surface.heights;
  // The difference is due to cells that flow at half the load but not at the whole load.
  CHECK(((at_once.surface.heights - then.surface.heights).abs().mean() < 1e-3 * depth.mean()));
}

TEST_CASE("An oscillation about the first load stays below the hardness", "[first_loading]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Surface surface = rough();
  const double amplitude = 0.03 * rms_height(surface);
  const auto options = contact(boundary, 0.2 * max_elastic_pressure(boundary));
  const ResidualSurface still = after_first_loading(surface, contact_modulus, pressure, options);
  const ResidualSurface moved =
      after_first_loading(surface, contact_modulus, pressure, options, amplitude);
  REQUIRE(moved.converged());
  const auto max_pressure = [&](const ResidualSurface& residual) {
    const auto mean =
        press(residual.surface, contact_modulus, at_pressure(pressure), elastic(options));
    return press(residual.surface, contact_modulus, at_indentation(mean.indentation + amplitude),
                 elastic(options));
  };
  const auto top = max_pressure(moved);
  // The load of the oscillation is found to a thousandth; a pressure at the hardness grows no
  // faster than a few times the load.
  CHECK(top.mean_pressure == Approx(moved.first_loading.pressure).epsilon(1e-3));
  CHECK(top.contact_pressure.maxCoeff() < 1.005 * options.hardness);
  CHECK(max_pressure(still).contact_pressure.maxCoeff() > 1.03 * options.hardness);
}

TEST_CASE("A load that the hardness cannot carry is refused", "[first_loading]") {
  const Surface surface = rough();
  const auto options = contact(Boundary::periodic, 1.05 * pressure);
  CHECK_THROWS_WITH(after_first_loading(surface, contact_modulus, 1.06 * pressure, options),
                    Catch::Contains("hardness: 10.5 MPa must exceed the nominal pressure"));
  // Nearly all of the area flows, and the rest closes over a short distance.
  const double gap = press(surface, contact_modulus, at_pressure(pressure), options).mean_gap;
  CHECK_THROWS_WITH(after_first_loading(surface, contact_modulus, pressure, options, 0.5 * gap),
                    Catch::Contains("hardness: 10.5 MPa must exceed the largest mean pressure of "
                                    "the oscillation"));
  CHECK(after_first_loading(surface, contact_modulus, pressure, options, 2 * gap)
            .first_loading.pressure == Approx(pressure).epsilon(1e-10));
  for (const double amplitude : {-1e-9, std::nan(""), HUGE_VAL})
    CHECK_THROWS_WITH(after_first_loading(surface, contact_modulus, pressure, options, amplitude),
                      Catch::Contains("normal_amplitude"));
  NormalContactState other;
  other.contact_pressure = Field::Zero(4, 4);
  CHECK_THROWS_AS(residual_surface(surface, contact_modulus, other, options), InvalidInput);
}

namespace {

/// A paraboloid loaded to `load` times the force at which its centre reaches the hardness, and the
/// forces of its unloading curve.
struct Unloading {
  double force = 0, radius = 0, indentation = 0;  // at the first load; radius from K = 2E*a
  std::vector<double> share, forces;              // parts of the indentation; forces, N
  double hardness = 0;

  Unloading(Index points, double load) {
    const double side = 1e-3, body_radius = 1e-2;
    const Grid2D grid{points, points, side, side};
    const Surface surface = paraboloid_surface(grid, body_radius, off_grid_center(grid));
    // At any load the contact fills half of the side, by Hertz or with the uniform pressure H =
    // p0/∛load.
    const double contact_radius = 0.25 * side / std::max(1.0, std::sqrt(2.0 / 3 * std::cbrt(load)));
    const double hertz = 4 * contact_modulus * std::pow(contact_radius, 3) / (3 * body_radius);
    force = hertz;
    // Hertz: p0 = 2E*a/(πR), and the force at first flow is proportional to p0³.
    hardness = 2 * contact_modulus * contact_radius / (pi * body_radius) / std::cbrt(load);
    NormalContactOptions options = contact(Boundary::free, hardness);
    options.tolerance = 1e-9;
    const ResidualSurface residual =
        after_first_loading(surface, contact_modulus, force / grid.area(), options);
    REQUIRE(residual.converged());
    const auto top = press(residual.surface, contact_modulus, at_pressure(force / grid.area()),
                           elastic(options));
    indentation = top.indentation;
    radius = normal_stiffness(top, grid, contact_modulus, elastic(options)) / (2 * contact_modulus);
    for (const double part : {0.2, 0.4, 0.6, 0.8}) {
      share.push_back(part);
      forces.push_back(press(residual.surface, contact_modulus, at_indentation(part * indentation),
                             elastic(options))
                           .force);
    }
  }
};

}  // namespace

TEST_CASE("A sphere unloads as the flattened sphere of its load and contact radius",
          "[first_loading]") {
  // Johnson, section 6.4: Hertz with the curvature 1/R' = 3F/(4E*a³), hence δ = 3F/(4E*a). He
  // assumes Hertz's pressures for the first loading; the flatter they are, the shallower they press
  // in the middle.
  struct Case {
    double load, tolerance;
  };
  const Case one = GENERATE(Case{1, 0.01}, Case{1.5, 0.04}, Case{3, 0.11});
  const Unloading curve(64, one.load);
  const double recovered = 3 * curve.force / (4 * contact_modulus * curve.radius);
  INFO(one.load << " " << curve.indentation / recovered);
  CHECK(curve.indentation == Approx(recovered).epsilon(one.tolerance));
  CHECK(curve.indentation < 1.01 * recovered);
  for (std::size_t i = 0; i < curve.share.size(); ++i)
    CHECK(curve.forces[i] / curve.force ==
          Approx(std::pow(curve.share[i], 1.5)).margin(one.tolerance));
}

TEST_CASE("A sphere far beyond first flow unloads from a uniform pressure", "[first_loading]") {
  // The residual profile is the displacement under the pressure H on a circle. By the method of
  // dimensionality reduction, g(x) = (2H/E*)(a − √(a² − x²)) and F(c) = 2E*∫_0^c (g(c) − g(x)) dx =
  // 2H[a² asin(c/a) − c√(a² − c²)] at δ = g(c).
  const Unloading curve(64, 1e4);
  const double a = std::sqrt(curve.force / (pi * curve.hardness));
  const double indentation = 2 * curve.hardness * a / contact_modulus;
  INFO(curve.radius / a << " " << curve.indentation / indentation);
  // Errors come from cells at the perimeter and from the rim that is still elastic: 2 % for 16
  // cells in the radius.
  CHECK(curve.radius == Approx(a).epsilon(0.02));
  CHECK(curve.indentation == Approx(indentation).epsilon(0.02));
  for (std::size_t i = 0; i < curve.share.size(); ++i) {
    const double depth = 1 - curve.share[i], c = std::sqrt(1 - depth * depth);
    CHECK(curve.forces[i] / curve.force ==
          Approx(2 / pi * (std::asin(c) - c * depth)).epsilon(0.03));
  }
}
