// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal.hpp>

#include "active_set_cg.hpp"
#include "awkward_contacts.hpp"
#include "gradient_projection.hpp"

using namespace salebra;
using namespace salebra::test;

namespace {

// bench/contact_robustness runs the whole set, 200 surfaces and finer grids.
void check(const AwkwardContact& contact) {
  INFO(contact.name);
  NormalContactOptions options;
  for (const auto& [precision, tolerance] :
       {std::pair{Precision::mixed, 1e-8}, std::pair{Precision::full, 1e-12}}) {
    options.precision = precision;
    options.tolerance = tolerance;
    const auto state = press_to_pressure(contact.surface, 1, contact.pressure, options);
    CHECK(state.converged);
    CHECK(state.residual < tolerance);
    CHECK(state.pressure.mean() == Approx(contact.pressure).epsilon(1e-10));
    const double first_touch = contact.surface.heights.maxCoeff() - contact.surface.heights.mean();
    // In full contact the gap tells the pressure no more.
    if (state.mean_gap < 1e-6 * first_touch || state.mean_gap > (1 - 1e-9) * first_touch) continue;
    const auto back = press_to_mean_gap(contact.surface, 1, state.mean_gap, options);
    CHECK(back.converged);
    // e_c is an energy; pressures differ by its root.
    CHECK(back.mean_pressure == Approx(contact.pressure).epsilon(10 * std::sqrt(tolerance)));
  }
}

// A solver of one grid with lengths in cells, as press_to_pressure runs it on the finest level.
struct SingleGrid {
  Surface surface = rough_surface({64, 64, 64, 64}, {.rms_slope = 0.1});
  double rms = rms_height(surface);
  detail::ContactTarget target{detail::ContactTarget::Kind::mean_pressure, 0.005};
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

TEST_CASE("Where conjugate gradients stall, gradient projection finds the same contact",
          "[normal]") {
  SingleGrid usual, stalled;
  const auto reference = usual.solve<double>();
  REQUIRE(reference.converged);
  // Without patience the first iterations that do not halve e_c exhaust the other thresholds.
  stalled.limits.patience = 0;
  const bool mixed = GENERATE(false, true);
  const auto outcome = mixed ? stalled.solve<float>() : stalled.solve<double>();
  CHECK(outcome.converged);
  CHECK(outcome.iterations > reference.iterations);
  CHECK(((stalled.p > 0) == (usual.p > 0)).all());
  CHECK((stalled.p - usual.p).abs().maxCoeff() < 1e-5 * usual.p.maxCoeff());
  CHECK(outcome.level == Approx(reference.level).epsilon(1e-7));
}

TEST_CASE("Gradient projection solves a contact on its own, from any start", "[normal]") {
  SingleGrid usual, projected;
  const bool load_given = GENERATE(true, false);
  const double bound = GENERATE(std::numeric_limits<double>::infinity(), 0.05);
  usual.target.bound = projected.target.bound = bound;
  const auto reference = usual.solve<double>();
  REQUIRE(reference.converged);
  if (!load_given) {
    projected.target = {detail::ContactTarget::Kind::level, reference.level, bound};
    projected.p.setZero();
  }
  auto compliance = normal_compliance<double>(projected.surface.grid, 1, Boundary::periodic);
  detail::ActiveSetOutcome outcome;
  detail::gradient_projection(compliance, projected.surface.grid, Boundary::periodic,
                              {projected.surface.heights.data()}, projected.rms, projected.target,
                              projected.limits, projected.p.data(), projected.g.data(), outcome);
  CHECK(outcome.converged);
  CHECK(((projected.p > 0) == (usual.p > 0)).all());
  CHECK(projected.p.mean() == Approx(0.005).epsilon(1e-8));
  CHECK(projected.p.maxCoeff() <= bound);
}

TEST_CASE("A fallback that runs out of iterations says so", "[normal]") {
  SingleGrid stalled;
  stalled.limits.patience = 0;
  stalled.limits.max_iterations = 12;
  const auto outcome = stalled.solve<double>();
  CHECK_FALSE(outcome.converged);
  CHECK(outcome.residual > stalled.limits.tolerance);
}

TEST_CASE("A start near the solution saves iterations and gives the same contact", "[normal]") {
  const Surface surface = rough_surface({128, 128, 1e-3, 1e-3});
  NormalContactOptions options;
  const auto cold = press_to_pressure(surface, 1e9, 3e6, options);
  options.initial_pressure = &cold.pressure;
  const auto warm = press_to_pressure(surface, 1e9, 3e6, options);
  CHECK(warm.converged);
  CHECK(warm.iterations < cold.iterations);
  CHECK(warm.mean_gap == Approx(cold.mean_gap).epsilon(1e-6));
  const Field wrong = Field::Zero(3, 3);
  options.initial_pressure = &wrong;
  CHECK_THROWS_AS(press_to_pressure(surface, 1e9, 3e6, options), InvalidInput);
}
