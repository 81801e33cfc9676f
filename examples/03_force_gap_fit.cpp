// SPDX-License-Identifier: GPL-3.0-or-later
// 03_force_gap_fit — computes force against mean gap by three models and tests for each how well
// F ∝ exp(−ū/l) holds.
// Sample runs:  03_force_gap_fit        03_force_gap_fit 512        03_force_gap_fit 512 0.5 11
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 256;
  const double hurst = argc > 2 ? std::atof(argv[2]) : 0.8;
  const unsigned long seed = argc > 3 ? std::strtoul(argv[3], nullptr, 10) : 7;

  // 1. Make a surface and a material: one elastic body, ν = 0.3, against a rigid one.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = hurst, .rolloff = grid.lx / 4, .short_cutoff = 8 * grid.dx(), .rms_height = 1e-6});
  const Surface surface = random_phase(grid, spectrum, seed);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const SpectralMoments moments = spectral_moments(surface);

  // 2. The pressures reach from the contact of a few summits to about a tenth of the area.
  std::vector<double> pressures;
  const double full = material.contact_modulus * moments.rms_slope();
  for (int i = 0; i < 16; ++i) pressures.push_back(full * 5e-4 * std::pow(100.0, i / 15.0));

  // 3. The models are boundary elements, Greenwood–Williamson with summits from the moments, and
  //    Greenwood–Williamson with the surface's own summits.
  const ForceCurve by_elements = sweep_pressures(surface, material, pressures);
  SummitEnsemble ensemble = summit_ensemble(moments.moment0, moments.moment2(), moments.moment4());
  ensemble.rms_height = moments.rms_height();
  const ForceCurve by_moments =
      curve_at_pressures(StatisticalSummits(ensemble, material, grid.area()), pressures);
  const ForceCurve by_summits =
      curve_at_pressures(DeterministicSummits(find_summits(surface).summits, material, grid.area(),
                                              0.0, moments.rms_height()),
                         pressures);

  // 4. Print for each the decay length over rms height, its range over parts of the window, and its
  //    change along the window.
  std::printf("%-26s %8s %18s %22s\n", "model", "l/h_rms", "parts of window", "closest … farthest");
  const auto report = [&](const char* name, const ForceCurve& curve) {
    const double h = moments.rms_height();
    const ExponentialFit fit = fit_exponential(curve);
    const ExponentialTest test = test_exponential(curve);
    const WindowSensitivity parts = window_sensitivity(curve);
    std::printf("%-26s %8.3f    %.3f … %.3f        %.3f … %.3f\n", name,
                fit.decay_length_over_rms_height, parts.decay_length_min / h,
                parts.decay_length_max / h, test.decay_length_at_min_gap / h,
                test.decay_length_at_max_gap / h);
  };
  report("boundary elements", by_elements);
  report("summits from the moments", by_moments);
  report("the surface's summits", by_summits);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
