// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/normal.hpp>

#include "contact/half_space/half_space.hpp"
#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

namespace {

constexpr double contact_modulus = 1e9;

NormalContactOptions free_contact(double tolerance = 1e-12) {
  NormalContactOptions options;
  options.boundary = Boundary::free;
  options.tolerance = tolerance;
  return options;
}

// The summit lies off the grid's points and lines of symmetry by parts of a cell, as it usually
// does.
Surface paraboloid(Index n, double side, double radius, double off_x = 0.31, double off_y = 0.17) {
  const double cell = side / double(n), x0 = side / 2 + off_x * cell, y0 = side / 2 + off_y * cell;
  return surface_of({n, n, side, side}, [=](double x, double y) {
    return -(std::pow(x - x0, 2) + std::pow(y - y0, 2)) / (2 * radius);
  });
}

}  // namespace

TEST_CASE("Love's and Cerruti's integrals equal sums over small parts of the cell",
          "[half_space]") {
  const double dx = 2e-3, dy = 3e-3;
  const auto [x, y] =
      GENERATE(std::pair<double, double>{4e-3, -5e-3}, std::pair<double, double>{0, 6e-3},
               std::pair<double, double>{-7e-3, 0}, std::pair<double, double>{11e-3, 13e-3});
  const CellIntegrals exact = cell_integrals(x, y, dx, dy);
  CellIntegrals sum;
  const int parts = 200;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      const double xi = x - dx * ((i + 0.5) / parts - 0.5),
                   eta = y - dy * ((j + 0.5) / parts - 0.5);
      const double r = std::hypot(xi, eta), area = dx * dy / (parts * parts);
      sum.inverse_distance += area / r;
      sum.xx += area * xi * xi / (r * r * r);
      sum.yy += area * eta * eta / (r * r * r);
      sum.xy += area * xi * eta / (r * r * r);
    }
  // The midpoint rule with 200 parts has an error of (1/200)²/24 times a few: 1e-5.
  const double scale = sum.inverse_distance;
  CHECK(exact.inverse_distance == Approx(sum.inverse_distance).epsilon(1e-5));
  CHECK(exact.xx == Approx(sum.xx).margin(1e-5 * scale));
  CHECK(exact.yy == Approx(sum.yy).margin(1e-5 * scale));
  CHECK(exact.xy == Approx(sum.xy).margin(1e-5 * scale));
}

TEST_CASE("Love's and Cerruti's integrals keep their digits at any distance", "[half_space]") {
  const double turn = GENERATE(0.0, 0.3, 0.8, 1.4, 2.5);
  const double c = std::cos(turn), s = std::sin(turn);
  for (const double r : {31.0, 33.0, 100.0, 1e3, 1e5}) {
    const double x = r * c, y = r * s;
    const auto cell = cell_integrals(x, y, 1, 1);
    // Taylor's series over a square of side 1: ∬f = f + ∇²f/24 + (f_xxxx + f_yyyy)/1920 +
    // f_xxyy/576; the next term is of sixth order.
    const double fourth = (9 - 90 * c * c + 105 * std::pow(c, 4)) / 1920 +
                          (9 - 90 * s * s + 105 * std::pow(s, 4)) / 1920 +
                          (105 * c * c * s * s - 12) / 576;
    const double exact = (1 + 1 / (24 * r * r) + fourth / std::pow(r, 4)) / r;
    CHECK(cell.inverse_distance == Approx(exact).epsilon(1e-12 + 3e-3 / std::pow(r, 6)));
    // ∇²(x²/r³) = (2 − 3 x²/r²)/r³; ∇²(xy/r³) = −3 xy/r⁵. The next order is 2e-8 of 1/r at 31.
    CHECK(cell.xx == Approx((c * c + (2 - 3 * c * c) / (24 * r * r)) / r)
                         .epsilon(1e-12)
                         .margin(0.5 / std::pow(r, 5)));
    CHECK(
        cell.xy ==
        Approx((c * s - 3 * c * s / (24 * r * r)) / r).epsilon(1e-12).margin(0.5 / std::pow(r, 5)));
    CHECK(cell.xx + cell.yy == Approx(cell.inverse_distance).epsilon(1e-14));
  }
}

TEST_CASE("A cell's own displacement is Love's value at the centre of a square", "[half_space]") {
  // (4/π) ln(1 + √2)/E* for a square of side 1 under unit pressure (Johnson, Contact Mechanics,
  // section 3.6).
  CHECK(cell_integrals(0, 0, 1, 1).inverse_distance ==
        Approx(4 * std::log(1 + std::sqrt(2.0))).epsilon(1e-14));
  CHECK(cell_integrals(0, 0, 1, 1).xx == Approx(cell_integrals(0, 0, 1, 1).yy).epsilon(1e-14));
}

