// SPDX-License-Identifier: GPL-3.0-or-later
// contact_flow — flow factors of a self-affine contact beside the contact itself, on one thread.
//
// usage: contact_flow [N_MAX [SEED]]
// H = 0.8, rms slope 1, cut-off 16 cells, roll-off a quarter of the side. Prints a row for each
// load: area, factors, Bruggeman's estimate, iterations, CPU seconds of contact and flow.

#include <cstdio>
#include <cstdlib>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/flow_factors.hpp>
#include <salebra/generators/filtered_noise.hpp>

#include "process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  const Index largest = argc > 1 ? std::atol(argv[1]) : 1024;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  parallel::set_threads(1);
  std::puts("points,pressure,area,factor x,factor y,Bruggeman,iterations,contact s,flow s");
  for (Index n = 256; n <= largest; n *= 2) {
    const auto side = static_cast<double>(n);
    const SelfAffineSpectrum spectrum(
        {.hurst = 0.8, .rolloff = side / 4, .short_cutoff = 16, .rms_slope = 1});
    const Surface surface = filtered_noise({n, n, side, side}, spectrum, seed);
    for (const double pressure : {0.01, 0.05, 0.1, 0.15, 0.2}) {
      const double before = bench::cpu_seconds();
      const NormalContactState state =
          press(surface, 1, at_pressure(pressure), {.tolerance = 1e-8});
      const double between = bench::cpu_seconds();
      const FlowFactors flow = flow_factors(state, surface.grid);
      const double after = bench::cpu_seconds();
      std::printf("%ld²,%g,%.4f,%.4g,%.4g,%.4g,%d,%.2f,%.2f\n", static_cast<long>(n), pressure,
                  state.contact_area_fraction, flow.pressure_flow_factor_x,
                  flow.pressure_flow_factor_y, flow.bruggeman_flow_factor, flow.iterations,
                  between - before, after - between);
      std::fflush(stdout);
    }
  }
}
