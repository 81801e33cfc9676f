// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/tangential/partial_slip.hpp>

#include "contact/tangential/disc_problem.hpp"

using namespace salebra;

namespace {

using std::numbers::pi;

constexpr double contact_modulus = 2e9;
constexpr double infinite = std::numeric_limits<double>::infinity();

// Hertz's pressure about a point (0.31, 0.17) of a cell off the middle of the grid.
Field hertz_pressure(const Grid2D& grid, double radius, double peak) {
  Field pressure(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double r = std::hypot((static_cast<double>(ix) - 0.31) * grid.dx() - grid.lx / 2,
                                  (static_cast<double>(iy) - 0.17) * grid.dy() - grid.ly / 2);
      pressure(ix, iy) = peak * std::sqrt(std::max(0.0, 1 - r * r / (radius * radius)));
    }
  return pressure;
}

// Pressures on islands with holes, without any symmetry.
Field island_pressure(const Grid2D& grid, double peak) {
  Field pressure(grid.nx, grid.ny);
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double x = 2 * pi * static_cast<double>(ix) / static_cast<double>(grid.nx);
      const double y = 2 * pi * static_cast<double>(iy) / static_cast<double>(grid.ny);
      pressure(ix, iy) =
          peak * std::max(0.0, std::sin(x + 0.3) * std::cos(2 * y) + 0.7 * std::sin(3 * x - y) +
                                   0.5 * std::cos(5 * x + 4 * y) - 0.6);
    }
  return pressure;
}

TangentialField uniform(const Grid2D& grid, double x, double y) {
  return {Field::Constant(grid.nx, grid.ny, x), Field::Constant(grid.nx, grid.ny, y)};
}

struct Solution {
  TangentialField traction, slip;
  PartialSlipReport report;
};

Solution solve(const Field& limit, const Grid2D& grid, const Material& material,
               const TangentialField& displacement, double scale, const StickOptions& options) {
  PartialSlipSolver solver(grid, material, options);
  Solution solution;
  solution.report = solver.solve(limit, displacement, scale, solution.traction, solution.slip);
  return solution;
}

}  // namespace

TEST_CASE("A sphere that is pushed sideways is Cattaneo's and Mindlin's", "[slip]") {
  // With tractions only along the motion the solution is exact at every Poisson's ratio: F_x = μF[1
  // − (1 − q)^{3/2}], q = G*x/(μE*δ), and the cells within a√(1 − q) stick.
  const double poisson = GENERATE(0.0, 0.3, 0.5), q = GENERATE(0.3, 0.9);
  const double radius = 0.35e-3, indentation = 1.5e-5, friction = 0.4;
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const double force = 4.0 / 3 * contact_modulus * radius * indentation;
  const double move = q * friction * contact_modulus * indentation / material.tangential_modulus;
  struct Error {
    double force, stick_radius;
  };
  const auto error = [&](Index n) {
    const Grid2D grid{n, n, 1e-3, 1e-3};
    const Field limit =
        friction * hertz_pressure(grid, radius, 1.5 * force / (pi * radius * radius));
    const Solution found =
        solve(limit, grid, material, uniform(grid, move, 0), move,
              {.tolerance = 1e-8, .boundary = Boundary::free, .hold_lateral = false});
    REQUIRE(found.report.converged());
    CHECK(found.report.fft_count < 80);  // measured: 40 to 72
    const double stuck = static_cast<double>((limit > 0).count() - found.report.slipping);
    return Error{found.traction.x.sum() * grid.cell_area() /
                         (friction * force * (1 - std::pow(1 - q, 1.5))) -
                     1,
                 std::sqrt(stuck * grid.cell_area() / pi / (1 - q)) / radius - 1};
  };
  const Error coarse = error(32), fine = error(128);
  // Measured at 128²: 1e-6 to 5e-5, and 0.3 to 0.9 % of the stick radius, a third of a cell.
  CHECK(std::abs(fine.force) < 1e-4);
  CHECK(std::abs(fine.force) < std::abs(coarse.force) / 8);
  CHECK(std::abs(fine.stick_radius) < 0.012);
  CHECK(std::abs(fine.stick_radius) < std::abs(coarse.stick_radius) / 2);
}

