// SPDX-License-Identifier: GPL-3.0-or-later
// Tangential stiffness and loss in a chosen direction, on surfaces with and without a lay.
#include <Eigen/Cholesky>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <vector>

#include "../contact/normal/rough_surface.hpp"
#include "surface/refine.hpp"

using namespace salebra;
using namespace salebra::test;

namespace {

constexpr double pi = std::numbers::pi, modulus = 1e9, slope = 0.1;

Material material_of(double poisson) { return Material::of_contact_modulus(modulus, poisson); }

/// A rough surface that is stretched along x: its lay is along x. The grid has square cells, since a
/// surface of n × stretch·n of them is drawn on cells that are shorter along x and then stretched.
Surface ground_surface(Index n, Index stretch, std::uint64_t seed = 1) {
  Surface surface = rough_surface({n, n, 1e-3, 1e-3}, {.rms_slope = slope, .seed = seed});
  const Surface whole = surface;
  surface.grid.nx = n * stretch;
  surface.grid.lx = 1e-3 * double(stretch);
  surface.heights = Field(surface.grid.nx, n);
  // Fourier interpolation along x, wave by wave: each wave along x keeps its number of periods.
  std::vector<double> weights(static_cast<std::size_t>(surface.grid.nx));
  for (Index d = 0; d < surface.grid.nx; ++d) {
    // Dirichlet kernel of n waves, at a distance of d/stretch cells.
    const double x = pi * double(d) / double(stretch);
    double sum = 1 + std::cos(x);
    for (Index k = 1; k < n / 2; ++k) sum += 2 * std::cos(2 * x * double(k) / double(n));
    weights[static_cast<std::size_t>(d)] = sum / double(n);
  }
  for (Index i = 0; i < surface.grid.nx; ++i) {
    Eigen::ArrayXd row = Eigen::ArrayXd::Zero(n);
    for (Index j = 0; j < n; ++j) {
      const Index distance =
          (i - j * stretch % surface.grid.nx + surface.grid.nx) % surface.grid.nx;
      row += weights[static_cast<std::size_t>(distance)] * whole.heights.row(j).transpose();
    }
    surface.heights.row(i) = row.transpose();
  }
  return surface;
}

Surface transposed(const Surface& surface) {
  const Grid2D& g = surface.grid;
  return {{g.ny, g.nx, g.ly, g.lx}, surface.heights.transpose(), surface.periodic, "transposed"};
}

/// K_t over (G*/E*)K in two directions at one pressure.
std::array<double, 2> ratios(const Surface& surface, const Material& material, double pressure,
                             double first, double second) {
  const auto curves =
      sweep_directions(surface, material, {pressure}, {first, second}, {.stick = true});
  std::array<double, 2> found{};
  for (std::size_t k = 0; k < 2; ++k) {
    const ForceSample& sample = curves[k].samples[0];
    REQUIRE(sample.converged);
    found[k] = sample.tangential_stiffness / (material.modulus_ratio() * sample.normal_stiffness);
  }
  return found;
}

/// K_t in a direction by a dense matrix of all tractions of the set, from the response in Fourier
/// space that the header states.
double dense_stiffness(const ContactSet& contact, const Grid2D& grid, double poisson,
                       double angle) {
  const double shear = modulus * (1 - poisson) / 2;
  std::vector<std::pair<Index, Index>> cells;
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j)
      if (contact(i, j)) cells.emplace_back(i, j);
  // Displacements of all cells by a unit traction on one, by the sum over all waves. On an even grid
  // the wave n/2 is its own opposite, so that q_x q_y has no sign there and its mean is 0.
  Field xx = Field::Zero(grid.nx, grid.ny), yy = xx, xy = xx;
  for (Index a = 0; a < grid.nx; ++a)
    for (Index b = 0; b < grid.ny; ++b) {
      if (a == 0 && b == 0) continue;
      const double qx = 2 * pi * double(2 * a > grid.nx ? a - grid.nx : a) / grid.lx;
      const double qy = 2 * pi * double(2 * b > grid.ny ? b - grid.ny : b) / grid.ly;
      const double q = std::hypot(qx, qy), scale = 1 / (shear * q * double(grid.points()));
      const bool own = 2 * a == grid.nx || 2 * b == grid.ny;
      for (Index i = 0; i < grid.nx; ++i)
        for (Index j = 0; j < grid.ny; ++j) {
          const double wave = std::cos(
              2 * pi * (double(a * i) / double(grid.nx) + double(b * j) / double(grid.ny)));
          xx(i, j) += scale * wave * (1 - poisson * qx * qx / (q * q));
          yy(i, j) += scale * wave * (1 - poisson * qy * qy / (q * q));
          if (!own) xy(i, j) -= scale * wave * poisson * qx * qy / (q * q);
        }
    }
  const auto count = static_cast<Index>(cells.size());
  Eigen::MatrixXd compliance(2 * count, 2 * count);
  for (Index k = 0; k < count; ++k)
    for (Index l = 0; l < count; ++l) {
      const auto [i, j] = cells[static_cast<std::size_t>(k)];
      const auto [m, n] = cells[static_cast<std::size_t>(l)];
      const Index di = (i - m + grid.nx) % grid.nx, dj = (j - n + grid.ny) % grid.ny;
      compliance(k, l) = xx(di, dj);
      compliance(count + k, count + l) = yy(di, dj);
      compliance(k, count + l) = compliance(count + k, l) = xy(di, dj);
    }
  Eigen::VectorXd motion(2 * count);
  motion << Eigen::VectorXd::Constant(count, std::cos(angle)),
      Eigen::VectorXd::Constant(count, std::sin(angle));
  return grid.cell_area() * motion.dot(compliance.ldlt().solve(motion));
}

}  // namespace

