// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/damping/cycle.hpp>

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double contact_modulus = 3e9;

// Cells whose centres lie within a radius of the middle of the grid, which is shifted by (0.31,
// 0.17) of a cell.
ContactSet disc(const Grid2D& grid, double radius) {
  ContactSet contact(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy)
      contact(ix, iy) =
          std::hypot((static_cast<double>(ix) - 0.31) * grid.dx() - grid.lx / 2,
                     (static_cast<double>(iy) - 0.17) * grid.dy() - grid.ly / 2) < radius;
  return contact;
}

// The cone with g(x) = c|x|: a = δ/c, F = E*δ²/c, F'' = 2E*/c at every δ > 0.
constexpr double cone_slope = 0.02;
ContactSets cone(const Grid2D& grid) {
  return [grid](double indentation) {
    return ContactSetAt{.contact = disc(grid, indentation / cone_slope),
                        .force = contact_modulus * indentation * indentation / cone_slope};
  };
}

// Nested sets without symmetry: islands that appear, grow and merge as δ goes from 0 to 1, with
// holes that close.
ContactSets islands(const Grid2D& grid) {
  return [grid](double indentation) {
    ContactSetAt level{.contact = ContactSet(grid.nx, grid.ny)};
    for (Index ix = 0; ix < grid.nx; ++ix)
      for (Index iy = 0; iy < grid.ny; ++iy) {
        const double x = 2 * pi * static_cast<double>(ix) / static_cast<double>(grid.nx);
        const double y = 2 * pi * static_cast<double>(iy) / static_cast<double>(grid.ny);
        level.contact(ix, iy) = std::sin(x + 0.3) * std::cos(2 * y) + 0.7 * std::sin(3 * x - y) +
                                    0.5 * std::cos(5 * x + 4 * y) >
                                1.4 - indentation;
      }
    return level;
  };
}

// K_t of a contact set for motion along `direction`.
double stiffness_along(const ContactSet& contact, const Grid2D& grid, const Material& material,
                       const CycleOptions& options) {
  const StickStiffness k = stick_stiffness(contact, grid, material, options.stick);
  const double c = std::cos(options.direction), s = std::sin(options.direction);
  return c * c * k.xx + 2 * c * s * k.xy + s * s * k.yy;
}

// The theorem for the sets of a discretised cycle that is symmetric about t = 1/2. The cells
// between A(t_k) and A(t_{k+1}) enter at t_{k+1/2} and leave at 1 − t_{k+1/2}, so W = ½ Σ (K_{k+1}
// − K_k) s².
double theorem(const ContactSets& contact_sets, const Grid2D& grid, const Material& material,
               const Trajectory& motion, const CycleOptions& options) {
  double sum = 0, below = 0;
  for (int k = 0; k <= options.steps / 2; ++k) {
    const double t = static_cast<double>(k) / options.steps, middle = t - 0.5 / options.steps;
    const double here =
        stiffness_along(contact_sets(motion.indentation(t)).contact, grid, material, options);
    if (k > 0)
      sum +=
          (here - below) * std::pow(motion.tangential(1 - middle) - motion.tangential(middle), 2);
    below = here;
  }
  return sum / 2;
}

}  // namespace

TEST_CASE("The simulated loss is half the integral of s squared over K_t, for any nested sets",
          "[cycle]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const double poisson = GENERATE(0.0, 0.3, 0.5);
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const ContactSets levels = islands(grid);
  CycleOptions options{.steps = 12, .direction = 0.7};
  options.stick = {.tolerance = 1e-9, .boundary = boundary};
  for (const Oscillation& motion :
       {Oscillation(EqualFrequency{0.5, 1e-6, pi / 2}),
        Oscillation(EqualFrequency{0.5, 1e-6, pi / 4}), Oscillation(Drag{0.5, 1e-3, 700.0})}) {
    const Trajectory trajectory = trajectory_of(motion, 0.5);
    const CycleResult cycle = simulate_cycle(levels, grid, material, trajectory, options);
    REQUIRE(cycle.converged());
    CHECK(cycle.periods == 1);
    CHECK(cycle.steady);
    // Exact for the discretised problem; the solvers leave 1e-9 of the motion, summed over the
    // steps.
    CHECK(cycle.work_per_cycle ==
          Approx(theorem(levels, grid, material, trajectory, options)).epsilon(1e-7));
    CHECK(cycle.dissipated == Approx(cycle.work_per_cycle).epsilon(1e-7));
  }
}

