// SPDX-License-Identifier: GPL-3.0-or-later
// How fast TangentialContact follows a trajectory on a tabulated law, one core.
// Sample runs:  damping_engine        damping_engine 10000000 100        damping_engine 10000000 100 0.3
// Arguments: steps, steps a cycle, friction coefficient (none or inf: full stick).
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>
#include <salebra/damping/tangential_contact.hpp>
#include <vector>

#include "../contact/process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  const long steps = argc > 1 ? std::atol(argv[1]) : 10'000'000;
  const int per_cycle = argc > 2 ? std::atoi(argv[2]) : 100;
  const double friction = argc > 3 ? std::atof(argv[3]) : std::numeric_limits<double>::infinity();

  // A curve that bends in ln F, as those of rough surfaces do.
  ForceCurve curve;
  for (int i = 0; i <= 40; ++i) {
    const double indentation = 2e-8 * i;
    curve.samples.push_back(
        {.indentation = indentation,
         .force = std::exp(1e7 * indentation - 2e12 * indentation * indentation)});
  }
  const TabulatedLaw law(curve, 0.8);
  const double low = 3e-7, high = 7e-7;
  TangentialContact contact(law, low, high,
                            {.friction_coefficient = friction, .tangential_range = 2e-7});

  std::vector<double> indentation, x;
  for (int i = 0; i < per_cycle; ++i) {
    const double angle = 2 * std::numbers::pi * i / per_cycle;
    indentation.push_back(0.5 * (low + high) - 0.5 * (high - low) * std::cos(angle));
    x.push_back(1e-7 * std::sin(angle + 0.4));
  }
  contact.start(indentation[0], x[0]);
  std::size_t memory = 0;
  const std::clock_t start = std::clock();  // CPU time: the machine may be busy
  std::size_t at = 0;
  for (long i = 0; i < steps; ++i) {
    if (++at == indentation.size()) at = 0;
    contact.move_to(indentation[at], x[at]);
    if (contact.memory() > memory) memory = contact.memory();
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf(
      "%8ld steps in %.3f s, %.0f ns a step, at most %zu pieces of history, peak memory %.1f MB, "
      "%.9g J a cycle\n",
      steps, seconds, 1e9 * seconds / static_cast<double>(steps), memory,
      1e-6 * static_cast<double>(bench::peak_bytes()),
      contact.dissipated() * per_cycle / static_cast<double>(steps));
}