TEST_CASE("The stiffness at any angle is that of a dense matrix", "[direction]") {
  const Surface surface = rough_surface({24, 24, 1e-3, 1e-3}, {.rolloff = 2, .cutoff = 6});
  const double poisson = 0.45, angle = GENERATE(0.0, pi / 6, pi / 2, 3 * pi / 4);
  const NormalContactState state = press(surface, modulus, at_pressure(0.04 * slope * modulus));
  const ContactSet contact = contact_set(state);
  const StickStiffness stick =
      stick_stiffness(contact, surface.grid, material_of(poisson), {.tolerance = 1e-8});
  const double dense = dense_stiffness(contact, surface.grid, poisson, angle);
  // K_t is a minimum, so its error is the square of the tolerance.
  CHECK(stick.along(angle) == Approx(dense).epsilon(1e-10));
  const ForceSample sample =
      force_sample(state, surface, material_of(poisson), {.stick = true, .direction = angle});
  CHECK(sample.direction == angle);
  CHECK(sample.tangential_stiffness == Approx(dense).epsilon(1e-5));
}

TEST_CASE("A contact is stiffer across the lay than along it", "[direction]") {
  // Stretch 6: 1.16 and 0.88 at ν = 0.3, 1.30 and 0.83 at ν = 0.45. These limits of single surfaces
  // are within the scatter of a few hundred patches.
  const Surface surface = ground_surface(64, 6);
  const double pressure = 0.05 * slope * modulus;
  const auto [across, along] = ratios(surface, material_of(0.3), pressure, pi / 2, 0);
  CHECK(across == Approx(1.16).margin(0.03));
  CHECK(along == Approx(0.88).margin(0.03));
  const auto [across45, along45] = ratios(surface, material_of(0.45), pressure, pi / 2, 0);
  CHECK(across45 == Approx(1.30).margin(0.05));
  CHECK(along45 == Approx(0.83).margin(0.04));
  // Without Poisson's effect all directions are equal; the tolerance is that of the stick solves.
  const auto [across0, along0] = ratios(surface, material_of(0), pressure, pi / 2, 0);
  CHECK(across0 == Approx(1).epsilon(1e-5));
  CHECK(along0 == Approx(1).epsilon(1e-5));
}

TEST_CASE("The directions of an isotropic surface agree within their scatter", "[direction]") {
  double sum = 0, square = 0;
  constexpr int seeds = 8;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Surface surface = rough_surface({64, 64, 1e-3, 1e-3}, {.rms_slope = slope, .seed = seed});
    const auto [x, y] = ratios(surface, material_of(0.3), 0.05 * slope * modulus, 0, pi / 2);
    sum += std::log(x / y);
    square += std::log(x / y) * std::log(x / y);
  }
  CHECK(std::abs(sum / seeds) < 3 * std::sqrt(square) / seeds);
}

