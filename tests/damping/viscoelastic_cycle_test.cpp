// SPDX-License-Identifier: GPL-3.0-or-later
// Viscoelastic contacts of surfaces against springs with memory, elastic limits and energy balances.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/viscoelastic_cycle.hpp>
#include <salebra/damping/viscoelastic_damping.hpp>
#include <string>
#include <vector>

#include "../contact/normal/rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

namespace {

constexpr double side = 1e-3, tau = 0.02, shear = 1e6;
const Body rubber = Body::half_space({3 * shear, 0.5});
const PronySeries standard_solid{shear, {{3 * shear, tau}}};
const PronySeries broad{1, {{2, tau}, {1, 10 * tau}}};

Body stiffer(double factor) { return Body::half_space({3 * shear * factor, 0.5}); }

/// A rough surface at rest, and an amplitude that is half of F/K.
struct RoughContact {
  Surface surface = rough_surface({32, 32, side, side}, {.seed = 2});
  OperatingPoint point = at_pressure(4e4);
  NormalContactState rest = press(surface, rubber, point);
  double amplitude = 0.5 * rest.force / normal_stiffness(rest, surface.grid, rubber);

  EqualFrequency motion(double product) const { return {amplitude, 1e-7, 0.9, product / tau}; }
};

}  // namespace

TEST_CASE("A sphere loses what springs with memory lose", "[viscoelastic_cycle]") {
  const double radius = 5e-3, indentation = 4e-6;
  const Material material = Material::of_contact_modulus(4 * shear, 0.5);
  const IndenterLaw law(paraboloid_profile(radius), material);
  constexpr Index n = 32;
  const double width = 2.6 * std::sqrt(radius * 2.2 * indentation), cell = width / n;
  Surface sphere = surface_of({n, n, width, width}, [&](double x, double y) {
    // The axis lies off the grid points.
    const double dx = x - width / 2 + 0.3 * cell, dy = y - width / 2 + 0.2 * cell;
    return -(dx * dx + dy * dy) / (2 * radius);
  });
  sphere.periodic = false;
  ViscoelasticCycleOptions options;
  options.steps = 32;
  options.contact.boundary = options.stick.boundary = Boundary::free;
  // The last amplitude lifts the sphere off. At high frequencies it loses contact even at the first.
  for (const double product : {0.01, 1.0, 100.0})
    for (const double amplitude : {0.45 * indentation, 1.1 * indentation}) {
      CAPTURE(product, amplitude);
      const EqualFrequency motion{amplitude, 3e-7, 0.9, product / tau};
      const ViscoelasticCycle found = viscoelastic_cycle(sphere, material, standard_solid, motion,
                                                         at_indentation(indentation), options);
      REQUIRE(found.converged());
      const ViscoelasticDamping springs =
          viscoelastic_damping(law, standard_solid, sample(motion, indentation, options.steps));
      const double tangential = springs.tangential_material_work + springs.relaxation_work;
      // About 12 cells per contact radius give forces within 0.3 %, and losses, which come from the
      // cells that open, within 2 %. The quadratures of both are of second order, with different
      // factors: (2π/32)²/2 = 2 % of the normal work more.
      CHECK(found.mean_force == Approx(springs.mean_force).epsilon(3e-3));
      CHECK(found.tangential_work == Approx(tangential).epsilon(0.02));
      CHECK(found.normal_work == Approx(springs.normal_material_work).epsilon(0.035));
      const ViscoelasticDamping exact =
          viscoelastic_damping(law, standard_solid, sample(motion, indentation, 1024));
      CHECK(std::abs(found.work_per_cycle - exact.work_per_cycle) <
            found.work_per_cycle_error + 0.015 * exact.work_per_cycle);
    }
}

TEST_CASE("The loss of a cycle is the dissipation of its branches and jumps, at second order",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  for (const double product : {0.01, 0.1, 3.0}) {
    const auto imbalance = [&](int steps) {
      const ViscoelasticCycle found =
          viscoelastic_cycle(contact.surface, rubber, standard_solid, contact.motion(product),
                             contact.point, {.steps = steps});
      REQUIRE(found.converged());
      CHECK(found.jump_work > 0);
      CHECK(found.jump_work < found.tangential_work);
      return std::abs(found.dissipated / found.work_per_cycle - 1);
    };
    const double coarse = imbalance(16), fine = imbalance(48);
    CAPTURE(product, coarse, fine);
    // Where a branch relaxes within a step, the trapezoidal rule of ∮F dδ is off by (2π/steps)²/2 =
    // 0.86 %; elsewhere it is better.
    CHECK(fine < 0.01);
    CHECK(fine < 0.5 * coarse);
  }
}