TEST_CASE("A zero-padded convolution is the sum over all loaded cells, without images",
          "[half_space]") {
  const Grid2D grid{7, 10, 7e-3, 5e-3};
  const Field pressure = 1e6 * (1 + Field::Random(7, 10));
  auto compliance = normal_compliance<double>(grid, contact_modulus, Boundary::free);
  Field displacement(7, 10);
  compliance.apply(pressure.data(), displacement.data());
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  auto shear = tangential_compliance<double>(grid, material, Boundary::free);
  const Field other = 1e6 * Field::Random(7, 10);
  Field x(7, 10), y(7, 10);
  shear.apply({pressure.data(), other.data()}, {x.data(), y.data()});
  for (const auto [i, j] : {std::pair<Index, Index>{0, 0}, {6, 9}, {3, 5}, {6, 0}}) {
    double normal = 0, along = 0, across = 0;
    for (Index a = 0; a < 7; ++a)
      for (Index b = 0; b < 10; ++b) {
        const auto cell = cell_integrals(double(i - a) * grid.dx(), double(j - b) * grid.dy(),
                                         grid.dx(), grid.dy());
        const double c1 = material.cerruti_isotropic, c2 = material.cerruti_directed;
        normal += cell.inverse_distance / (pi * contact_modulus) * pressure(a, b);
        along += (c1 * cell.inverse_distance + c2 * cell.xx) * pressure(a, b) +
                 c2 * cell.xy * other(a, b);
        across += (c1 * cell.inverse_distance + c2 * cell.yy) * other(a, b) +
                  c2 * cell.xy * pressure(a, b);
      }
    CHECK(displacement(i, j) == Approx(normal).epsilon(1e-12));
    CHECK(x(i, j) == Approx(along).epsilon(1e-12));
    CHECK(y(i, j) == Approx(across).epsilon(1e-12));
  }
}

TEST_CASE("At ν = 0 the tangential compliance is twice decoupled, and equal to the normal one",
          "[half_space]") {
  // For one elastic body with ν = 0, G* = E*, c1 = 1/(πE*) and c2 = 0, so that all three kernels
  // coincide.
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Grid2D grid{24, 20, 1e-3, 1e-3};
  const Field traction = Field::Random(24, 20);
  const Field none = Field::Zero(24, 20);
  auto normal = normal_compliance<double>(grid, contact_modulus, boundary);
  auto shear = tangential_compliance<double>(grid, Material::of_contact_modulus(contact_modulus, 0),
                                             boundary);
  Field u(24, 20), x(24, 20), y(24, 20);
  normal.apply(traction.data(), u.data());
  shear.apply({none.data(), traction.data()}, {x.data(), y.data()});
  CHECK((y - u).abs().maxCoeff() < 1e-13 * u.abs().maxCoeff());
  CHECK(x.abs().maxCoeff() < 1e-13 * u.abs().maxCoeff());
}

