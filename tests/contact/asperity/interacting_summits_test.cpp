// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/asperity_sampling.hpp>
#include <salebra/contact/asperity/interacting_summits.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/surface/summits.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

const double modulus = 2.5;
const Material soft = Material::of_contact_modulus(modulus, 0.3);

/// (1/A) Σ_{q≠0} (2/q) exp(iq·r) by Ewald's method in its plainest form: both sums run over a
/// square of lattice points, with the split at which they converge alike. At r = 0 the limit of
/// −erf(αr)/r replaces the term of r = 0 itself.
double periodic_kernel(double x, double y, double lx, double ly) {
  const double split = std::sqrt(pi / (lx * ly));
  double sum = -2 * std::sqrt(pi) / (split * lx * ly);
  for (int i = -9; i <= 9; ++i)
    for (int j = -9; j <= 9; ++j) {
      const double r = std::hypot(x + i * lx, y + j * ly);
      sum += r == 0 ? -2 * split / std::sqrt(pi) : std::erfc(split * r) / r;
      const double qx = 2 * pi * i / lx, qy = 2 * pi * j / ly, q = std::hypot(qx, qy);
      if (q > 0)
        sum += 2 * pi / (q * lx * ly) * std::erfc(q / (2 * split)) * std::cos(qx * x + qy * y);
    }
  return sum / pi;
}

std::vector<Summit> random_summits(int count, double radius, double size) {
  return draw_summits({.summit_density = 1, .radius = radius, .summit_rms = 1}, count, size, 17);
}

Grid2D square(double size) { return {4, 4, size, size}; }

}  // namespace

TEST_CASE("The plain periodic kernel has the known constant of the square lattice",
          "[interacting]") {
  // Σ' 1/r over a square lattice with its neutralising background: −3.900264920001956.
  CHECK(pi * periodic_kernel(0, 0, 1, 1) == Approx(-3.900264920001956).epsilon(1e-12));
}

TEST_CASE("One summit alone is lifted by its periodic images only", "[interacting]") {
  const double size = 3, radius = 0.05;
  const InteractingSummits single({{.x = 1.7, .y = 0.2, .curvature1 = 20, .curvature2 = 20}}, soft,
                                  square(size));
  const double separation = -0.01;
  const AsperityContact contact = single.at(separation);
  REQUIRE(contact.converged);
  // δ = −s + 3.9002649 P/(πE*L), whichever summit carries P. The grid part of the sums is accurate
  // to 1e-9.
  const double depth = 0.01 + 3.900264920001956 * contact.force / (pi * modulus * size);
  CHECK(contact.force ==
        Approx(4.0 / 3 * modulus * std::sqrt(radius) * std::pow(depth, 1.5)).epsilon(1e-8));
}

TEST_CASE("Every summit is in equilibrium with all the others", "[interacting]") {
  const double lx = 7, ly = 5;
  std::vector<Summit> summits = random_summits(60, 0.02, 5);
  for (Summit& summit : summits) summit.x *= 7.0 / 5;
  double mean = 0;
  for (const Summit& summit : summits) mean += summit.height / 60;
  const InteractingSummits model(summits, soft, {4, 4, lx, ly}, 0.4);
  const double separation = GENERATE(1.0, 0.0, -1.5);
  const InteractingSummits::State state = model.solve(separation);
  REQUIRE(state.converged);
  int in_contact = 0;
  for (std::size_t i = 0; i < summits.size(); ++i) {
    double depth = summits[i].height - mean - separation;
    for (std::size_t j = 0; j < summits.size(); ++j)
      depth -= state.loads[j] / modulus *
               periodic_kernel(summits[i].x - summits[j].x, summits[i].y - summits[j].y, lx, ly);
    const double load = 4.0 / 3 * modulus * std::sqrt(0.02) * std::pow(std::max(depth, 0.0), 1.5);
    // The error is 1e-10 of the solver and 1e-9 of the grid, relative to the maximum displacement,
    // which is of the order of the maximum depth.
    CHECK(state.loads[i] == Approx(load).margin(1e-7));
    in_contact += state.loads[i] > 0;
  }
  CHECK(in_contact > 5);
  CHECK(model.at(separation).contacts == in_contact);
  CHECK(model.mean_gap(separation) == Approx(separation + mean - 0.4));
}

