// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cstddef>
#include <cstring>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/base/row_partition.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/contact/tangential/stick.hpp>

#include "contact/normal/active_set_cg.hpp"
#include "contact/normal/gradient_projection.hpp"
#include "ranks_in_threads.hpp"
#include "rough_surface.hpp"

// One contact is spread over several processes. Every number has the bits of a single process,
// since sums run over blocks of rows, and transforms over rows and columns, that are the same
// everywhere. Therefore no tolerance is needed.

using namespace salebra;
using salebra::testing::run_ranks;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Surface spread(const Surface& surface, const Communicator& ranks) {
  Surface mine{surface.grid, {}, surface.periodic, surface.origin, ranks};
  const RowPartition rows = mine.partition();
  mine.heights = surface.heights.middleRows(rows.begin(), rows.count());
  return mine;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_rows(const Field& whole, const Field& mine, const RowPartition& rows) {
  return mine.rows() == rows.count() &&
         std::memcmp(whole.data() + rows.begin() * whole.cols(), mine.data(),
                     static_cast<std::size_t>(mine.size()) * sizeof(double)) == 0;
}

void require_same(const NormalContactState& alone, const NormalContactState& together,
                  const RowPartition& rows) {
  if (!together.converged()) throw Error("not converged");
  if (alone.iterations != together.iterations || alone.fft_count != together.fft_count ||
      alone.multilevel_count != together.multilevel_count)
    throw Error("another number of iterations");
  if (!same_bits(alone.mean_pressure, together.mean_pressure) ||
      !same_bits(alone.mean_gap, together.mean_gap) ||
      !same_bits(alone.indentation, together.indentation) ||
      !same_bits(alone.contact_area_fraction, together.contact_area_fraction) ||
      !same_bits(alone.elastic_energy, together.elastic_energy) ||
      !same_bits(alone.residual, together.residual))
    throw Error("other bits of a number");
  if (!same_rows(alone.contact_pressure, together.contact_pressure, rows) ||
      !same_rows(alone.gap, together.gap, rows))
    throw Error("other bits of a field");
}

using Press = std::function<NormalContactState(const Surface&)>;

// Compares the same contact and its stiffness between one process and this many.
void compare(const Surface& surface, const Press& press, const NormalContactOptions& options,
             int ranks) {
  const NormalContactState alone = press(surface);
  REQUIRE(alone.converged());
  Field alone_punch;
  const double alone_stiffness = normal_stiffness(alone, surface.grid, 1, options, &alone_punch);
  run_ranks(ranks, [&](const Communicator& all) {
    const Surface mine = spread(surface, all);
    const NormalContactState together = press(mine);
    require_same(alone, together, mine.partition());
    if (options.boundary == Boundary::free) return;
    Field punch;
    const double stiffness = normal_stiffness(together, surface.grid, 1, options, &punch);
    if (!same_bits(alone_stiffness, stiffness)) throw Error("another stiffness");
    if (!same_rows(alone_punch, punch, mine.partition())) throw Error("other bits of the punch");
  });
}

}  // namespace