TEST_CASE(
    "Hertz: force, indentation and peak pressure converge at second order, the contact radius at "
    "first",
    "[normal]") {
  const double side = 1e-3, radius = 1e-2, contact_radius = side / 4;
  const double force = 4.0 / 3 * contact_modulus * std::pow(contact_radius, 3) / radius;
  const double approach = contact_radius * contact_radius / radius;
  const double peak = 1.5 * force / (pi * contact_radius * contact_radius);
  struct Errors {
    double force = 0, approach = 0, peak = 0, radius = 0;
  };
  // The errors scatter with the position of the summit in its cell; their mean over a few positions
  // does not.
  const std::array<std::array<double, 2>, 6> places{
      {{0.31, 0.17}, {0.04, 0.46}, {0.72, 0.61}, {0.55, 0.93}, {0.88, 0.28}, {0.19, 0.79}}};
  const auto errors = [&](Index n) {
    Errors mean;
    for (const auto& [x, y] : places) {
      const Surface surface = paraboloid(n, side, radius, x, y);
      // First touch is at the summit of the paraboloid, which lies between the points of the grid.
      const double touch = -surface.heights.maxCoeff();
      const auto held =
          press(surface, contact_modulus, at_indentation(approach - touch), free_contact());
      const auto loaded =
          press(surface, contact_modulus, at_pressure(force / surface.grid.area()), free_contact());
      REQUIRE((held.converged() && loaded.converged()));
      const auto add = [](double& sum, double value, double exact) {
        sum += std::abs(value / exact - 1) / 6;
      };
      add(mean.force, held.force, force);
      add(mean.approach, loaded.indentation + touch, approach);
      add(mean.peak, loaded.contact_pressure.maxCoeff(), peak);
      add(mean.radius, std::sqrt(held.contact_area_fraction * side * side / pi), contact_radius);
    }
    return mean;
  };
  const Errors coarse = errors(16), fine = errors(128);
  const auto order = [](double from, double to) { return std::log2(from / to) / 3; };
  INFO("force " << coarse.force << ' ' << fine.force << ", approach " << coarse.approach << ' '
                << fine.approach << ", peak " << coarse.peak << ' ' << fine.peak << ", radius "
                << coarse.radius << ' ' << fine.radius);
  // Pressures are constant over cells and match the gap at their centres: second order inside. The
  // edge, where p falls like a square root over one cell, adds the same order. Measured from 16 to
  // 256 cells: 1.85, 1.88, 1.92, 1.95 for the force.
  CHECK(order(coarse.force, fine.force) == Approx(1.9).margin(0.15));
  CHECK(order(coarse.approach, fine.approach) == Approx(1.9).margin(0.15));
  CHECK(order(coarse.peak, fine.peak) > 1.8);
  CHECK(fine.force < 1e-4);
  // Cells count whole, and cells that the edge cuts carry load: an eighth of a cell too much on
  // each side.
  CHECK(order(coarse.radius, fine.radius) == Approx(1.0).margin(0.15));
  CHECK(fine.radius * contact_radius < 0.25 * side / 128);
}

TEST_CASE("Hertz: force, indentation and stiffness are one curve", "[normal]") {
  const Surface surface = paraboloid(96, 1e-3, 1e-2);
  const double indentation = 5e-6;
  const auto options = free_contact();
  const auto state = press(surface, contact_modulus, at_indentation(indentation), options);
  REQUIRE(state.converged());
  CHECK(state.indentation == Approx(indentation).epsilon(1e-12));
  CHECK(state.force ==
        Approx(4.0 / 3 * contact_modulus * std::sqrt(1e-2) * std::pow(indentation, 1.5))
            .epsilon(2e-3));
  const auto back = press(surface, contact_modulus, at_pressure(state.mean_pressure), options);
  CHECK(back.indentation == Approx(indentation).epsilon(1e-8));
  // K = 2E*a; the contact radius is accurate to half a cell in fifty.
  const double stiffness = normal_stiffness(state, surface.grid, contact_modulus, options);
  CHECK(stiffness == Approx(2 * contact_modulus * std::sqrt(1e-2 * indentation)).epsilon(1e-2));
}

TEST_CASE("A flat square punch is linear: its force is its stiffness times its indentation",
          "[normal]") {
  const double side = 1e-3, indentation = 1e-6;
  const auto stiffness = [&](Index n) {
    const Surface punch = surface_of({n, n, side, side}, [](double, double) { return 0.25; });
    const auto state = press(punch, contact_modulus, at_indentation(indentation), free_contact());
    REQUIRE(state.converged());
    CHECK(state.contact_area_fraction == 1);
    const double value = normal_stiffness(state, punch.grid, contact_modulus, free_contact());
    CHECK(value * indentation == Approx(state.force).epsilon(1e-8));
    const auto back =
        press(punch, contact_modulus, at_pressure(state.mean_pressure), free_contact());
    CHECK(back.indentation == Approx(indentation).epsilon(1e-8));
    return value / (contact_modulus * side);
  };
  // Collocation at cell centres converges at first order, because of the edge singularity: one
  // Richardson step.
  const double coarse = stiffness(32), fine = stiffness(64), extrapolated = 2 * fine - coarse;
  INFO(coarse << ' ' << fine << ' ' << extrapolated);
  // π/(4πε0) times the capacity of a square plate, 0.36679 × 4πε0 × side, because electrostatics
  // has the same kernel.
  CHECK(extrapolated == Approx(0.36679 * pi).epsilon(1e-3));
}

TEST_CASE("A free contact does not feel the size of its grid", "[normal]") {
  const auto pressed = [](Index n, double side) {
    const double cell = side / double(n);
    // Both grids have the same cells around the summit.
    const Surface surface = surface_of({n, n, side, side}, [=](double x, double y) {
      return -(std::pow(x - side / 2, 2) + std::pow(y - side / 2, 2)) / 2e-2 + 0 * cell;
    });
    return press(surface, contact_modulus, at_pressure(0.2 / surface.grid.area()),
                 free_contact(1e-13));
  };
  const auto small = pressed(48, 0.6e-3), large = pressed(80, 1e-3);
  REQUIRE((small.converged() && large.converged()));
  CHECK(small.indentation == Approx(large.indentation).epsilon(1e-8));
  CHECK(small.contact_pressure.maxCoeff() ==
        Approx(large.contact_pressure.maxCoeff()).epsilon(1e-6));
}

