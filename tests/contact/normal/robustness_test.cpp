// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <thread>
#include <tuple>
#include <vector>

#include "awkward_contacts.hpp"
#include "contact/normal/active_set_cg.hpp"
#include "contact/normal/gradient_projection.hpp"
#include "independent_residual.hpp"
#include "measured_surfaces.hpp"

using namespace salebra;
using namespace salebra::test;

namespace {

// bench/contact/robustness runs the whole set of 200 surfaces, and finer grids.
void check(const AwkwardContact& contact, Boundary boundary = Boundary::periodic) {
  INFO(contact.name);
  NormalContactOptions options;
  options.boundary = boundary;
  for (const auto& [precision, tolerance] :
       {std::pair{Precision::mixed, 1e-8}, std::pair{Precision::full, 1e-12}}) {
    options.precision = precision;
    options.tolerance = tolerance;
    const auto sound = [&, tolerance = tolerance](const NormalContactState& state) {
      CHECK(state.converged());
      CHECK(state.residual < tolerance);
      // A different kind of transform rounds differently, by 1e-15 of the heights.
      CHECK(independent_residual(state.contact_pressure, contact.surface, 1, boundary) <
            1.1 * tolerance);
    };
    const auto state = press(contact.surface, 1, at_pressure(contact.pressure), options);
    sound(state);
    CHECK(state.contact_pressure.mean() == Approx(contact.pressure).epsilon(1e-10));
    const double first_touch = contact.surface.heights.maxCoeff() - contact.surface.heights.mean();
    const bool periodic = boundary == Boundary::periodic;
    // In full contact the pressure does not follow from the gap.
    if (periodic &&
        (state.mean_gap < 1e-6 * first_touch || state.mean_gap > (1 - 1e-9) * first_touch))
      continue;
    const auto back = periodic
                          ? press(contact.surface, 1, at_mean_gap(state.mean_gap), options)
                          : press(contact.surface, 1, at_indentation(state.indentation), options);
    sound(back);
    // e_c is an energy, so pressures differ by its root.
    CHECK(back.mean_pressure == Approx(contact.pressure).epsilon(10 * std::sqrt(tolerance)));
  }
}

// A solver on one grid with lengths in cells, as press uses it on the finest grid.
struct SingleGrid {
  Surface surface = rough_surface({64, 64, 64, 64}, {.rms_slope = 0.1});
  double rms = rms_height(surface);
  detail::ScaledOperatingPoint target{ControlQuantity::pressure, 0.005};
  detail::ActiveSetLimits limits{.tolerance = 1e-12};
  Field p = Field::Constant(64, 64, 0.005), g = Field::Zero(64, 64);

  template <class Real>
  detail::ActiveSetOutcome solve() {
    detail::ActiveSetCg<Real> solver(surface.grid, 1, Boundary::periodic, {surface.heights.data()},
                                     rms);
    return solver.solve(target, limits, p.data(), g.data());
  }
};

}  // namespace

TEST_CASE("Random surfaces of any exponent, cut-off and load converge, by pressure and by gap",
          "[normal]") {
  for (int k = 0; k < 12; ++k) check(awkward_surface(k, 64));
}

TEST_CASE("Punches, steps, single cells and full contact converge, by pressure and by gap",
          "[normal]") {
  for (const auto& contact : awkward_shapes(32)) check(contact);
}

TEST_CASE("A contact is found by its mean gap where coarse grids have another mean height",
          "[normal]") {
  // Coarse grids sample only the higher points. At the same plane height they would be beyond full
  // contact.
  const auto [lowered, least, most] =
      GENERATE(std::tuple{0.1, 0.99, 0.999}, std::tuple{1.0, 0.4, 0.6});
  Surface surface = rough_surface({128, 128, 1, 1}, {.seed = 7});
  const double rms = rms_height(surface), pressure = 0.15;
  for (Index i = 0; i < 128; ++i)
    for (Index j = 0; j < 128; ++j)
      if (i % 2 == 1 || j % 2 == 1) surface.heights(i, j) -= lowered * rms;
  NormalContactOptions options;
  options.precision = GENERATE(Precision::mixed, Precision::full);
  const auto state = press(surface, 1, at_pressure(pressure), options);
  REQUIRE(state.converged());
  REQUIRE(state.contact_area_fraction > least);
  REQUIRE(state.contact_area_fraction < most);
  // 3/4 of the cells are lowered, but none of a coarse grid.
  REQUIRE(state.mean_gap < 0.75 * lowered * rms);
  const auto back = press(surface, 1, at_mean_gap(state.mean_gap), options);
  CHECK(back.converged());
  CHECK(independent_residual(back.contact_pressure, surface, 1) < 1.1 * options.tolerance);
  // e_c is an energy, so pressures differ by its root.
  CHECK(back.mean_pressure == Approx(pressure).epsilon(10 * std::sqrt(options.tolerance)));
}