TEST_CASE("Slow cycles are those of the relaxed body", "[viscoelastic_cycle]") {
  const RoughContact contact;
  const double product = 1e-3;
  const ViscoelasticCycle found = viscoelastic_cycle(
      contact.surface, rubber, broad, contact.motion(product), contact.point, {.steps = 64});
  REQUIRE(found.converged());
  const CycleResult elastic = simulate_cycle(
      boundary_element_contact_sets(contact.surface, rubber), contact.surface.grid, rubber,
      trajectory_of(contact.motion(product), contact.rest.indentation), {.steps = 64});
  // The slow limits: W_n → Σ g ωτ u_z² ∫K sin²θ dθ, and W_t → W∞ + Σ g ωτ ∫K_t (dx/dθ)² dθ.
  constexpr int phases = 32;
  double normal = 0, tangential = 0;
  for (int n = 0; n < phases; ++n) {
    const double theta = 2 * pi * (n + 0.5) / phases;
    const NormalContactState state =
        press(contact.surface, rubber,
              at_indentation(contact.rest.indentation + contact.amplitude * std::cos(theta)));
    const double speed = 1e-7 * std::sin(theta + 0.9);
    normal += normal_stiffness(state, contact.surface.grid, rubber) *
              std::pow(contact.amplitude * std::sin(theta), 2) * 2 * pi / phases;
    tangential += stick_stiffness(contact_set(state), contact.surface.grid, rubber, {}, true).xx *
                  speed * speed * 2 * pi / phases;
  }
  const double viscosity = product * (2 + 1 * 10);
  // ωτ of the slower branch is 0.01, so that corrections are of this order.
  CHECK(found.normal_work == Approx(viscosity * normal).epsilon(0.02));
  CHECK(std::abs(found.tangential_work - elastic.work_per_cycle - viscosity * tangential) <
        0.02 * elastic.work_per_cycle + elastic.step_error);
  CHECK(found.samples.size() == 65);
  CHECK(found.contact_area_max == Approx(elastic.contact_area_max).epsilon(0.01));
}

TEST_CASE("Fast cycles are elastic with the unrelaxed modulus and frozen branches",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  const Grid2D& grid = contact.surface.grid;
  const ViscoelasticCycle found = viscoelastic_cycle(
      contact.surface, rubber, standard_solid, contact.motion(1e3), contact.point, {.steps = 32});
  REQUIRE(found.converged());
  // With α = G(0)/G∞ and the mean displacement ū, the pressures are those of the unrelaxed body
  // under the heights h − (1 − 1/α) ū, found here by repetition.
  const double alpha = 4, top = contact.surface.heights.maxCoeff();
  const Body unrelaxed = stiffer(alpha);
  Field mean = Field::Zero(grid.nx, grid.ny);
  const auto pressed = [&](double indentation) {
    Surface frozen = contact.surface;
    frozen.heights -= (1 - 1 / alpha) * mean;
    const double depth = frozen.heights.maxCoeff() - (top - indentation);
    return std::pair(press(frozen, unrelaxed, at_indentation(depth)), frozen);
  };
  double force = 0;
  for (int repeat = 0; repeat < 60; ++repeat) {
    Field sum = Field::Zero(grid.nx, grid.ny);
    force = 0;
    for (int n = 0; n <= 16; ++n) {
      const double weight = (n == 0 || n == 16 ? 1 : 2) / 32.0;
      const double indentation =
          contact.rest.indentation - contact.amplitude * std::cos(2 * pi * n / 32);
      const auto [state, frozen] = pressed(indentation);
      // The gap is that of the surface itself.
      sum += weight * (state.gap + contact.surface.heights - (top - indentation));
      force += weight * state.force;
    }
    mean = sum;
  }
  CHECK(found.mean_force == Approx(force).epsilon(1e-3));
  CHECK(found.mean_force > 1.05 * contact.rest.force);
  const CycleResult elastic = simulate_cycle(
      [&](double indentation) {
        const NormalContactState state = pressed(indentation).first;
        return ContactSetAt{contact_set(state), state.force, state.converged()};
      },
      grid, unrelaxed, trajectory_of(contact.motion(1), contact.rest.indentation), {.steps = 32});
  // Corrections are of the order of 1/(ωτ) of the elastic energy; the mid-steps of both differ by
  // the time at which cells change.
  CHECK(found.tangential_work == Approx(elastic.work_per_cycle).epsilon(0.02));
  CHECK(found.jump_work == Approx(found.tangential_work).epsilon(0.02));
  CHECK(found.normal_work <
        0.01 * found.normal_storage_stiffness * pi * contact.amplitude * contact.amplitude);
}

