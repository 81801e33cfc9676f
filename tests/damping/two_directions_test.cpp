// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/mdr/mdr.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/trajectory_damping.hpp>

#include "islands.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

const Material material = Material::of_contact_modulus(3e9, 0.3);
constexpr int steps = 24;

// An ellipse that is not along x and not in phase with the normal motion.
double x_at(double t) { return 2e-6 * std::cos(2 * pi * t + 0.7); }
double y_at(double t) { return 3e-6 * std::cos(2 * pi * t - 0.9) + 1e-6 * std::sin(4 * pi * t); }
double indentation_at(double t) { return 0.5 - 0.4 * std::cos(2 * pi * t); }

// Loss of stuck cells in three dimensions on a path in two directions, from the minimum of δ: half
// of the move, the change of the contact set at rest, half of the move.
double simulated_work(const std::function<ContactSet(double)>& set_at, const Grid2D& grid) {
  StickSolver solver(grid, material, {.tolerance = 1e-11});
  const auto zero = [&] {
    return TangentialField{Field::Zero(grid.nx, grid.ny), Field::Zero(grid.nx, grid.ny)};
  };
  ContactSet contact = set_at(indentation_at(0));
  TangentialField displacement = zero(), traction = zero();
  double work = 0;
  const auto move = [&](double from, double to) {
    const double dx = x_at(to) - x_at(from), dy = y_at(to) - y_at(from);
    const double before = traction.x.sum() * dx + traction.y.sum() * dy;
    displacement.x += contact.select(Field::Constant(grid.nx, grid.ny, dx), 0.0);
    displacement.y += contact.select(Field::Constant(grid.nx, grid.ny, dy), 0.0);
    REQUIRE(solver.solve(contact, displacement, 1e-6, traction).converged());
    work += grid.cell_area() * (before + traction.x.sum() * dx + traction.y.sum() * dy) / 2;
  };
  for (int step = 1; step <= steps; ++step) {
    const double from = (step - 1.0) / steps, to = double(step) / steps;
    move(from, (from + to) / 2);
    const ContactSet next = set_at(indentation_at(to));
    const ContactSet staying = contact && next, entering = next && !contact;
    REQUIRE(solver.solve(staying, displacement, 1e-6, traction).converged());
    const TangentialField present = solver.displacement(staying, traction, entering);
    displacement.x = entering.select(present.x, staying.select(displacement.x, 0.0));
    displacement.y = entering.select(present.y, staying.select(displacement.y, 0.0));
    contact = next;
    move((from + to) / 2, to);
  }
  return work;
}

// ½ Σ s·(K_{k+1} − K_k)s: the cells between two sets enter at the middle time, and leave equally
// long before the end. crossed = false omits K_xy, which gives the sum of both directions.
double theorem(const std::function<ContactSet(double)>& set_at, const Grid2D& grid, bool crossed) {
  double sum = 0;
  StickStiffness below;
  for (int k = 0; k <= steps / 2; ++k) {
    const StickStiffness here = stick_stiffness(set_at(indentation_at(double(k) / steps)), grid,
                                                material, {.tolerance = 1e-9});
    if (k > 0) {
      const double middle = (k - 0.5) / steps;
      const double x = x_at(1 - middle) - x_at(middle), y = y_at(1 - middle) - y_at(middle);
      sum += 0.5 * ((here.xx - below.xx) * x * x + (here.yy - below.yy) * y * y);
      if (crossed) sum += (here.xy - below.xy) * x * y;
    }
    below = here;
  }
  return sum;
}

}  // namespace

TEST_CASE("In three dimensions a path in two directions loses by the vector of its stretch",
          "[two-directions]") {
  // With these numbers of cells no island has the height of one of the levels.
  const Grid2D grid{27, 20, 1.3e-3, 1e-3}, square{24, 24, 1e-3, 1e-3};
  const auto islands = [contact_sets = island_contact_sets(grid)](double indentation) {
    return contact_sets(indentation).contact;
  };
  // The solver leaves 1e-11 of the displacement; the theorem itself is exact on any nested sets.
  CHECK(simulated_work(islands, grid) == Approx(theorem(islands, grid, true)).epsilon(1e-7));
  // Islands without symmetry couple both directions.
  CHECK(std::abs(theorem(islands, grid, false) / theorem(islands, grid, true) - 1) > 1e-4);
  // A circle has K_xy = 0, so the loss is the sum of both directions, as for every isotropic K_t.
  const auto circle = [&](double indentation) {
    ContactSet contact(square.nx, square.ny);
    for (Index ix = 0; ix < square.nx; ++ix)
      for (Index iy = 0; iy < square.ny; ++iy)
        contact(ix, iy) = std::hypot(double(ix) - 11.5, double(iy) - 11.5) < 11 * indentation;
    return contact;
  };
  CHECK(simulated_work(circle, square) == Approx(theorem(circle, square, false)).epsilon(1e-7));
}

TEST_CASE("A path in two directions loses the sum of both", "[two-directions]") {
  const IndenterLaw law(paraboloid_profile(5e-3), material);
  SampledMotion path;
  std::vector<double> transverse;
  for (int i = 0; i <= 500; ++i) {
    const double t = i / 500.0;
    path.time.push_back(t);
    path.indentation.push_back(4e-6 * indentation_at(t));
    path.displacement.push_back(x_at(t));
    transverse.push_back(y_at(t));
  }
  SampledMotion across = path;
  across.displacement = transverse;
  const TrajectoryDamping both = trajectory_damping(law, path, transverse);
  const TrajectoryDamping x = trajectory_damping(law, path), y = trajectory_damping(law, across);
  CHECK(both.work_per_cycle == Approx(x.work_per_cycle + y.work_per_cycle).epsilon(1e-12));
  CHECK(both.relaxation_work == both.work_per_cycle);
  CHECK(both.dissipated[200] == Approx(x.dissipated[200] + y.dissipated[200]).epsilon(1e-12));
  CHECK(both.tangential_force == x.tangential_force);
  CHECK(both.transverse_force == y.tangential_force);
  CHECK(x.transverse_force.empty());

  // These numbers do not change when the axes are turned.
  SampledMotion turned = path;
  std::vector<double> turned_transverse = transverse;
  const double c = std::cos(0.4), s = std::sin(0.4);
  for (std::size_t i = 0; i < path.time.size(); ++i) {
    turned.displacement[i] = c * path.displacement[i] - s * transverse[i];
    turned_transverse[i] = s * path.displacement[i] + c * transverse[i];
  }
  const TrajectoryDamping same = trajectory_damping(law, turned, turned_transverse);
  CHECK(same.work_per_cycle == Approx(both.work_per_cycle).epsilon(1e-10));
  CHECK(same.power == Approx(both.power).epsilon(1e-10));
  CHECK(same.damping_constant == Approx(both.damping_constant).epsilon(1e-10));
  CHECK(same.storage_stiffness == Approx(both.storage_stiffness).epsilon(1e-10));
  CHECK(same.loss_factor == Approx(both.loss_factor).epsilon(1e-10));

  transverse.pop_back();
  CHECK_THROWS_WITH(trajectory_damping(law, path, transverse), Catch::Contains("transverse"));
  transverse.push_back(std::nan(""));
  CHECK_THROWS_AS(trajectory_damping(law, path, transverse), InvalidInput);
}