TEST_CASE("A single point and constant heights are in full contact under any pressure",
          "[normal]") {
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  NormalContactOptions options{.tolerance = 1e-8, .boundary = boundary, .precision = precision};
  if (precision == Precision::full) options.tolerance = 1e-12;
  for (const Index n : {1, 24})
    for (const double pressure : {1e-6, 1.0, 1e6}) {
      const Surface plane = surface_of({n, n, 1, 1}, [](double, double) { return -3.25; });
      const auto state = press(plane, 1, at_pressure(pressure), options);
      CHECK(state.converged());
      CHECK(state.contact_area_fraction == 1);
      CHECK(state.contact_pressure.mean() == Approx(pressure).epsilon(1e-12));
      // The pressure is uniform if the cell repeats; an isolated flat punch is pressed hardest at
      // its edges. e_c is an energy, so gaps are of the order of its root.
      CHECK(state.gap.abs().maxCoeff() < 10 * std::sqrt(options.tolerance) * pressure);
      if (boundary == Boundary::periodic || n == 1)
        CHECK((state.contact_pressure == pressure).all());
    }
}

TEST_CASE("Measured surfaces converge, as cells that repeat and as isolated bodies", "[normal]") {
  const auto measured = measured_surfaces(SALEBRA_SURFACES, 96);
  CHECK(measured.usable.size() >= 6);
  for (const auto& [name, surface, slope, undefined] : measured.usable)
    for (const double load : {1e-3, 0.3})
      for (const Boundary boundary : {Boundary::periodic, Boundary::free})
        check({name + ", pressure over E*·(rms slope) " + std::to_string(load), surface,
               load * slope},
              boundary);
  // One file is text without heights, one has no shape of a surface.
  CHECK(std::count_if(measured.unusable.begin(), measured.unusable.end(), [](const auto& why) {
          return why.find("nonsense") != std::string::npos ||
                 why.find("wrong") != std::string::npos;
        }) == 2);
}

TEST_CASE("Undefined points of a measured surface are named, not pressed", "[normal]") {
  const Surface surface = read_surface(SALEBRA_SURFACES "/sur-2.sur");
  REQUIRE(surface.undefined_points() == 25);
  CHECK_THROWS_WITH(press(surface, 1e9, at_pressure(1e3)), Catch::Contains("25"));
}

TEST_CASE("Where conjugate gradients stall, gradient projection finds the same contact",
          "[normal]") {
  SingleGrid usual, stalled;
  const auto reference = usual.solve<double>();
  REQUIRE(reference.converged());
  // Without patience, the first iterations that do not halve e_c use up the other thresholds.
  stalled.limits.patience = 0;
  const bool mixed = GENERATE(false, true);
  const auto outcome = mixed ? stalled.solve<float>() : stalled.solve<double>();
  CHECK(outcome.converged());
  CHECK(outcome.iterations > reference.iterations);
  CHECK(((stalled.p > 0) == (usual.p > 0)).all());
  CHECK((stalled.p - usual.p).abs().maxCoeff() < 1e-5 * usual.p.maxCoeff());
  CHECK(outcome.plane_height == Approx(reference.plane_height).epsilon(1e-7));
}

TEST_CASE("Gradient projection solves a contact on its own, from any start", "[normal]") {
  SingleGrid usual, projected;
  const bool load_given = GENERATE(true, false);
  const double bound = GENERATE(std::numeric_limits<double>::infinity(), 0.05);
  usual.target.bound = projected.target.bound = bound;
  const auto reference = usual.solve<double>();
  REQUIRE(reference.converged());
  if (!load_given) {
    projected.target = {ControlQuantity::indentation, reference.plane_height, bound};
    projected.p.setZero();
  }
  auto compliance = normal_compliance<double>(projected.surface.grid, 1, Boundary::periodic);
  detail::ActiveSetOutcome outcome;
  detail::gradient_projection({compliance,
                               projected.surface.grid,
                               projected.surface.partition(),
                               Boundary::periodic,
                               {projected.surface.heights.data()},
                               projected.rms,
                               projected.target},
                              projected.limits, projected.p.data(), projected.g.data(), outcome);
  CHECK(outcome.converged());
  CHECK(((projected.p > 0) == (usual.p > 0)).all());
  CHECK(projected.p.mean() == Approx(0.005).epsilon(1e-8));
  CHECK(projected.p.maxCoeff() <= bound);
}

