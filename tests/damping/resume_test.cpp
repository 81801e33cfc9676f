// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <salebra/damping/cycle_state.hpp>
#include <salebra/generators/shapes.hpp>

#include "islands.hpp"

using namespace salebra;

namespace {

const Grid2D grid{22, 18, 1.1e-3, 0.9e-3};
const Material material = Material::of_contact_modulus(3e9, 0.3);
const ContactSets levels = island_contact_sets(grid);

// The path begins at the maximum indentation, so the first period is not the steady one.
Trajectory two_periods() {
  const Trajectory from_min = trajectory_of(EqualFrequency{0.5, 1e-6, 0.9}, 0.5);
  return {[=](double t) { return from_min.indentation(t + 0.5); },
          [=](double t) { return from_min.tangential(t + 0.5); }};
}

}  // namespace

TEST_CASE("A cycle resumed from any of its steps ends in the same bits", "[cycle]") {
  CycleOptions options{.steps = 12, .direction = 0.4};
  std::vector<CycleState> states;
  options.on_state = [&](const CycleState& state) { states.push_back(state); };
  const CycleResult whole = simulate_cycle(levels, grid, material, two_periods(), options);
  REQUIRE(whole.periods > 1);
  REQUIRE(states.size() == static_cast<std::size_t>(whole.periods) * 13);
  for (const std::size_t k : {0u, 1u, 5u, 12u, 13u, 20u, 25u}) {
    CycleOptions rest{.steps = 12, .direction = 0.4, .resume = &states[k]};
    const CycleResult resumed = simulate_cycle(levels, grid, material, two_periods(), rest);
    CHECK(resumed.work_per_cycle == whole.work_per_cycle);
    CHECK(resumed.dissipated == whole.dissipated);
    CHECK(resumed.stored_energy_change == whole.stored_energy_change);
    CHECK(resumed.periods == whole.periods);
    CHECK(resumed.iterations == whole.iterations);
    CHECK(resumed.fft_count == whole.fft_count);
    CHECK((resumed.smallest == whole.smallest).all());
    CHECK((resumed.largest == whole.largest).all());
    REQUIRE(resumed.samples.size() == whole.samples.size());
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
      CHECK(resumed.samples[i].work == whole.samples[i].work);
      CHECK(resumed.samples[i].tangential_force == whole.samples[i].tangential_force);
    }
    CHECK(resumed.steady);
    CHECK(resumed.converged());
  }
}

TEST_CASE("A state of another grid or of a finer cycle is refused", "[cycle]") {
  CycleState state;
  CycleOptions options{.steps = 12, .on_state = [&](const CycleState& s) { state = s; }};
  const Trajectory motion = trajectory_of(EqualFrequency{0.5, 1e-6, 0.9}, 0.5);
  simulate_cycle(levels, grid, material, motion, options);
  CycleOptions coarser{.steps = 8, .resume = &state};
  CHECK_THROWS_WITH(simulate_cycle(levels, grid, material, motion, coarser),
                    Catch::StartsWith("resume: 12"));
  state.smallest = ContactSet::Constant(4, 4, false);
  CycleOptions smaller{.steps = 12, .resume = &state};
  CHECK_THROWS_WITH(simulate_cycle(levels, grid, material, motion, smaller),
                    Catch::StartsWith("resume: 16"));
}

