// SPDX-License-Identifier: GPL-3.0-or-later
// contact_sweep — the force curve of a surface by salebra, timed: 20 loads from f = p/(E*·rms
// slope) = 1e-4 to 0.1, evenly in log f, each with the stiffness of its contact set.
//
// usage: contact_sweep HEIGHTS.raw N TOLERANCE THREADS [CONCURRENT_LOADS]
// HEIGHTS.raw: N x N float64 without a header, one period of side 1, rms slope 0.1, E* = 1. Prints
// one JSON object.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/sweep.hpp>

#include "process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  if (argc < 5) return 2;
  const Index n = std::atol(argv[2]);
  Surface surface{{n, n, 1.0, 1.0}, Field(n, n), true, argv[1]};
  std::ifstream(argv[1], std::ios::binary)
      .read(reinterpret_cast<char*>(surface.heights.data()),
            static_cast<std::streamsize>(sizeof(double)) * n * n);
  parallel::set_threads(std::atoi(argv[4]));
  constexpr int loads = 20;
  constexpr double first = 1e-4, last = 0.1, slope = 0.1;
  std::vector<double> pressures(loads);
  for (int k = 0; k < loads; ++k)
    pressures[static_cast<std::size_t>(k)] =
        slope * first * std::pow(last / first, k / (loads - 1.0));
  SweepOptions options;
  options.stiffness = true;
  options.contact.tolerance = std::atof(argv[3]);
  if (argc > 5) options.concurrent_loads = std::atoi(argv[5]);

  const long before = bench::peak_bytes();
  const double cpu = bench::cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  const ForceCurve curve =
      sweep_pressures(surface, Material::of_contact_modulus(1.0), pressures, options);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  bool converged = curve.samples.size() == loads;
  for (const ForceSample& sample : curve.samples) converged = converged && sample.converged;
  std::printf(
      "{\"wall\": %.4f, \"cpu\": %.4f, \"bytes\": %ld, \"converged\": %s, \"stiffness\": %.10g}\n",
      wall, bench::cpu_seconds() - cpu, bench::peak_bytes() - before, converged ? "true" : "false",
      curve.samples.back().normal_stiffness);
  return converged ? 0 : 1;
}
