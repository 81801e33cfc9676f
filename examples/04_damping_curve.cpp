// SPDX-License-Identifier: GPL-3.0-or-later
// 04_damping_curve — computes the damping constant of a rough contact against amplitude by Eq. (16)
// with a fitted decay length, by the same law at finite amplitude, and by the curve without a law.
// Sample runs:  04_damping_curve        04_damping_curve 512        04_damping_curve 512 0.003
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/contact/law/fit.hpp>
#include <salebra/contact/law/law.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/closed_form.hpp>
#include <salebra/damping/dissipation.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>
#include <vector>

using namespace salebra;

int main(int argc, char** argv) try {
  const Index n = argc > 1 ? std::atoi(argv[1]) : 256;
  const double relative_pressure = argc > 2 ? std::atof(argv[2]) : 0.01;  // p/(E*h')

  // 1. Make surface, material and force–gap curve as in example 03.
  const Grid2D grid{n, n, 1e-3, 1e-3};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.8, .rolloff = grid.lx / 4, .short_cutoff = 8 * grid.dx(), .rms_height = 1e-6});
  const Surface surface = random_phase(grid, spectrum, 7);
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const double full = material.contact_modulus * spectral_moments(surface).rms_slope();
  std::vector<double> pressures;
  for (int i = 0; i < 24; ++i) pressures.push_back(full * 2e-4 * std::pow(500.0, i / 23.0));
  const ForceCurve curve = sweep_pressures(surface, material, pressures);

  // 2. Make two laws from the curve: the paper's exponential law, and an interpolation of the
  //    samples.
  const double force = relative_pressure * full * grid.area();
  const double decay_length = fit_exponential(curve).decay_length;
  const ExponentialLaw exponential(force, decay_length, material.modulus_ratio());
  const TabulatedLaw tabulated(curve, material.modulus_ratio());

  // 3. Shear the contact at 1 µm/s while it vibrates in the normal direction at 20 kHz, and print
  //    the damping constant P/v² for each amplitude.
  std::printf("F = %.4g N, l = %.4g nm\n", force, decay_length * 1e9);
  std::printf("%8s %16s %16s %16s (N s/m) %12s %12s\n", "u_z/l", "Eq. (16)", "exponential law",
              "curve", "(16)/law", "(16)/curve");
  for (const double k : {0.02, 0.05, 0.1, 0.2, 0.4}) {
    const Drag motion{.normal_amplitude = k * decay_length,
                      .drag_velocity = 1e-6,
                      .angular_frequency = 2 * std::numbers::pi * 20e3};
    const double small = closed_form::damping_constant(
        closed_form::work_per_cycle_rough(material.modulus_ratio(), force, decay_length, motion),
        motion);
    const DampingResult law = relaxation_damping(exponential, at_force(force), motion);
    const DampingResult measured = relaxation_damping(tabulated, at_force(force), motion);
    std::printf("%8.2f %16.6g %16.6g %16.6g %20.4f %12.4f\n", k, small, law.damping_constant,
                measured.damping_constant, small / law.damping_constant,
                small / measured.damping_constant);
    if (!law.converged || !measured.converged) return 1;
  }

  // 4. The ratio of Eq. (16) to the law shows the effect of the finite amplitude alone,
  //    1 + 0.42 u_z/l + …; the ratio to the curve also contains the error of the fit.
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
