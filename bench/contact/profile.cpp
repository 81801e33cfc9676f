// SPDX-License-Identifier: GPL-3.0-or-later
// contact_profile — where the time of a periodic contact goes.
//
// usage: contact_profile [N [THREADS [LOAD...]]]          default: 2048 1 0.005 0.02 0.1
//
// LOAD is p/(E*·rms slope) on a self-affine surface: H = 0.8, roll-off at 1/8 of the side, shortest
// wave 8 cells, rms slope 0.1. The solver's levels are run one by one as press() runs
// them. A transform takes each row from the tiles and hands it back to them: this counts as part of
// it. What a solve takes beyond its transforms and the multilevel kernel is its other pointwise passes.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <vector>

#include "contact/normal/active_set_cg.hpp"
#include "contact/normal/nested_contact.hpp"

namespace {

using namespace salebra;

double now() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

template <class Body>
double median_seconds(const Body& body) {
  std::vector<double> seconds(5);
  for (double& each : seconds) {
    const double start = now();
    body();
    each = now() - start;
  }
  std::nth_element(seconds.begin(), seconds.begin() + 2, seconds.end());
  return seconds[2];
}

// Seconds of a chain of products in registers on each of the threads. What these lose beside each
// other, as on two hardware threads of one core or on a shared machine, no program can win back.
double register_seconds(int threads) {
  std::vector<double> results(static_cast<std::size_t>(threads));
  return median_seconds([&] {
    parallel::for_slabs(threads, [&](Index begin, Index) {
      std::array<double, 8> chains;
      chains.fill(1.0);
      for (int k = 0; k < 20'000'000; ++k)
        for (double& chain : chains) chain = 0.999 * chain + 0.001;
      results[static_cast<std::size_t>(begin)] = std::accumulate(chains.begin(), chains.end(), 0.0);
    });
    volatile double used = std::accumulate(results.begin(), results.end(), 0.0);
    static_cast<void>(used);
  });
}

struct RowPartition {
  double setup = 0, prolongation = 0, single_pairs = 0, double_pairs = 0, multilevel = 0,
         pointwise = 0;
  double total() const {
    return setup + prolongation + single_pairs + double_pairs + multilevel + pointwise;
  }
};

void profile(const Surface& surface, double load) {
  const Grid2D& physical = surface.grid;
  const double cell = physical.dx(), side = static_cast<double>(physical.nx);
  const Grid2D grid{physical.nx, physical.ny, side, side};
  const double highest = surface.heights.maxCoeff();
  const double rms = std::sqrt((surface.heights - surface.heights.mean()).square().mean());
  const detail::ScaledOperatingPoint target{ControlQuantity::pressure, load * 0.1 * cell};

  RowPartition coarse, fine;
  double start = now();
  const auto levels =
      detail::multigrid_levels(grid, surface.partition(), {surface.heights.data(), highest},
                               Boundary::periodic, std::numeric_limits<int>::max());
  coarse.setup += now() - start;
  Field pressure, gap;
  detail::ActiveSetOutcome outcome;
  double pair = 0;
  for (std::size_t k = levels.size(); k-- > 0;) {
    const detail::MultigridLevel& level = levels[k];
    RowPartition& partition = k == 0 ? fine : coarse;
    start = now();
    Field guess(level.grid.nx, level.grid.ny);
    if (k + 1 == levels.size()) {
      guess.setConstant(target.value);
    } else {
      detail::prolong({levels[k + 1], pressure, gap, outcome.plane_height}, level,
                      Boundary::periodic, 0.6 / cell_compliance(level.grid, 1), guess.data());
    }
    pressure = std::move(guess);
    gap = Field(level.grid.nx, level.grid.ny);
    partition.prolongation += now() - start;

    start = now();
    detail::ActiveSetCg<float> solver(level.grid, 1, Boundary::periodic, level.heights, rms);
    partition.setup += now() - start;
    start = now();
    outcome =
        solver.solve(target, {k == 0 ? 1e-8 : 1e-3, 1000, k == 0}, pressure.data(), gap.data());
    const double solve = now() - start;
    partition.double_pairs += outcome.exact_fft_seconds;
    partition.single_pairs += outcome.fft_seconds - outcome.exact_fft_seconds;
    partition.multilevel += outcome.multilevel_seconds;
    partition.pointwise += solve - outcome.fft_seconds - outcome.multilevel_seconds;
    pair = (outcome.fft_seconds - outcome.exact_fft_seconds) /
           (outcome.fft_count - outcome.exact_fft_count);
  }

  const double total = coarse.total() + fine.total();
  const auto line = [&](const char* name, double seconds) {
    std::printf("  %-44s %8.3f s %5.1f %%\n", name, seconds, 100 * seconds / total);
  };
  std::printf("load %g: %d pairs (%d of them in double), %d iterations, e_c %.1e\n", load,
              outcome.fft_count, outcome.exact_fft_count, outcome.iterations, outcome.residual);
  line("coarser levels, all of it", coarse.total());
  line("prolongation", fine.prolongation);
  line("set-up: plans, symbol, stencil", fine.setup);
  line("transforms in float", fine.single_pairs);
  line("transforms in double", fine.double_pairs);
  line("the multilevel kernel", fine.multilevel);
  line("other pointwise passes", fine.pointwise);
  std::printf("  %-44s %8.3f s\n", "all", total);
  std::printf("  a pair in float takes %.2f ms with the passes that make and take its rows\n",
              1e3 * pair);
  const double cells = static_cast<double>(grid.points()) * outcome.iterations;
  std::printf("  of the cells, %.1f %% are in use in an iteration, and %.1f %% at rest\n",
              100 * outcome.active_cells / cells, 100 * outcome.resting_cells / cells);
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atol(argv[1]) : 2048;
  parallel::set_threads(argc > 2 ? std::atoi(argv[2]) : 1);
  std::vector<double> loads;
  for (int k = 3; k < argc; ++k) loads.push_back(std::atof(argv[k]));
  if (loads.empty()) loads = {0.005, 0.02, 0.1};
  if (n < 64 || loads.front() <= 0) return 2;

  const double cell = 1.0 / static_cast<double>(n);
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = 0.125, .short_cutoff = 8 * cell, .rms_slope = 0.1});
  const Surface surface = exact_rms({n, n, 1, 1}, spectrum, 1, Rms::slope);
  std::printf("%ld x %ld cells, %d thread(s)\n", static_cast<long>(n), static_cast<long>(n),
              parallel::threads());
  if (const int threads = parallel::threads(); threads > 1)
    std::printf("a loop in registers is done %.2f times as often on all threads as on one\n",
                threads * register_seconds(1) / register_seconds(threads));
  for (const double load : loads) profile(surface, load);
}
