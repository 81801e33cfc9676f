// SPDX-License-Identifier: GPL-3.0-or-later
// 05_measured_surface — presses a measured surface, computes force against mean gap, and checks
// whether the curve has one decay length.
// Sample runs:  05_measured_surface data/surfaces/afm-scan.txt        05_measured_surface scan.x3p 70e9
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <salebra/salebra.hpp>
#include <vector>

using namespace salebra;

int main(int argc, char** argv) try {
  if (argc < 2) {
    std::fprintf(stderr, "usage: 05_measured_surface FILE [CONTACT_MODULUS]\n");
    return 2;
  }
  const double contact_modulus = argc > 2 ? std::atof(argv[2]) : 115e9;  // Pa

  // 1. Read the heights from any format and subtract the tilt of the stage.
  const Surface raw = read_surface(argv[1]);
  const Surface surface = detrended(raw, default_detrend(raw));
  const SpectralMoments moments = surface_moments(surface);
  const double rms_slope = moments.rms_slope();
  std::printf("%lld x %lld points, %s x %s, rms height %s, rms slope %.4f\n",
              static_cast<long long>(surface.grid.nx), static_cast<long long>(surface.grid.ny),
              format_quantity(surface.grid.lx, Dimension::length).c_str(),
              format_quantity(surface.grid.ly, Dimension::length).c_str(),
              format_quantity(moments.rms_height(), Dimension::length).c_str(), rms_slope);

  // 2. Press at sixteen loads, from the contact of a few summits to a fifth of full contact, E*h'.
  //    The scan is continued periodically.
  std::vector<double> pressures;
  for (int i = 0; i < 16; ++i)
    pressures.push_back(contact_modulus * rms_slope * 5e-4 * std::pow(400.0, i / 15.0));
  SweepOptions options;
  options.stiffness = false;
  const ForceCurve curve =
      sweep_pressures(surface, Material::of_contact_modulus(contact_modulus), pressures, options);
  std::printf("%12s %12s %10s\n", "pressure", "mean gap", "area");
  for (const ForceSample& sample : curve.samples)
    std::printf("%12s %12s %8.2f %%\n",
                format_quantity(sample.pressure, Dimension::pressure).c_str(),
                format_quantity(sample.mean_gap, Dimension::length).c_str(),
                100 * sample.contact_area_fraction);

  // 3. Fit the exponential law and test it. If it does not hold, use the curve itself, as in
  //    example 04.
  const ExponentialFit fit = fit_exponential(curve);
  const ExponentialTest test = test_exponential(curve);
  const WindowSensitivity parts = window_sensitivity(curve);
  std::printf("decay length %s; parts of the window give %s … %s\n",
              format_quantity(fit.decay_length, Dimension::length).c_str(),
              format_quantity(parts.decay_length_min, Dimension::length).c_str(),
              format_quantity(parts.decay_length_max, Dimension::length).c_str());
  std::printf("over the window l runs from %s (smallest gap) to %s (largest gap)\n",
              format_quantity(test.decay_length_at_min_gap, Dimension::length).c_str(),
              format_quantity(test.decay_length_at_max_gap, Dimension::length).c_str());
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