TEST_CASE("Poisson's ratio turns the direction of slip, and hardly changes the force", "[slip]") {
  // Cattaneo and Mindlin assume that all points slip along the force. At ν > 0 their displacement
  // has another direction.
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const double radius = 0.35e-3, peak = 3e7, friction = 0.4, q = 0.9;
  const Field limit = friction * hertz_pressure(grid, radius, peak);
  const auto turned = [&](double poisson) {
    const Material material = Material::of_contact_modulus(contact_modulus, poisson);
    const double indentation = pi * peak * radius / (2 * contact_modulus);
    const double move = q * friction * contact_modulus * indentation / material.tangential_modulus;
    const StickOptions both{.tolerance = 1e-8, .boundary = Boundary::free};
    StickOptions along = both;
    along.hold_lateral = false;
    const Solution free = solve(limit, grid, material, uniform(grid, move, 0), move, both);
    const Solution straight = solve(limit, grid, material, uniform(grid, move, 0), move, along);
    REQUIRE(free.report.converged());
    REQUIRE(straight.report.converged());
    struct {
      double across, force;
    } result{free.traction.y.abs().maxCoeff() / (friction * peak),
             free.traction.x.sum() / straight.traction.x.sum() - 1};
    return result;
  };
  const auto without = turned(0), with = turned(0.3);
  CHECK(without.across < 1e-6);
  CHECK(with.across == Approx(0.038).margin(0.003));
  CHECK(std::abs(with.force) < 1e-3);
}

TEST_CASE("Partial slip on islands obeys Coulomb's law in every cell", "[slip]") {
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  const double poisson = GENERATE(0.0, 0.5);
  const bool hold_lateral = GENERATE(true, false);
  const Grid2D grid{54, 40, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, poisson);
  const Field limit = island_pressure(grid, 8e7);
  const ContactSet contact = limit > 0;
  // With a history, cells do not start from a common displacement.
  TangentialField displacement = uniform(grid, 1e-6, hold_lateral ? 4e-7 : 0);
  for (Index ix = 0; ix < grid.nx; ++ix) displacement.x.row(ix) += 1e-8 * static_cast<double>(ix);
  const double scale = 1e-6, tolerance = 1e-9;
  const StickOptions options{
      .tolerance = tolerance, .boundary = boundary, .hold_lateral = hold_lateral};
  PartialSlipSolver solver(grid, material, options);
  TangentialField traction, slip;
  const PartialSlipReport report = solver.solve(limit, displacement, scale, traction, slip);
  REQUIRE(report.converged());
  CHECK(report.slipping > 50);
  CHECK(contact.count() - report.slipping > 50);
  const TangentialField moved = solver.displacement(contact, traction, contact);
  // The solver bounds the rms in units of the scale; this test checks each of some 700 cells.
  const double close = 100 * tolerance * scale;
  for (Index ix = 0; ix < grid.nx; ++ix)
    for (Index iy = 0; iy < grid.ny; ++iy) {
      const double tx = traction.x(ix, iy), ty = traction.y(ix, iy), t = std::hypot(tx, ty);
      const double sx = slip.x(ix, iy), sy = slip.y(ix, iy), s = std::hypot(sx, sy);
      CHECK(t <= limit(ix, iy) * (1 + 1e-12));
      if (!contact(ix, iy)) continue;
      CHECK(std::abs(moved.x(ix, iy) + sx - displacement.x(ix, iy)) < close);
      if (hold_lateral) CHECK(std::abs(moved.y(ix, iy) + sy - displacement.y(ix, iy)) < close);
      if (s > close) CHECK(tx * sx + ty * sy > (1 - 1e-4) * limit(ix, iy) * s);
      if (t < 0.999 * limit(ix, iy)) CHECK(s == 0);
    }
}

