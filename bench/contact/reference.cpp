// SPDX-License-Identifier: GPL-3.0-or-later
// contact_reference — one periodic contact by the plain Polonsky–Keer of the tests, timed as
// contact_solve times salebra.
//
// usage: contact_reference HEIGHTS.raw N PRESSURE TOLERANCE THREADS PRESSURE_OUT.raw
// HEIGHTS.raw: N x N float64 without a header, one period of side 1, E* = 1. THREADS is not used:
// the solver is serial.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "../../tests/contact/normal/polonsky_keer.hpp"
#include "process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  if (argc != 7) return 2;
  const Index n = std::atol(argv[2]);
  Surface surface{{n, n, 1.0, 1.0}, Field(n, n), true, argv[1]};
  const auto bytes = static_cast<std::streamsize>(sizeof(double)) * n * n;
  std::ifstream(argv[1], std::ios::binary)
      .read(reinterpret_cast<char*>(surface.heights.data()), bytes);
  const double tolerance = std::atof(argv[4]);

  const long before = bench::peak_bytes();
  const double cpu = bench::cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  const auto result = test::polonsky_keer(surface, 1.0, std::atof(argv[3]), tolerance, 100'000);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // Each iteration transforms the pressure and the direction, the last one the pressure alone.
  std::printf("{\"wall\": %.6f, \"cpu\": %.6f, \"bytes\": %ld, \"pairs\": %d, \"e_c\": %.3e}\n",
              wall, bench::cpu_seconds() - cpu, bench::peak_bytes() - before,
              2 * result.iterations + 1, result.residual);
  std::ofstream(argv[6], std::ios::binary)
      .write(reinterpret_cast<const char*>(result.pressure.data()), bytes);
  return result.residual < tolerance ? 0 : 1;
}
