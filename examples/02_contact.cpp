// SPDX-License-Identifier: GPL-3.0-or-later
// 02_contact — one rough surface under one pressure, by boundary elements, beside the theories of
// its contact area.
// Sample runs:  02_contact        02_contact 512        02_contact 512 0.002
#include <cstdio>
#include <cstdlib>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/contact/normal/normal.hpp>
#include <salebra/contact/theories.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 256;
  const double relative_pressure = argc > 2 ? std::atof(argv[2]) : 0.01;  // p/(E*h')

  // 1. A periodic surface whose shortest wave spans eight cells: fewer, and the contact area comes
  //    out too large.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = grid.lx / 4, .short_cutoff = 8 * grid.dx(), .rms_slope = 0.1});
  const Surface surface = random_phase(grid, spectrum, 7);

  // 2. Area is decided by p/(E*h'), h' the rms slope.
  const double contact_modulus = 1e9;  // Pa
  const double rms_slope = spectral_moments(surface).rms_slope();
  const double pressure = relative_pressure * contact_modulus * rms_slope;

  // 3. Press. A solver that gave up says so in its result; its numbers are then no answer.
  const NormalContactState state = press(surface, contact_modulus, at_pressure(pressure));
  if (!state.converged()) {
    std::fprintf(stderr, "not converged: residual %.1e after %d iterations\n", state.residual,
                 state.iterations);
    return 1;
  }
  std::printf("pressure              %s\n", format_quantity(pressure, Dimension::pressure).c_str());
  std::printf("mean gap              %s\n",
              format_quantity(state.mean_gap, Dimension::length).c_str());
  std::printf("elastic energy        %s\n",
              format_quantity(state.elastic_energy, Dimension::energy).c_str());
  std::printf("contact area fraction %.4f, Persson %.4f, Bush–Gibson–Thomas %.4f\n",
              state.contact_area_fraction,
              persson_area_fraction(pressure, contact_modulus, rms_slope),
              bgt_area_fraction(pressure, contact_modulus, rms_slope));
  std::printf("solver                %d iterations, residual %.1e\n", state.iterations,
              state.residual);

  // 4. The mean gap that the pressure gave, given back, must return that pressure.
  const NormalContactState back = press(surface, contact_modulus, at_mean_gap(state.mean_gap));
  std::printf("pressure from that mean gap / pressure = %.7f\n", back.mean_pressure / pressure);
  return back.converged() ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
