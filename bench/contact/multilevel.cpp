// SPDX-License-Identifier: GPL-3.0-or-later
// contact_multilevel — exact transforms, multilevel applications and processor time of contacts that
// iterate on the multilevel kernel, beside those that iterate with transforms.
//
// usage: contact_multilevel [N [SEEDS [REPEATS]]]          default: 512 1 1; one thread
//
// Self-affine surfaces as in contact_profile, with shortest waves of 8 and 2 cells; the free ones
// are N/2 points wide, so that both have the same transform. Each line is the worst of the seeds:
// pairs of transforms of the finest grid to e_c <= 1e-8 by transforms, on the multilevel kernel wherever it
// can be used, and as the solver chooses; the seconds of the first over those of the others (least
// of the repeats, which take turns). `contraction` is that of the error of a punch on the contact's
// cells from one exact residual to the next, to be compared with eps/(1 − eps), which bounds it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <vector>

#include "base/memory.hpp"
#include "contact/normal/active_set_cg.hpp"
#include "contact/normal/nested_contact.hpp"
#include "process_cost.hpp"

namespace {

using namespace salebra;
using detail::MultilevelShare;

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Case {
  Boundary boundary;
  double cutoff, load, hardness;  // load and hardness over E*·(rms slope)
};

struct Solved {
  Field pressure;
  detail::ActiveSetOutcome outcome;
  double seconds = 0;
};

// Surfaces have cells of size 1 here and E* = 1.
Solved solve(const Surface& surface, const Case& c, MultilevelShare share) {
  const double start = bench::cpu_seconds();
  const double rms = std::sqrt((surface.heights - surface.heights.mean()).square().mean());
  const detail::ScaledOperatingPoint target{ControlQuantity::pressure, 0.1 * c.load,
                                            0.1 * c.hardness};
  const auto levels = detail::multigrid_levels(surface.grid, surface.partition(),
                                               {surface.heights.data(), surface.heights.maxCoeff()},
                                               c.boundary, std::numeric_limits<int>::max());
  Solved solved;
  Field gap;
  for (std::size_t k = levels.size(); k-- > 0;) {
    const Grid2D& grid = levels[k].grid;
    Field guess = uninitialised_field(grid.nx, grid.ny);
    if (k + 1 == levels.size()) {
      guess.setConstant(target.value);
    } else {
      detail::prolong({levels[k + 1], solved.pressure, gap, solved.outcome.plane_height}, levels[k],
                      c.boundary, 0.6 / cell_compliance(grid, 1), guess.data());
    }
    solved.pressure = std::move(guess);
    gap = uninitialised_field(grid.nx, grid.ny);
    detail::ActiveSetCg<float> solver(grid, 1, c.boundary, levels[k].heights, rms);
    detail::ActiveSetLimits limits{k == 0 ? 1e-8 : 1e-3, 1000, k == 0};
    limits.multilevel_share = share;
    solved.outcome = solver.solve(target, limits, solved.pressure.data(), gap.data());
  }
  solved.seconds = bench::cpu_seconds() - start;
  return solved;
}

// The error of a punch after one round on the multilevel kernel over that before, in the metric of G.
double contraction(const Surface& surface, const Case& c, const Field& pressure) {
  const auto punch = [&](double relative_gain, MultilevelShare share) {
    detail::PunchLimits limits;
    limits.relative_gain = relative_gain;
    limits.multilevel_share = share;
    limits.round_ends = 1e-8;  // the bound is that of an exact solve within the round
    return detail::ActiveSetCg<float>(surface.grid, 1, c.boundary, {}, 0)
        .punch_load(pressure.data(), 0.1 * c.hardness, limits);
  };
  // A gain of a tenth is reached after one round, whatever the stencils.
  const auto once = punch(0.1, 1.0);
  if (once.multilevel_count == 0) return 0;
  return std::sqrt(std::max(0.0, 1 - once.load / punch(1e-13, 0.0).load));
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atol(argv[1]) : 512;
  const int seeds = argc > 2 ? std::atoi(argv[2]) : 1, repeats = argc > 3 ? std::atoi(argv[3]) : 1;
  if (n < 128 || seeds < 1 || repeats < 1) return 2;
  parallel::set_threads(1);

  std::vector<Case> cases;
  for (const double cutoff : {8.0, 2.0})
    for (const double load : {0.001, 0.005, 0.02, 0.1, 0.3, 0.6, 1.2})
      cases.push_back({Boundary::periodic, cutoff, load, infinite});
  for (const double load : {0.005, 0.02, 0.1, 0.3})
    cases.push_back({Boundary::free, 8, load, infinite});
  for (const double hardness : {0.2, 0.5, 1.0})
    for (const Boundary boundary : {Boundary::periodic, Boundary::free})
      cases.push_back({boundary, 8, 0.02, hardness});

  std::printf("%-9s %-8s %7s %6s %8s  %5s %12s %12s  %7s %7s  %11s %8s\n", "points", "boundary",
              "cut-off", "f", "hardness", "pairs", "on multilevel kernels", "as chosen",
              "multilevel", "chosen", "contraction", "e_c");
  bool all_converged = true;
  for (const Case& c : cases) {
    const Index points = c.boundary == Boundary::free ? n / 2 : n;
    struct Worst {
      int pairs = 0, applications = 0;
      double seconds = 0;
    };
    std::array<Worst, 3> worst;
    double contracted = 0, residual = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      const double cell = 1.0 / static_cast<double>(points);
      const SelfAffineSpectrum spectrum(
          {.hurst = 0.8, .rolloff = 0.125, .short_cutoff = c.cutoff * cell, .rms_slope = 0.1});
      Surface surface =
          exact_rms({points, points, 1, 1}, spectrum, static_cast<std::uint64_t>(seed), Rms::slope);
      surface.heights /= cell;
      surface.grid.lx = surface.grid.ly = static_cast<double>(points);
      // Plans and stencils are made once in a process.
      if (seed == 1) solve(surface, c, 1.0);
      std::array<double, 3> seconds;
      seconds.fill(infinite);
      for (int repeat = 0; repeat < repeats; ++repeat)
        for (std::size_t k = 0; k < 3; ++k) {
          constexpr std::array<MultilevelShare, 3> shares = {0.0, 1.0, std::nullopt};
          const Solved found = solve(surface, c, shares[k]);
          worst[k].pairs = std::max(worst[k].pairs, found.outcome.fft_count);
          worst[k].applications = std::max(worst[k].applications, found.outcome.multilevel_count);
          seconds[k] = std::min(seconds[k], found.seconds);
          residual = std::max(residual, found.outcome.residual);
          all_converged = all_converged && found.outcome.converged();
          if (k == 1 && repeat == 0)
            contracted = std::max(contracted, contraction(surface, c, found.pressure));
        }
      for (std::size_t k = 0; k < 3; ++k) worst[k].seconds += seconds[k];
    }
    std::printf(
        "%4ld^2    %-8s %7g %6g %8g  %5d %5d + %-4d %5d + %-4d  %7.2f %7.2f  %11.4f %8.1e\n",
        static_cast<long>(points), c.boundary == Boundary::free ? "free" : "periodic", c.cutoff,
        c.load, c.hardness, worst[0].pairs, worst[1].pairs, worst[1].applications, worst[2].pairs,
        worst[2].applications, worst[0].seconds / worst[1].seconds,
        worst[0].seconds / worst[2].seconds, contracted, residual);
    std::fflush(stdout);
  }
  for (const Boundary boundary : {Boundary::periodic, Boundary::free}) {
    const Index points = boundary == Boundary::free ? n / 2 : n;
    const Grid2D grid{points, points, static_cast<double>(points), static_cast<double>(points)};
    if (const auto multilevel = detail::MultilevelKernel::make(
            grid, RowPartition(points),
            detail::normal_symbol(grid, 1, boundary, RowPartition(points)), 1, boundary))
      std::printf("%s: %d levels, eps %.4f, eps/(1 - eps) %.4f\n",
                  boundary == Boundary::free ? "free" : "periodic", multilevel->depth(),
                  multilevel->error(), multilevel->error() / (1 - multilevel->error()));
  }
  return all_converged ? 0 : 1;
}