TEST_CASE("Transposing a surface exchanges its directions", "[direction]") {
  const Surface surface = ground_surface(32, 4), turned = transposed(surface);
  const std::vector<double> pressures{0.03 * slope * modulus, 0.05 * slope * modulus};
  const Material material = material_of(0.3);
  const std::vector<double> directions{0, pi / 2}, exchanged{pi / 2, 0};
  const SweepOptions sweep{.stick = true};
  const auto curves = sweep_directions(surface, material, pressures, directions, sweep),
             other = sweep_directions(turned, material, pressures, exchanged, sweep);
  const Drag motion{1e-8, 1e-6, 1e5};
  const auto losses = surface_damping(surface, material, motion, curves),
             turned_losses = surface_damping(turned, material, motion, other);
  for (std::size_t d = 0; d < 2; ++d)
    for (std::size_t k = 0; k < pressures.size(); ++k) {
      // Both grids have the same contacts; the solvers' tolerances remain.
      CHECK(curves[d].samples[k].tangential_stiffness ==
            Approx(other[d].samples[k].tangential_stiffness).epsilon(1e-5));
      CHECK(losses[d][k].direction == directions[d]);
      CHECK(losses[d][k].damping_constant ==
            Approx(turned_losses[d][k].damping_constant).epsilon(1e-4));
    }
  // Both directions have the same contacts, so their ratio has a smaller error than either.
  CHECK(losses[1][1].damping_constant > 1.03 * losses[0][1].damping_constant);
}

TEST_CASE("Two directions of one call are those of two calls", "[direction]") {
  const Surface surface = ground_surface(32, 4);
  const Material material = material_of(0.3);
  const std::vector<double> pressures{0.03 * slope * modulus, 0.05 * slope * modulus};
  // A motion within the contacts, and one that lifts off, which takes another way.
  const Drag motion{GENERATE(1e-8, 4e-6), 1e-6, 1e5};
  const double friction = GENERATE(std::numeric_limits<double>::quiet_NaN(), 0.3);
  const SurfaceDampingOptions options{
      .hold = Hold::force, .friction_coefficient = friction, .excursion = 1e-5};
  const auto curves = sweep_directions(surface, material, pressures, {pi / 2, 0}, {.stick = true});
  const auto both = surface_damping(surface, material, motion, curves, options);
  const auto along = surface_damping(surface, material, motion, curves[1], options);
  const auto across = surface_damping(surface, material, motion, curves[0], options);
  for (std::size_t k = 0; k < pressures.size(); ++k) {
    REQUIRE(both[0][k].converged);
    CHECK(both[0][k].work_per_cycle == across[k].work_per_cycle);
    // Below the oscillation each direction may use contacts of the other.
    CHECK(both[1][k].work_per_cycle == Approx(along[k].work_per_cycle).epsilon(1e-3));
  }
}

TEST_CASE("The loss in a direction is that of the interval quadrature and the simulation",
          "[direction]") {
  const Surface surface = ground_surface(48, 3);
  const Material material = material_of(0.4);
  const double pressure = 0.05 * slope * modulus;
  const EqualFrequency motion{3e-7, 1e-7, pi / 2, 1e5};
  const auto curves = sweep_directions(
      surface, material, {0.8 * pressure, pressure, 1.2 * pressure}, {pi / 2, 0}, {.stick = true});
  const auto losses = surface_damping(surface, material, motion, curves, {.keep_cells = true});
  const ContactSets contacts = boundary_element_contact_sets(surface, modulus);
  const double center = press(surface, modulus, at_pressure(pressure)).indentation;
  double quadrature[2], simulated[2];
  for (std::size_t d = 0; d < 2; ++d) {
    IntervalQuadratureOptions intervals{.intervals = 32, .direction = losses[d][1].direction};
    const IntervalQuadratureResult result =
        interval_quadrature(contacts, surface.grid, material, motion, center, intervals);
    REQUIRE(result.converged());
    CHECK(result.direction == curves[d].direction());
    quadrature[d] = result.work_per_cycle;
    CycleOptions cycle{.steps = 64, .direction = losses[d][1].direction};
    simulated[d] =
        simulate_cycle(contacts, surface.grid, material, trajectory_of(motion, center), cycle)
            .work_per_cycle;
  }
  // Cells enter one at a time, so each loss has an error of some per cent, most of which is the same
  // in both directions.
  const double ratio = losses[0][1].work_per_cycle / losses[1][1].work_per_cycle;
  CAPTURE(losses[0][1].work_per_cycle, losses[0][1].work_per_cycle_error(), quadrature[0],
          simulated[0]);
  CAPTURE(losses[1][1].work_per_cycle, losses[1][1].work_per_cycle_error(), quadrature[1],
          simulated[1]);
  CHECK(ratio > 1.1);
  CHECK(quadrature[0] / quadrature[1] == Approx(ratio).epsilon(0.05));
  CHECK(simulated[0] / simulated[1] == Approx(quadrature[0] / quadrature[1]).epsilon(0.01));
}