TEST_CASE("A contact over processes has the bits of one process", "[spread]") {
  const int ranks = GENERATE(2, 3, 4, 5, 8);
  NormalContactOptions options;
  options.tolerance = 1e-9;
  const auto to_pressure = [&options](double pressure) {
    return [&options, pressure](const Surface& surface) {
      return press(surface, 1, at_pressure(pressure), options);
    };
  };
  SECTION("of a part of the cells from 0.01 to a half") {
    const Surface surface = test::rough_surface({192, 192, 192, 192});
    compare(surface, to_pressure(GENERATE(5e-4, 5e-3, 5e-2)), options, ranks);
  }
  SECTION("on the multilevel kernel") {
    const Surface surface = test::rough_surface({512, 512, 512, 512});
    compare(surface, to_pressure(5e-4), options, ranks);
  }
  SECTION("of odd and unequal sizes, and with more processes than blocks") {
    const auto [nx, ny] =
        GENERATE(std::pair<Index, Index>{96, 50}, std::pair<Index, Index>{101, 64},
                 std::pair<Index, Index>{150, 128}, std::pair<Index, Index>{16, 16});
    const Surface surface = test::rough_surface(
        {nx, ny, static_cast<double>(nx), static_cast<double>(ny)}, {.rolloff = 1, .cutoff = 6});
    compare(surface, to_pressure(5e-3), options, ranks);
  }
  SECTION("nearly full, by its mean gap, of a surface whose coarse grids have another mean") {
    Surface surface = test::rough_surface({192, 192, 192, 192});
    const double rms = test::rms_height(surface);
    for (Index i = 1; i < 192; i += 2) surface.heights.row(i) -= 0.1 * rms;
    const auto to_gap = [&](const Surface& pressed) {
      return press(pressed, 1, at_mean_gap(1e-3 * rms), options);
    };
    compare(surface, to_gap, options, ranks);
  }
  SECTION("with hardness") {
    options.hardness = 0.03;
    compare(test::rough_surface({192, 192, 192, 192}), to_pressure(5e-3), options, ranks);
  }
  SECTION("in double precision") {
    options.precision = Precision::full;
    compare(test::rough_surface({96, 96, 96, 96}), to_pressure(5e-3), options, ranks);
  }
  SECTION("at a given gap and indentation") {
    const Surface surface = test::rough_surface({128, 128, 128, 128});
    const NormalContactState state = press(surface, 1, at_pressure(3e-3), options);
    compare(
        surface,
        [&](const Surface& s) { return press(s, 1, at_mean_gap(state.mean_gap), options); },
        options, ranks);
    compare(
        surface,
        [&](const Surface& s) { return press(s, 1, at_indentation(state.indentation), options); },
        options, ranks);
  }
  SECTION("of an isolated surface") {
    options.boundary = Boundary::free;
    compare(test::rough_surface({150, 128, 150, 128}), to_pressure(5e-3), options, ranks);
  }
  SECTION("from a start that is given") {
    const Surface surface = test::rough_surface({128, 128, 128, 128});
    const Field start = press(surface, 1, at_pressure(2e-3), options).contact_pressure;
    options.initial_pressure = &start;
    const NormalContactState alone = press(surface, 1, at_pressure(3e-3), options);
    run_ranks(ranks, [&](const Communicator& all) {
      const Surface mine = spread(surface, all);
      const RowPartition rows = mine.partition();
      const Field my_start = start.middleRows(rows.begin(), rows.count());
      NormalContactOptions of_mine = options;
      of_mine.initial_pressure = &my_start;
      require_same(alone, press(mine, 1, at_pressure(3e-3), of_mine), rows);
    });
  }
}

TEST_CASE("A contact over processes has the bits of one process for two threads each", "[spread]") {
  const Surface surface = test::rough_surface({192, 192, 192, 192});
  const NormalContactState alone = press(surface, 1, at_pressure(5e-3));
  parallel::set_threads(2);
  run_ranks(GENERATE(1, 2, 3, 4, 5, 8), [&](const Communicator& all) {
    const Surface mine = spread(surface, all);
    require_same(alone, press(mine, 1, at_pressure(5e-3)), mine.partition());
  });
  parallel::set_threads(0);
}

TEST_CASE("The multilevel kernel over processes has the bits of one process", "[spread]") {
  using namespace salebra::detail;
  const auto boundary = GENERATE(Boundary::periodic, Boundary::free);
  const int ranks = GENERATE(2, 3, 5, 8);
  // Processes begin on even and on odd rows of the coarser levels.
  const Index nx = 320, ny = 256;
  const Surface surface = test::rough_surface({nx, ny, double(nx), double(ny)});
  const double highest = surface.heights.maxCoeff();
  const auto solve = [&](const Surface& mine, Field& p, Field& g) {
    p = Field::Constant(mine.heights.rows(), ny, 1e-3);
    g = p;
    ActiveSetCg<float> solver(surface.grid, mine.partition(), 1, boundary,
                              {mine.heights.data(), highest}, 1);
    ActiveSetLimits limits;
    limits.multilevel_share = infinite;
    return solver.solve({ControlQuantity::pressure, 1e-3, infinite}, limits, p.data(), g.data());
  };
  Field p, g;
  const ActiveSetOutcome alone = solve(surface, p, g);
  REQUIRE(alone.converged());
  REQUIRE(alone.multilevel_count > 10);
  run_ranks(ranks, [&](const Communicator& all) {
    const Surface mine = spread(surface, all);
    Field my_p, my_g;
    const ActiveSetOutcome together = solve(mine, my_p, my_g);
    if (alone.multilevel_count != together.multilevel_count ||
        alone.fft_count != together.fft_count)
      throw Error("another number of iterations");
    if (!same_rows(p, my_p, mine.partition()) || !same_rows(g, my_g, mine.partition()))
      throw Error("other bits of a field");
  });
}

