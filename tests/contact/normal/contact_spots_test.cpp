// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/contact_spots.hpp>
#include <salebra/generators/filtered_noise.hpp>

#include "ranks_in_threads.hpp"

using namespace salebra;

namespace {

/// Draws a spot for each letter; dots are no contact; the pressure is 2 in each contact cell.
Field drawn(const std::vector<std::string>& rows) {
  Field pressure(static_cast<Index>(rows.size()), static_cast<Index>(rows[0].size()));
  for (Index ix = 0; ix < pressure.rows(); ++ix)
    for (Index iy = 0; iy < pressure.cols(); ++iy)
      pressure(ix, iy) =
          rows[static_cast<std::size_t>(ix)][static_cast<std::size_t>(iy)] == '.' ? 0 : 2;
  return pressure;
}

}  // namespace

TEST_CASE("Spots are cells joined by edges, across a periodic border too", "[spots]") {
  const Field pressure = drawn({"a..bb.a",  //
                                "...b...",  //
                                "..c....",  //
                                "a...d.a",  //
                                "a..dd.."});
  const Grid2D grid{5, 7, 10, 7};  // cells of 2 × 1
  const ContactSpots periodic = contact_spots(pressure, grid);
  // Spot a wraps along both axes; d touches b across the border along x.
  REQUIRE(periodic.spots.size() == 3);
  CHECK(periodic.spots[0].area == Approx(12));
  CHECK(periodic.spots[0].force == Approx(24));
  CHECK(periodic.spots[1].area == Approx(10));
  CHECK(periodic.spots[2].area == Approx(2));
  CHECK(periodic.contact_area_fraction == Approx(12.0 / 35));

  const ContactSpots free = contact_spots(pressure, grid, Boundary::free);
  CHECK(free.spots.size() == 7);
  CHECK(free.spots[0].area == Approx(6));
  CHECK(free.perimeter > periodic.perimeter);
}

TEST_CASE("The perimeter runs along cell edges and corrects the area by a share of each",
          "[spots]") {
  const Field pressure = drawn({"......",  //
                                "..aaa.",  //
                                "..aaa.",  //
                                "......"});
  const Grid2D grid{4, 6, 8, 6};  // cells of 2 × 1
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const ContactSpots spots = contact_spots(pressure, grid, boundary);
    CHECK(spots.perimeter == Approx(2 * 3 * 1 + 2 * 2 * 2));
    CHECK(spots.corrected_area_fraction ==
          Approx((6 - 10 * (3.14159265358979 - 1 + 0.69314718055995) / 24) / 24).epsilon(1e-12));
  }
  // A full contact on a free grid ends at the border; on a periodic grid it has no edge.
  const Field full = Field::Constant(4, 6, 1.0);
  CHECK(contact_spots(full, grid, Boundary::free).perimeter == Approx(28));
  CHECK(contact_spots(full, grid).perimeter == 0);
  CHECK(contact_spots(full, grid).spots.size() == 1);
  CHECK(contact_spots(Field::Zero(4, 6), grid).spots.empty());
  CHECK_THROWS_AS(contact_spots(full, {6, 4, 1, 1}), InvalidInput);
}

TEST_CASE("The corrected area of a coarse grid is that of a fine one", "[spots]") {
  // The same surfaces, whose short cut-off is at 8 and at 32 cells.
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 1.0 / 2, .short_cutoff = 8.0 / 64, .rms_slope = 0.1});
  double counted = 0, corrected = 0, exact = 0;
  for (std::uint64_t seed : {1, 2, 3}) {
    const auto spots_of = [&](Index points) {
      const Surface surface = filtered_noise({points, points, 1, 1}, spectrum, seed);
      const NormalContactState state =
          press(surface, 1, at_pressure(0.02 * 0.1), {.tolerance = 1e-8});
      REQUIRE(state.converged());
      return contact_spots(state.contact_pressure, surface.grid);
    };
    const ContactSpots coarse = spots_of(64), fine = spots_of(256);
    counted += coarse.contact_area_fraction;
    corrected += coarse.corrected_area_fraction;
    exact += fine.corrected_area_fraction;
  }
  // The counted area is 10 % too large. The corrected area of 25 contacts of 10 to 50 cells is
  // uncertain by their shapes on the grid: the correction must remove two thirds of the error.
  CHECK(counted > 1.05 * exact);
  CHECK(std::abs(corrected - exact) < (counted - exact) / 3);
}

TEST_CASE("Spots of a pressure that is spread have the bits of one process", "[spots][share]") {
  const Grid2D grid = GENERATE(Grid2D{64, 64, 1, 1}, Grid2D{96, 50, 1.5, 1}, Grid2D{101, 64, 1, 1},
                               Grid2D{16, 16, 1, 1});
  const Boundary boundary = GENERATE(Boundary::periodic, Boundary::free);
  // Contact areas from few cells to so many that the largest spots wind through all rows (0.593
  // percolate).
  const double part = GENERATE(0.1, 0.6, 0.65);
  std::mt19937 engine(static_cast<unsigned>(grid.nx));
  Field pressure(grid.nx, grid.ny);
  for (Index k = 0; k < pressure.size(); ++k) {
    const double chance = static_cast<double>(engine()) / static_cast<double>(std::mt19937::max());
    pressure.data()[k] = chance < part ? 0.1 + chance : 0;
  }
  const ContactSpots alone = contact_spots(pressure, grid, boundary);
  double force = 0;
  for (const ContactSpot& spot : alone.spots) force += spot.force;
  CHECK(force == Approx(pressure.sum() * grid.cell_area()));
  for (const int ranks : {1, 2, 3, 4, 5, 8}) {
    CAPTURE(grid.nx, grid.ny, part, ranks);
    std::atomic<int> right = 0;
    salebra::testing::run_ranks(ranks, [&](const Communicator& together) {
      const RowPartition rows(together, grid.nx);
      const ContactSpots spots =
          contact_spots(pressure.middleRows(rows.begin(), rows.count()), grid, boundary, together);
      right += spots.spots.size() == alone.spots.size() &&
               std::memcmp(spots.spots.data(), alone.spots.data(),
                           spots.spots.size() * sizeof(ContactSpot)) == 0 &&
               spots.contact_area_fraction == alone.contact_area_fraction &&
               spots.perimeter == alone.perimeter &&
               spots.corrected_area_fraction == alone.corrected_area_fraction;
    });
    CHECK(right == ranks);
  }
}
