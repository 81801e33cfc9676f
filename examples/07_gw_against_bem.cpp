// SPDX-License-Identifier: GPL-3.0-or-later
// 07_gw_against_bem — compares Greenwood and Williamson's summits with boundary elements on the
// same surface: area, gap, stiffness and damping constant, up to loads at which independent summits
// fail.
// Sample runs:  07_gw_against_bem        07_gw_against_bem 512        07_gw_against_bem 512 11
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/asperity/greenwood_williamson.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 256;
  const unsigned long seed = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 7;

  // 1. Make surface and material as in example 03, with loads from 2e-4 to 0.2 E*h'.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = grid.lx / 8, .short_cutoff = 8 * grid.dx(), .rms_height = 1e-6});
  const Surface surface = random_phase(grid, spectrum, seed);
  const SpectralMoments moments = spectral_moments(surface);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const double full = material.contact_modulus * moments.rms_slope();
  std::vector<double> pressures;
  for (int i = 0; i < 16; ++i) pressures.push_back(full * 2e-4 * std::pow(1000.0, i / 15.0));

  // 2. Compute two curves of the same surface: solved by boundary elements, and summed over its own
  //    summits.
  const ForceCurve elements = sweep_pressures(surface, material, pressures);
  const ForceCurve summits =
      curve_at_pressures(DeterministicSummits(find_summits(surface).summits, material, grid.area(),
                                              0.0, moments.rms_height()),
                         pressures);

  // 3. Put both laws under the same motion. Damping depends on F'', which magnifies small
  //    differences of F.
  const TabulatedLaw element_law(elements, material.modulus_ratio());
  const TabulatedLaw summit_law(summits, material.modulus_ratio());
  const Drag motion{.normal_amplitude = 0.02 * moments.rms_height(),
                    .drag_velocity = 1e-6,
                    .angular_frequency = 2 * std::numbers::pi * 20e3};
  std::printf("summits over boundary elements\n%12s %9s %8s %8s %8s\n", "p/(E*h')", "gap/h_rms",
              "area", "K", "damping");
  double first = 0, last = 0;
  // At the first and the last load the cycle would leave the curves.
  for (std::size_t i = 2; i + 2 < pressures.size(); i += 2) {
    const ForceSample& solved = elements.samples[i];
    const ForceSample& summed = summits.samples[i];
    const DampingResult by_elements =
        relaxation_damping(element_law, at_force(solved.force), motion);
    const DampingResult by_summits = relaxation_damping(summit_law, at_force(solved.force), motion);
    if (!solved.converged || !by_elements.converged || !by_summits.converged) return 1;
    last = summed.normal_stiffness / solved.normal_stiffness;
    if (first == 0) first = last;
    std::printf("%12.5f %9.2f %8.3f %8.3f %8.3f\n", pressures[i] / full,
                solved.mean_gap / moments.rms_height(),
                summed.contact_area_fraction / solved.contact_area_fraction, last,
                by_summits.damping_constant / by_elements.damping_constant);
  }

  // 4. Contact patches that are far apart do not interact. At high loads they do, and independent
  //    summits are too soft.
  std::printf("K of the summits falls from %.2f to %.2f of that of the boundary elements\n", first,
              last);
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