TEST_CASE("Creep is the elastic contact at the creep compliance while the contact grows",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  const double g = 3, pressure = contact.point.value;
  const auto creep = [&](int steps) {
    const std::vector<double> times{0, 1.5 * tau, 3 * tau, 4.5 * tau, 6 * tau};
    const ViscoelasticPath path =
        viscoelastic_path(contact.surface, rubber, standard_solid, times,
                          {ControlQuantity::pressure, {pressure}}, {.steps = steps});
    REQUIRE(path.converged);
    double worst = 0;
    for (const ViscoelasticPoint& point : path.points) {
      // One branch: J(t) G∞ = 1 − g/(1 + g) exp(−t/(τ(1 + g))).
      const double compliance = 1 - g / (1 + g) * std::exp(-point.time / (tau * (1 + g)));
      const NormalContactState elastic =
          press(contact.surface, stiffer(1 / compliance), contact.point);
      CHECK(point.force == Approx(elastic.force).epsilon(1e-9));
      CHECK(point.pressure == Approx(pressure).epsilon(1e-9));
      CHECK(std::isnan(point.pressure_error));
      const double error = std::abs(point.indentation - elastic.indentation);
      CHECK(error <= point.indentation_error + 1e-9 * elastic.indentation);
      worst = std::max(worst, error / elastic.indentation);
      CHECK(point.mean_gap == Approx(elastic.mean_gap).epsilon(3e-3));
      CHECK(point.contact_area_fraction ==
            Approx(elastic.contact_area_fraction).margin(2.0 / 1024));
    }
    CHECK(std::ranges::is_sorted(path.points, {}, &ViscoelasticPoint::contact_area_fraction));
    return worst;
  };
  // The first point is exact; the order in the steps is at least 1.7.
  const double coarse = creep(4), fine = creep(16);
  CAPTURE(coarse, fine);
  CHECK(fine < 3e-4);
  CHECK(fine < coarse / 10);
}

TEST_CASE("A surface without load recovers to its shape", "[viscoelastic_cycle]") {
  const RoughContact contact;
  const std::vector<ViscoelasticPoint> path =
      viscoelastic_path(contact.surface, rubber, standard_solid,
                        std::vector{0.0, tau, 2 * tau, 3 * tau, 100 * tau},
                        {ControlQuantity::pressure, {4e4, 4e4, 0, 0, 0}}, {.steps = 2})
          .points;
  // The contact touches the recovering surface from above, below the first touch of a flat one.
  CHECK(path[2].indentation > path[3].indentation);
  CHECK(path[3].indentation > 0.01 * path[0].indentation);
  CHECK(std::abs(path[4].indentation) < 0.05 * path[3].indentation);
  CHECK(path[2].force == 0);
}

TEST_CASE("A held indentation relaxes its force to that of the relaxed body",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  const double g = 3, depth = contact.rest.indentation;
  // A held indentation keeps contact and displacements, so that the force follows G(t).
  for (const ViscoelasticPoint& point :
       viscoelastic_path(contact.surface, rubber, standard_solid,
                         std::vector{0.0, 0.5 * tau, 2 * tau, 40 * tau},
                         {ControlQuantity::indentation, {depth}}, {.steps = 2})
           .points) {
    CHECK(point.force ==
          Approx((1 + g * std::exp(-point.time / tau)) * contact.rest.force).epsilon(1e-6));
    CHECK(point.indentation == Approx(depth).epsilon(1e-12));
    CHECK(point.pressure_error <= 1e-6 * point.pressure);
    CHECK(std::isnan(point.indentation_error));
  }
}

TEST_CASE("The steady state does not depend on the start, and may keep the mean force",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  const auto sweep = [&](std::vector<double> products, Hold hold) {
    for (double& product : products) product /= tau;
    const auto cycles =
        viscoelastic_sweep(contact.surface, rubber, standard_solid, contact.motion(1),
                           contact.point, products, {.steps = 16, .hold = hold});
    for (const ViscoelasticCycle& cycle : cycles) REQUIRE(cycle.converged());
    return cycles;
  };
  for (const Hold hold : {Hold::indentation, Hold::force}) {
    const ViscoelasticCycle alone = sweep({1}, hold)[0], after = sweep({0.1, 1}, hold)[1];
    // Each state is within 1e-4 of the amplitude.
    CHECK(after.work_per_cycle == Approx(alone.work_per_cycle).epsilon(2e-3));
    CHECK(after.mean_force == Approx(alone.mean_force).epsilon(5e-4));
    if (hold == Hold::indentation) {
      CHECK(alone.mean_indentation == contact.rest.indentation);
    } else {
      CHECK(alone.mean_force == Approx(contact.rest.force).epsilon(1e-3));
      const ViscoelasticCycle same =
          viscoelastic_cycle(contact.surface, rubber, standard_solid, contact.motion(1),
                             at_indentation(alone.mean_indentation), {.steps = 16});
      CHECK(same.work_per_cycle == Approx(alone.work_per_cycle).epsilon(2e-3));
    }
  }
}