TEST_CASE("The slower method that finishes stalled contacts has the bits of one process",
          "[spread]") {
  using namespace salebra::detail;
  const Surface surface = test::rough_surface({96, 64, 96, 64});
  const double bound = GENERATE(infinite, 0.03);
  const ScaledOperatingPoint target{ControlQuantity::pressure, 5e-3, bound};
  const auto solve = [&](const Surface& mine, Field& p, Field& g) {
    const RowPartition rows = mine.partition();
    p = Field::Constant(rows.count(), 64, target.value);
    g = p;
    auto compliance = normal_compliance<double>(
        surface.grid, normal_symbol(surface.grid, 1, Boundary::periodic, rows), rows);
    ActiveSetOutcome outcome;
    gradient_projection(
        {compliance, surface.grid, rows, Boundary::periodic, {mine.heights.data()}, 1, target},
        {.tolerance = 1e-8}, p.data(), g.data(), outcome);
    return outcome;
  };
  Field p, g;
  REQUIRE(solve(surface, p, g).converged());
  const int ranks = GENERATE(2, 5, 8);
  run_ranks(ranks, [&](const Communicator& all) {
    const Surface mine = spread(surface, all);
    Field my_p, my_g;
    if (!solve(mine, my_p, my_g).converged()) throw Error("not converged");
    if (!same_rows(p, my_p, mine.partition()) || !same_rows(g, my_g, mine.partition()))
      throw Error("other bits of a field");
  });
}

TEST_CASE("A force curve with both stiffnesses over processes has the bits of one process",
          "[spread]") {
  const auto boundary = GENERATE(Boundary::periodic, Boundary::free);
  const int ranks = GENERATE(2, 3, 8);
  // The smaller grid has no multilevel kernel, so the stencil preconditions its stick solves.
  const Index n = GENERATE(96, 256);
  const Surface surface = test::rough_surface({n, n, double(n), double(n)});
  const Material material = Material::of_contact_modulus(1, 0.3);
  SweepOptions options;
  options.contact.boundary = boundary;
  options.stick = true;
  const std::vector<double> pressures{1e-3, 4e-3};
  // A single process solves K and K_t of an isolated contact on the cells that it spans, several
  // processes on the whole grid: they agree to the tolerance of 1e-11 of the gain for K, and of the
  // square of 1e-3 for K_t.
  const auto same = [&](double a, double b, double tolerance) {
    return boundary == Boundary::periodic ? same_bits(a, b) : std::abs(a - b) <= tolerance * a;
  };
  const ForceCurve alone = sweep_pressures(surface, material, pressures, options);
  run_ranks(ranks, [&](const Communicator& all) {
    const ForceCurve together = sweep_pressures(spread(surface, all), material, pressures, options);
    if (!same_bits(alone.rms_height, together.rms_height)) throw Error("another rms height");
    for (std::size_t k = 0; k < pressures.size(); ++k) {
      const ForceSample &a = alone.samples[k], &b = together.samples[k];
      if (!b.converged || !same_bits(a.force, b.force) || !same_bits(a.indentation, b.indentation))
        throw Error("another force");
      if (!same(a.normal_stiffness, b.normal_stiffness, 1e-8)) throw Error("another K");
      if (!same(a.tangential_stiffness, b.tangential_stiffness, 1e-5)) throw Error("another K_t");
    }
  });
}

