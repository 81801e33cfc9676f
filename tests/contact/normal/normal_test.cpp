// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/normal/punch.hpp>

#include "independent_residual.hpp"
#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

namespace {

constexpr double contact_modulus = 1e9;

NormalContactOptions tight(double tolerance = 1e-13, Precision precision = Precision::full) {
  NormalContactOptions options;
  options.tolerance = tolerance;
  options.precision = precision;
  return options;
}

double residual_of(const NormalContactState& state, const Surface& surface) {
  return independent_residual(state.contact_pressure, surface, contact_modulus);
}

}  // namespace

TEST_CASE("Contact agrees with Polonsky and Keer's solver in cells, mean gap and energy",
          "[normal]") {
  // Even, odd and prime grids, rectangles, cells that are not square, and surfaces that are rough
  // and smooth on the scale of a cell.
  const auto [grid, roughness] = GENERATE(
      std::pair{Grid2D{96, 80, 1.2e-3, 0.8e-3}, RoughnessOfTest{}},
      std::pair{Grid2D{81, 81, 1e-3, 1e-3}, RoughnessOfTest{.hurst = 0.3, .cutoff = 2, .seed = 2}},
      std::pair{Grid2D{61, 97, 1e-3, 1e-3}, RoughnessOfTest{.hurst = 0.6, .cutoff = 4, .seed = 3}},
      std::pair{Grid2D{128, 31, 1e-3, 0.5e-3}, RoughnessOfTest{.rolloff = 2, .seed = 4}});
  const double load = GENERATE(0.003, 0.05, 0.5);
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Surface surface = rough_surface(grid, roughness);
  const double pressure = load * contact_modulus * 0.1;
  const auto reference = polonsky_keer(surface, contact_modulus, pressure, 5e-13);
  const auto state =
      press(surface, contact_modulus, at_pressure(pressure), tight(1e-14, precision));
  REQUIRE(reference.residual < 5e-13);  // its rounding ends at 2e-13
  REQUIRE(state.converged());
  CHECK(((state.contact_pressure > 0) == (reference.pressure > 0)).all());
  // e_c bounds the error of the energy; that of the gap is of order √e_c at worst.
  CHECK(state.mean_gap == Approx(reference.gap.mean()).epsilon(1e-8));
  const double energy = 0.5 * surface.grid.cell_area() *
                        (reference.pressure *
                         half_space_displacement(reference.pressure, surface.grid, contact_modulus))
                            .sum();
  CHECK(state.elastic_energy == Approx(energy).epsilon(1e-8));
}

TEST_CASE("Pressure and gap are complementary to the tolerance asked, on any grid", "[normal]") {
  const auto [nx, ny] =
      GENERATE(std::pair<Index, Index>{128, 128}, std::pair<Index, Index>{97, 101},
               std::pair<Index, Index>{256, 24}, std::pair<Index, Index>{75, 130},
               std::pair<Index, Index>{1, 512}, std::pair<Index, Index>{300, 3});
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Surface surface =
      rough_surface({nx, ny, 1e-3, 2e-3 * double(ny) / double(nx)}, {.rolloff = 2});
  const auto state = press(surface, contact_modulus, at_pressure(2e6), tight(1e-12, precision));
  CHECK(state.converged());
  CHECK(state.residual < 1e-12);
  // The reference transform rounds in another order: 1e-15 of the heights, against 1e-12.
  CHECK(residual_of(state, surface) < 1.1e-12);
  CHECK((state.contact_pressure >= 0).all());
  CHECK(state.gap.minCoeff() > -1e-6 * rms_height(surface));
  CHECK(state.contact_pressure.mean() == Approx(2e6).epsilon(1e-12));
  CHECK(state.force == Approx(2e6 * surface.grid.area()).epsilon(1e-12));
}

