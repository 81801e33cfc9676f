// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the estimated memory and time of one surface on processes and groups.
#include "study/cost.hpp"

#include <catch2/catch.hpp>
#include <salebra/base/error.hpp>
#include <tuple>

#include "study_text.hpp"

using namespace salebra;

namespace {

SurfaceWork work_of(Index n, std::vector<double> loads, int ranks = 1) {
  return {.grid = {n, n, 1e-5, 1e-5}, .loads = std::move(loads), .ranks = ranks};
}

}  // namespace

TEST_CASE("Estimated memory is what was measured, to 15 %", "[cost]") {
  // Measured peaks of the largest process, MB.
  struct {
    Index n;
    double load;  // 0: generation
    bool normal, tangential;
    int ranks;
    double measured;
  } const runs[]{{2048, 0, false, false, 1, 64},      {2048, 0, false, false, 2, 57},
                 {4096, 0, false, false, 1, 166},     {4096, 0, false, false, 8, 60},
                 {2048, 0.02, false, false, 1, 244},  {2048, 0.1, false, false, 1, 277},
                 {2048, 0.3, false, false, 1, 327},   {2048, 0.02, true, false, 1, 256},
                 {2048, 0.02, true, true, 1, 417},    {2048, 0.1, true, true, 1, 561},
                 {4096, 0.005, false, false, 1, 838}, {4096, 0.02, false, false, 1, 839},
                 {4096, 0.1, false, false, 1, 978},   {4096, 0.02, true, false, 1, 842},
                 {4096, 0.02, true, true, 1, 1534},   {2048, 0.02, false, false, 2, 148},
                 {2048, 0.1, false, false, 2, 159},   {2048, 0.02, true, false, 2, 166},
                 {2048, 0.1, true, true, 2, 315},     {4096, 0.005, false, false, 2, 497},
                 {4096, 0.02, false, false, 2, 497},  {4096, 0.1, false, false, 2, 527},
                 {4096, 0.02, true, false, 2, 544},   {4096, 0.02, true, true, 2, 873},
                 {2048, 0.02, false, false, 4, 97},   {2048, 0.1, true, true, 4, 182},
                 {4096, 0.02, false, false, 8, 173},  {4096, 0.02, false, false, 16, 108}};
  for (const auto& run : runs) {
    INFO(run.n << "², load " << run.load << ", " << run.ranks << " processes");
    SurfaceWork work = work_of(run.n, {}, run.ranks);
    if (run.load > 0) work.loads = {run.load};
    work.normal_stiffness = run.normal;
    work.tangential_stiffness = run.tangential;
    CHECK(surface_memory(work) == Approx(1e6 * run.measured).epsilon(0.15));
  }
  for (const auto& [n, ranks, measured] : {std::tuple(1024, 1, 124),
                                           {1024, 2, 89},
                                           {1024, 4, 64},
                                           {2048, 1, 394},
                                           {2048, 2, 254},
                                           {2048, 4, 148}}) {
    INFO(n << "², isolated, " << ranks << " processes");
    SurfaceWork isolated = work_of(n, {0.02}, ranks);
    isolated.boundary = Boundary::free;
    CHECK(surface_memory(isolated) == Approx(1e6 * measured).epsilon(0.15));
  }
}

TEST_CASE("A process alone takes the memory of a load on each thread, one of many that of one",
          "[cost]") {
  SurfaceWork work = work_of(4096, {0.02, 0.02, 0.02});
  const double one = surface_memory(work);
  work.threads = 2;
  CHECK(surface_memory(work) > 1.7 * one);
  work.threads = 8;  // there are three loads
  CHECK(surface_memory(work) < 3 * one);
  work.ranks = work.groups = 3;
  CHECK(surface_memory(work) == one);
}

TEST_CASE("As many groups as fit, and no more than are of use", "[cost]") {
  const std::vector<double> loads(16, 0.02);
  const SurfaceWork work = work_of(4096, loads, 12);
  const auto any = [](double) { return true; };
  // With 12 processes there are two rounds, for which eight groups are enough.
  CHECK(groups_that_fit(work, any) == 8);
  CHECK(groups_that_fit(work_of(4096, loads, 64), any) == 16);
  CHECK(groups_that_fit(work_of(4096, loads, 1), any) == 1);
  CHECK(groups_that_fit(work_of(4096, {0.02}, 64), any) == 1);
  CHECK(groups_that_fit(work, [](double) { return false; }) == 1);
  // The memory of two processes per group, which allows six groups or fewer.
  SurfaceWork of_two = work;
  of_two.groups = 6;
  const double enough = surface_memory(of_two);
  CHECK(groups_that_fit(work, [&](double bytes) { return bytes <= enough; }) == 6);
}

TEST_CASE("More processes take less time until machines exchange more than they compute",
          "[cost]") {
  const auto seconds = [](int ranks, int nodes, int groups = 1) {
    SurfaceWork work = work_of(16384, std::vector<double>(8, 0.02), ranks);
    work.nodes = nodes;
    work.groups = groups;
    return estimate_cost(work);
  };
  const Cost one = seconds(4, 1), two = seconds(8, 2), many = seconds(64, 16);
  CHECK(one.network_seconds == 0);
  // 40 bytes per cell and contact in six transforms, of which half leave a machine of two.
  const double bytes = 8 * (4 + 2 * 2) * 16384.0 * 16384.0 / 4;
  CHECK(two.network_seconds > 8 * bytes / Cost::bandwidth);
  CHECK(two.network_seconds < 2 * 8 * bytes / Cost::bandwidth);
  CHECK(many.network_seconds < two.network_seconds);
  // Each machine presses its own loads.
  CHECK(seconds(8, 2, 2).network_seconds == 0);
  CHECK_THROWS_AS(seconds(2, 3), InvalidInput);
  CHECK_THROWS_AS(seconds(2, 1, 3), InvalidInput);
}

TEST_CASE("A study over processes takes of each what was measured, and its groups share surfaces",
          "[cost]") {
  // The measured case: one surface of 2048² points, four loads up to 0.1 E*h'.
  StudyConfiguration study = parse_study_configuration(study_text("seed_count = 1", 4), "s.toml");
  auto& surfaces = std::get<GeneratedSurfaces>(study.surfaces);
  surfaces.grid = {2048, 2048, 1e-5, 1e-5};
  surfaces.spectrum.rolloff = 1.25e-6;
  surfaces.spectrum.short_cutoff = 40e-9;
  study.pressures = {2e-3, 1e-2, 5e-2, 0.1};
  for (const auto& [ranks, measured] : {std::pair(2, 324), {4, 187}}) {
    INFO(ranks << " processes");
    CHECK(estimate_cost(study, {.ranks = ranks}).memory == Approx(1e6 * measured).epsilon(0.15));
  }
  surfaces.seeds = {1, 2, 3, 4};
  const StudyCost together = estimate_cost(study, {.ranks = 8}),
                  apart = estimate_cost(study, {.ranks = 8, .groups = 4});
  CHECK(apart.memory > 2 * together.memory);
  CHECK_THROWS_AS(estimate_cost(study, {.ranks = 2, .groups = 3}), InvalidInput);
  CHECK_THROWS_AS(estimate_cost(study, {.ranks = 2, .nodes = 3}), InvalidInput);
}