TEST_CASE("A force curve of groups of processes has the bits of one process", "[spread]") {
  const std::pair of_groups = GENERATE(std::pair{2, 2}, std::pair{3, 2}, std::pair{5, 2},
                                       std::pair{5, 5}, std::pair{8, 3}, std::pair{4, 1});
  const int ranks = of_groups.first, count = of_groups.second;
  const Surface surface = test::rough_surface({96, 96, 96, 96});
  const Material material = Material::of_contact_modulus(1, 0.3);
  SweepOptions options;
  options.stick = true;
  // Of five groups one has no load.
  const std::vector<double> pressures{1e-3, 2e-3, 4e-3, 8e-3};
  const ForceCurve alone = sweep_pressures(surface, material, pressures, options);
  // Counts how often each load was solved, and by each group at most.
  std::array<std::atomic<int>, 4> solved{};
  std::vector<std::atomic<int>> loads(static_cast<std::size_t>(count));
  run_ranks(ranks, [&](const Communicator& all) {
    SweepOptions own = options;
    own.groups = Groups(all, count);
    own.on_state = [&](std::size_t k, const NormalContactState&) {
      if (!own.groups->own().is_root()) return;
      ++solved[k];
      ++loads[static_cast<std::size_t>(own.groups->index())];
    };
    const ForceCurve together =
        sweep_pressures(spread(surface, own.groups->own()), material, pressures, own);
    if (!same_bits(alone.rms_height, together.rms_height)) throw Error("another rms height");
    if (together.samples.size() != pressures.size()) throw Error("a load is missing");
    for (std::size_t k = 0; k < pressures.size(); ++k)
      if (std::memcmp(&alone.samples[k], &together.samples[k], offsetof(ForceSample, converged)) !=
          0)
        throw Error("other bits");
  });
  for (const auto& times : solved) CHECK(times == 1);
  const int most = (4 + count - 1) / count;
  for (const auto& of_group : loads) CHECK((of_group >= 4 / count && of_group <= most));
}

TEST_CASE("A sweep that its root stops ends in all processes, within a contact and a stiffness",
          "[spread]") {
  const int groups = GENERATE(1, 2);
  // Progress reports of the first solve come from the contact, later ones from stiffnesses and the
  // next loads.
  const int last = GENERATE(0, 1, 5, 20, 40, 60, 80);
  const Surface surface = test::rough_surface({96, 96, 96, 96});
  const Material material = Material::of_contact_modulus(1, 0.3);
  run_ranks(4, [&](const Communicator& all) {
    SweepOptions options;
    options.stick = true;
    options.groups = Groups(all, groups);
    int reports = 0;
    options.contact.on_progress = [&](const ProgressReport&) {
      return !all.is_root() || reports++ < last;
    };
    const ForceCurve curve = sweep_pressures(spread(surface, options.groups->own()), material,
                                             {1e-3, 2e-3, 4e-3}, options);
    const std::string mine = std::to_string(curve.samples.size());
    for (const std::string& other : all.gather_all(mine))
      if (other != mine) throw Error("another number of samples");
  });
}

TEST_CASE("Groups of processes are at most as many as processes", "[spread]") {
  const int count = GENERATE(0, 4);
  CHECK_THROWS_WITH(run_ranks(3, [&](const Communicator& all) { Groups(all, count); }),
                    Catch::Contains("groups") && Catch::Contains("number of processes"));
}

TEST_CASE("The stiffness of both directions over processes has the bits of one process",
          "[spread]") {
  const Surface surface = test::rough_surface({128, 96, 128, 96});
  const ContactSet contact = contact_set(press(surface, 1, at_pressure(3e-3)));
  const Material material = Material::of_contact_modulus(1, 0.3);
  StickOptions options;
  options.hold_lateral = GENERATE(true, false);
  const StickStiffness alone = stick_stiffness(contact, surface.grid, material, options);
  REQUIRE(alone.converged());
  run_ranks(5, [&](const Communicator& all) {
    const RowPartition rows(all, 128);
    const ContactSet mine = contact.middleRows(rows.begin(), rows.count());
    const StickStiffness together =
        stick_stiffness(mine, surface.grid, material, options, false, {}, all);
    if (!same_bits(alone.xx, together.xx) || !same_bits(alone.yy, together.yy) ||
        !same_bits(alone.xy, together.xy))
      throw Error("other bits");
  });
}