TEST_CASE("Pressure, force, mean gap and indentation lead to each other and back", "[normal]") {
  const double load = GENERATE(0.001, 0.02, 0.3, 1.0);
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Surface surface = rough_surface({128, 90, 1e-3, 1e-3});
  const double pressure = load * contact_modulus * 0.1;
  const auto options = tight(1e-13, precision);
  const auto first = press(surface, contact_modulus, at_pressure(pressure), options);
  const auto at_gap = press(surface, contact_modulus, at_mean_gap(first.mean_gap), options);
  const auto to_indentation =
      press(surface, contact_modulus, at_indentation(first.indentation), options);
  const auto back = press(surface, contact_modulus, at_pressure(at_gap.mean_pressure), options);
  const auto under_force =
      press(surface, contact_modulus, at_force(pressure * surface.grid.area()), options);
  for (const auto* state : {&first, &at_gap, &to_indentation, &back, &under_force}) {
    REQUIRE(state->converged());
    // e_c is an energy, so the pressures agree to a part of its root, 3e-7.
    CHECK(state->mean_pressure == Approx(pressure).epsilon(1e-8));
    CHECK(state->mean_gap == Approx(first.mean_gap).epsilon(1e-8));
    CHECK(((state->contact_pressure > 0) == (first.contact_pressure > 0)).all());
  }
  // The prescribed quantity is met to rounding, whatever the residual.
  CHECK(at_gap.mean_gap == Approx(first.mean_gap).epsilon(1e-12));
  CHECK(to_indentation.indentation == Approx(first.indentation).epsilon(1e-12));
  CHECK(back.mean_pressure == Approx(at_gap.mean_pressure).epsilon(1e-12));
}

TEST_CASE("The mean height and a translation by whole cells change nothing", "[normal]") {
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Index nx = GENERATE(96, 77);
  const Surface surface = rough_surface({nx, 96, 1e-3, 1.1e-3});
  const double pressure = 3e6;
  const auto plain =
      press(surface, contact_modulus, at_pressure(pressure), tight(1e-14, precision));
  const auto same = [&](const NormalContactState& state) {
    REQUIRE(state.converged());
    // Both are within 1e-14 in energy of one solution; with the same contact cells the problem is
    // linear, and gaps agree to 1e-10.
    CHECK(state.mean_gap == Approx(plain.mean_gap).epsilon(1e-10));
    CHECK(state.indentation == Approx(plain.indentation).epsilon(1e-10));
    CHECK(state.elastic_energy == Approx(plain.elastic_energy).epsilon(1e-10));
    CHECK(state.contact_area_fraction == plain.contact_area_fraction);
  };
  Surface lifted = surface;
  lifted.heights += 1000 * rms_height(surface);
  // The mean takes three decimals from the heights: 1e-13 of h_rms.
  const auto high = press(lifted, contact_modulus, at_pressure(pressure), tight(1e-13, precision));
  same(high);
  CHECK(((high.contact_pressure > 0) == (plain.contact_pressure > 0)).all());
  Surface moved = surface;
  const auto at = [&](Index i, Index j) { return std::pair{(i + 37) % nx, (j + 11) % 96}; };
  for (Index i = 0; i < nx; ++i)
    for (Index j = 0; j < 96; ++j) {
      const auto [a, b] = at(i, j);
      moved.heights(a, b) = surface.heights(i, j);
    }
  const auto shifted =
      press(moved, contact_modulus, at_pressure(pressure), tight(1e-14, precision));
  same(shifted);
  for (Index i = 0; i < nx; i += 5)
    for (Index j = 0; j < 96; ++j) {
      const auto [a, b] = at(i, j);
      CHECK((shifted.contact_pressure(a, b) > 0) == (plain.contact_pressure(i, j) > 0));
    }
}

TEST_CASE("The contact has the same cells and pressures for one thread and for two", "[normal]") {
  const Surface surface = rough_surface({256, 256, 1e-3, 1e-3});
  parallel::set_threads(1);
  const auto one = press(surface, contact_modulus, at_pressure(3e6));
  parallel::set_threads(2);
  const auto two = press(surface, contact_modulus, at_pressure(3e6));
  parallel::set_threads(0);
  // Sums run over fixed slabs, so the bits are equal, not only the digits.
  CHECK((one.contact_pressure == two.contact_pressure).all());
  CHECK((one.gap == two.gap).all());
}

