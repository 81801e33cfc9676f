// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated time, memory and disk space of a study before it runs.
#include "cost.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/study/realisation.hpp>
#include <vector>

#include "base/fft.hpp"
#include "base/memory.hpp"
#include "case_run.hpp"

namespace salebra {
namespace {

// Times and memory per cell of the grid. They were measured on one thread of a server with AVX-512,
// with 24 loads from 5e-4 to 0.2 E*h' (h': rms slope) and surfaces of 256², 512² and 1024² points.
constexpr double stick_per_cell = 0.15e-6;  // s, a stick solve
// The number of iterations grows with this power of the number of cells.
constexpr double growth = 0.15;
// Time of a contact inside the oscillation, which starts from the pressures of the previous one, s.
constexpr double interval_per_cell = 0.15e-6;
constexpr double memory_per_cell = 80;         // bytes, a contact
constexpr double memory_per_cell_stick = 155;  // bytes, a contact with a stick solve
constexpr double memory_of_adhesion = 130;     // bytes, additional for adhesion
// Bytes of each load that wait for the oscillation about it: 6 to 14 measured for 12 to 48 loads of
// 512² points.
constexpr double memory_of_load = 8;
// Number of contacts without adhesion that cost as much as one with adhesion.
constexpr double contacts_of_adhesion = 8;
// Memory of a surface with the transforms that generate it, bytes.
constexpr double surface_per_cell = 24;
constexpr double memory_of_program = 22e6;  // bytes
// Time of a forward and backward transform of 256² points on the server named above, s.
constexpr double reference_transform = 0.39e-3;
// speed-up by each further thread that shares a contact.
constexpr double gain_of_a_thread = 0.75;

/// Time of a forward and backward Fourier transform of 256² points on this machine, s. Returns the
/// shortest of nine times, because other programs only make it longer.
double transform_seconds() {
  constexpr Index n = 256;
  RealFft2D<double> fft(n, n);
  std::vector<double> values(static_cast<std::size_t>(n * n), 0.0);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(n * fft.modes_y()));
  double least = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 9; ++repeat) {
    const auto start = std::chrono::steady_clock::now();
    fft.forward(values.data(), modes.data());
    fft.backward(modes.data(), values.data());
    least = std::min(
        least, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return least;
}

/// Number of contacts solved inside the oscillation for each load, as a mean over the surfaces. A
/// contact on finer or coarser cells counts in proportion to its number of cells.
double intervals_of(const StudyConfiguration& point, const Grid2D& grid) {
  if (point.intervals == 0) return 0;
  const auto of = [&](std::uint64_t seed) {
    const SurfaceDampingOptions options = surface_damping_options(point, grid, seed);
    // Counts the contacts with their stiffnesses, one contact to begin with, and about two to
    // choose the range of indentations. On the first grid, if an error is computed, also three
    // stick solves.
    const double first = options.intervals + 8, others = options.intervals / 2.0 + 5;
    double contacts = options.coarsen           ? first / 4 + others
                      : options.refinements > 0 ? first
                                                : others;
    for (int k = 1; k <= options.refinements; ++k) contacts += others * std::pow(4.6, k);
    return contacts + (options.seam ? others : 0);
  };
  const std::vector<std::uint64_t> seeds = detail::seeds_of(point);
  const auto count = static_cast<double>(seeds.size());
  return (of(seeds.front()) + (count - 1) * of(seeds.back())) / count;
}

PointCost cost_of(const StudyConfiguration& point, double speed) {
  PointCost cost;
  cost.configuration = point;
  cost.surfaces = 1;
  if (const auto* generated = std::get_if<GeneratedSurfaces>(&point.surfaces)) {
    cost.grid = generated->grid;
    cost.surfaces = generated->seeds.size();
    cost.warnings = forecast(cost.grid, *generated->spectrum_of_all()).warnings;
  } else {
    cost.grid = study_surface(point, 0).grid;
  }
  const StudyLoads loads = study_loads(point);
  cost.contact_scale = loads.contact_scale;
  cost.pressures = loads.pressures;
  cost.warnings.insert(cost.warnings.end(), loads.warnings.begin(), loads.warnings.end());
  const bool stick = stick_solves(point);
  const auto cells = static_cast<double>(cost.grid.points());
  cost.intervals = intervals_of(point, cost.grid);
  double per_cell = (stick ? stick_per_cell : 0) + interval_per_cell * cost.intervals;
  for (const StudyModel& model : models_of(point)) per_cell += model.seconds_per_cell;
  if (point.adhesion)
    per_cell += contact_models()[0].seconds_per_cell * contacts_of_adhesion *
                (1 + 2.0 * double(point.adhesion->cycle.size()) / double(cost.pressures.size()));
  cost.seconds = static_cast<double>(cost.surfaces * cost.pressures.size()) * per_cell * cells *
                 std::pow(cells / (512.0 * 512.0), growth) / speed;
  cost.memory = cells * (stick ? memory_per_cell_stick : memory_per_cell);
  if (point.adhesion) cost.memory += cells * memory_of_adhesion;
  return cost;
}

/// Memory in bytes that a computed surface keeps until the result is written: its samples, and for
/// each load the numbers of contact patches by size.
double kept_bytes(const StudyConfiguration& point, const Grid2D& grid) {
  const auto loads = static_cast<double>(point.pressures.size());
  const auto models = static_cast<double>(point.models.size());
  const int sizes = std::bit_width(static_cast<std::uint64_t>(grid.points()));
  return sizeof(Realisation) + models * sizeof(ModelResult) +
         loads * (models * (sizeof(ForceSample) + sizeof(DampingPoint) + 2 * sizeof(double)) +
                  sizeof(SpotStatistics) + sizes * sizeof(double));
}

/// Speed-up by threads if this many contacts can be computed in parallel. If there are fewer
/// contacts than threads, several threads share a contact.
double gain_of(int threads, std::size_t contacts) {
  const double at_once = std::min(static_cast<double>(contacts), static_cast<double>(threads));
  return at_once + gain_of_a_thread * (threads - at_once);
}

ShardPlan plan_of(const StudyCost& cost, std::size_t shards) {
  struct Load {
    std::size_t surfaces = 0, contacts = 0;
    double seconds = 0;
  };
  std::vector<Load> loads(shards);
  std::size_t index = 0;
  for (const PointCost& point : cost.points)
    for (std::size_t i = 0; i < point.surfaces; ++i) {
      Load& load = loads[index++ % shards];
      ++load.surfaces;
      load.contacts += point.pressures.size();
      load.seconds += point.seconds / static_cast<double>(point.surfaces);
    }
  ShardPlan plan{.shards = shards};
  for (const Load& load : loads) {
    plan.surfaces = std::max(plan.surfaces, load.surfaces);
    plan.seconds = std::max(plan.seconds, load.seconds / gain_of(cost.threads, load.contacts));
  }
  for (const PointCost& point : cost.points)
    plan.memory = std::max(
        plan.memory, study_memory(point.configuration, point.grid, cost.threads, plan.surfaces));
  return plan;
}

/// The load p/(E*h'_rms), limited to the range in which time and memory were measured.
double felt(double load) { return std::clamp(load, 1e-3, 0.5); }
// The number of iterations grows with this power of the load.
constexpr double power_of_load = 0.35;

/// Time of one contact, s, on one thread of the server of the constants above, including K and K_t
/// if they are computed. The constants are means over the loads of a study; a solve at 0.0165 E*h'
/// takes this mean time. Without K a solve takes the fraction `without_stiffness` of it.
double contact_seconds(const SurfaceWork& work, double load) {
  constexpr double mean_load = 0.0165, without_stiffness = 0.5;
  const auto cells = static_cast<double>(work.grid.points());
  const double per_cell = contact_models()[std::size_t(ContactModel::bem)].seconds_per_cell *
                              (work.normal_stiffness ? 1.0 : without_stiffness) +
                          (work.tangential_stiffness ? stick_per_cell : 0);
  const double isolated =
      // A free boundary needs transforms of twice the size.
      work.boundary == Boundary::free ? 2.5 : 1;
  return (work.adhesive ? contacts_of_adhesion : 1) * isolated * per_cell * cells *
         std::pow(cells / (512.0 * 512.0), growth) *
         std::pow(felt(load) / mean_load, power_of_load);
}

/// Time that one contact needs for messages between the machines of its group, s. Counts the bytes
/// of the columns of the transforms and the messages of the multilevel kernel (docs/scaling.md).
double network_seconds(const SurfaceWork& work, double load) {
  const double nodes = std::ceil(double(work.nodes) / work.groups),
               ranks = double(work.ranks) / work.groups;
  if (nodes < 2) return 0;
  const auto cells = static_cast<double>(work.grid.points());
  const double bytes = (work.tangential_stiffness ? 580 : 83) * cells;  // bytes of all transforms
  const double transforms = work.tangential_stiffness ? 24 : 8;
  const double applications = 77 * std::sqrt(std::sqrt(cells) / 4096) *
                              std::pow(felt(load) / 0.02, power_of_load) *
                              (work.normal_stiffness ? 1.5 : 1.0);
  const double messages = transforms * 2 * (ranks - 1) + applications * (30 + 3 * std::log2(ranks));
  return (work.adhesive ? contacts_of_adhesion : 1) *
         (bytes / nodes * (1 - 1 / nodes) / Cost::bandwidth + messages * Cost::latency);
}

}  // namespace

double surface_memory(const SurfaceWork& work) {
  // Memory of a process (of_process), and memory per cell (heights and those below), bytes,
  // measured at 1024², 2048² and 4096² points and loads up to half of E*h'
  // (tests/study/cost_test.cpp).
  constexpr double of_process = 33e6, heights = 8;
  const auto cells = static_cast<double>(work.grid.points());
  const int ranks = std::max(1, work.ranks / work.groups);
  const bool together = ranks > 1, isolated = work.boundary == Boundary::free;
  const double mine = cells / ranks;
  // To make a surface, a process needs buffers for the columns that it sends and receives.
  if (work.loads.empty()) return of_process + (heights + (together ? 4.5 : 0)) * mine;
  const double load = felt(std::ranges::max(work.loads));
  const double contact = (work.tangential_stiffness ? 56 + 196 * std::sqrt(load) : 43 + 62 * load) +
                         (together && work.normal_stiffness ? 8 : 0) + (isolated ? 36 : 0) +
                         (work.adhesive ? memory_of_adhesion : 0);
  // Bytes of what each process holds for the whole grid: the coarser levels of the multilevel
  // kernel (free boundary) or the symbols of the compliance (periodic).
  const double whole = together ? (isolated ? 4 : 1.5) * cells : 0;
  // A single process solves one load on each of its threads; several processes solve one at a time.
  const double at_once =
      work.ranks > 1 ? 1 : double(std::min(work.loads.size(), std::size_t(work.threads)));
  return of_process + (heights + at_once * contact) * mine + whole;
}

int groups_that_fit(SurfaceWork work, const std::function<bool(double bytes)>& fits) {
  // Each group solves its loads one after the other, in rounds. Tries one round, then two, and so
  // on. For a number of rounds it takes the smallest number of groups, so that a group has most
  // processes.
  const std::size_t loads = work.loads.size();
  for (std::size_t rounds = 1; rounds < loads; ++rounds) {
    work.groups = static_cast<int>((loads + rounds - 1) / rounds);
    if (work.groups <= work.ranks && fits(surface_memory(work))) return work.groups;
  }
  return 1;
}

Cost estimate_cost(const SurfaceWork& work) {
  require(work.nodes >= 1 && work.nodes <= work.ranks, "nodes", work.nodes,
          "must lie between 1 and the number of processes");
  require(work.groups >= 1 && work.groups <= work.ranks, "groups", work.groups,
          "must lie between 1 and the number of processes");
  Cost cost{{work.ranks, work.nodes, work.groups}, work.threads};
  cost.memory = surface_memory(work);
  cost.available = static_cast<double>(available_memory());
  const double speed = reference_transform / transform_seconds();
  const double ranks = std::max(1, work.ranks / work.groups);
  const double gain = ranks * gain_of(work.threads, 1);
  constexpr double generation_per_cell = 5e-9;  // s, on one thread
  // Time to set up the multilevel kernel, s per cell, for a contact and for its stiffness. It is
  // not divided by the number of processes, since each does all of it.
  const double set_up = ranks > 1 ? (work.normal_stiffness ? 2 : 1) * 3.7e-9 : 0;
  const auto cells = static_cast<double>(work.grid.points());
  // Each group solves its part of the loads. A single process solves one load on each of its
  // threads.
  const double gain_of_loads = work.ranks == 1 ? gain_of(work.threads, work.loads.size()) : gain;
  std::vector<double> of_group(static_cast<std::size_t>(work.groups), 0.0);
  for (const double load : work.loads) {
    auto least = std::ranges::min_element(of_group);
    *least += (contact_seconds(work, load) / gain_of_loads + set_up * cells) / speed;
    cost.network_seconds += network_seconds(work, load) / work.groups;
  }
  cost.seconds = generation_per_cell * cells / speed / gain + std::ranges::max(of_group) +
                 cost.network_seconds;
  return cost;
}

double study_memory(const StudyConfiguration& point, const Grid2D& grid, int threads,
                    std::optional<std::size_t> in_one_process) {
  const auto surfaces =
      static_cast<double>(in_one_process.value_or(detail::seeds_of(point).size()));
  // run_ensembles() holds at most as many surfaces as threads at the same time, and each thread
  // solves a contact of one of them.
  const double open = std::min(surfaces, static_cast<double>(threads));
  const double contacts =
      std::min(surfaces * static_cast<double>(point.pressures.size()), double(threads));
  const double per_contact = (point.adhesion ? memory_of_adhesion : 0) +
                             (stick_solves(point) ? memory_per_cell_stick : memory_per_cell) -
                             surface_per_cell;
  const auto cells = static_cast<double>(grid.points());
  const int halvings =
      surface_damping_options(point, grid, detail::seeds_of(point).front()).refinements;
  const double refined = halvings == 0 ? 0
                                       : std::pow(4.0, halvings) *
                                             (open * surface_per_cell + contacts * memory_per_cell);
  const double waiting = point.intervals == 0 || point.adhesion
                             ? 0
                             : memory_of_load * static_cast<double>(point.pressures.size());
  return memory_of_program +
         cells * (std::max(open * surface_per_cell + contacts * per_contact, refined) +
                  open * waiting) +
         surfaces * kept_bytes(point, grid);
}

std::size_t StudyCost::surfaces() const {
  std::size_t count = 0;
  for (const PointCost& point : points) count += point.surfaces;
  return count;
}

std::size_t StudyCost::contacts() const {
  std::size_t count = 0;
  for (const PointCost& point : points) count += point.surfaces * point.pressures.size();
  return count;
}

SurfaceWork surface_work(const StudyConfiguration& point, const Grid2D& grid,
                         const std::vector<double>& loads, const StudyProcesses& processes) {
  return {.grid = grid,
          .loads = loads,
          .normal_stiffness = true,
          .tangential_stiffness = stick_solves(point),
          .adhesive = point.adhesion.has_value(),
          .ranks = processes.ranks,
          .nodes = processes.nodes,
          .groups = processes.groups,
          .threads = parallel::threads()};
}

namespace {

/// Adds the cost of a point of the parameter grid on several processes: each group computes one
/// surface at a time.
void add_point(StudyCost& cost, const PointCost& own) {
  const StudyProcesses& all = cost;
  std::vector<double> loads;
  for (const double pressure : own.pressures) loads.push_back(pressure / own.contact_scale);
  SurfaceWork work = surface_work(own.configuration, own.grid, loads, all);
  cost.memory =
      std::max(cost.memory, surface_memory(work) + static_cast<double>(own.surfaces) *
                                                       kept_bytes(own.configuration, own.grid));
  work.ranks = std::max(1, all.ranks / all.groups);
  work.nodes = std::max(1, std::min(all.nodes / all.groups, work.ranks));
  work.groups = 1;
  // The contacts inside the oscillation multiply the time and the messages of the sweep of loads.
  const double sweep = contact_models()[std::size_t(ContactModel::bem)].seconds_per_cell +
                       (work.tangential_stiffness ? stick_per_cell : 0);
  const double more = 1 + interval_per_cell * own.intervals / sweep;
  const double rounds =
      std::ceil(static_cast<double>(own.surfaces) / static_cast<double>(all.groups));
  const Cost one = estimate_cost(work);
  cost.seconds += rounds * more * one.seconds;
  cost.network_seconds += rounds * more * one.network_seconds;
}

}  // namespace

StudyCost estimate_cost(const StudyConfiguration& configuration, const StudyProcesses& processes) {
  require(processes.nodes >= 1 && processes.nodes <= processes.ranks, "nodes", processes.nodes,
          "must lie between 1 and the number of processes");
  require(processes.groups >= 1 && processes.groups <= processes.ranks, "groups", processes.groups,
          "must lie between 1 and the number of processes");
  StudyCost cost{{processes, parallel::threads()}, {}};
  cost.available = static_cast<double>(available_memory());
  cost.memory = memory_of_program;
  const double speed = reference_transform / transform_seconds();
  for (StudyConfiguration point : parameter_combinations(configuration)) {
    PointCost own = cost_of(point, speed);
    if (processes.ranks > 1) {
      add_point(cost, own);
    } else {
      cost.seconds += own.seconds / gain_of(cost.threads, own.surfaces * own.pressures.size());
      cost.memory = std::max(cost.memory, study_memory(point, own.grid, cost.threads));
    }
    cost.points.push_back(std::move(own));
  }
  return cost;
}

ShardPlan plan_shards(const StudyCost& cost, double seconds) {
  require_positive(seconds, "shard_seconds");
  // Begins with a lower limit of the number of shards: the work of all threads, divided evenly.
  const std::size_t most = cost.surfaces();
  double work = 0;
  for (const PointCost& point : cost.points) work += point.seconds;
  const double fewest = std::min(work / cost.threads / seconds, static_cast<double>(most));
  std::size_t shards = std::max<std::size_t>(1, static_cast<std::size_t>(fewest));
  ShardPlan plan = plan_of(cost, shards);
  while (plan.seconds > seconds && shards < most) {
    // Increases the number by a hundredth at a time, so that planning stays fast with many
    // surfaces.
    shards = std::min(most, shards + std::max<std::size_t>(1, shards / 100));
    plan = plan_of(cost, shards);
  }
  return plan;
}

}  // namespace salebra
