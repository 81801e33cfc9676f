// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/distributions.hpp>

#include "ranks_in_threads.hpp"
#include "rough_surface.hpp"

using namespace salebra;
using namespace salebra::test;

namespace {

double integral(const std::vector<double>& density, double width) {
  return std::accumulate(density.begin(), density.end(), 0.0) * width;
}

double first_moment(const std::vector<double>& at, const std::vector<double>& density,
                    double width) {
  return std::inner_product(at.begin(), at.end(), density.begin(), 0.0) * width;
}

}  // namespace

TEST_CASE("Densities of pressure and gap add up to the contact and to what is out of it",
          "[distributions]") {
  const Grid2D grid{64, 64, 1e-3, 1e-3};
  const NormalContactState state = press(rough_surface(grid), 1e9, at_pressure(5e6));
  const int bins = GENERATE(1, 7, 200);
  const ContactDistributions found = contact_distributions(state, grid, bins);
  REQUIRE(found.contact_pressure.size() == static_cast<std::size_t>(bins));
  REQUIRE(found.gap_density.size() == static_cast<std::size_t>(bins));
  CHECK(integral(found.pressure_density, found.pressure_width) ==
        Approx(state.contact_area_fraction).epsilon(1e-12));
  CHECK(integral(found.gap_density, found.gap_width) ==
        Approx(1 - state.contact_area_fraction).epsilon(1e-12));
  // A value lies within half a bin of the middle of its bin, and so does the mean.
  CHECK(
      first_moment(found.contact_pressure, found.pressure_density, found.pressure_width) ==
      Approx(state.mean_pressure).margin(0.5 * found.pressure_width * state.contact_area_fraction));
  CHECK(first_moment(found.gap, found.gap_density, found.gap_width) ==
        Approx(state.mean_gap).margin(0.5 * found.gap_width));
  CHECK(found.contact_pressure.back() + 0.5 * found.pressure_width ==
        Approx(state.contact_pressure.maxCoeff()));
}

TEST_CASE("The pressures of a sphere are distributed as Hertz has it", "[distributions]") {
  // With p = p0 √(1 − r²/a²), P(p) dp = 2πr dr/A = 2πa²/(A p0²) p dp: it rises linearly from 0.
  const Grid2D grid{256, 256, 1e-3, 1e-3};
  constexpr double radius = 1e-2;
  const Surface sphere = surface_of(grid, [&](double x, double y) {
    return -(std::pow(x - 5e-4, 2) + std::pow(y - 5e-4, 2)) / (2 * radius);
  });
  const NormalContactState state = press(sphere, 1e9, at_force(8), {.boundary = Boundary::free});
  REQUIRE(state.converged());
  const double contact_radius = std::cbrt(3 * state.force * radius / (4 * 1e9));
  const double peak = 1.5 * state.force / (std::numbers::pi * std::pow(contact_radius, 2));
  const ContactDistributions found = contact_distributions(state, grid, 5);
  // About 12 500 cells are in contact, whose edge is uncertain by a part of a cell: a hundredth of
  // the density in a bin that holds a tenth of them.
  for (std::size_t bin = 1; bin < 5; ++bin)
    CHECK(found.pressure_density[bin] ==
          Approx(2 * std::numbers::pi * std::pow(contact_radius / peak, 2) / grid.area() *
                 found.contact_pressure[bin])
              .epsilon(0.03));
}

TEST_CASE("Distributions of a contact that is spread have the bits of one process",
          "[distributions][share]") {
  const Grid2D grid{96, 50, 1e-3, 1e-3};
  const NormalContactState whole =
      press(rough_surface(grid), 1e9, at_pressure(5e6), {.tolerance = 1e-6});
  const ContactDistributions alone = contact_distributions(whole, grid);
  std::atomic<int> right = 0;
  salebra::testing::run_ranks(3, [&](const Communicator& ranks) {
    const RowPartition rows(ranks, grid.nx);
    NormalContactState mine = whole;
    mine.contact_pressure = whole.contact_pressure.middleRows(rows.begin(), rows.count());
    mine.gap = whole.gap.middleRows(rows.begin(), rows.count());
    mine.communicator = ranks;
    const ContactDistributions found = contact_distributions(mine, grid);
    right += found.pressure_density == alone.pressure_density &&
             found.gap_density == alone.gap_density && found.gap == alone.gap;
  });
  CHECK(right == 3);
}

TEST_CASE("What is nowhere has no distribution", "[distributions]") {
  const Grid2D grid{8, 8, 1, 1};
  NormalContactState state;
  state.contact_pressure = Field::Constant(8, 8, 2.0);
  state.gap = Field::Zero(8, 8);
  const ContactDistributions full = contact_distributions(state, grid, 4);
  CHECK(full.gap.empty());
  CHECK(integral(full.pressure_density, full.pressure_width) == Approx(1));
  // All pressures are equal to the maximum.
  CHECK(full.pressure_density.back() == Approx(1 / full.pressure_width));
  CHECK_THROWS_AS(contact_distributions(state, grid, 0), InvalidInput);
  CHECK_THROWS_AS(contact_distributions(state, {8, 9, 1, 1}), InvalidInput);
}
