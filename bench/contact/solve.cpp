// SPDX-License-Identifier: GPL-3.0-or-later
// contact_solve — one contact by salebra, timed as peers.py times the peers.
//
// usage: contact_solve HEIGHTS.raw N PRESSURE TOLERANCE THREADS PRESSURE_OUT.raw BOUNDARY
// HEIGHTS.raw: N x N float64 without a header, side 1, E* = 1; BOUNDARY: periodic (one period) or
// free (one patch on an infinite half-space). Prints one JSON object. "setup" is part of "wall":
// levels, plans, symbols and stencils, which are made once more to be timed by themselves.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <string_view>

#include "contact/normal/nested_contact.hpp"
#include "process_cost.hpp"

namespace {

using namespace salebra;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double setup_seconds(const Surface& surface, Boundary boundary) {
  const auto start = std::chrono::steady_clock::now();
  const double side = static_cast<double>(surface.grid.nx);
  const auto levels =
      detail::multigrid_levels({surface.grid.nx, surface.grid.ny, side, side}, surface.partition(),
                               {surface.heights.data(), surface.heights.maxCoeff()}, boundary,
                               std::numeric_limits<int>::max());
  for (const auto& level : levels)
    detail::ActiveSetCg<float>(level.grid, 1, boundary, level.heights, 1);
  return seconds_since(start);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 8) return 2;
  const Index n = std::atol(argv[2]);
  Surface surface{{n, n, 1.0, 1.0}, Field(n, n), true, argv[1]};
  const auto bytes = static_cast<std::streamsize>(sizeof(double)) * n * n;
  std::ifstream(argv[1], std::ios::binary)
      .read(reinterpret_cast<char*>(surface.heights.data()), bytes);
  parallel::set_threads(std::atoi(argv[5]));
  const Boundary boundary =
      std::string_view(argv[7]) == "free" ? Boundary::free : Boundary::periodic;

  const long before = bench::peak_bytes();
  const double cpu = bench::cpu_seconds();
  const auto start = std::chrono::steady_clock::now();
  const auto state = press(surface, 1.0, at_pressure(std::atof(argv[3])),
                           {.tolerance = std::atof(argv[4]), .boundary = boundary});
  const double wall = seconds_since(start);
  const double spent = bench::cpu_seconds() - cpu;
  const long bytes_more = bench::peak_bytes() - before;
  std::printf(
      "{\"wall\": %.6f, \"setup\": %.6f, \"cpu\": %.6f, \"bytes\": %ld, \"pairs\": %d, "
      "\"iterations\": %d, \"e_c\": %.3e, \"converged\": %s}\n",
      wall, setup_seconds(surface, boundary), spent, bytes_more, state.fft_count, state.iterations,
      state.residual, state.converged() ? "true" : "false");
  std::ofstream(argv[6], std::ios::binary)
      .write(reinterpret_cast<const char*>(state.contact_pressure.data()), bytes);
  return state.converged() ? 0 : 1;
}
