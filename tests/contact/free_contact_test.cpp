// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/half_space.hpp>
#include <salebra/contact/normal.hpp>

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

// Off the grid's points and lines of symmetry, as contacts usually are.
Surface paraboloid(Index n, double side, double radius) {
  const double cell = side / double(n), x0 = side / 2 + 0.31 * cell, y0 = side / 2 + 0.17 * cell;
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
  // The midpoint rule with 200 parts is good to (1/200)²/24 times a few: 1e-5.
  const double scale = sum.inverse_distance;
  CHECK(exact.inverse_distance == Approx(sum.inverse_distance).epsilon(1e-5));
  CHECK(exact.xx == Approx(sum.xx).margin(1e-5 * scale));
  CHECK(exact.yy == Approx(sum.yy).margin(1e-5 * scale));
  CHECK(exact.xy == Approx(sum.xy).margin(1e-5 * scale));
}

TEST_CASE("A cell's own displacement is Love's value at the centre of a square", "[half_space]") {
  // (4/π) ln(1 + √2)/E* for a square of side 1 under unit pressure (Johnson, Contact Mechanics, section 3.6).
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
  // One elastic body with ν = 0: G* = E*, c1 = 1/(πE*), c2 = 0, so that all three kernels coincide.
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

TEST_CASE("Hertz: approach and peak pressure converge at least at order 1.5 in the cell size",
          "[normal]") {
  const double side = 1e-3, radius = 1e-2, contact_radius = side / 4;
  const double force = 4.0 / 3 * contact_modulus * std::pow(contact_radius, 3) / radius;
  const double approach = contact_radius * contact_radius / radius;
  const auto errors = [&](Index n) {
    const Surface surface = paraboloid(n, side, radius);
    const auto state =
        press_to_pressure(surface, contact_modulus, force / surface.grid.area(), free_contact());
    REQUIRE(state.converged);
    // First touch is at the summit of the paraboloid, which lies between the points of the grid.
    const double touch = -surface.heights.maxCoeff();
    const double peak = 1.5 * force / (pi * contact_radius * contact_radius);
    return std::array<double, 3>{
        std::abs((state.indentation + touch) / approach - 1),
        std::abs(state.pressure.maxCoeff() / peak - 1),
        std::abs(std::sqrt(state.contact_area_fraction * side * side / pi) / contact_radius - 1)};
  };
  const auto coarse = errors(32), fine = errors(128);
  INFO("approach " << coarse[0] << ' ' << fine[0] << " peak " << coarse[1] << ' ' << fine[1]
                   << " radius " << coarse[2] << ' ' << fine[2]);
  // Uniform pressure on cells at an edge where p falls like a square root: order 3/2.
  CHECK(std::log(coarse[0] / fine[0]) / std::log(4.0) > 1.4);
  CHECK(fine[0] < 1e-4);
  CHECK(fine[1] < 1e-3);
  CHECK(fine[2] < 5e-3);
}

TEST_CASE("Hertz: force, indentation and stiffness are one curve", "[normal]") {
  const Surface surface = paraboloid(96, 1e-3, 1e-2);
  const double indentation = 5e-6;
  const auto options = free_contact();
  const auto state = press_to_indentation(surface, contact_modulus, indentation, options);
  REQUIRE(state.converged);
  CHECK(state.indentation == Approx(indentation).epsilon(1e-12));
  CHECK(state.force ==
        Approx(4.0 / 3 * contact_modulus * std::sqrt(1e-2) * std::pow(indentation, 1.5))
            .epsilon(2e-3));
  const auto back = press_to_pressure(surface, contact_modulus, state.mean_pressure, options);
  CHECK(back.indentation == Approx(indentation).epsilon(1e-8));
  // K = 2E*a; the contact radius is known to half a cell in fifty.
  const double stiffness = normal_stiffness(state, surface.grid, contact_modulus, options);
  CHECK(stiffness == Approx(2 * contact_modulus * std::sqrt(1e-2 * indentation)).epsilon(1e-2));
}

TEST_CASE("A flat square punch is linear: its force is its stiffness times its indentation",
          "[normal]") {
  const double side = 1e-3, indentation = 1e-6;
  const auto stiffness = [&](Index n) {
    const Surface punch = surface_of({n, n, side, side}, [](double, double) { return 0.25; });
    const auto state = press_to_indentation(punch, contact_modulus, indentation, free_contact());
    REQUIRE(state.converged);
    CHECK(state.contact_area_fraction == 1);
    const double value = normal_stiffness(state, punch.grid, contact_modulus, free_contact());
    CHECK(value * indentation == Approx(state.force).epsilon(1e-8));
    const auto back =
        press_to_pressure(punch, contact_modulus, state.mean_pressure, free_contact());
    CHECK(back.indentation == Approx(indentation).epsilon(1e-8));
    return value / (contact_modulus * side);
  };
  // Collocation at cell centres converges at first order to the edge singularity: one Richardson step.
  const double coarse = stiffness(32), fine = stiffness(64), extrapolated = 2 * fine - coarse;
  INFO(coarse << ' ' << fine << ' ' << extrapolated);
  // π/(4πε0) times the capacity of a square plate, 0.36679 × 4πε0 × side: electrostatics has the same kernel.
  CHECK(extrapolated == Approx(0.36679 * pi).epsilon(1e-3));
}

TEST_CASE("A free contact does not feel the size of its grid", "[normal]") {
  const auto pressed = [](Index n, double side) {
    const double cell = side / double(n);
    // The same cells around the summit on both grids.
    const Surface surface = surface_of({n, n, side, side}, [=](double x, double y) {
      return -(std::pow(x - side / 2, 2) + std::pow(y - side / 2, 2)) / 2e-2 + 0 * cell;
    });
    return press_to_pressure(surface, contact_modulus, 0.2 / surface.grid.area(),
                             free_contact(1e-13));
  };
  const auto small = pressed(48, 0.6e-3), large = pressed(80, 1e-3);
  REQUIRE((small.converged && large.converged));
  CHECK(small.indentation == Approx(large.indentation).epsilon(1e-8));
  CHECK(small.pressure.maxCoeff() == Approx(large.pressure.maxCoeff()).epsilon(1e-6));
}

TEST_CASE("A free contact names what it does not have", "[normal]") {
  const Surface surface = paraboloid(16, 1e-3, 1e-2);
  CHECK_THROWS_WITH(press_to_mean_gap(surface, contact_modulus, 1e-6, free_contact()),
                    Catch::Contains("boundary"));
  CHECK_THROWS_AS(press_to_indentation(surface, contact_modulus, -1e-6, free_contact()),
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
  const auto elastic = press_to_pressure(surface, contact_modulus, pressure, options);
  options.hardness = 0.3 * elastic.pressure.maxCoeff();
  const auto state = press_to_pressure(surface, contact_modulus, pressure, options);
  REQUIRE(state.converged);
  CHECK(state.pressure.maxCoeff() == options.hardness);
  const Index saturated = (state.pressure == options.hardness).count();
  CHECK(saturated > 100);
  CHECK(state.pressure.mean() == Approx(pressure).epsilon(1e-10));
  CHECK((state.gap.minCoeff() > -1e-6 * rms_height(surface)));
  CHECK(((state.pressure < options.hardness) || (state.gap == 0)).all());
  CHECK(state.indentation > elastic.indentation);
  CHECK(normal_stiffness(state, surface.grid, contact_modulus, options) > 0);
  // A hardness that no cell reaches changes nothing.
  options.hardness = 1.01 * elastic.pressure.maxCoeff();
  CHECK(press_to_pressure(surface, contact_modulus, pressure, options).mean_gap ==
        Approx(elastic.mean_gap).epsilon(1e-6));
  options.hardness = pressure;
  CHECK_THROWS_WITH(press_to_pressure(surface, contact_modulus, pressure, options),
                    Catch::Contains("hardness"));
}

TEST_CASE("Hardness that most of the load meets: soft as a cushion, still a solution", "[normal]") {
  // The set of free cells flutters here, and gradient projection has to finish.
  const double hardness = GENERATE(1.05e6, 1.3e6, 4e6, 1e7);
  const Surface surface = rough_surface({64, 64, 1e-3, 1e-3});
  NormalContactOptions options;
  options.hardness = hardness;
  const auto state = press_to_pressure(surface, contact_modulus, 1e6, options);
  REQUIRE(state.converged);
  CHECK(state.pressure.mean() == Approx(1e6).epsilon(1e-10));
  CHECK(state.pressure.maxCoeff() == hardness);
  // No cell carries more than its hardness: at least so much area is in contact.
  CHECK(state.contact_area_fraction >= 1e6 / hardness);
}
