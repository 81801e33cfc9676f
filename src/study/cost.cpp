// SPDX-License-Identifier: GPL-3.0-or-later
// Estimated time, memory and disk space of a study before it runs.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <complex>
#include <limits>
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

}  // namespace

double study_memory(const StudyConfiguration& point, const Grid2D& grid, int threads) {
  const auto* generated = std::get_if<GeneratedSurfaces>(&point.surfaces);
  const auto surfaces = static_cast<double>(generated ? generated->seeds.size() : 1);
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
  const auto threads = static_cast<std::size_t>(cost.threads);
  for (StudyConfiguration point : parameter_combinations(configuration)) {
    PointCost own = cost_of(point, speed);
    const bool side_by_side = own.surfaces >= threads;
    const double gain = side_by_side ? cost.threads : 1 + gain_of_a_thread * (cost.threads - 1);
    cost.seconds += own.seconds / gain;
    cost.memory = std::max(cost.memory, study_memory(point, own.grid, cost.threads));
    cost.points.push_back(std::move(own));
  }
  return cost;
}

}  // namespace salebra
