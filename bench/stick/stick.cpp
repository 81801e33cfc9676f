// SPDX-License-Identifier: GPL-3.0-or-later
// Cost of stick solves, of the level quadrature and of the time-stepped cycle on a self-affine
// surface, one thread.
// Sample runs:  stick        stick solve 256 512 1024        stick intervals 512 32        stick cycle 256 64
// CPU time is what counts where the machine is busy; wall time is printed beside it.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <salebra/base/parallel.hpp>
#include <salebra/damping/interval_quadrature.hpp>
#include <salebra/generators/random_phase.hpp>
#include <string>
#include <vector>

namespace {

using namespace salebra;

constexpr double slope = 0.1;

class Stopwatch {
 public:
  double cpu() const { return static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC; }
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }

 private:
  std::clock_t cpu_ = std::clock();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

Surface rough(Index n) {
  const Grid2D grid{n, n, 1.0, 1.0};
  SelfAffineParameters parameters;
  parameters.hurst = 0.8;
  parameters.rolloff = 1.0 / 8;
  parameters.short_cutoff = 8.0 / static_cast<double>(n);
  parameters.rms_slope = slope;
  return random_phase(grid, SelfAffineSpectrum(parameters), 1);
}

// Solves to 1e-6 of contacts from light to nearly full.
void solve(Index n) {
  const Surface surface = rough(n);
  const Material material = Material::of_contact_modulus(1.0, 0.3);
  for (const double pressure : {0.005, 0.02, 0.1, 0.5, 1.2}) {
    const ContactSet contact = contact_set(press(surface, 1.0, at_pressure(pressure * slope)));
    const Stopwatch watch;
    const StickStiffness stiffness = stick_stiffness(contact, surface.grid, material, {}, true);
    std::printf(
        "solve   %4ld^2  p/(E*h') %.3f  %3d iterations  %3d FFT pairs  K_t %.8f  CPU %.3f s  wall "
        "%.3f s\n",
        static_cast<long>(n), pressure, stiffness.iterations, stiffness.fft_count, stiffness.xx,
        watch.cpu(), watch.wall());
  }
}

struct RoughContact {
  Surface surface;
  Material material = Material::of_contact_modulus(1.0, 0.3);
  ContactSets contact_sets;
  double indentation = 0, amplitude = 0;

  explicit RoughContact(Index n) : surface(rough(n)) {
    indentation = press(surface, 1.0, at_pressure(0.02 * slope)).indentation;
    amplitude = 0.2 * std::sqrt(surface.heights.square().mean());
    contact_sets = boundary_element_contact_sets(surface, 1.0);
  }
};

void intervals(Index n, int count) {
  const RoughContact contact(n);
  IntervalQuadratureOptions options;
  options.intervals = count;
  const Stopwatch watch;
  const IntervalQuadratureResult result = interval_quadrature(
      contact.contact_sets, contact.surface.grid, contact.material,
      EqualFrequency{contact.amplitude, contact.amplitude, 1.0}, contact.indentation, options);
  std::printf(
      "intervals  %4ld^2  %3d intervals  %4ld pairs on contact sets  W %.6e +- %.1e  K_t/(G*/E*)K "
      "%.4f  "
      "CPU %.2f "
      "s  wall %.2f s\n",
      static_cast<long>(n), count, result.fft_count, result.work_per_cycle, result.error_estimate,
      result.stiffness_ratio, watch.cpu(), watch.wall());
}

void cycle(Index n, int steps) {
  const RoughContact contact(n);
  CycleOptions options;
  options.steps = steps;
  const Stopwatch watch;
  const CycleResult result = simulate_cycle(
      contact.contact_sets, contact.surface.grid, contact.material,
      trajectory_of(EqualFrequency{contact.amplitude, contact.amplitude, 1.0}, contact.indentation),
      options);
  std::printf(
      "cycle   %4ld^2  %3d steps   %4ld pairs  W %.6e  dissipated/W - 1 %.1e  CPU %.2f s  wall "
      "%.2f "
      "s\n",
      static_cast<long>(n), steps, result.fft_count, result.work_per_cycle,
      result.dissipated / result.work_per_cycle - 1, watch.cpu(), watch.wall());
}

}  // namespace

int main(int argc, char** argv) {
  parallel::set_threads(1);
  const std::string what = argc > 1 ? argv[1] : "all";
  std::vector<int> numbers;
  for (int k = 2; k < argc; ++k) numbers.push_back(std::atoi(argv[k]));
  if (what == "solve" || what == "all")
    for (const int n :
         numbers.empty() || what == "all" ? std::vector<int>{256, 512, 1024} : numbers)
      solve(n);
  if (what == "intervals" || what == "all")
    intervals(numbers.empty() ? 512 : numbers[0], numbers.size() < 2 ? 32 : numbers[1]);
  if (what == "cycle" || what == "all")
    cycle(numbers.empty() ? 256 : numbers[0], numbers.size() < 2 ? 64 : numbers[1]);
}
