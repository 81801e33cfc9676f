// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <vector>

#include "contact/normal/gradient_projection.hpp"
#include "ranks_in_threads.hpp"
#include "rough_surface.hpp"

using namespace salebra;
using salebra::testing::run_ranks;

namespace {

// A contact, and its pressure after each iteration.
struct Watched {
  NormalContactState state;
  std::vector<Field> pressures;
};

Watched watch(const Surface& surface, double pressure, NormalContactOptions options) {
  Watched watched;
  options.checkpoint_every = 0;
  options.on_checkpoint = [&](const Field& present) { watched.pressures.push_back(present); };
  watched.state = press(surface, 1, at_pressure(pressure), options);
  return watched;
}

}  // namespace

TEST_CASE("Checkpoints change no bit of a contact, and a later one starts from them", "[normal]") {
  NormalContactOptions options;
  Index side = 128;
  double pressure = 5e-3;
  SECTION("by transforms") {}
  SECTION("on the multilevel kernel") {
    side = 512;
    pressure = 5e-4;
  }
  SECTION("in double precision") { options.precision = Precision::full; }
  SECTION("with hardness") { options.hardness = 0.03; }
  SECTION("of an isolated surface") { options.boundary = Boundary::free; }
  const auto length = static_cast<double>(side);
  const Surface surface = test::rough_surface({side, side, length, length});
  const NormalContactState plain = press(surface, 1, at_pressure(pressure), options);
  REQUIRE(plain.converged());
  const Watched watched = watch(surface, pressure, options);
  CHECK(watched.state.iterations == plain.iterations);
  CHECK((watched.state.contact_pressure == plain.contact_pressure).all());
  CHECK((watched.state.gap == plain.gap).all());

  // Coarser grids take no checkpoints.
  REQUIRE(static_cast<int>(watched.pressures.size()) == plain.iterations);
  for (const Field& present : watched.pressures) {
    CHECK((present >= 0 && present <= std::min(1.0, options.hardness * (1 + 1e-14))).all());
    CHECK((present > 0).any());
  }
  // Checkpoints are in Pa, not in the units of the solver: the last one is the result except for
  // the last correction of the load.
  CHECK(watched.pressures.back().mean() == Approx(pressure).epsilon(1e-3));

  // Float, because a file stores float. The residual is an energy of the order of the square of the
  // error, so 1e-10 leaves 1e-5 of the gap.
  const Field start = watched.pressures[watched.pressures.size() / 2].cast<float>().cast<double>();
  options.initial_pressure = &start;
  const NormalContactState continued = press(surface, 1, at_pressure(pressure), options);
  CHECK(continued.converged());
  CHECK(continued.iterations < plain.iterations);
  CHECK(continued.mean_gap == Approx(plain.mean_gap).epsilon(1e-5));
}

TEST_CASE("A checkpoint of processes has the bits of one, when the root's clock says", "[normal]") {
  const Surface surface = test::rough_surface({192, 192, 192, 192});
  const Watched alone = watch(surface, 5e-3, {});
  const int ranks = GENERATE(2, 3, 5);
  const bool by_root = GENERATE(true, false);
  run_ranks(ranks, [&](const Communicator& all) {
    Surface mine{surface.grid, {}, surface.periodic, surface.origin, all};
    const RowPartition rows = mine.partition();
    mine.heights = surface.heights.middleRows(rows.begin(), rows.count());
    std::size_t count = 0;
    NormalContactOptions options;
    options.checkpoint_every = all.is_root() == by_root ? 0 : 1e9;
    options.on_checkpoint = [&](const Field& present) {
      const Field& whole = alone.pressures.at(count++);
      if (!(whole.middleRows(rows.begin(), rows.count()) == present).all())
        throw Error("another pressure");
    };
    press(mine, 1, at_pressure(5e-3), options);
    if (count != (by_root ? alone.pressures.size() : 0)) throw Error("not by the root's clock");
  });
}

TEST_CASE("Gradient projection keeps its bits beside checkpoints too", "[normal]") {
  const Surface surface = test::rough_surface({64, 64, 64, 64});
  auto compliance = normal_compliance<double>(surface.grid, 1, Boundary::periodic);
  const auto solve = [&](const detail::ActiveSetLimits& limits, Field& p) {
    p = Field::Constant(64, 64, 5e-3);
    Field g = p;
    detail::ActiveSetOutcome outcome;
    detail::gradient_projection({compliance,
                                 surface.grid,
                                 RowPartition(64),
                                 Boundary::periodic,
                                 {surface.heights.data()},
                                 1,
                                 {ControlQuantity::pressure, 5e-3}},
                                limits, p.data(), g.data(), outcome);
    return outcome;
  };
  Field plain, watched;
  REQUIRE(solve({.tolerance = 1e-8}, plain).converged());
  int count = 0;
  const detail::ActiveSetLimits limits{.tolerance = 1e-8,
                                       .checkpoint_due = [] { return true; },
                                       .take_checkpoint =
                                           [&] {
                                             ++count;
                                             watched *= 3;  // the callback may change it, for
                                                            // example its units
                                           }};
  REQUIRE(solve(limits, watched).converged());
  CHECK(count > 1);
  CHECK((watched == plain).all());
}

TEST_CASE("A time between checkpoints that is none is refused", "[normal]") {
  const Surface surface = test::rough_surface({16, 16, 16, 16}, {.rolloff = 1, .cutoff = 6});
  const double every = GENERATE(-1.0, std::numeric_limits<double>::quiet_NaN());
  CHECK_THROWS_WITH(press(surface, 1, at_pressure(5e-3), {.checkpoint_every = every}),
                    Catch::Contains("checkpoint_every"));
}