TEST_CASE("Contact spreads to cells at rest within an iteration, not only at a check of all cells",
          "[normal]") {
  RoughnessOfTest smooth;
  smooth.cutoff = 32;
  const Surface surface = rough_surface({256, 256, 1e-3, 1e-3}, smooth);
  NormalContactOptions options = tight(1e-8, Precision::mixed);
  const auto light = press(surface, contact_modulus, at_pressure(2e5), options);
  options.initial_pressure = &light.contact_pressure;
  const auto state = press(surface, contact_modulus, at_pressure(3e5), options);
  CHECK(state.converged());
  CHECK(state.iterations < 50);  // measured: 15, and 135 if quiet tiles do not become active again
}

TEST_CASE("A sinusoid closes completely at Westergaard's pressure", "[normal]") {
  const double amplitude = 1e-6, wavelength = 1e-3;
  const double full = pi * contact_modulus * amplitude /
                      wavelength;  // Johnson, Contact Mechanics (1985), section 13.2
  const Surface surface = surface_of({64, 16, wavelength, wavelength / 4}, [&](double x, double) {
    return amplitude * std::cos(2 * pi * x / wavelength);
  });
  // Full contact is one Fourier mode and has no discretisation error.
  const auto closed = press(surface, contact_modulus, at_pressure(1.01 * full), tight());
  REQUIRE(closed.converged());
  CHECK(closed.contact_area_fraction == 1);
  CHECK(closed.contact_pressure.maxCoeff() == Approx(2.01 * full).epsilon(1e-6));
  CHECK(closed.mean_gap < 1e-6 * amplitude);
  CHECK(std::isinf(normal_stiffness(closed, surface.grid, contact_modulus)));
  const auto open = press(surface, contact_modulus, at_pressure(0.97 * full), tight());
  REQUIRE(open.converged());
  CHECK(open.contact_area_fraction < 1);
}

TEST_CASE("The contact strip of a sinusoid has Westergaard's width, to the nearest cells",
          "[normal]") {
  const double amplitude = 1e-6, wavelength = 1e-3;
  const double full = pi * contact_modulus * amplitude / wavelength;
  const double load = GENERATE(0.02, 0.2, 0.5, 0.8);
  const double exact = 2 / pi * std::asin(std::sqrt(load));
  for (const Index n : {64, 256, 1024, 4096}) {
    const Surface surface =
        surface_of({n, 1, wavelength, wavelength / double(n)},
                   [&](double x, double) { return amplitude * std::cos(2 * pi * x / wavelength); });
    const auto state = press(surface, contact_modulus, at_pressure(load * full), tight(1e-12));
    REQUIRE(state.converged());
    INFO("n " << n << " fraction " << state.contact_area_fraction << " exact " << exact);
    // First order: cells at the edges count whole, one on each side.
    CHECK(std::abs(state.contact_area_fraction - exact) <= 2.0 / double(n));
  }
}

TEST_CASE("The mean gap of a sinusoid converges to Westergaard's at second order", "[normal]") {
  const double amplitude = 1e-6, wavelength = 1e-3;
  const double full = pi * contact_modulus * amplitude / wavelength;
  const auto error = [&](Index n) {
    const Surface surface =
        surface_of({n, 1, wavelength, wavelength / double(n)},
                   [&](double x, double) { return amplitude * std::cos(2 * pi * x / wavelength); });
    double sum = 0;
    for (const double load : {0.1, 0.3, 0.7}) {
      // dū/dp = (λ/πE*) ln sin²(πa/λ) for strips of width 2a, sin²(πa/λ) = p/p_full, and ū = A at
      // first touch.
      const double exact = amplitude * (1 - load * (1 - std::log(load)));
      const auto state = press(surface, contact_modulus, at_pressure(load * full), tight());
      REQUIRE(state.converged());
      sum += std::abs(state.mean_gap - exact) / amplitude;
    }
    return sum;
  };
  const double coarse = error(64), fine = error(2048);
  INFO("errors " << coarse << ' ' << fine);
  CHECK(fine < 1e-5);
  // The error scatters with the position of the edge within its cell; five doublings and three
  // loads show the order (1.9).
  CHECK(std::log2(coarse / fine) / 5 > 1.6);
}