TEST_CASE("The nested sets of these tests split and merge", "[cycle]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  std::vector<std::size_t> pieces;
  for (const double indentation : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const ContactSet contact = islands(grid)(indentation).contact;
    pieces.push_back(contact_spots(contact.cast<double>(), grid).spots.size());
  }
  CHECK(*std::max_element(pieces.begin(), pieces.end()) >
        *std::min_element(pieces.begin(), pieces.end()));
  CHECK(std::adjacent_find(pieces.begin(), pieces.end(), std::less<>()) != pieces.end());
  CHECK(std::adjacent_find(pieces.begin(), pieces.end(), std::greater<>()) != pieces.end());
}

TEST_CASE("Cells that enter and leave while the body rests release nothing", "[cycle]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  // The core is displaced, the contact around it grows and shrinks again, then the core moves back.
  const Trajectory trajectory{
      [](double t) {
        return t < 0.3 || t > 0.7 ? 0.3 : 0.3 + 0.6 * std::sin((t - 0.3) / 0.4 * pi);
      },
      [](double t) {
        return 1e-6 * (t < 0.25 ? t / 0.25 : t > 0.75 ? (1 - t) / 0.25 : 1.0);
      }};
  CycleOptions options{.steps = 20, .direction = 0.7};
  options.stick.boundary = boundary;
  const CycleResult cycle = simulate_cycle(islands(grid), grid, material, trajectory, options);
  REQUIRE(cycle.converged());
  CHECK(cycle.largest.count() > 2 * cycle.smallest.count());
  const double core = stiffness_along(cycle.smallest, grid, material, options);
  const double stored = core * 1e-12 / 2;
  // The solvers' 1e-8 of the motion, twenty times.
  CHECK(std::abs(cycle.dissipated) < 1e-6 * stored);
  CHECK(std::abs(cycle.work_per_cycle) < 1e-6 * stored);
  // The force stays that of the core, because cells that enter carry no traction.
  for (const CycleSample& sample : cycle.samples)
    if (sample.t > 0.26 && sample.t < 0.74)
      CHECK(sample.tangential_force == Approx(core * 1e-6).epsilon(1e-6));
}

TEST_CASE("The steps state an error that covers what they lack to many steps", "[cycle]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const Oscillation kind =
      GENERATE(Oscillation(EqualFrequency{0.5, 1e-6, pi / 4}), Oscillation(Drag{0.5, 1e-3, 700.0}));
  const Trajectory motion = trajectory_of(kind, 0.5);
  const auto run = [&](int steps) {
    CycleOptions options{.steps = steps, .direction = 0.7};
    return simulate_cycle(islands(grid), grid, material, motion, options);
  };
  const double settled = run(512).work_per_cycle;
  double first = 0, last = 0;
  for (const int steps : {8, 16, 20, 32, 45, 64}) {
    const CycleResult cycle = run(steps);
    CHECK(std::abs(cycle.work_per_cycle - settled) <= cycle.step_error);
    // The error is not much larger than the deviation, so it is useful to a reader.
    CHECK(cycle.step_error < 12.0 / steps * settled);
    if (steps == 8) first = cycle.step_error;
    last = cycle.step_error;
  }
  // Eight times as many steps: the order is one, since few cells enter in a step, and they enter in
  // groups.
  CHECK(last < first / 4);
}

TEST_CASE("The steps' error holds where few of them meet many cells", "[cycle]") {
  // The error is that of the rule, h²/24 = 2.6 % at eight steps, and not that of single cells.
  const Grid2D grid{56, 56, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0);
  const double indentation = 0.25e-3 * cone_slope, amplitude = 0.2e-3 * cone_slope;
  const Trajectory motion = trajectory_of(EqualFrequency{amplitude, 2e-6, pi / 2}, indentation);
  const auto run = [&](int steps) {
    CycleOptions options{.steps = steps};
    options.stick.boundary = Boundary::free;
    return simulate_cycle(cone(grid), grid, material, motion, options);
  };
  const CycleResult coarse = run(8);
  const double settled = run(64).work_per_cycle;
  CHECK(coarse.work_per_cycle / settled - 1 == Approx(-pi * pi / 16 / 24).epsilon(0.3));
  CHECK(std::abs(coarse.work_per_cycle - settled) <= coarse.step_error);
}

