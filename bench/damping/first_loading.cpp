// SPDX-License-Identifier: GPL-3.0-or-later
// Damping after a plastic first loading: cells halved on the residual surface, against a first
// loading of the halved cells.
//   damping_first_loading [surfaces [points]]
// One line per load: seed, first load (raised by the oscillation about it) over the hardness, area
// that flowed, pressure over the mean first load, γ of the residual surface with its stated error,
// γ of the first loading on halved cells, and their difference over the root of the sum of the
// squares of the stated error and the other's scatter. docs/surface_damping.md quotes ranges and
// the last line.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/normal/first_loading.hpp>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <utility>
#include <vector>

#include "surface/refine.hpp"

using namespace salebra;

namespace {

constexpr double hardness = 6e9, amplitude = 1e-9;  // Pa, m
const Material steel = Material::of_contact_modulus(115e9, 0.3);

std::vector<SurfaceDamping> damping_of(const Surface& surface, double first_load, int refinements) {
  SweepOptions sweep;
  sweep.contact.tolerance = 1e-8;
  const ForceCurve curve = sweep_pressures(
      surface, steel, {0.2 * first_load, 0.5 * first_load, 0.8 * first_load, first_load}, sweep);
  return surface_damping(surface, steel, Drag{amplitude, 1e-6, 2 * std::numbers::pi * 20e3}, curve,
                         {.refinements = refinements});
}

ResidualSurface loaded(Surface surface, double pressure) {
  NormalContactOptions options;
  options.tolerance = 1e-8;
  options.hardness = hardness;
  return after_first_loading(std::move(surface), steel.contact_modulus, pressure, options,
                             amplitude);
}

}  // namespace

int main(int count, char** arguments) {
  const int surfaces = count > 1 ? std::atoi(arguments[1]) : 5;
  const Index points = count > 2 ? std::atoi(arguments[2]) : 128;
  SelfAffineParameters parameters;
  parameters.hurst = 0.8;
  parameters.rolloff = 2.5e-6;
  parameters.short_cutoff = 10e-6 / 32;
  parameters.rms_height = 30e-9;
  int cases = 0, within = 0;
  for (int seed = 1; seed <= surfaces; ++seed)
    for (const double pressure : {5e8, 2e9}) {
      const Surface surface = filtered_noise({points, points, 10e-6, 10e-6},
                                             SelfAffineSpectrum(parameters), std::uint64_t(seed));
      const ResidualSurface coarse = loaded(surface, pressure);
      const ResidualSurface fine = loaded(refined(surface, 2), pressure);
      const auto halved = damping_of(coarse.surface, pressure, 1);
      const auto other = damping_of(fine.surface, pressure, 0);
      for (std::size_t k = 0; k < halved.size(); ++k) {
        const double one = halved[k].damping_constant, error = halved[k].damping_constant_error();
        const double two = other[k].damping_constant;
        const double scatter = other[k].error.noise * two / other[k].work_per_cycle;
        const double share = std::abs(one - two) / std::hypot(error, scatter);
        std::printf("%d %.3f %.3f %.1f %8.4g %6.2g %8.4g %5.2f\n", seed,
                    coarse.first_loading.pressure / hardness,
                    coarse.first_loading.yielded_area_fraction, std::vector{0.2, 0.5, 0.8, 1.0}[k],
                    one, error, two, share);
        ++cases;
        within += share < 1;
      }
    }
  std::printf("%d of %d within the stated errors\n", within, cases);
}