TEST_CASE("The punch stiffness is the derivative of the force by the mean gap", "[normal]") {
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  const Surface surface = rough_surface({96, 128, 1e-3, 1e-3});
  const auto middle = press(surface, contact_modulus, at_pressure(4e6), tight(1e-14));
  const double step = 1e-7 * middle.mean_gap;
  const auto closer =
      press(surface, contact_modulus, at_mean_gap(middle.mean_gap - step), tight(1e-14));
  const auto apart =
      press(surface, contact_modulus, at_mean_gap(middle.mean_gap + step), tight(1e-14));
  REQUIRE((closer.converged() && apart.converged()));
  const double stiffness =
      normal_stiffness(middle, surface.grid, contact_modulus, tight(1e-12, precision));
  // While no cell enters or leaves, F(ū) is linear; the forces carry the error of e_c over a step
  // of 2e-7.
  CHECK(stiffness == Approx((closer.force - apart.force) / (2 * step)).epsilon(1e-4));
}

TEST_CASE("A punch solve that does not come to its end has no stiffness", "[normal]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const Surface surface = rough_surface({96, 128, 1e-3, 1e-3});
  auto options = tight(1e-10, Precision::mixed);
  options.boundary = boundary;
  const auto state = press(surface, contact_modulus, at_pressure(4e6), options);
  const double stiffness = normal_stiffness(state, surface.grid, contact_modulus, options);
  // The set alone gives the same stiffness, to the digits of its tolerance.
  const auto punch =
      punch_stiffness(contact_set(state), surface.grid, contact_modulus, {.boundary = boundary});
  CHECK(punch.converged());
  CHECK(punch.residual < 1e-4);
  CHECK(punch.normal_stiffness == Approx(stiffness).epsilon(1e-10));
  options.max_iterations = 3;
  CHECK(std::isnan(normal_stiffness(state, surface.grid, contact_modulus, options)));
  options.max_iterations = 1000;
  options.on_progress = [](const ProgressReport& report) { return report.step < 3; };
  CHECK(std::isnan(normal_stiffness(state, surface.grid, contact_modulus, options)));
  const auto limited = punch_stiffness(contact_set(state), surface.grid, contact_modulus,
                                       {.max_iterations = 3, .boundary = boundary});
  CHECK(limited.termination == Termination::iteration_limit);
  CHECK(limited.iterations == 3);
}

TEST_CASE("Plane and single-cell surfaces, and targets that no contact meets", "[normal]") {
  Surface plane{{16, 16, 1e-3, 1e-3}, Field::Constant(16, 16, 2.5), true, ""};
  const auto state = press(plane, contact_modulus, at_pressure(7.0));
  CHECK(state.converged());
  CHECK(state.contact_area_fraction == 1);
  CHECK((state.contact_pressure == 7.0).all());
  CHECK(state.mean_gap == 0);
  CHECK_THROWS_AS(press(plane, contact_modulus, at_mean_gap(1e-9)), InvalidInput);

  Surface surface = rough_surface({32, 32, 1e-3, 1e-3});
  CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(0)), InvalidInput);
  CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(-1)), InvalidInput);
  CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(std::nan(""))), InvalidInput);
  // Numbers beyond the range of double compare false, which must not pass for agreement.
  CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(1e300)), InvalidInput);
  Surface giant = surface;
  giant.heights *= 1e200;
  CHECK_THROWS_AS(press(giant, contact_modulus, at_pressure(1e6)), InvalidInput);
  CHECK_THROWS_AS(press(surface, 0, at_pressure(1e6)), InvalidInput);
  CHECK_THROWS_AS(press(surface, contact_modulus, at_mean_gap(0)), InvalidInput);
  CHECK_THROWS_WITH(press(surface, contact_modulus, at_force(-1)), Catch::StartsWith("force: -1"));
  const double touch = surface.heights.maxCoeff() - surface.heights.mean();
  CHECK_THROWS_WITH(press(surface, contact_modulus, at_mean_gap(touch)),
                    Catch::Contains("first touches"));
  NormalContactOptions options;
  options.tolerance = 0;
  CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(1e6), options), InvalidInput);
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    surface.heights(3, 4) = bad;
    CHECK_THROWS_AS(press(surface, contact_modulus, at_pressure(1e6)), InvalidInput);
    CHECK_THROWS_AS(press(surface, contact_modulus, at_mean_gap(1e-9)), InvalidInput);
    CHECK_THROWS_AS(press(surface, contact_modulus, at_indentation(1e-9)), InvalidInput);
  }
  surface.heights(3, 4) = std::nan("");
  CHECK_THROWS_WITH(press(surface, contact_modulus, at_pressure(1e6)),
                    Catch::Contains("undefined"));
}

