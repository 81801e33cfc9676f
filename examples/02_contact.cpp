// SPDX-License-Identifier: GPL-3.0-or-later
// 02_contact — presses one rough surface at one pressure by boundary elements and compares its
// contact area with two theories.
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

  // 1. The shortest wave of the periodic surface has eight cells; with fewer cells the contact area
  //    is too large.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = grid.lx / 4, .short_cutoff = 8 * grid.dx(), .rms_slope = 0.1});
  const Surface surface = random_phase(grid, spectrum, 7);

  // 2. p/(E*h') determines the contact area; h' is the rms slope.
  const double contact_modulus = 1e9;  // Pa
  const double rms_slope = spectral_moments(surface).rms_slope();
  const double pressure = relative_pressure * contact_modulus * rms_slope;

  // 3. Press. If the solver did not converge, its numbers must not be used.
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

  // 4. Pressing to the mean gap of this contact must give the same pressure.
  const NormalContactState back = press(surface, contact_modulus, at_mean_gap(state.mean_gap));
  std::printf("pressure from that mean gap / pressure = %.7f\n", back.mean_pressure / pressure);
  return back.converged() ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
