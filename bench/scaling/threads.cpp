// SPDX-License-Identifier: GPL-3.0-or-later
// How the main jobs would scale, on a machine of few cores:  scaling_threads [N [BARRIER_US [THREADS...]]]
// Each job runs with more threads than there are cores. Processor times of all slabs of each
// parallel region are measured and dealt to THREADS (8 16 64) as they would take them; of a loop
// over tasks, the thread that took longest counts. Between regions the job is serial. Critical path
// = serial part + longest threads + BARRIER_US (5) for each region. Assumed: a core for each
// thread, as fast as here with both cores busy, and memory that feeds them all.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <queue>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/cycle.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/areal_parameters.hpp>
#include <salebra/surface/correlation.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <salebra/surface/summits.hpp>
#include <vector>

#include "base/region_report.hpp"
#include "base/task_pool.hpp"

using namespace salebra;

namespace {

struct Path {
  double serial = 0, longest = 0, parallel = 0, last_end = 0;
  long regions = 0;
} path;

/// Seconds until the last of so many threads is done, each of which takes the next part when it is
/// free.
double span_of(std::span<const double> parts, int threads) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free;
  for (int thread = 0; thread < threads; ++thread) free.push(0);
  double last = 0;
  for (const double part : parts) {
    const double end = free.top() + part;
    free.pop();
    free.push(end);
    last = std::max(last, end);
  }
  return last;
}

void hear(double begun, std::span<const double> parts, bool tasks) {
  path.serial += begun - path.last_end;
  path.longest += tasks ? std::ranges::max(parts) : span_of(parts, parallel::threads());
  for (const double part : parts) path.parallel += part;
  ++path.regions;
  path.last_end = detail::thread_seconds();
}

Path measured(const std::function<void()>& job) {
  path = {.last_end = detail::thread_seconds()};
  detail::region_report = hear;
  job();
  detail::region_report = nullptr;
  path.serial += detail::thread_seconds() - path.last_end;
  return path;
}

Surface surface_of(Index n, std::uint64_t seed) {
  const double side = static_cast<double>(n);
  return filtered_noise({n, n, side, side},
                        SelfAffineSpectrum({.hurst = 0.8,
                                            .long_cutoff = side / 4,
                                            .rolloff = side / 4,
                                            .short_cutoff = 8,
                                            .rms_slope = 0.1}),
                        seed);
}

void statistics(const Surface& surface) {
  const PowerSpectrum spectrum = power_spectrum(surface);
  fit_self_affine(spectrum);
  radial_spectrum(spectrum);
  radial_correlation(correlation_map(surface));
  for (const Axis axis : {Axis::x, Axis::y}) {
    profile_psd(surface, axis);
    scale_dependence(surface, axis);
  }
  summit_statistics(find_summits(surface));
  surface_moments(surface);
  areal_parameters(surface);
}

// Its tangential motion is as large as the normal one, which presses the mean contact by a tenth.
void cycle(const Surface& surface, const Material& material, double indentation) {
  CycleOptions options;
  options.steps = 16;
  options.friction_coefficient = 0.3;
  const Oscillation motion = EqualFrequency{.normal_amplitude = 0.1 * indentation,
                                            .tangential_amplitude = 0.1 * indentation,
                                            .phase = 0.8};
  simulate_frictional_cycle(boundary_element_pressures(surface, material.contact_modulus),
                            surface.grid, material, trajectory_of(motion, indentation), options);
}

}  // namespace

int main(int argc, char** argv) {
  const Index n = argc > 1 ? std::atol(argv[1]) : 2048;
  const double barrier = 1e-6 * (argc > 2 ? std::atof(argv[2]) : 5);
  std::vector<int> threads;
  for (int k = 3; k < argc; ++k) threads.push_back(std::atoi(argv[k]));
  if (threads.empty()) threads = {8, 16, 64};
  const Surface surface = surface_of(n, 1);
  std::vector<Surface> small;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) small.push_back(surface_of(n / 4, seed));
  const Material material = Material::of_contact_modulus(1);
  const Material sliding = Material::of_contact_modulus(1, 0.3);
  const double indentation = press(small[0], 1, at_pressure(2e-3)).indentation;
  // Parts of the contact modulus times the slope of 0.1.
  const std::vector<double> pressures{1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
  const std::vector<std::pair<const char*, std::function<void()>>> jobs{
      {"contact", [&] { press(surface, 1, at_pressure(2e-3)); }},
      {"sweeps of 8 surfaces",
       [&] {
         detail::TaskLoop loop({});
         loop.run(8, [&](Index k) {
           sweep_pressures(small[static_cast<std::size_t>(k)], material, pressures);
         });
       }},
      {"cycle with friction", [&] { cycle(small[0], sliding, indentation); }},
      {"statistics", [&] { statistics(surface); }},
      {"generate", [&] { surface_of(n, 2); }}};
  std::printf("%-22s %7s %10s %8s %8s %8s %8s\n", "job", "threads", "one, s", "serial", "path, s",
              "regions", "speed-up");
  for (const auto& [name, job] : jobs) {
    job();  // touches memory and makes plans
    parallel::set_threads(1);
    const Path one = measured(job);
    for (const int count : threads) {
      parallel::set_threads(count);
      std::vector<Path> runs{measured(job), measured(job), measured(job)};
      const auto critical = [&](const Path& of) {
        return of.serial + of.longest + barrier * static_cast<double>(of.regions);
      };
      std::ranges::sort(runs, {}, critical);
      const Path& median = runs[1];
      std::printf("%-22s %7d %10.3f %7.1f%% %8.3f %8ld %8.1f\n", name, count, one.serial,
                  100 * median.serial / (median.serial + median.parallel), critical(median),
                  median.regions, one.serial / critical(median));
      std::fflush(stdout);
    }
  }
}
