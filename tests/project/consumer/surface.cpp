// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>
#include <salebra/generators/random_phase.hpp>

// A generated surface without the rest of salebra: random phase gives the lattice's rms height to
// round-off.
int main() {
  const salebra::Grid2D grid{32, 32, 1e-3, 1e-3};
  const salebra::SelfAffineSpectrum spectrum(
      {.rolloff = 5e-4, .short_cutoff = 1e-4, .rms_height = 1e-6});
  const salebra::Surface surface = salebra::random_phase(grid, spectrum, 1);
  const double rms_height = std::sqrt(surface.heights.square().mean());
  const double expected = spectrum.lattice_moments(grid).rms_height();
  std::printf("rms height %.6g m, expected %.6g m\n", rms_height, expected);
  return std::abs(rms_height / expected - 1) < 1e-10 ? 0 : 1;
}
