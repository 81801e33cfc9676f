// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <salebra/study/configuration.hpp>
#include <string>
#include <vector>

#include "results/answer_json.hpp"

namespace salebra {

/// What one point of a study's parameter grid would do.
struct PointCost {
  StudyConfiguration configuration;  ///< its ensemble lists are empty
  Grid2D grid;
  double contact_scale = 0;       ///< E*h'_rms, Pa
  std::vector<double> pressures;  ///< Pa
  std::size_t surfaces = 0;
  /// Contacts inside the oscillation for each load and surface, counted in contacts on the cells as
  /// they are; without the halvings that a relative error may ask for beyond the first.
  double intervals = 0;
  double seconds = 0;  ///< of one thread, all surfaces
  double memory = 0;   ///< of one surface, bytes
  std::vector<std::string>
      warnings;  ///< of the generator: what the grid does to the spectrum; StudyLoads::doubts
};

constexpr void describe(auto&& visit, std::type_identity<PointCost>) {
  using enum Dimension;
  using S = PointCost;
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::grid, Part{"", "points and size of one of them"});
  visit(&S::pressures, Quantity{"pressure", pressure, "nominal pressure"});
  visit(&S::intervals, Quantity{"intervals", dimensionless, "contacts inside the oscillation"});
  visit(&S::seconds, Quantity{"seconds_of_one_thread", Dimension::time, "time of one thread"});
  visit(&S::warnings, Quantity{"warnings", dimensionless, "warnings"});
}

/// Processes that share a study, StudyRun::groups.
struct StudyProcesses {
  int ranks = 1, nodes = 1;  ///< and the machines that they share evenly
  int groups = 1;
};

/// What work would cost on machines like this one.
struct Cost : StudyProcesses {
  int threads = 1;             ///< of each process
  double seconds = 0;          ///< wall time on idle machines; with a precision, the most
  double network_seconds = 0;  ///< of it for what goes from machine to machine
  double memory = 0;           ///< peak of the process that takes most, bytes
  double available = 0;        ///< memory of this machine, bytes; 0 where it does not say

  double memory_of_all() const { return memory * ranks; }
  double memory_of_node() const { return memory * std::ceil(double(ranks) / nodes); }

  /// Assumed between machines, bytes/s, half of an adapter of 200 Gb/s, and of a message, s.
  static constexpr double bandwidth = 12.5e9, latency = 2e-6;
};

constexpr void describe(auto&& visit, std::type_identity<Cost>) {
  using enum Dimension;
  using S = Cost;
  visit(&S::ranks, Quantity{"ranks", dimensionless, "number of processes"});
  visit(&S::nodes, Quantity{"nodes", dimensionless, "number of machines"});
  visit(&S::groups, Quantity{"groups", dimensionless, "number of groups of processes"});
  visit(&S::threads, Quantity{"threads", dimensionless, "threads of each process"});
  visit(&S::seconds, Quantity{"seconds", Dimension::time, "wall time"});
  visit(&S::network_seconds, Quantity{"network_seconds", Dimension::time, "time between machines"});
  visit(&S::memory_of_all, Quantity{"memory_bytes", dimensionless, "memory of all processes"});
  visit(&S::memory_of_node, Quantity{"memory_bytes_of_node", dimensionless, "of each machine"});
  visit(&S::available, Quantity{"available_memory_bytes", dimensionless, "memory that is free"});
}

/// What a study would cost before anything of it is computed: its memory is that of the surfaces
/// that are side by side, and of the program.
struct StudyCost : Cost {
  std::vector<PointCost> points;

  std::size_t surfaces() const;
  std::size_t contacts() const;
};

constexpr void describe(auto&& visit, std::type_identity<StudyCost>) {
  using enum Dimension;
  using S = StudyCost;
  visit(&S::points, Objects{{"points", "each of the parameter grid"}});
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::contacts, Quantity{"contacts", dimensionless, "number of contacts"});
  describe(visit, std::type_identity<Cost>{});
}

/// Peak memory of run_ensembles() at one point of the parameter grid, bytes: the program, the
/// surfaces that are side by side on this many threads, and what is kept of all of them. grid: of
/// one surface. surfaces: that one process computes; empty: all of the point.
double study_memory(const StudyConfiguration& point, const Grid2D& grid, int threads,
                    std::optional<std::size_t> surfaces = {});

/// Counts what run_ensembles() would do, and multiplies it with what a contact costs for each cell:
/// measured once on a server, for surfaces of 256² to 1024² points and loads up to 0.2 E*h', and
/// scaled by how long one Fourier transform takes here. Good to a factor of two for studies, of
/// three with interacting summits. Of several processes as estimate_cost(SurfaceWork) has it.
/// throws  as parameter_combinations(), and as readers do for a measured surface, which is read;
///         InvalidInput unless there is at least one process on each machine and in each group
/// cost    some milliseconds, and the reading of a measured surface
StudyCost estimate_cost(const StudyConfiguration& configuration,
                        const StudyProcesses& processes = {});

/// One surface that one process, or several together, make and press.
struct SurfaceWork {
  Grid2D grid;
  std::vector<double> loads;  ///< of its contacts, p/(E*h'_rms); none: it is made only
  bool normal_stiffness = false, tangential_stiffness = false;  ///< K; K_t by stick solves
  bool adhesive = false;
  Boundary boundary = Boundary::periodic;
  int ranks = 1, nodes = 1;  ///< processes, and the machines that they share evenly
  int groups = 1;   ///< of processes, each of which holds the surface and presses some of the loads
  int threads = 1;  ///< of each process
};

/// Time as estimate_cost() of a study has it, shared evenly, with the exchange between machines as
/// docs/scaling.md models it. Memory as it was measured for one to sixteen processes, true to 15 %.
/// Neither has the reading and writing of files.
/// throws InvalidInput unless there is at least one process on each machine and in each group
/// cost   some milliseconds
Cost estimate_cost(const SurfaceWork& work);

/// Its memory alone.
double surface_memory(const SurfaceWork& work);

/// The contacts of one surface of a study, which each group of processes presses at all of these
/// loads.
SurfaceWork surface_work(const StudyConfiguration& point, const Grid2D& grid,
                         const std::vector<double>& loads, const StudyProcesses& processes);

/// The most groups that are of use, whose surfaces fit into memory: exchange between processes is
/// what does not get faster with more of them. fits: whether each process may take so many bytes. 1
/// where nothing does.
int groups_that_fit(SurfaceWork work, const std::function<bool(double bytes)>& fits);

/// A study divided among processes of cost.threads threads each.
struct ShardPlan {
  std::size_t shards = 1;
  std::size_t surfaces = 0;  ///< of the largest shard
  double seconds = 0;        ///< wall time of the longest shard on an idle machine
  double memory = 0;         ///< peak of a shard, bytes
};

constexpr void describe(auto&& visit, std::type_identity<ShardPlan>) {
  using enum Dimension;
  using S = ShardPlan;
  visit(&S::shards, Quantity{"count", dimensionless, "number of shards"});
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::seconds, Quantity{"seconds", Dimension::time, "wall time"});
  visit(&S::memory, Quantity{"memory_bytes", dimensionless, "memory of a shard"});
}

/// The fewest shards none of which takes longer than that; one for each surface where even these
/// do.
ShardPlan plan_shards(const StudyCost& cost, double seconds);

}  // namespace salebra
