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

/// Expected work at one point of a study's parameter grid.
struct PointCost {
  StudyConfiguration configuration;  ///< of this point; its lists of varied parameters are empty
  Grid2D grid;
  double contact_scale = 0;       ///< E*h'_rms, Pa
  std::vector<double> pressures;  ///< Pa
  std::size_t surfaces = 0;
  /// Number of contacts inside the oscillation for each load and surface, in units of contacts on
  /// the given cells; without the halvings that a relative error may need beyond the first.
  double intervals = 0;
  double seconds = 0;  ///< on one thread, for all surfaces
  double memory = 0;   ///< needed by one surface, bytes
  /// Warnings of the surface generator about the effect of the grid on the spectrum, and
  /// StudyLoads::warnings.
  std::vector<std::string> warnings;
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

/// Processes that share the work on a study; `groups` is explained at StudyRun::groups.
struct StudyProcesses {
  /// Number of processes, and of machines among which they are divided evenly.
  int ranks = 1, nodes = 1;
  int groups = 1;
};

/// Estimated cost of work on machines like the present one.
struct Cost : StudyProcesses {
  int threads = 1;  ///< per process
  /// Wall time on idle machines; if a precision is requested, the longest possible time.
  double seconds = 0;
  double network_seconds = 0;  ///< part of `seconds` in which machines exchange messages
  double memory = 0;           ///< largest memory of one process, bytes
  double available = 0;        ///< memory of the present machine, bytes; 0 if unknown

  double memory_of_all() const { return memory * ranks; }
  double memory_of_node() const { return memory * std::ceil(double(ranks) / nodes); }

  /// Assumed network between machines: bandwidth in bytes/s (half of a 200 Gb/s adapter), and
  /// latency of a message in s.
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

/// Estimated cost of a study before anything is computed. Its memory is that of the program and of
/// the surfaces that are computed at the same time.
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

/// Largest memory of run_ensembles() at one point of the parameter grid, bytes: the program, the
/// surfaces that are computed at the same time on `threads` threads, and the results of all
/// surfaces. grid: of one surface. surfaces: number that one process computes; empty: all surfaces
/// of the point.
double study_memory(const StudyConfiguration& point, const Grid2D& grid, int threads,
                    std::optional<std::size_t> surfaces = {});

/// Counts the contacts of run_ensembles() and multiplies them by the time of a contact per cell.
/// This time was measured once on a server, for surfaces of 256² to 1024² points and loads up to
/// 0.2 E*h' (h': rms slope). It is scaled by the time of one Fourier transform on the present
/// machine. The estimate agrees within a factor of two for studies, and of three with interacting
/// summits. The cost of several processes is that of estimate_cost(SurfaceWork).
/// throws  as parameter_combinations(), and as readers do for a measured surface, which is read;
///         InvalidInput unless there is at least one process on each machine and in each group
/// cost    some milliseconds, and the time to read a measured surface
StudyCost estimate_cost(const StudyConfiguration& configuration,
                        const StudyProcesses& processes = {});

/// Work on one surface: one or several processes make it and press it.
struct SurfaceWork {
  Grid2D grid;
  std::vector<double> loads;  ///< p/(E*h'_rms) of its contacts; empty: the surface is only made
  /// Compute K; compute K_t by stick solves.
  bool normal_stiffness = false, tangential_stiffness = false;
  bool adhesive = false;
  Boundary boundary = Boundary::periodic;
  /// Number of processes, and of machines among which they are divided evenly.
  int ranks = 1, nodes = 1;
  /// Groups of processes; each group holds the surface and presses some of the loads.
  int groups = 1;
  int threads = 1;  ///< per process
};

/// Estimated cost of work on one surface. The time is that of estimate_cost() of a study, divided
/// evenly among the processes, plus the exchange between machines by the model of docs/scaling.md.
/// The memory follows measurements with one to sixteen processes, accurate to 15 %. Reading and
/// writing files is not included.
/// throws  InvalidInput unless there is at least one process on each machine and in each group
/// cost    some milliseconds
Cost estimate_cost(const SurfaceWork& work);

/// Largest memory of one process, bytes.
double surface_memory(const SurfaceWork& work);

/// The work on one surface of a study. Each group of processes presses all of these loads.
SurfaceWork surface_work(const StudyConfiguration& point, const Grid2D& grid,
                         const std::vector<double>& loads, const StudyProcesses& processes);

/// The largest useful number of groups for which `work` fits into memory. With more groups each
/// group has fewer processes and exchanges less, which saves time since more processes do not
/// exchange faster. fits: returns whether each process may take this many bytes. Returns 1 if
/// nothing fits.
int groups_that_fit(SurfaceWork work, const std::function<bool(double bytes)>& fits);

/// A study divided into shards, each computed by one process with cost.threads threads.
struct ShardPlan {
  std::size_t shards = 1;
  std::size_t surfaces = 0;  ///< number of surfaces of the largest shard
  double seconds = 0;        ///< wall time of the slowest shard on an idle machine
  double memory = 0;         ///< largest memory of a shard, bytes
};

constexpr void describe(auto&& visit, std::type_identity<ShardPlan>) {
  using enum Dimension;
  using S = ShardPlan;
  visit(&S::shards, Quantity{"count", dimensionless, "number of shards"});
  visit(&S::surfaces, Quantity{"surfaces", dimensionless, "number of surfaces"});
  visit(&S::seconds, Quantity{"seconds", Dimension::time, "wall time"});
  visit(&S::memory, Quantity{"memory_bytes", dimensionless, "memory of a shard"});
}

/// The smallest number of shards of which none takes longer than `seconds`. If even shards of one
/// surface take longer, returns one shard per surface.
ShardPlan plan_shards(const StudyCost& cost, double seconds);

}  // namespace salebra