TEST_CASE("A contact that the fallback solves carries the load asked, on cells of any shape",
          "[normal]") {
  Lcg random(7);
  int saturated = 0;
  for (int k = 0; k < 300; ++k) {
    // Cells up to a million times as long as wide often need the fallback. Its first steps are as
    // large as the heights, while the loads are up to 1e11 times smaller.
    const Index nx = 2 + k % 7, ny = 2 + k % 5;
    const double root = std::pow(10, -3 + 6 * random.uniform());
    const auto cells = [](Index count) { return static_cast<double>(count); };
    Surface surface{{nx, ny, cells(nx) * root, cells(ny) / root}, Field(nx, ny), true, "cells"};
    for (double& height : surface.heights.reshaped()) height = random.uniform();
    const double load = std::pow(10, -11 + 9 * random.uniform());
    NormalContactOptions options{.precision = Precision::full};
    if (k % 4 > 0) options.hardness = load * (1.1 + 5 * random.uniform());
    options.boundary = k % 2 == 0 ? Boundary::periodic : Boundary::free;
    INFO("contact " << k << ", dx/dy = " << root * root << ", load " << load);
    const NormalContactState state = press(surface, 1, at_pressure(load), options);
    CHECK(state.converged());
    // The load is corrected to 1e-14, and its sum rounds by a few 1e-16.
    CHECK(state.mean_pressure == Approx(load).epsilon(2e-14).scale(0));
    CHECK(state.contact_pressure.maxCoeff() <= options.hardness);
    saturated += (state.contact_pressure == options.hardness).any();
  }
  CHECK(saturated > 30);
}

TEST_CASE("A fallback that runs out of iterations says so", "[normal]") {
  SingleGrid stalled;
  stalled.limits.patience = 0;
  stalled.limits.max_iterations = 12;
  const auto outcome = stalled.solve<double>();
  CHECK(outcome.termination == Termination::iteration_limit);
  CHECK(outcome.residual > stalled.limits.tolerance);
  // Round-off leaves a larger residual, so more iterations would be of no use.
  stalled.limits.tolerance = 1e-30;
  stalled.limits.max_iterations = 100000;
  CHECK(stalled.solve<double>().termination == Termination::stalled);
}

TEST_CASE("A start near the solution saves iterations and gives the same contact", "[normal]") {
  const Surface surface = rough_surface({128, 128, 1e-3, 1e-3});
  NormalContactOptions options;
  const auto cold = press(surface, 1e9, at_pressure(3e6), options);
  options.initial_pressure = &cold.contact_pressure;
  const auto warm = press(surface, 1e9, at_pressure(3e6), options);
  CHECK(warm.converged());
  CHECK(warm.iterations < cold.iterations);
  CHECK(warm.mean_gap == Approx(cold.mean_gap).epsilon(1e-6));
  // Its own solution meets the tolerance and is iterated nevertheless: a start that is returned
  // unchanged would be an answer that nothing solved.
  CHECK(warm.iterations >= 1);
  CHECK(warm.iterations <= 2);
  CHECK(warm.residual < options.tolerance);
  CHECK((warm.contact_pressure != cold.contact_pressure).any());
  // The residual is an energy of the order of the square of the error: 1e-10 leaves 1e-5.
  CHECK((warm.contact_pressure - cold.contact_pressure).abs().maxCoeff() <=
        1e-4 * cold.contact_pressure.maxCoeff());
  const Field wrong = Field::Zero(3, 3);
  options.initial_pressure = &wrong;
  CHECK_THROWS_AS(press(surface, 1e9, at_pressure(3e6), options), InvalidInput);
}

TEST_CASE("What contacts of equal grids share changes none of them", "[normal]") {
  const Surface surface = rough_surface({256, 256, 1e-3, 1e-3});
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    NormalContactOptions options;
    options.boundary = boundary;
    const auto once = [&] { return press(surface, 1e9, at_pressure(3e5), options); };
    const auto alone = once();
    // Several threads use the operators at the same time, other grids evict them from the cache,
    // and they are made anew.
    std::array<NormalContactState, 4> states;
    std::vector<std::thread> threads;
    for (auto& state : states) threads.emplace_back([&] { state = once(); });
    for (auto& thread : threads) thread.join();
    press(rough_surface({128, 256, 1e-3, 2e-3}), 1e9, at_pressure(3e5), options);
    detail::NormalOperators::of({3400, 3400, 1, 1}, 1, Boundary::periodic, RowPartition(3400));
    auto last = once();
    for (const NormalContactState* state :
         {&states[0], &states[1], &states[2], &states[3], &last}) {
      CHECK((state->contact_pressure == alone.contact_pressure).all());
      CHECK((state->gap == alone.gap).all());
      CHECK(state->multilevel_count == alone.multilevel_count);
    }
  }
  const auto of = [](Index side, double modulus) {
    return detail::NormalOperators::of({side, side, 1, 1}, modulus, Boundary::periodic,
                                       RowPartition(side));
  };
  const auto first = of(64, 1);
  CHECK(of(64, 1) == first);
  CHECK(of(64, 2) != first);
  of(3000, 1);  // 9 of 12 million points
  CHECK(of(64, 1) == first);
  of(3400, 1);
  CHECK(of(64, 1) == first);
  of(2000, 1);
  of(3400, 2);
  CHECK(of(64, 1) != first);
}