TEST_CASE("K and F'' are derivatives of the interacting force", "[interacting]") {
  const InteractingSummits model(random_summits(40, 0.05, 6), soft, square(6), 0, 1,
                                 SummitShape::circular, {.tolerance = 1e-12});
  const double separation = 0.137, step = 1e-4;
  const AsperityContact contact = model.at(separation);
  REQUIRE(contact.converged);
  const AsperityContact closer = model.at(separation - step), farther = model.at(separation + step);
  // No summit touches or leaves between the three states, so the differences are smooth, with
  // errors of order step².
  REQUIRE(closer.contacts == farther.contacts);
  CHECK(contact.normal_stiffness ==
        Approx((closer.force - farther.force) / (2 * step)).epsilon(1e-6));
  CHECK(contact.force_curvature ==
        Approx((closer.normal_stiffness - farther.normal_stiffness) / (2 * step)).epsilon(1e-5));
}

TEST_CASE("Sparse summits do not feel each other", "[interacting]") {
  // The interaction is of the order of Σ P/(πE*L): if L is a thousand times the contact radius, it
  // is at most 1e-3 of δ.
  const std::vector<Summit> summits = random_summits(10, 1e-4, 1e2);
  const InteractingSummits interacting(summits, soft, square(1e2));
  const DeterministicSummits independent(summits, soft, 1e4);
  CHECK(interacting.force(0) == Approx(independent.force(0)).epsilon(2e-3));
  CHECK(interacting.force(0) != independent.force(0));
}

TEST_CASE("Sparse elliptical summits have the area of Hertz's ellipses", "[interacting]") {
  // As above, the displacement by the neighbours is at most 1e-3 of δ. An ellipse whose curvatures
  // have this ratio has a tenth less area than the circle of the same force.
  std::vector<Summit> summits = random_summits(10, 1e-4, 1e2);
  for (Summit& summit : summits) summit.curvature2 /= 8;
  const InteractingSummits interacting(summits, soft, square(1e2), 0, 1, SummitShape::elliptical);
  const DeterministicSummits independent(summits, soft, 1e4, 0, 1, SummitShape::elliptical);
  CHECK(interacting.at(0).contact_area == Approx(independent.at(0).contact_area).epsilon(2e-3));
}

TEST_CASE("Interaction moves the force-gap curve of summits to that of boundary elements",
          "[interacting]") {
  // The remaining difference: summits are not paraboloids, and contacts merge.
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 1.0 / 4, .short_cutoff = 16.0 / 128, .rms_slope = 0.1});
  const double force = 0.03 * 0.1 * modulus;
  double independent_error = 0, interacting_error = 0;
  double independent_length = 0, interacting_length = 0;
  for (std::uint64_t seed : {1, 2, 3}) {
    const Surface surface = filtered_noise(Grid2D{128, 128, 1, 1}, spectrum, seed);
    const std::vector<Summit> summits = find_summits(surface).summits;
    const DeterministicSummits independent(summits, soft, 1, surface.heights.mean());
    const InteractingSummits interacting(summits, soft, surface.grid, surface.heights.mean());
    const NormalContactState exact =
        press(surface, modulus, at_pressure(force), {.tolerance = 1e-8});
    REQUIRE(exact.converged());
    const double exact_length = force / normal_stiffness(exact, surface.grid, modulus);
    const double alone = independent.separation_of(force);
    const double together = interacting.separation_of(force);
    CHECK(interacting.force(together) == Approx(force).epsilon(1e-8));
    independent_error += std::abs(independent.mean_gap(alone) - exact.mean_gap);
    interacting_error += std::abs(interacting.mean_gap(together) - exact.mean_gap);
    independent_length += std::abs(force / independent.normal_stiffness(alone) / exact_length - 1);
    interacting_length +=
        std::abs(force / interacting.normal_stiffness(together) / exact_length - 1);
  }
  CHECK(interacting_error < independent_error / 2);
  CHECK(interacting_length < independent_length / 2);
}