TEST_CASE("Without a limit it is the stick solve, and far beyond it the whole contact slides",
          "[slip]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  const Field pressure = island_pressure(grid, 8e7);
  const ContactSet contact = pressure > 0;
  const TangentialField displacement = uniform(grid, 1e-6, -3e-7);
  const StickOptions options{.tolerance = 1e-10};
  TangentialField stuck;
  StickSolver stick(grid, material, options);
  REQUIRE(stick.solve(contact, displacement, 1e-6, stuck).converged());
  const Field no_limit = contact.select(Field::Constant(grid.nx, grid.ny, infinite), 0.0);
  const Solution free = solve(no_limit, grid, material, displacement, 1e-6, options);
  REQUIRE(free.report.converged());
  CHECK(free.report.slipping == 0);
  CHECK((free.traction.x - stuck.x).abs().maxCoeff() < 1e-7 * stuck.x.abs().maxCoeff());
  CHECK((free.traction.y - stuck.y).abs().maxCoeff() < 1e-7 * stuck.x.abs().maxCoeff());

  // Motion along (4, 3)/5, a hundred times larger than the stick limit, so that tractions point
  // nearly along it.
  const Solution sliding =
      solve(pressure, grid, material, uniform(grid, 4e-3, 3e-3), 1e-5, options);
  REQUIRE(sliding.report.converged());
  CHECK(sliding.report.slipping == contact.count());
  CHECK(sliding.traction.x.sum() == Approx(0.8 * pressure.sum()).epsilon(1e-4));
  CHECK(sliding.traction.y.sum() == Approx(0.6 * pressure.sum()).epsilon(1e-4));
}

TEST_CASE("The fallback finds the same tractions, and an unfinished solve says so", "[slip]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  const Field limit = island_pressure(grid, 8e7);
  const TangentialField displacement = uniform(grid, 1e-6, 5e-7);
  const ContactSet contact = limit > 0;
  detail::ContactSystem system(grid, material, Boundary::periodic, detail::Traction::tangential,
                               detail::loading_window(contact, grid, Boundary::periodic));
  const detail::PointList points = system.points(contact);
  std::vector<double> limits, targets;
  for (const Index cell : points.cell) limits.push_back(limit.data()[cell]);
  for (const Field* component : {&displacement.x, &displacement.y})
    for (const Index cell : points.cell) targets.push_back(component->data()[cell]);
  // The result must not depend on the units: float has seven digits, but no number as small as
  // 1e-50.
  for (const double unit : {1.0, 1e-50}) {
    std::vector<double> shears(targets), exact(targets.size()), loose(targets.size());
    for (double& shear : shears) shear *= unit;
    system.response().apply(points, shears.data(), points, exact.data());
    system.response().apply_loosely(points, shears.data(), loose.data());
    const double largest = *std::max_element(exact.begin(), exact.end());
    CHECK(largest > 0);
    for (std::size_t i = 0; i < exact.size(); ++i)
      CHECK(std::abs(loose[i] - exact[i]) < detail::SurfaceResponse::loose_error * largest);
  }
  const auto found = [&](bool gradient_only, int max_iterations) {
    detail::DiscProblem problem(system, points, limits, targets, contact_modulus);
    if (gradient_only) problem.use_gradient_steps_only();
    std::vector<double> tractions(targets.size(), 0.0), gradient;
    const PartialSlipReport report = problem.solve(1e-14, max_iterations, {}, tractions, gradient);
    return std::pair(report, tractions);
  };
  const auto [fast, newton] = found(false, 1000);
  const auto [slow, projected] = found(true, 20000);
  REQUIRE(fast.converged());
  REQUIRE(slow.converged());
  CHECK(fast.slipping > 20);
  CHECK(fast.slipping < contact.count() - 20);
  CHECK(fast.iterations < slow.iterations);
  const double peak = *std::max_element(limits.begin(), limits.end());
  for (std::size_t i = 0; i < newton.size(); ++i)
    CHECK(std::abs(newton[i] - projected[i]) < 1e-5 * peak);
  CHECK(found(false, 5).first.termination == Termination::iteration_limit);
  CHECK(found(false, 5).first.residual > 1e-14);
}