TEST_CASE("Rubber films and slow shear balance their energy", "[viscoelastic_cycle]") {
  const RoughContact contact;
  const Body film = Body::layered({{0.1 * side, 3 * shear, 0.49}});
  for (const Body& body : {film, film.measured_from(Datum::base)}) {
    const ViscoelasticCycle found =
        viscoelastic_cycle(contact.surface, body, standard_solid,
                           EqualFrequency{3e-7, 1e-7, 0.9, 1 / tau}, contact.point, {.steps = 32});
    REQUIRE(found.converged());
    CHECK(found.dissipated == Approx(found.work_per_cycle).epsilon(0.01));
    CHECK(found.work_per_cycle > 0);
  }
  const ViscoelasticCycle slow =
      viscoelastic_cycle(contact.surface, rubber, standard_solid,
                         Drag{contact.amplitude, 1e-4, 1 / tau}, contact.point, {.steps = 32});
  REQUIRE(slow.converged());
  CHECK(slow.tangential_work > 10 * slow.normal_work);
  CHECK(slow.dissipated == Approx(slow.work_per_cycle).epsilon(0.01));
  CHECK(slow.damping_constant > 0);
  // Under a constant contact the shear loses K_t Σ g_k τ_k v² per second.
  const ViscoelasticCycle still =
      viscoelastic_cycle(contact.surface, rubber, standard_solid, Drag{0, 1e-6, 1 / tau},
                         contact.point, {.steps = 16});
  REQUIRE(still.converged());
  const double stiffness =
      stick_stiffness(contact_set(contact.rest), contact.surface.grid, rubber, {}, true).xx;
  CHECK(still.damping_constant == Approx(3 * tau * stiffness).epsilon(1e-3));
}

TEST_CASE("A loss that does not exceed its error is not stated", "[viscoelastic_cycle]") {
  ViscoelasticCycle cycle{.work_per_cycle = 3,
                          .work_per_cycle_error = 1,
                          .normal_work = 2.5,
                          .tangential_work = 0.5,
                          .power = 3,
                          .damping_constant = 7,
                          .termination = Termination::converged};
  cycle.drop_uncertain();
  CHECK(cycle.work_per_cycle == 3);
  CHECK(cycle.normal_work == 2.5);
  CHECK(std::isnan(cycle.damping_constant));
  cycle.work_per_cycle = -0.1;
  cycle.drop_uncertain();
  for (const double number : {cycle.work_per_cycle, cycle.normal_work, cycle.power})
    CHECK(std::isnan(number));
  // An elastic body in contact that never opens loses nothing; what is left is rounding.
  const RoughContact contact;
  const ViscoelasticCycle elastic =
      viscoelastic_cycle(contact.surface, rubber, {shear, {}}, EqualFrequency{1e-12, 0, 0, 1},
                         contact.point, {.steps = 16});
  REQUIRE(elastic.converged());
  CHECK(!(elastic.work_per_cycle < 0));
}

TEST_CASE("A frequency without a steady state has no numbers, and the others keep theirs",
          "[viscoelastic_cycle]") {
  const RoughContact contact;
  // The branch forgets within cycles at the first and the last frequency, and after 1e5 cycles at
  // the second one.
  const PronySeries series{1, {{3, 1e4 * tau}}};
  const std::vector<double> frequencies{1e-4 / tau, 100 / tau, 1e-4 / tau};
  const auto found =
      viscoelastic_sweep(contact.surface, rubber, series, contact.motion(1), contact.point,
                         frequencies, {.steps = 16, .max_cycles = 20});
  REQUIRE(found.size() == 3);
  for (const std::size_t k : {0u, 2u}) {
    CHECK(found[k].converged());
    CHECK(found[k].work_per_cycle > 0);
  }
  CHECK(found[2].work_per_cycle == Approx(found[0].work_per_cycle).epsilon(2e-3));
  CHECK(found[1].termination == Termination::iteration_limit);
  CHECK(found[1].angular_frequency == frequencies[1]);
  for (const double number : {found[1].work_per_cycle, found[1].damping_constant,
                              found[1].mean_force, found[1].contact_area_max})
    CHECK(std::isnan(number));
  CHECK(found[1].samples.empty());
}