TEST_CASE("A cycle with friction resumed from any of its steps ends in the same bits", "[cycle]") {
  const PressureFields pressures = island_pressures(grid);
  const Trajectory motion = trajectory_of(EqualFrequency{0.5, 1e-6, 0.9}, 0.5);
  CycleOptions options{.friction_coefficient = 0.4, .steps = 8, .direction = 0.4};
  std::vector<CycleState> states;
  options.on_state = [&](const CycleState& state) { states.push_back(state); };
  const CycleResult whole = simulate_frictional_cycle(pressures, grid, material, motion, options);
  REQUIRE(whole.converged());
  REQUIRE(whole.periods > 1);
  CHECK(whole.slip_work > 0);
  REQUIRE(states.size() == static_cast<std::size_t>(whole.periods) * 9);
  for (const std::size_t k : {0u, 3u, 8u, 9u, 14u}) {
    CycleOptions rest{.friction_coefficient = 0.4, .steps = 8, .direction = 0.4};
    rest.resume = &states[k];
    const CycleResult resumed = simulate_frictional_cycle(pressures, grid, material, motion, rest);
    CHECK(resumed.work_per_cycle == whole.work_per_cycle);
    CHECK(resumed.relaxation_work == whole.relaxation_work);
    CHECK(resumed.slip_work == whole.slip_work);
    CHECK(resumed.periods == whole.periods);
    CHECK(resumed.iterations == whole.iterations);
    CHECK(resumed.fft_count == whole.fft_count);
    CHECK((resumed.loss == whole.loss).all());
    CHECK((resumed.smallest == whole.smallest).all());
    CHECK((resumed.largest == whole.largest).all());
    REQUIRE(resumed.samples.size() == whole.samples.size());
    for (std::size_t i = 0; i < whole.samples.size(); ++i)
      CHECK(resumed.samples[i].tangential_force == whole.samples[i].tangential_force);
    CHECK(resumed.steady == whole.steady);
    CHECK(resumed.converged());
  }
  CycleOptions coarser{.friction_coefficient = 0.4, .steps = 4};
  coarser.resume = &states[8];
  CHECK_THROWS_WITH(simulate_frictional_cycle(pressures, grid, material, motion, coarser),
                    Catch::StartsWith("resume: 8"));
  CHECK_THROWS_WITH(simulate_cycle(levels, grid, material, motion, coarser),
                    Catch::StartsWith("resume: is the state of another kind of cycle"));
}

TEST_CASE("A coupled cycle resumed from any of its steps ends in the same bits", "[cycle]") {
  // For a free surface the kernels are made for the window of a contact, and their rounding depends
  // on it. For a periodic one, and without coupling, a step without motion keeps the tolerance
  // scale of the step before.
  const Boundary boundary = GENERATE(Boundary::free, Boundary::periodic);
  const Grid2D cells{14, 12, 1.2e-3, 1e-3};
  const Surface surface = elliptic_paraboloid_surface(cells, 12e-3, 6e-3, off_grid_center(cells));
  const Trajectory motion = trajectory_of(EqualFrequency{3e-6, 3e-6, 0.8}, 9e-6);
  const NormalContactOptions normal{.boundary = boundary};
  CycleOptions options{.friction_coefficient = 0.3, .steps = 6, .max_periods = 2};
  if (boundary == Boundary::periodic) options.coupling_constant = 0;
  options.stick.boundary = boundary;
  std::vector<CycleState> states;
  CycleOptions recorded = options;
  recorded.on_state = [&](CycleState state) { states.push_back(std::move(state)); };
  const CycleResult whole = simulate_coupled_cycle(surface, material, motion, recorded, normal);
  REQUIRE(whole.converged());
  REQUIRE(whole.periods == 2);
  CHECK(whole.slip_work > 0);
  REQUIRE(states.size() == 14);
  for (const std::size_t k : {0u, 2u, 6u, 9u}) {
    options.resume = &states[k];
    const CycleResult resumed = simulate_coupled_cycle(surface, material, motion, options, normal);
    CHECK(resumed.work_per_cycle == whole.work_per_cycle);
    CHECK(resumed.normal_work == whole.normal_work);
    CHECK(resumed.gap_work == whole.gap_work);
    CHECK(resumed.slip_work == whole.slip_work);
    CHECK(resumed.iterations == whole.iterations);
    CHECK(resumed.fft_count == whole.fft_count);
    CHECK((resumed.loss == whole.loss).all());
    for (std::size_t i = 0; i < whole.samples.size(); ++i) {
      CHECK(resumed.samples[i].normal_force == whole.samples[i].normal_force);
      CHECK(resumed.samples[i].tangential_force == whole.samples[i].tangential_force);
    }
    CHECK(resumed.converged());
  }
}
