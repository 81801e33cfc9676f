// SPDX-License-Identifier: GPL-3.0-or-later
// 01_surface — makes a self-affine surface and compares its requested roughness with the roughness
// that the grid can represent and with that of the surface made.
// Sample runs:  01_surface        01_surface 1024        01_surface 512 0.6 3
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/units.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/summits.hpp>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 256;
  const double hurst = argc > 2 ? std::atof(argv[2]) : 0.8;
  const unsigned long seed = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 1;

  // 1. The period is 1 mm, the roll-off half of it, the shortest wave eight cells of the grid, and
  //    the rms height 1 µm.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = hurst, .rolloff = grid.lx / 2, .short_cutoff = 8 * grid.dx(), .rms_height = 1e-6});

  // 2. Before any surface is made, the lattice sum predicts its moments on this grid.
  const Forecast expected = forecast(grid, spectrum);
  for (const auto& warning : expected.warnings) std::printf("note: %s\n", warning.c_str());

  // 3. Random phase gives every mode exactly its power, so the surface must have the moments of the
  //    lattice sum.
  const Surface surface = random_phase(grid, spectrum, seed);
  const SpectralMoments realised = spectral_moments(surface);
  std::printf("%-22s %12s %12s %12s\n", "", "continuum", "lattice", "realised");
  const auto row = [&](const char* name, double (SpectralMoments::*quantity)() const,
                       Dimension dimension) {
    std::printf("%-22s %12s %12s %12s\n", name,
                format_quantity((expected.target.*quantity)(), dimension).c_str(),
                format_quantity((expected.lattice.*quantity)(), dimension).c_str(),
                format_quantity((realised.*quantity)(), dimension).c_str());
  };
  row("rms height", &SpectralMoments::rms_height, Dimension::length);
  row("rms slope", &SpectralMoments::rms_slope, Dimension::dimensionless);
  row("Nayak parameter", &SpectralMoments::nayak, Dimension::dimensionless);

  // 4. Compare the number of summits with Nayak's density for a Gaussian surface of these moments,
  //    m4/(6√3 π m2).
  const SummitStatistics summits = summit_statistics(find_summits(surface));
  const double nayak_density =
      realised.moment4() / (6 * std::sqrt(3.0) * std::numbers::pi * realised.moment2());
  std::printf("%-22s %.4g per mm², Nayak: %.4g\n", "summit density", summits.summit_density * 1e-6,
              nayak_density * 1e-6);
  std::printf("%-22s %s\n", "mean summit radius",
              format_quantity(summits.mean_radius, Dimension::length).c_str());

  std::printf("realised/lattice rms height = %.9f\n",
              realised.rms_height() / expected.lattice.rms_height());
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