TEST_CASE("A free contact does not feel where on its grid it lies, nor from where heights count",
          "[normal]") {
  const Surface surface = paraboloid(64, 1e-3, 4e-3, -12.4, -10.7);
  Surface moved = surface;
  for (Index i = 0; i < 64; ++i)
    for (Index j = 0; j < 64; ++j)
      moved.heights(i, j) =
          1e-3 - (std::pow(double(i) - 19.6 - 17, 2) + std::pow(double(j) - 21.3 - 13, 2)) *
                     surface.grid.cell_area() / 8e-3;
  const double pressure = 0.3 / surface.grid.area();
  const auto here = press(surface, contact_modulus, at_pressure(pressure), free_contact(1e-14));
  const auto there = press(moved, contact_modulus, at_pressure(pressure), free_contact(1e-14));
  REQUIRE((here.converged() && there.converged()));
  CHECK(here.contact_area_fraction > 0.01);
  CHECK(there.contact_area_fraction == here.contact_area_fraction);
  CHECK(there.indentation == Approx(here.indentation).epsilon(1e-10));
  CHECK(there.elastic_energy == Approx(here.elastic_energy).epsilon(1e-10));
}

TEST_CASE("A free contact names what it does not have", "[normal]") {
  const Surface surface = paraboloid(16, 1e-3, 1e-2);
  CHECK_THROWS_WITH(press(surface, contact_modulus, at_mean_gap(1e-6), free_contact()),
                    Catch::Contains("boundary"));
  CHECK_THROWS_AS(press(surface, contact_modulus, at_indentation(-1e-6), free_contact()),
                  InvalidInput);
}

TEST_CASE("Saturated cells carry exactly the hardness, and forces balance", "[normal]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Surface surface = rough_surface({96, 96, 1e-3, 1e-3});
  NormalContactOptions options = free_contact();
  options.boundary = boundary;
  options.precision = precision;
  const double pressure = 1e7;
  const auto elastic = press(surface, contact_modulus, at_pressure(pressure), options);
  options.hardness = 0.3 * elastic.contact_pressure.maxCoeff();
  const auto state = press(surface, contact_modulus, at_pressure(pressure), options);
  REQUIRE(state.converged());
  CHECK(state.contact_pressure.maxCoeff() == options.hardness);
  const Index saturated = (state.contact_pressure == options.hardness).count();
  CHECK(saturated > 100);
  CHECK(state.contact_pressure.mean() == Approx(pressure).epsilon(1e-10));
  CHECK((state.gap.minCoeff() > -1e-6 * rms_height(surface)));
  CHECK(((state.contact_pressure < options.hardness) || (state.gap == 0)).all());
  CHECK(state.indentation > elastic.indentation);
  CHECK(normal_stiffness(state, surface.grid, contact_modulus, options) > 0);
  // A hardness that no cell reaches changes nothing.
  options.hardness = 1.01 * elastic.contact_pressure.maxCoeff();
  CHECK(press(surface, contact_modulus, at_pressure(pressure), options).mean_gap ==
        Approx(elastic.mean_gap).epsilon(1e-6));
  options.hardness = pressure;
  CHECK_THROWS_WITH(press(surface, contact_modulus, at_pressure(pressure), options),
                    Catch::Contains("hardness"));
}

TEST_CASE("Hardness that most of the load meets: soft as a cushion, still a solution", "[normal]") {
  // The set of free cells flutters here, so gradient projection must finish the solve.
  const double hardness = GENERATE(1.05e6, 1.3e6, 4e6, 1e7);
  const Surface surface = rough_surface({64, 64, 1e-3, 1e-3});
  NormalContactOptions options;
  options.hardness = hardness;
  const auto state = press(surface, contact_modulus, at_pressure(1e6), options);
  REQUIRE(state.converged());
  CHECK(state.contact_pressure.mean() == Approx(1e6).epsilon(1e-10));
  CHECK(state.contact_pressure.maxCoeff() == hardness);
  // No cell carries more than its hardness, so at least this area is in contact.
  CHECK(state.contact_area_fraction >= 1e6 / hardness);
}