TEST_CASE("An approach of full contact is named before any work", "[normal]") {
  const Surface surface = rough_surface({32, 32, 1e-3, 1e-3});
  const double full = surface.heights.maxCoeff() - surface.heights.mean();
  for (const double indentation : {full, 2 * full})
    CHECK_THROWS_WITH(press(surface, contact_modulus, at_indentation(indentation)),
                      Catch::Contains("indentation") && Catch::Contains("full"));
  // Just below full contact the contact is nearly full.
  const auto state = press(surface, contact_modulus, at_indentation(0.999999 * full));
  CHECK(state.converged());
  CHECK(state.contact_area_fraction > 0.99);
  CHECK(state.mean_gap == Approx(1e-6 * full).epsilon(1e-6));
}

TEST_CASE("Whatever the limit of iterations, converged says the truth", "[normal]") {
  const Surface surface = rough_surface({128, 128, 1e-3, 1e-3});
  const Precision precision = GENERATE(Precision::mixed, Precision::full);
  auto options = tight(1e-10, precision);
  const double pressure = 4e6;
  const auto full = press(surface, contact_modulus, at_pressure(pressure), options);
  REQUIRE(full.converged());
  int unfinished = 0;
  for (int limit = 1; limit <= full.iterations + 1; ++limit) {
    options.max_iterations = limit;
    const auto state = press(surface, contact_modulus, at_pressure(pressure), options);
    const auto held = press(surface, contact_modulus, at_mean_gap(full.mean_gap), options);
    CHECK(state.iterations <= limit);
    CHECK(state.mean_pressure == Approx(pressure).epsilon(1e-10));
    CHECK(held.mean_gap == Approx(full.mean_gap).epsilon(1e-10));
    // The residual is not an estimate: another transform finds the same value from the pressures.
    // At a given approach gaps count from there and not from the minimum gap, which can only add to
    // the residual.
    CHECK(state.residual == Approx(residual_of(state, surface)).epsilon(1e-3));
    CHECK(held.residual > 0.999 * residual_of(held, surface));
    for (const auto* each : {&state, &held}) {
      CHECK(each->termination == (each->residual < options.tolerance
                                      ? Termination::converged
                                      : Termination::iteration_limit));
      unfinished += !each->converged();
    }
  }
  CHECK(unfinished >= full.iterations);  // otherwise the limit had no effect
}

TEST_CASE("The progress callback stops a contact", "[normal]") {
  const Surface surface = rough_surface({128, 128, 1e-3, 1e-3});
  auto options = tight();
  int calls = 0;
  options.on_progress = [&](const ProgressReport& report) {
    CHECK(report.stage == "contact");
    return ++calls < 20;
  };
  const auto state = press(surface, contact_modulus, at_pressure(4e6), options);
  CHECK(calls == 20);
  CHECK(state.termination == Termination::interrupted);
  CHECK_FALSE(state.converged());
}