TEST_CASE("The steps' error holds for a motion that turns inside the sweep", "[cycle]") {
  // Two unequal rises per period, begun while δ rises: bands enter, are partly released and enter
  // again.
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const Trajectory motion{
      [](double t) { return 0.5 + 0.3 * std::sin(2 * pi * t) + 0.2 * std::sin(4 * pi * t + 0.4); },
      [](double t) { return 1e-6 * (t + 0.5 * std::cos(2 * pi * t + 0.5)); }};
  const auto run = [&](int steps) {
    return simulate_cycle(islands(grid), grid, material, motion, {.steps = steps});
  };
  const double settled = run(768).work_per_cycle;
  double first = 0, last = 0;
  for (const int steps : {24, 48, 96}) {
    const CycleResult cycle = run(steps);
    REQUIRE(cycle.steady);
    CHECK(cycle.dissipated == Approx(cycle.work_per_cycle).epsilon(1e-6));
    CHECK(std::abs(cycle.work_per_cycle - settled) <= cycle.step_error);
    CHECK(cycle.step_error < 0.3 * settled);
    if (steps == 24) first = cycle.step_error;
    last = cycle.step_error;
  }
  // Four times as many steps, with no trace of where the first period began.
  CHECK(last < first / 2);
}

TEST_CASE("A contact turned by 90 degrees loses along y what it lost along x", "[cycle]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3}, turned{20, 27, 1e-3, 1.3e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  const ContactSets across = [&](double indentation) {
    ContactSetAt level = islands(grid)(indentation);
    level.contact = ContactSet(level.contact.transpose());
    return level;
  };
  const Trajectory motion = trajectory_of(EqualFrequency{0.5, 1e-6, 0.6}, 0.5);
  CycleOptions along_x{.steps = 12}, along_y{.steps = 12, .direction = pi / 2};
  const double first =
      simulate_cycle(islands(grid), grid, material, motion, along_x).work_per_cycle;
  const double second = simulate_cycle(across, turned, material, motion, along_y).work_per_cycle;
  const double other =
      simulate_cycle(islands(grid), grid, material, motion, along_y).work_per_cycle;
  CHECK(second == Approx(first).epsilon(1e-7));
  // The contact has no symmetry that could hide an exchange of the axes.
  CHECK(std::abs(other / first - 1) > 0.005);
}

TEST_CASE("The cone loses Eqs (12) and (15) at any amplitude", "[cycle]") {
  const double poisson = GENERATE(0.0, 0.3, 0.5);
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const double indentation = 0.3e-3 * cone_slope, amplitude = 0.1e-3 * cone_slope;
  const double curvature = material.modulus_ratio() * 2 * contact_modulus / cone_slope;
  CycleOptions options{.steps = 32};
  options.stick.boundary = Boundary::free;
  const auto lost = [&](const Oscillation& motion) {
    const CycleResult cycle =
        simulate_cycle(cone(grid), grid, material, trajectory_of(motion, indentation), options);
    REQUIRE(cycle.converged());
    CHECK(cycle.contact_area_min == Approx(pi * 0.04e-6).epsilon(0.02));
    CHECK(cycle.contact_area_max == Approx(pi * 0.16e-6).epsilon(0.02));
    CHECK(cycle.smallest.count() * grid.cell_area() == cycle.contact_area_min);
    return cycle.work_per_cycle;
  };
  // Measured: 0.2 % in case (a), mostly h²/24 = 1.6e-3 of the steps, and 0.5 to 0.8 % in case (b),
  // from the grid.
  for (const double phase : {pi / 2, pi / 4}) {
    const double s = std::sin(phase);
    CHECK(lost(EqualFrequency{amplitude, 2e-6, phase}) ==
          Approx(8.0 / 3 * curvature * 4e-12 * amplitude * s * s).epsilon(0.005));
  }
  CHECK(lost(Drag{amplitude, 2e-3, 900.0}) ==
        Approx(2 * (pi * pi - 4) * curvature * amplitude * std::pow(2e-3 / 900, 2)).epsilon(0.012));
}