TEST_CASE(
    "A load of a path may be lifted but not pull, and an indentation stays below full contact",
    "[viscoelastic_cycle]") {
  const RoughContact contact;
  const auto path = [&](ControlQuantity control, const std::vector<double>& values) {
    std::vector<double> times(values.size());
    for (std::size_t k = 0; k < times.size(); ++k) times[k] = tau * static_cast<double>(k);
    return viscoelastic_path(contact.surface, rubber, standard_solid, times, {control, values},
                             {.steps = 2});
  };
  using Catch::Matchers::Contains, Catch::Matchers::StartsWith;
  for (const double value : {-5e3, 0.0}) {
    CHECK_THROWS_WITH(path(ControlQuantity::pressure, {value}),
                      StartsWith("pressure: ") && Contains("must be a finite number > 0"));
    CHECK_THROWS_WITH(path(ControlQuantity::normal_force, {value}), StartsWith("force: "));
    CHECK_THROWS_WITH(path(ControlQuantity::indentation, {value}), StartsWith("indentation: "));
  }
  CHECK_THROWS_WITH(path(ControlQuantity::pressure, {4e4, -4e4}),
                    StartsWith("pressure: -40000 must be >= 0"));
  CHECK_THROWS_WITH(path(ControlQuantity::normal_force, {1, -1}), StartsWith("force: -1 must"));
  CHECK(path(ControlQuantity::pressure, {4e4, 0}).points.back().force == 0);

  // The elastic contacts of the steps have values that are larger by up to G(0)/G∞ = 4.
  const double full = contact.surface.heights.maxCoeff() - contact.surface.heights.mean(),
               depth = contact.rest.indentation;
  const auto raised = path(ControlQuantity::indentation, {depth, -depth});
  CHECK(raised.points.back().indentation == Approx(-depth));
  CHECK(raised.points.back().force == 0);
  CHECK(path(ControlQuantity::indentation, {0.9 * full}).converged);
  try {
    path(ControlQuantity::indentation, {depth, 1.01 * full});
    FAIL("full contact was not refused");
  } catch (const InvalidInput& refusal) {
    CHECK(std::stod(refusal.value()) == Approx(1.01 * full));
    CHECK_THAT(refusal.constraint(), StartsWith("must be below "));
    CHECK(std::stod(refusal.constraint().substr(14)) == Approx(full));
  }
}

TEST_CASE("What has no meaning on a viscoelastic body is refused", "[viscoelastic_cycle]") {
  const RoughContact contact;
  const auto cycle = [&](const EqualFrequency& motion, const OperatingPoint& point,
                         const ViscoelasticCycleOptions& options = {}) {
    return viscoelastic_cycle(contact.surface, rubber, broad, motion, point, options);
  };
  CHECK_THROWS_AS(cycle({1e-6, 1e-7, 0, 0}, contact.point), InvalidInput);
  CHECK_THROWS_AS(cycle(contact.motion(1), contact.point, {.steps = 17}), InvalidInput);
  CHECK_THROWS_AS(cycle(contact.motion(1), contact.point, {.contact = {.hardness = 1e9}}),
                  InvalidInput);
  // The motion reaches full contact.
  CHECK_THROWS_AS(cycle({1e-4, 1e-7, 0, 1}, contact.point), InvalidInput);
  CHECK_THROWS_AS(viscoelastic_path(contact.surface, rubber, broad, std::vector{0.0, 0.0},
                                    {ControlQuantity::pressure, {1e4, 1e4}}),
                  InvalidInput);
  CHECK_THROWS_AS(viscoelastic_path(contact.surface, rubber, broad, std::vector{0.0},
                                    {ControlQuantity::mean_gap, {1e-6}}),
                  InvalidInput);
  for (const int steps : {0, 3})
    CHECK_THROWS_AS(viscoelastic_path(contact.surface, rubber, broad, std::vector{0.0},
                                      {ControlQuantity::pressure, {1e4}}, {.steps = steps}),
                    InvalidInput);
  CHECK_THROWS_AS(viscoelastic_path(contact.surface, rubber, broad, std::vector{0.0, 1.0, 2.0},
                                    {ControlQuantity::pressure, {1e4, 2e4}}),
                  InvalidInput);
}
