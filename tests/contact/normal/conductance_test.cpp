// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Cholesky>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/normal/conductance.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/normal/punch.hpp>
#include <utility>
#include <vector>

#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;
using std::numbers::pi;

namespace {

/// Conductance of a contact set between two half-spaces in a periodic cell, from the potential
/// problem. The current density i of the cells enters each body, whose potential is
///     V̂ = ρ î/|q|,   ∇²V = 0 below,   −(1/ρ)∂V/∂z = i,   mean zero,
/// by a sum over waves. V of both bodies together is 1 on the set, which is a dense system for the
/// set alone.
double potential_solve(const ContactSet& set, const Grid2D& grid, double resistivity) {
  std::vector<std::pair<Index, Index>> cells;
  for (Index i = 0; i < grid.nx; ++i)
    for (Index j = 0; j < grid.ny; ++j)
      if (set(i, j)) cells.emplace_back(i, j);
  Field potential = Field::Zero(grid.nx, grid.ny);  // for a unit current density in cell (0, 0)
  for (Index a = -(grid.nx - 1) / 2; a <= grid.nx / 2; ++a)
    for (Index b = -(grid.ny - 1) / 2; b <= grid.ny / 2; ++b) {
      if (a == 0 && b == 0) continue;
      const double wave =
          2 * pi * std::hypot(static_cast<double>(a) / grid.lx, static_cast<double>(b) / grid.ly);
      for (Index i = 0; i < grid.nx; ++i)
        for (Index j = 0; j < grid.ny; ++j)
          potential(i, j) += resistivity / wave / static_cast<double>(grid.points()) *
                             std::cos(2 * pi *
                                      (static_cast<double>(a * i) / static_cast<double>(grid.nx) +
                                       static_cast<double>(b * j) / static_cast<double>(grid.ny)));
    }
  const auto count = static_cast<Index>(cells.size());
  Eigen::MatrixXd matrix(count, count);
  for (Index m = 0; m < count; ++m)
    for (Index n = 0; n < count; ++n) {
      const auto [i, j] = cells[static_cast<std::size_t>(m)];
      const auto [k, l] = cells[static_cast<std::size_t>(n)];
      matrix(m, n) = potential((i - k + grid.nx) % grid.nx, (j - l + grid.ny) % grid.ny);
    }
  return matrix.ldlt().solve(Eigen::VectorXd::Ones(count)).sum() * grid.cell_area();
}

}  // namespace

TEST_CASE("The conductance by the stiffness is that of a potential solve on the contact set",
          "[conductance]") {
  const Grid2D grid{32, 24, 1e-3, 8e-4};
  constexpr double modulus = 2e9, first = 3e-8, second = 5e-7;
  const double part = GENERATE(0.02, 0.1);
  const NormalContactState state =
      press(rough_surface(grid), modulus, at_pressure(part * 0.1 * modulus));
  REQUIRE(state.converged());
  const ContactSet set = contact_set(state);
  // Two bodies have the potential of one body with the sum of their resistivities.
  const double expected = potential_solve(set, grid, first + second);
  // The stiffness is an extremum, so its error is of the order of the square of the tolerance.
  const PunchStiffness punch = punch_stiffness(set, grid, modulus, {.tolerance = 1e-7});
  REQUIRE(punch.converged());
  CHECK(electrical_conductance(punch.normal_stiffness, modulus, first, second) ==
        Approx(expected).epsilon(1e-8));
  CHECK(thermal_conductance(punch.normal_stiffness, modulus, 1 / second, 1 / first) ==
        Approx(expected).epsilon(1e-8));
}

TEST_CASE("A circular spot conducts as Holm's", "[conductance]") {
  // A circular punch, K = 2E*a, has C = 4a/(ρ_1 + ρ_2), which is 2a/ρ for equal bodies.
  constexpr double radius = 3e-6, modulus = 1e11, resistivity = 1.7e-8;
  const double stiffness = 2 * modulus * radius;
  CHECK(electrical_conductance(stiffness, modulus, resistivity, resistivity) ==
        Approx(2 * radius / resistivity));
  CHECK(electrical_conductance(stiffness, modulus, resistivity, 0) ==
        Approx(4 * radius / resistivity));
  CHECK(thermal_conductance(stiffness, modulus, 400, std::numeric_limits<double>::infinity()) ==
        Approx(4 * radius * 400));
  CHECK(std::isinf(thermal_conductance(std::numeric_limits<double>::infinity(), modulus, 1, 1)));
  CHECK(std::isnan(thermal_conductance(std::numeric_limits<double>::quiet_NaN(), modulus, 1, 1)));

  CHECK_THROWS_AS(electrical_conductance(-1, modulus, 1, 1), InvalidInput);
  CHECK_THROWS_AS(electrical_conductance(1, 0, 1, 1), InvalidInput);
  CHECK_THROWS_AS(electrical_conductance(1, modulus, 0, 0), InvalidInput);
  CHECK_THROWS_AS(electrical_conductance(1, modulus, 1, -1), InvalidInput);
  CHECK_THROWS_AS(thermal_conductance(1, modulus, 0, 1), InvalidInput);
  constexpr double perfect = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(thermal_conductance(1, modulus, perfect, perfect), InvalidInput);
}
