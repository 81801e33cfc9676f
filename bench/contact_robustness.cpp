// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every awkward contact that we could think of, in load and in gap control, in both precisions. Prints the failures and the
// worst iteration counts; exit status 1 if anything failed.
//   contact_robustness [number of random surfaces [points]]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal.hpp>
#include <string>

#include "../tests/contact/awkward_contacts.hpp"

namespace {

using namespace salebra;

struct Tally {
  int runs = 0, failures = 0, iterations = 0, most = 0;
  std::string worst;

  void add(const std::string& name, const NormalContactState& state, bool sound) {
    ++runs;
    iterations += state.iterations;
    if (state.iterations > most) {
      most = state.iterations;
      worst = name;
    }
    if (state.converged && sound) return;
    ++failures;
    std::printf("FAILED %s: converged %d e_c %.2e iterations %d area %.4f\n", name.c_str(),
                state.converged, state.residual, state.iterations, state.contact_area_fraction);
    std::fflush(stdout);
  }
  void print(const char* title) const {
    std::printf("%s: %d runs, %d failures, %.1f iterations on average, %d at most (%s)\n", title,
                runs, failures, static_cast<double>(iterations) / std::max(runs, 1), most,
                worst.c_str());
    std::fflush(stdout);
  }
};

// Presses to a pressure, then to the mean gap that this gives, and compares.
void press(const test::AwkwardContact& contact, Tally& loads, Tally& gaps) {
  const Surface& surface = contact.surface;
  for (const Precision precision : {Precision::mixed, Precision::full}) {
    NormalContactOptions options;
    options.precision = precision;
    options.tolerance = precision == Precision::mixed ? 1e-8 : 1e-12;
    const std::string name = contact.name + (precision == Precision::mixed ? ", mixed" : ", full");
    const auto state = press_to_pressure(surface, 1, contact.pressure, options);
    loads.add(name, state, std::abs(state.pressure.mean() / contact.pressure - 1) < 1e-10);
    const double first_touch = surface.heights.maxCoeff() - surface.heights.mean();
    if (!(state.mean_gap > 1e-6 * first_touch && state.mean_gap < (1 - 1e-9) * first_touch))
      continue;
    const auto back = press_to_mean_gap(surface, 1, state.mean_gap, options);
    const double difference = std::abs(back.mean_pressure / contact.pressure - 1);
    gaps.add(name + ", gap given, pressure off by " + std::to_string(difference), back,
             difference < (precision == Precision::mixed ? 1e-3 : 1e-5));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int surfaces = argc > 1 ? std::atoi(argv[1]) : 200;
  const Index n = argc > 2 ? std::atol(argv[2]) : 128;
  parallel::set_threads(1);
  Tally random_loads, random_gaps, shape_loads, shape_gaps;
  for (int k = 0; k < surfaces; ++k) press(test::awkward_surface(k, n), random_loads, random_gaps);
  random_loads.print("random surfaces, pressure given");
  random_gaps.print("random surfaces, mean gap given");

  for (const auto& contact : test::awkward_shapes(n)) press(contact, shape_loads, shape_gaps);
  shape_loads.print("shapes, pressure given");
  shape_gaps.print("shapes, mean gap given");
  return random_loads.failures + random_gaps.failures + shape_loads.failures + shape_gaps.failures >
         0;
}
