// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated time, memory and disk space of a study before it runs.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <complex>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/base/fft.hpp>
#include <salebra/base/memory.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/study/cost.hpp>
#include <salebra/study/realisation.hpp>
#include <vector>

#include "case_run.hpp"

namespace salebra {
namespace {

// Measured on one thread of a server with AVX-512, 24 loads from 5e-4 to 0.2 E*h', surfaces of 256², 512² and 1024² points.
constexpr double stick_per_cell = 0.15e-6;       // s
constexpr double growth = 0.15;                  // iterations grow with this power of the cells
constexpr double level_per_cell = 0.15e-6;       // s, a contact that starts from its neighbour
constexpr double memory_per_cell = 80;           // bytes
constexpr double memory_per_cell_stick = 155;    // bytes
constexpr double refined_surface_per_cell = 24;  // bytes, with its transforms
constexpr double memory_of_program = 22e6;       // bytes
constexpr double reference_transform = 0.39e-3;  // s, a pair of 256² in double there
constexpr double gain_of_a_thread = 0.75;        // where threads share one surface

/// Shortest of a few: what a busy machine adds is not its speed.
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

/// Contacts inside the oscillation for each load, those of finer and coarser cells by their size; mean over the surfaces.
double levels_of(const StudyConfiguration& point, const Grid2D& grid) {
  if (point.levels == 0) return 0;
  const auto of = [&](std::uint64_t seed) {
    const SurfaceDampingOptions options = surface_damping_options(point, grid, seed);
    // One to begin with, and about two to choose the range.
    const double contacts = options.levels + 2 + (options.choose_levels ? 2 : 0);
    double grids = options.coarsen ? 1.25 : 1;
    for (int k = 1; k <= options.refinements; ++k) grids += std::pow(4.6, k);
    return contacts * (grids + (options.seam ? 1 : 0));
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
    cost.warnings = forecast(cost.grid, SelfAffineSpectrum(generated->spectrum)).warnings;
  } else {
    cost.grid = study_surface(point, 0).grid;
  }
  cost.contact_scale = contact_scale(point);
  cost.pressures = study_pressures(point);
  const bool stick = stick_solves(point);
  const auto cells = static_cast<double>(cost.grid.points());
  cost.levels = levels_of(point, cost.grid);
  double per_cell = (stick ? stick_per_cell : 0) + level_per_cell * cost.levels;
  for (const StudyModel& model : models_of(point)) per_cell += model.seconds_per_cell;
  cost.seconds = static_cast<double>(cost.surfaces * cost.pressures.size()) * per_cell * cells *
                 std::pow(cells / (512.0 * 512.0), growth) / speed;
  cost.memory = cells * (stick ? memory_per_cell_stick : memory_per_cell);
  return cost;
}

/// What is kept of a surface until the result is written: its samples, and the spots of each load by size.
double kept_bytes(const StudyConfiguration& point, const Grid2D& grid) {
  const auto loads = static_cast<double>(point.pressures.size());
  const auto models = static_cast<double>(point.models.size());
  const int sizes = std::bit_width(static_cast<std::uint64_t>(grid.points()));
  return sizeof(Realisation) +
         loads * (models * (sizeof(ForceSample) + sizeof(DampingPoint) + 2 * sizeof(double)) +
                  sizeof(SpotStatistics) + sizes * sizeof(double));
}

/// Of threads over one, where a process has this many surfaces: one on each thread, or all threads on each.
double gain_of(int threads, std::size_t surfaces) {
  const bool side_by_side = surfaces >= static_cast<std::size_t>(threads);
  return side_by_side ? threads : 1 + gain_of_a_thread * (threads - 1);
}

ShardPlan plan_of(const StudyCost& cost, std::size_t shards) {
  struct Load {
    std::size_t surfaces = 0;
    double seconds = 0;
  };
  std::vector<Load> loads(shards);
  std::size_t place = 0;
  for (const PointCost& point : cost.points)
    for (std::size_t i = 0; i < point.surfaces; ++i) {
      Load& load = loads[place++ % shards];
      ++load.surfaces;
      load.seconds += point.seconds / static_cast<double>(point.surfaces);
    }
  ShardPlan plan{.shards = shards};
  for (const Load& load : loads) {
    plan.surfaces = std::max(plan.surfaces, load.surfaces);
    plan.seconds = std::max(plan.seconds, load.seconds / gain_of(cost.threads, load.surfaces));
  }
  for (const PointCost& point : cost.points)
    plan.memory = std::max(
        plan.memory, study_memory(point.configuration, point.grid, cost.threads, plan.surfaces));
  return plan;
}

}  // namespace

double study_memory(const StudyConfiguration& point, const Grid2D& grid, int threads,
                    std::optional<std::size_t> in_one_process) {
  const auto surfaces =
      static_cast<double>(in_one_process.value_or(detail::seeds_of(point).size()));
  // As run_ensembles() does: one surface on each thread where there are enough, else all threads on each.
  const double side_by_side = surfaces >= threads ? threads : 1;
  const double per_cell = stick_solves(point) ? memory_per_cell_stick : memory_per_cell;
  const auto cells = static_cast<double>(grid.points());
  // The refined surface with the contacts of its loads: of one surface on all threads, of several the first on its own.
  const int halvings =
      surface_damping_options(point, grid, detail::seeds_of(point).front()).refinements;
  const double refined =
      halvings == 0
          ? 0
          : std::pow(4.0, halvings) * cells *
                (refined_surface_per_cell + memory_per_cell * (side_by_side > 1 ? 1 : threads));
  return memory_of_program + std::max(side_by_side * per_cell * cells, refined) +
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

StudyCost estimate_cost(const StudyConfiguration& configuration) {
  StudyCost cost;
  cost.threads = parallel::threads();
  cost.available = static_cast<double>(available_memory());
  cost.memory = memory_of_program;
  const double speed = reference_transform / transform_seconds();
  for (StudyConfiguration point : parameter_combinations(configuration)) {
    PointCost own = cost_of(point, speed);
    cost.seconds += own.seconds / gain_of(cost.threads, own.surfaces);
    cost.memory = std::max(cost.memory, study_memory(point, own.grid, cost.threads));
    cost.points.push_back(std::move(own));
  }
  return cost;
}

ShardPlan plan_shards(const StudyCost& cost, double seconds) {
  require_positive(seconds, "shard_seconds");
  // Fewer cannot do: this is the work of all threads, divided evenly.
  const std::size_t most = cost.surfaces();
  double work = 0;
  for (const PointCost& point : cost.points) work += point.seconds;
  const double fewest = std::min(work / cost.threads / seconds, static_cast<double>(most));
  std::size_t shards = std::max<std::size_t>(1, static_cast<std::size_t>(fewest));
  ShardPlan plan = plan_of(cost, shards);
  while (plan.seconds > seconds && shards < most) {
    // By a hundredth at a time, so that planning takes no time with many surfaces.
    shards = std::min(most, shards + std::max<std::size_t>(1, shards / 100));
    plan = plan_of(cost, shards);
  }
  return plan;
}

}  // namespace salebra