TEST_CASE("Cells without a limit only tell where the others take them", "[slip]") {
  const Grid2D grid{27, 20, 1.3e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.4);
  const double scale = 1e-6;
  const StickOptions options{.tolerance = 1e-9};
  detail::TangentialWorkspace workspace(grid, material, options);
  const Field limit = island_pressure(grid, 8e7);
  // Every third column is read too.
  ContactSet wanted = limit > 0;
  for (Index iy = 0; iy < grid.ny; iy += 3) wanted.col(iy) = true;
  detail::ContactSystem& system = workspace.system_for(wanted);
  const detail::PointList points = system.points(wanted);
  const TangentialField target = uniform(grid, 1e-6, 5e-7);
  const std::vector<double> targets = workspace.gather(target, points);
  const auto solved = [&](const std::vector<double>& start, const detail::KnownResponse* known) {
    std::vector<double> tractions = start, slip;
    const PartialSlipReport report =
        detail::solve_discs(workspace, system, points, detail::values_at(limit, points), targets,
                            scale, tractions, slip, known);
    return std::tuple(report, tractions, slip);
  };
  const std::vector<double> nothing(targets.size(), 0.0);
  const auto [report, tractions, slip] = solved(nothing, nullptr);
  REQUIRE(report.converged());

  PartialSlipSolver alone(grid, material, options);
  TangentialField traction, slip_alone;
  const PartialSlipReport same = alone.solve(limit, target, scale, traction, slip_alone);
  CHECK(same.slipping == report.slipping);
  const std::vector<double> expected = workspace.gather(traction, points);
  std::vector<double> displacements(targets.size());
  system.response().apply(points, tractions.data(), points, displacements.data());
  const std::vector<double> limits = detail::values_at(limit, points);
  // Newton steps of both end anywhere within the tolerance of 1e-15 m, which is 1e-9 of the
  // tractions' displacement and about 1e-7 of a single traction.
  for (std::size_t i = 0; i < targets.size(); ++i) {
    CHECK(std::abs(tractions[i] - expected[i]) < 1e-6 * limit.maxCoeff());
    if (limits[i % points.cell.size()] > 0) continue;
    CHECK(tractions[i] == 0);
    CHECK(std::abs(targets[i] - displacements[i] - slip[i]) < 20 * options.tolerance * scale);
  }

  // A known response is only a start. The second one is wrong by a tenth, states this error, and
  // looks like the solution.
  std::vector<double> start = tractions;
  for (double& value : start) value *= 0.9;
  for (const detail::KnownResponse& known : {detail::KnownResponse{tractions, displacements, 0},
                                             detail::KnownResponse{start, targets, 0.1 * scale}}) {
    const auto [again, found, slip_again] = solved(start, &known);
    REQUIRE(again.converged());
    for (std::size_t i = 0; i < found.size(); ++i) {
      CHECK(std::abs(found[i] - tractions[i]) < 1e-6 * limit.maxCoeff());
      CHECK(std::abs(slip_again[i] - slip[i]) < 20 * options.tolerance * scale);
    }
  }
}

TEST_CASE("The residual of a partial-slip solve is in units of the scale", "[slip]") {
  // Without tractions every cell that sticks misses its whole displacement, of length 5e-9 m, which
  // is 1e-3 of the scale. This is within the tolerance, so nothing is solved.
  const Grid2D grid{16, 16, 1e-3, 1e-3};
  const Field pressure = hertz_pressure(grid, 3e-4, 1e6);
  PartialSlipSolver solver(grid, Material::of_contact_modulus(contact_modulus, 0.3),
                           {.tolerance = 1e-2});
  TangentialField traction, slip;
  const PartialSlipReport report =
      solver.solve((pressure > 0).select(Field::Constant(16, 16, infinite), 0.0),
                   uniform(grid, 3e-9, 4e-9), 5e-6, traction, slip);
  CHECK(report.iterations == 0);
  CHECK(report.residual == Approx(1e-3).epsilon(1e-12));
}

TEST_CASE("Bad input of a partial-slip solve is named", "[slip]") {
  const Grid2D grid{8, 8, 1e-3, 1e-3};
  const Material material = Material::of_contact_modulus(contact_modulus, 0.3);
  PartialSlipSolver solver(grid, material);
  TangentialField traction, slip;
  const TangentialField displacement = uniform(grid, 1e-6, 0);
  Field limit = Field::Zero(8, 8);
  CHECK(solver.solve(limit, displacement, 1e-6, traction, slip).converged());
  CHECK(traction.x.abs().maxCoeff() == 0);
  limit(2, 2) = -1;
  CHECK_THROWS_WITH(solver.solve(limit, displacement, 1e-6, traction, slip),
                    Catch::StartsWith("limit: -1"));
  limit.setConstant(1);
  CHECK_THROWS_AS(solver.solve(limit, displacement, 1e-6, traction, slip), InvalidInput);
  limit(0, 0) = 0;
  CHECK_THROWS_WITH(solver.solve(limit, displacement, 0, traction, slip),
                    Catch::StartsWith("scale: 0"));
  CHECK_THROWS_AS(PartialSlipSolver(grid, Material::of_contact_modulus(1e9)), InvalidInput);
}