TEST_CASE("A stop and a bad surface in one process end all of them", "[spread]") {
  const Surface surface = test::rough_surface({64, 64, 64, 64});
  run_ranks(3, [&](const Communicator& all) {
    Surface mine = spread(surface, all);
    NormalContactOptions options;
    options.on_progress = [&](const ProgressReport& report) {
      return all.rank() != 1 || report.step < 3;
    };
    if (press(mine, 1, at_pressure(1e-3), options).termination != Termination::interrupted)
      throw Error("not interrupted");
    if (all.rank() == 2) mine.heights(0, 5) = std::nan("");
    try {
      press(mine, 1, at_pressure(1e-3));
      throw Error("no failure");
    } catch (const InvalidInput& error) {
      if (error.field() != "heights") throw Error("another failure");
    }
  });
}

TEST_CASE("A sweep that one process stops ends in all of them with the same loads", "[spread]") {
  const Surface surface = test::rough_surface({64, 64, 64, 64});
  const Material material = Material::of_contact_modulus(1, 0.3);
  SweepOptions options;
  options.stick = true;
  options.concurrent_loads = 1;
  int calls = 0;
  options.contact.on_progress = [&](const ProgressReport&) { return ++calls > 0; };
  const std::vector<double> pressures{1e-3, 2e-3, 4e-3};
  REQUIRE(sweep_pressures(surface, material, pressures, options).samples.size() == 3);
  // The stops lie within a contact, within each of the two stiffness solves, and between two loads;
  // the last call follows the last load.
  for (int stop = 1; stop < calls; stop += 3) {
    CAPTURE(stop, calls);
    std::vector<std::size_t> loads(3);
    run_ranks(3, [&](const Communicator& all) {
      SweepOptions mine = options;
      int call = 0;
      mine.contact.on_progress = [&](const ProgressReport&) {
        return all.rank() != 1 || ++call != stop;
      };
      loads[static_cast<std::size_t>(all.rank())] =
          sweep_pressures(spread(surface, all), material, pressures, mine).samples.size();
    });
    CHECK(loads[0] < 3);
    CHECK(loads[0] == loads[1]);
    CHECK(loads[0] == loads[2]);
  }
}

TEST_CASE("Two hundred faults, each in one process, end all of them alike", "[spread]") {
  const Surface surface = test::rough_surface({64, 64, 64, 64});
  test::Lcg chance(7);
  for (int fault = 0; fault < 200; ++fault) {
    const int ranks = 2 + static_cast<int>(3 * chance.uniform()),
              failing = static_cast<int>(ranks * chance.uniform()),
              kind = static_cast<int>(5 * chance.uniform()),
              step = static_cast<int>(20 * chance.uniform());
    CAPTURE(fault, ranks, failing, kind, step);
    std::vector<std::string> ends(static_cast<std::size_t>(ranks));
    run_ranks(ranks, [&](const Communicator& all) {
      const bool fails = all.rank() == failing;
      Surface mine = spread(surface, all);
      const RowPartition rows = mine.partition();
      Field start = Field::Constant(rows.count(), 64, 1e-3);
      NormalContactOptions options;
      options.tolerance = 1e-12;
      if (kind == 1) options.initial_pressure = &start;
      if (fails && kind == 0 && rows.count() > 0) mine.heights(0, 3) = std::nan("");
      if (fails && kind == 1 && rows.count() > 0) start(0, 3) = -1;
      if (fails && kind == 2) mine.heights.conservativeResize(rows.count() + 1, 64);
      if (kind == 3)
        options.on_progress = [&](const ProgressReport& report) {
          return !fails || report.step < step;
        };
      if (kind == 4) options.on_progress = [&](const ProgressReport&) { return !fails; };
      std::string& end = ends[static_cast<std::size_t>(all.rank())];
      try {
        end = press(mine, 1, at_pressure(1e-3), options).termination == Termination::interrupted
                  ? "interrupted"
                  : "solved";
      } catch (const InvalidInput& error) {
        end = error.field();
      }
    });
    for (const std::string& end : ends) {
      CHECK(end == ends.front());
      CHECK(end != "solved");
    }
  }
}
