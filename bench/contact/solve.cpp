// SPDX-License-Identifier: GPL-3.0-or-later
// contact_solve — one periodic contact by salebra, timed as peers.py times the peers.
//
// usage: contact_solve HEIGHTS.raw N PRESSURE TOLERANCE THREADS PRESSURE_OUT.raw
// HEIGHTS.raw: N x N float64 without a header, one period of side 1, E* = 1. Prints one JSON object.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal.hpp>

#include "process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  if (argc != 7) return 2;
  const Index n = std::atol(argv[2]);
  Surface surface{{n, n, 1.0, 1.0}, Field(n, n), true, argv[1]};
  const auto bytes = static_cast<std::streamsize>(sizeof(double)) * n * n;
  std::ifstream(argv[1], std::ios::binary)
      .read(reinterpret_cast<char*>(surface.heights.data()), bytes);
  parallel::set_threads(std::atoi(argv[5]));

  const long before = bench::peak_bytes();
  const double cpu = bench::cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  const auto state =
      press_to_pressure(surface, 1.0, std::atof(argv[3]), {.tolerance = std::atof(argv[4])});
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf(
      "{\"wall\": %.6f, \"cpu\": %.6f, \"bytes\": %ld, \"pairs\": %d, \"iterations\": %d, \"e_c\": "
      "%.3e, "
      "\"converged\": %s}\n",
      wall, bench::cpu_seconds() - cpu, bench::peak_bytes() - before, state.fft_count,
      state.iterations, state.residual, state.converged ? "true" : "false");
  std::ofstream(argv[6], std::ios::binary)
      .write(reinterpret_cast<const char*>(state.pressure.data()), bytes);
  return state.converged ? 0 : 1;
}