TEST_CASE("The sums for thousands of summits agree with the plain ones", "[interacting]") {
  // More points than one cell of neighbours holds, on a rectangle: this tests both the cell lists
  // and the grid.
  std::vector<Summit> summits = random_summits(2500, 1e-3, 9);
  for (Summit& summit : summits) summit.y /= 3;
  const InteractingSummits model(summits, soft, {4, 4, 9, 3});
  const double separation = 1.5;
  const InteractingSummits::State state = model.solve(separation);
  REQUIRE(state.converged);
  double mean = 0;
  for (const Summit& summit : summits) mean += summit.height / 2500;
  const double deepest = std::ranges::max(state.indentation);
  // Every third summit in contact, and some of the others.
  int contacts = 0;
  for (std::size_t i = 0; i < summits.size(); ++i) {
    if (state.loads[i] > 0 ? ++contacts % 3 != 0 : i % 101 != 0) continue;
    double depth = summits[i].height - mean - separation;
    for (std::size_t j = 0; j < summits.size(); ++j)
      if (state.loads[j] > 0)
        depth -= state.loads[j] / modulus *
                 periodic_kernel(summits[i].x - summits[j].x, summits[i].y - summits[j].y, 9, 3);
    if (state.loads[i] == 0) {
      CHECK(depth < 1e-8 * deepest);
      continue;
    }
    // The error is 1e-10 of the solver and the 1e-9 that the sums promise, relative to
    // displacements below the maximum depth.
    CHECK(state.indentation[i] == Approx(depth).margin(3e-9 * deepest).epsilon(0));
    CHECK(state.loads[i] ==
          Approx(4.0 / 3 * modulus * std::sqrt(1e-3) * std::pow(state.indentation[i], 1.5)));
  }
}

TEST_CASE("Given the force or given the separation, the state is the same", "[interacting]") {
  const InteractingSummits model(random_summits(400, 0.02, 20), soft, square(20));
  const double separation = GENERATE(1.5, 0.2, -1.0);
  const InteractingSummits::State by_separation = model.solve(separation);
  REQUIRE(by_separation.converged);
  const AsperityContact contact = model.contact_of(by_separation);
  const InteractingSummits::State by_force = model.solve_for_force(contact.force);
  REQUIRE(by_force.converged);
  // Both solvers stop at 1e-10 of the maximum indentation, which is of the order of one.
  CHECK(by_force.separation == Approx(separation).margin(1e-9));
  CHECK(model.contact_of(by_force).force == Approx(contact.force).epsilon(1e-12));
  CHECK(model.contact_of(by_force).normal_stiffness ==
        Approx(contact.normal_stiffness).epsilon(1e-7));
  CHECK(model.separation_of(contact.force) == by_force.separation);
  // The solve from another state gives the same result.
  const InteractingSummits::State from_other = model.solve_for_force(contact.force, &by_separation);
  CHECK(from_other.separation == Approx(separation).margin(1e-9));
  const InteractingSummits::State closer = model.solve_for_force(2 * contact.force, &by_force);
  CHECK(closer.converged);
  CHECK(closer.separation < separation);
}

TEST_CASE("A curve of interacting summits is that of its single loads", "[interacting]") {
  const InteractingSummits model(random_summits(300, 0.02, 15), soft, square(15));
  const std::vector<double> pressures{0.08, 0.0005, 0.002, 0.02};
  std::vector<double> fractions;
  const ForceCurve curve = curve_at_pressures(model, pressures, [&](const ProgressReport& report) {
    if (fractions.empty() || report.fraction != fractions.back())
      fractions.push_back(report.fraction);
    return true;
  });
  REQUIRE(curve.samples.size() == 4);
  CHECK(fractions == std::vector<double>{0, 0.25, 0.5, 0.75});
  const AsperityModel& plain = model;
  const ForceCurve single = curve_at_pressures(plain, pressures);
  for (std::size_t k = 0; k < 4; ++k) {
    const ForceSample &one = curve.samples[k], &other = single.samples[k];
    REQUIRE(one.converged);
    CHECK(one.pressure == Approx(other.pressure).epsilon(1e-8));
    CHECK(one.mean_gap == Approx(other.mean_gap).margin(1e-8));
    CHECK(one.contact_area_fraction == Approx(other.contact_area_fraction).epsilon(1e-7));
    CHECK(one.normal_stiffness == Approx(other.normal_stiffness).epsilon(1e-7));
  }
  CHECK(curve.samples[0].pressure == Approx(0.0005).epsilon(1e-12));
  CHECK(curve_at_pressures(model, pressures, [](const ProgressReport& report) {
          return report.step < 2;
        }).samples.size() == 2);
}

