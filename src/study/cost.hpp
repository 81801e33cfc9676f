// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <salebra/study/configuration.hpp>
#include <string>
#include <vector>

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
  double levels = 0;
  double seconds = 0;  ///< of one thread, all surfaces
  double memory = 0;   ///< of one surface, bytes
  std::vector<std::string>
      warnings;  ///< of the generator: what the grid does to the spectrum; StudyLoads::doubts
};

/// Processes that share a study, StudyRun::groups.
struct StudyProcesses {
  int ranks = 1, nodes = 1;  ///< and the machines that they share evenly
  int groups = 1;
};

/// What a study would cost on this machine, or on several like it, before anything of it is
/// computed.
struct StudyCost {
  std::vector<PointCost> points;
  StudyProcesses processes;
  int threads = 1;  ///< of each process
  double seconds =
      0;  ///< wall time with these threads on an idle machine; with a precision, the most
  double memory =
      0;  ///< peak of a process, bytes: of the surfaces that are side by side, and of the program
  double available = 0;  ///< memory of the machine, bytes; 0 where it does not say

  std::size_t surfaces() const;
  std::size_t contacts() const;
};

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
  Boundary boundary = Boundary::periodic;
  int ranks = 1, nodes = 1;  ///< processes, and the machines that they share evenly
  int groups = 1;   ///< of processes, each of which holds the surface and presses some of the loads
  int threads = 1;  ///< of each process
};

/// What that would cost on machines like this one.
struct SurfaceCost {
  double seconds = 0;            ///< wall time on idle machines; half to twice as long
  double network_seconds = 0;    ///< of it for what goes from machine to machine
  double memory_of_process = 0;  ///< peak of the one that takes most, bytes; true to 15 %

  static constexpr double bandwidth =
      12.5e9;  ///< assumed between machines, bytes/s: half of an adapter of 200 Gb/s
  static constexpr double latency = 2e-6;  ///< assumed of a message, s
};

/// Time as estimate_cost() of a study has it, shared evenly, with the exchange between machines as
/// docs/scaling.md models it. Memory as it was measured for one to sixteen processes. Neither has
/// the reading and writing of files.
/// throws InvalidInput unless there is at least one process on each machine and in each group
/// cost   some milliseconds
SurfaceCost estimate_cost(const SurfaceWork& work);

/// SurfaceCost::memory_of_process alone.
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

/// The fewest shards none of which takes longer than that; one for each surface where even these
/// do.
ShardPlan plan_shards(const StudyCost& cost, double seconds);

}  // namespace salebra
