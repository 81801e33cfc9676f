// SPDX-License-Identifier: GPL-3.0-or-later
#include <salebra/damping/level_quadrature.hpp>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/law.hpp>
#include <salebra/damping/dissipation.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double contact_modulus = 3e9;

// Cells whose centres lie in an ellipse about the middle of the grid, shifted by (0.31, 0.17) of a cell.
ContactSet ellipse(const Grid2D& grid, double a, double b) {
  ContactSet contact(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double x = (static_cast<double>(ix) - 0.31) * grid.dx() - grid.lx / 2;
      const double y = (static_cast<double>(iy) - 0.17) * grid.dy() - grid.ly / 2;
      contact(ix, iy) = std::pow(x / a, 2) + std::pow(y / b, 2) < 1;
    }
  return contact;
}

// The paraboloid r²/(2R): a² = Rδ, F = (4/3)E*√R δ^(3/2).
constexpr double radius = 0.3;
const double law_coefficient = 4.0 / 3 * contact_modulus * std::sqrt(radius);
ContactLevels paraboloid(const Grid2D& grid) {
  return [grid](double indentation) {
    const double a = std::sqrt(radius * std::max(indentation, 0.0));
    return ContactLevel{ellipse(grid, a, a), law_coefficient * std::pow(std::max(indentation, 0.0), 1.5)};
  };
}

const Grid2D grid{48, 48, 1e-3, 1e-3};
constexpr double mean_indentation = 0.3e-6, amplitude = 0.1e-6;  // contact radii from 0.24 to 0.35 mm

LevelQuadratureOptions free_boundary() {
  LevelQuadratureOptions options;
  options.stick.boundary = Boundary::free;
  return options;
}

}  // namespace

TEST_CASE("Levels of a paraboloid give its exact loss at finite amplitude", "[levels]") {
  const double poisson = GENERATE(0.0, 0.3, 0.5);
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const PowerLaw law(law_coefficient, 1.5, material.modulus_ratio());
  for (const Oscillation& motion :
       {Oscillation(EqualFrequency{amplitude, 2e-7, 0.8}), Oscillation(Drag{amplitude, 1e-3, 2e3})}) {
    const LevelQuadratureResult levels = level_quadrature(paraboloid(grid), grid, material, motion,
                                                          mean_indentation, free_boundary());
    const DampingResult exact = relaxation_damping(law, AtIndentation{mean_indentation}, motion);
    REQUIRE(levels.converged);
    // The forces are exact here, so that only the fit of F remains.
    CHECK(levels.work_by_force == Approx(exact.work_per_cycle).epsilon(1e-6));
    CHECK(levels.curvature == Approx(exact.curvature).epsilon(1e-6));
    CHECK(levels.small_amplitude_work == Approx(exact.small_amplitude_work).epsilon(1e-6));
    // The number of cells cancels in K_t/K, the shape of their outline does not: 0.65 % at most on 48 cells, 0.1 % on 128.
    CHECK(levels.work_per_cycle == Approx(exact.work_per_cycle).epsilon(0.01));
    CHECK(levels.work_by_levels == Approx(exact.work_per_cycle).epsilon(0.02));
    CHECK(levels.error_estimate < 5e-3 * exact.work_per_cycle);
    if (poisson == 0)  // the kernels coincide
      CHECK(levels.work_per_cycle == Approx(levels.work_by_force).epsilon(1e-8));
  }
}