TEST_CASE("Beside the edges of plateaus the error knows how cells are interpolated",
          "[direction]") {
  // Heights cut at one level have edges, at which interpolation overshoots: on finer cells the loss
  // is that of another surface. The given cells and the finer ones are both possible surfaces.
  const std::uint64_t seed = GENERATE(1, 2, 3, 4);
  Surface honed = rough_surface({64, 64, 1e-3, 1e-3}, {.rolloff = 4, .cutoff = 6, .seed = seed});
  honed.heights = honed.heights.min(0.3 * rms_height(honed));
  honed.periodic = false;
  const Material material = material_of(0.3);
  const double pressure = 0.03 * slope * modulus;
  const EqualFrequency motion{2e-7, 1e-7, pi / 2, 1e5};
  const ForceCurve curve =
      sweep_pressures(honed, material, {0.8 * pressure, pressure, 1.2 * pressure}, {.stick = true});
  const SurfaceDamping loss = surface_damping(honed, material, motion, curve)[1];
  REQUIRE(loss.converged);
  const double quadrature =
      interval_quadrature(boundary_element_contact_sets(honed, modulus), honed.grid, material,
                          motion, press(honed, modulus, at_pressure(pressure)).indentation,
                          {.intervals = 32})
          .work_per_cycle;
  CAPTURE(seed, loss.work_per_cycle, loss.work_per_cycle_error(), quadrature);
  CHECK(std::abs(loss.work_per_cycle - quadrature) < loss.work_per_cycle_error());
}

TEST_CASE("The loss of a few coarse contacts is within its error of that of finer cells",
          "[direction]") {
  // 24 × 72 cells, of which about 60 enter within the oscillation: the discretisation changes the
  // loss by a tenth, and differently in each direction: on these cells alone, simulation and
  // quadrature agree on a loss that is not that of the surface.
  const std::uint64_t seed = GENERATE(1, 2, 3);
  const bool keep_cells = GENERATE(false, true);
  const Surface surface = ground_surface(24, 3, seed);
  const Material material = material_of(0.4);
  const double pressure = 0.05 * slope * modulus;
  const EqualFrequency motion{3e-7, 1e-7, pi / 2, 1e5};
  const auto curves = sweep_directions(
      surface, material, {0.8 * pressure, pressure, 1.2 * pressure}, {pi / 2, 0}, {.stick = true});
  const auto losses =
      surface_damping(surface, material, motion, curves, {.keep_cells = keep_cells});
  const Surface fine = refined(surface, 4);
  const ContactSets contacts = boundary_element_contact_sets(fine, modulus);
  const double center = press(fine, modulus, at_pressure(pressure)).indentation;
  for (std::size_t d = 0; d < 2; ++d) {
    const double quadrature =
        interval_quadrature(contacts, fine.grid, material, motion, center,
                            {.intervals = 16, .direction = losses[d][1].direction})
            .work_per_cycle;
    CAPTURE(seed, keep_cells, d, losses[d][1].work_per_cycle, losses[d][1].work_per_cycle_error(),
            quadrature);
    CHECK(std::abs(losses[d][1].work_per_cycle - quadrature) < losses[d][1].work_per_cycle_error());
  }
}