TEST_CASE("A summit within a larger contact is pressed out of it", "[interacting]") {
  const std::vector<Summit> summits{
      {.x = 1, .y = 1, .height = 0.1, .curvature1 = 0.1, .curvature2 = 0.1},
      {.x = 1.05, .y = 1, .height = 0.099, .curvature1 = 0.1, .curvature2 = 0.1}};
  const InteractingSummits model(summits, soft, square(10));
  // The contact radius of the higher summit is √(10·0.1) = 1, twenty times the distance.
  const InteractingSummits::State state = model.solve(0);
  CHECK(state.converged);
  CHECK(std::min(state.loads[0], state.loads[1]) == 0);
  CHECK(std::max(state.loads[0], state.loads[1]) > 0);
}

TEST_CASE("Interacting summits say what they cannot have", "[interacting]") {
  const std::vector<Summit> summits = random_summits(5, 1, 1);
  CHECK_THROWS_WITH(InteractingSummits({summits[0], summits[0]}, soft, square(1)),
                    Catch::Contains("summits.position"));
  CHECK_THROWS_AS(InteractingSummits({}, soft, square(1)), InvalidInput);
  CHECK_THROWS_WITH(InteractingSummits(summits, soft, square(1), 0, 1, SummitShape::circular,
                                       {.max_iterations = 0}),
                    Catch::Contains("max_iterations"));
  const InteractingSummits hasty(random_summits(100, 1, 5), soft, square(5), 0, 1,
                                 SummitShape::circular, {.max_iterations = 1});
  CHECK_FALSE(hasty.at(0).converged);
  CHECK_FALSE(curve_at_separations(hasty, {0}).samples[0].converged);
  // A load without a solution has no gap and no separation.
  const ForceSample lost = curve_at_pressures(hasty, {1}).samples[0];
  CHECK_FALSE(lost.converged);
  CHECK(std::isnan(lost.mean_gap));
  CHECK_THROWS_AS(hasty.separation_of(25), NotConverged);
  CHECK(hasty.at(100).force == 0);
  CHECK(hasty.at(100).converged);
}

TEST_CASE("Interacting summits can be stopped within a load, and reports change nothing",
          "[interacting]") {
  const auto summits = random_summits(40, 0.05, 6);
  const InteractingSummits model(summits, soft, square(6));
  const std::vector<double> pressures{1e-3, 1e-2, 5e-2};
  int reports = 0, of_first = 0;
  const ForceCurve whole = curve_at_pressures(model, pressures, [&](const ProgressReport& report) {
    CHECK(report.stage == "interacting summits");
    ++reports;
    of_first += report.step == 0;
    return true;
  });
  REQUIRE(whole.samples.size() == 3);
  // Each load reports several times, so that a load of many summits can be interrupted soon.
  REQUIRE(reports - of_first > 10);
  const ForceCurve silent = curve_at_pressures(model, pressures);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(whole.samples[k].mean_gap == silent.samples[k].mean_gap);
  // Finished loads are returned, wherever in the second load the interruption comes.
  for (const int last : {of_first, of_first + 3}) {
    int told = 0;
    const ForceCurve stopped =
        curve_at_pressures(model, pressures, [&](const ProgressReport&) { return ++told <= last; });
    CHECK(stopped.samples.size() == 1);
    CHECK(told == last + 1);
  }
  const auto stop = [](const ProgressReport&) { return false; };
  CHECK_THROWS_AS(model.solve(0.5, stop), Interrupted);
  CHECK_THROWS_AS(model.contact_of(model.solve(0.5), stop), Interrupted);
  // A function without its own progress argument uses that of the model.
  const InteractingSummits stoppable(summits, soft, square(6), 0, ForceSample::unknown,
                                     SummitShape::circular, {.on_progress = stop});
  CHECK_THROWS_AS(stoppable.at(0.5), Interrupted);
  CHECK_THROWS_AS(stoppable.separation_of(1e-2), Interrupted);
  CHECK(stoppable.solve(0.5, [](const ProgressReport&) { return true; }).converged);
}
