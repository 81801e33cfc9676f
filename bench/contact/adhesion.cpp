// SPDX-License-Identifier: GPL-3.0-or-later
// contact_adhesion — adhesive contacts of a self-affine surface from 256² on, on one thread.
//
// usage: contact_adhesion [N_MAX [SEED]]
// H = 0.8, rms slope 1, cut-off 16 cells, roll-off a quarter of the side; w = 0.32 E*·cell,
// ρ = 1.33 cells (2.66 of van der Waals: the same largest tension), P = 0.01 E* and 0.05 E*. Prints a row for each potential and size: contacts,
// exact pairs of transforms, applications of the ladder, CPU seconds.

#include <cstdio>
#include <cstdlib>
#include <salebra/base/parallel.hpp>
#include <salebra/contact/normal/adhesion.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <string>

#include "process_cost.hpp"

int main(int argc, char** argv) {
  using namespace salebra;
  const Index largest = argc > 1 ? std::atol(argv[1]) : 1024;
  const auto seed = static_cast<std::uint64_t>(argc > 2 ? std::atol(argv[2]) : 1);
  parallel::set_threads(1);
  std::puts("points,potential,pressure,area,contacts,pairs,ladder,cpu s,termination");
  for (Index n = 256; n <= largest; n *= 2) {
    const auto side = static_cast<double>(n);
    const SelfAffineSpectrum spectrum(
        {.hurst = 0.8, .rolloff = side / 4, .short_cutoff = 16, .rms_slope = 1});
    const Surface surface = filtered_noise({n, n, side, side}, spectrum, seed);
    for (const double pressure : {0.01, 0.05})
      for (const auto& [potential, name] : Words<AdhesionPotential>::values) {
        const double range = potential == AdhesionPotential::van_der_waals ? 2.66 : 1.33;
        const double before = bench::cpu_seconds();
        const AdhesiveContactState state =
            press_adhesive(surface, 1, {.pressure = pressure}, {potential, 0.32, range});
        const double spent = bench::cpu_seconds() - before;
        std::printf("%ld²,%s,%g,%.4f,%d,%d,%d,%.2f,%s\n", static_cast<long>(n),
                    std::string(name).c_str(), pressure, state.contact_area_fraction,
                    state.outer_iterations, state.fft_count, state.ladder_count, spent,
                    std::string(word_of(state.termination)).c_str());
        std::fflush(stdout);
      }
  }
}