TEST_CASE("Along and across an elongated contact the loss differs as Mindlin's ellipses do", "[levels]") {
  const double poisson = 0.4, axes = 0.25;
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  // Similar ellipses: every level has the same K_t/K, whatever the force law.
  const ContactLevels levels = [&](double indentation) {
    const double a = 0.45e-3 * indentation / (mean_indentation + amplitude);
    return ContactLevel{ellipse(grid, a, axes * a), indentation * indentation};
  };
  // ∫_0^{2π} (1 − ν cos²φ)/√(a²cos²φ + b²sin²φ) dφ of PHYSICS section 7's kernel, by the trapezoidal rule: periodic, so exact.
  const auto compliance = [&](double a, double b) {
    double sum = 0;
    for (int k = 0; k < 400; ++k) {
      const double c = std::cos(2 * pi * k / 400), s = std::sin(2 * pi * k / 400);
      sum += (1 - poisson * c * c) / std::hypot(a * c, b * s);
    }
    return sum;
  };
  const auto normal = [&](double a, double b) {
    double sum = 0;
    for (int k = 0; k < 400; ++k)
      sum += (1 - poisson) / std::hypot(a * std::cos(2 * pi * k / 400), b * std::sin(2 * pi * k / 400));
    return sum;
  };
  const Oscillation motion = EqualFrequency{amplitude, 2e-7, pi / 2};
  for (const double direction : {0.0, pi / 2}) {
    LevelQuadratureOptions options = free_boundary();
    options.levels = 8;
    options.direction = direction;
    const LevelQuadratureResult result =
        level_quadrature(levels, grid, material, motion, mean_indentation, options);
    const double along = direction == 0 ? compliance(1, axes) : compliance(axes, 1);
    const double expected = normal(1, axes) / along / material.modulus_ratio();
    CHECK(std::abs(expected - 1) > 0.05);
    CHECK(result.stiffness_ratio == Approx(expected).epsilon(4e-3));  // 0.2 % measured
  }
}

TEST_CASE("Levels and steps agree on a contact of several pieces", "[levels]") {
  const Grid2D cells{36, 30, 1.2e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactLevels caps = [&](double indentation) {
    ContactLevel level{.contact = ContactSet::Constant(cells.nx, cells.ny, false)};
    for (Index ix = 0; ix < cells.nx; ++ix)
      for (Index iy = 0; iy < cells.ny; ++iy) {
        const double x = 2 * pi * (static_cast<double>(ix) + 0.31) / 36;
        const double y = 2 * pi * (static_cast<double>(iy) + 0.17) / 30;
        level.contact(ix, iy) = std::sin(x) + std::cos(2 * y) + 0.5 * std::sin(2 * x + y) > 1.5 - indentation;
      }
    return level;
  };
  const Oscillation motion = EqualFrequency{0.5, 2e-7, 1.0};
  LevelQuadratureOptions options;
  options.levels = 32;
  const double by_levels =
      level_quadrature(caps, cells, material, motion, 0.5, options).work_by_levels;
  CycleOptions steps{.steps = 64};
  const double by_steps =
      simulate_cycle(caps, cells, material, trajectory_of(motion, 0.5), steps).work_per_cycle;
  // Both sample a K_t that grows by whole cells, a few hundred of them: below a per cent.
  CHECK(by_levels == Approx(by_steps).epsilon(0.01));
}

TEST_CASE("A level that fails makes the quadrature fail, and bad input is named", "[levels]") {
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const Oscillation motion = EqualFrequency{amplitude, 2e-7, pi / 2};
  LevelQuadratureOptions options = free_boundary();
  options.levels = 4;
  options.stick.max_iterations = 2;
  CHECK_FALSE(
      level_quadrature(paraboloid(grid), grid, material, motion, mean_indentation, options).converged);
  options = free_boundary();
  options.on_progress = [](const ProgressReport& report) { return report.step < 3; };
  CHECK(level_quadrature(paraboloid(grid), grid, material, motion, mean_indentation, options).interrupted);
  options.levels = 3;
  CHECK_THROWS_WITH(
      level_quadrature(paraboloid(grid), grid, material, motion, mean_indentation, options),
      Catch::StartsWith("levels: 3"));
  CHECK_THROWS_WITH(level_quadrature(paraboloid(grid), grid, material, EqualFrequency{0, 1, 1},
                                     mean_indentation, free_boundary()),
                    Catch::StartsWith("normal_amplitude: 0"));
}