TEST_CASE("The loss goes with the squared sine of the phase, even in few steps", "[cycle]") {
  // If a contact set changed before or after the move and not in its middle, the phase would shift
  // by half a step: 20 % of the loss at 45 degrees and 32 steps, nothing at 90 degrees.
  const Grid2D grid{24, 24, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const auto lost = [&](double phase) {
    const Trajectory motion = trajectory_of(EqualFrequency{0.5, 1e-6, phase}, 0.5);
    return simulate_cycle(islands(grid), grid, material, motion, {.steps = 8}).work_per_cycle;
  };
  const double most = lost(pi / 2);
  for (const double phase : {pi / 4, 0.3, -2.0})
    CHECK(lost(phase) == Approx(most * std::pow(std::sin(phase), 2)).epsilon(1e-6));
  CHECK(std::abs(lost(0)) < 1e-9 * most);
}

TEST_CASE("A contact whose cells do not change loses nothing", "[cycle]") {
  const Grid2D grid{40, 40, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const ContactSets cylinder = [&](double) { return ContactSetAt{disc(grid, 0.3e-3)}; };
  CycleOptions options{.steps = 16};
  options.stick.boundary = Boundary::free;
  const double amplitude = 2e-6;
  const CycleResult cycle = simulate_cycle(
      cylinder, grid, material, trajectory_of(EqualFrequency{1e-7, amplitude, 1.0}, 1e-6), options);
  const double stiffness = stick_stiffness(disc(grid, 0.3e-3), grid, material, options.stick).xx;
  CHECK(std::abs(cycle.work_per_cycle) < 1e-9 * stiffness * amplitude * amplitude / 2);
  CHECK(cycle.dissipated == 0);
  // Half-way the energy is stored: the motion does work.
  CHECK(cycle.samples[8].work > 0.1 * stiffness * amplitude * amplitude);
}

TEST_CASE("The steady loss does not depend on where the motion starts", "[cycle]") {
  const Grid2D grid{24, 24, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const CycleOptions options{.steps = 16};
  const Trajectory from_min = trajectory_of(EqualFrequency{0.5, 1e-6, 1.1}, 0.5);
  const Trajectory from_greatest{[&](double t) { return from_min.indentation(t + 0.5); },
                                 [&](double t) { return from_min.tangential(t + 0.5); }};
  const CycleResult first = simulate_cycle(islands(grid), grid, material, from_min, options);
  const CycleResult second = simulate_cycle(islands(grid), grid, material, from_greatest, options);
  CHECK(first.periods == 1);
  CHECK(second.periods > 1);
  CHECK(second.steady);
  CHECK(second.work_per_cycle == Approx(first.work_per_cycle).epsilon(1e-6));
  // A run that stops after the first period, which is not steady, reports that.
  const CycleResult hasty =
      simulate_cycle(islands(grid), grid, material, from_greatest, {.steps = 16, .max_periods = 1});
  CHECK(hasty.periods == 1);
  CHECK_FALSE(hasty.steady);
}

TEST_CASE("Drag leaves the core stressed and the rest of its loop closed", "[cycle]") {
  const Grid2D grid{24, 24, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const CycleOptions options{.steps = 16};
  const double advance = 2 * pi * 1e-3 / 500;
  const CycleResult cycle = simulate_cycle(islands(grid), grid, material,
                                           trajectory_of(Drag{0.5, 1e-3, 500.0}, 0.5), options);
  const double core = stick_stiffness(cycle.smallest, grid, material, options.stick).xx;
  CHECK(cycle.samples.back().tangential_force == Approx(core * advance).epsilon(1e-7));
  CHECK(cycle.stored_energy_change == Approx(core * advance * advance / 2).epsilon(1e-7));
  CHECK(cycle.samples.front().tangential == 0);
  CHECK(cycle.samples.back().tangential == Approx(advance));
}

TEST_CASE("A cycle that cannot be trusted is not called converged, and bad input is named",
          "[cycle]") {
  const Grid2D grid{24, 24, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const Trajectory motion = trajectory_of(EqualFrequency{0.5, 1e-6, 1.1}, 0.5);
  CycleOptions options{.steps = 8};
  options.stick.max_iterations = 3;
  CHECK_FALSE(simulate_cycle(islands(grid), grid, material, motion, options).converged());
  const ContactSets doubtful = [&](double indentation) {
    ContactSetAt level = islands(grid)(indentation);
    level.converged = indentation < 0.4 || indentation > 0.6;  // reached inside the cycle
    return level;
  };
  CHECK_FALSE(simulate_cycle(doubtful, grid, material, motion, {.steps = 8}).converged());
  const CycleOptions stopped{.steps = 8,
                             .on_progress = [](const ProgressReport& r) { return r.step < 3; }};
  const CycleResult partial = simulate_cycle(islands(grid), grid, material, motion, stopped);
  CHECK(partial.termination == Termination::interrupted);
  CHECK_FALSE(partial.converged());
  CHECK_THROWS_WITH(simulate_cycle(islands(grid), grid, material, motion, {.steps = 3}),
                    Catch::StartsWith("steps: 3"));
  CHECK_THROWS_AS(trajectory_of(Drag{0.1, 1.0, 0.0}, 0), InvalidInput);
}
