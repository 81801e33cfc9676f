// SPDX-License-Identifier: GPL-3.0-or-later
// Stated errors of the damping of generated surfaces against what they converge to on cells of a quarter of the size.
//   damping_errors [surfaces [points [seed]]]
// One line per load: Hurst exponent, cells in the shortest wave, amplitude over rms height, pressure over E*h', W, its error and the
// parts of it (cells, scatter, levels, ratio, solver), all over W; then W converged, less W, over W. The last lines count.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <salebra/contact/sweep.hpp>
#include <salebra/damping/surface_damping.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/spectrum.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/refine.hpp>
#include <vector>

using namespace salebra;

namespace {

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

int main(int count, char** words) {
  const int surfaces = count > 1 ? std::atoi(words[1]) : 200;
  const Index points = count > 2 ? std::atoi(words[2]) : 64;
  const auto seed = static_cast<std::uint64_t>(count > 3 ? std::atoi(words[3]) : 1);
  constexpr std::array hurst{0.3, 0.5, 0.8}, shortest{4.0, 6.0, 8.0};
  constexpr std::array amplitudes{0.003, 0.01, 0.03, 0.1, 0.3};
  const Material material = Material::of_contact_modulus(1e9, 0.3);
  const Grid2D grid{points, points, 1e-6, 1e-6};
  constexpr double slope = 0.1;
  std::vector<double> pressures;
  for (int k = 0; k < 6; ++k)
    pressures.push_back(2e-3 * std::pow(75, k / 5.0) * slope * material.contact_modulus);

  std::vector<double> over_actual;
  int stated = 0, held = 0, unstated = 0, cases = 0, held_of_all = 0;
  for (int i = 0; i < surfaces; ++i) {
    const double h = hurst[static_cast<std::size_t>(i % 3)];
    const double cells = shortest[static_cast<std::size_t>(i / 3 % 3)];
    const double amplitude = amplitudes[static_cast<std::size_t>(i % 5)];
    const SelfAffineSpectrum spectrum({.hurst = h,
                                       .rolloff = i % 2 == 0 ? 0.25e-6 : 0.5e-6,
                                       .short_cutoff = cells * grid.dx(),
                                       .rms_slope = slope});
    const Surface surface = filtered_noise(grid, spectrum, seed + static_cast<std::uint64_t>(i));
    const double rms = height_statistics(surface).rms_height;
    const Drag motion{amplitude * rms, 1e-3, 2 * std::numbers::pi * 20e3};
    const auto curve_of = [&](const Surface& s) {
      SweepOptions sweep;
      sweep.contact.tolerance = 1e-8;
      sweep.stick = true;
      return sweep_pressures(s, material, pressures, sweep);
    };
    const auto results = surface_damping(surface, material, motion, curve_of(surface));
    const Surface fine = refined(surface, 4);
    SurfaceDampingOptions many;
    many.levels = 16;
    many.refinements = 0;
    const auto converged = surface_damping(fine, material, motion, curve_of(fine), many);
    for (std::size_t k = 0; k < results.size(); ++k) {
      const SurfaceDamping& r = results[k];
      if (!r.converged || !converged[k].converged) continue;
      const double w = r.work_per_cycle, actual = converged[k].work_per_cycle - w;
      std::printf("%.1f %.0f %.3f %.4f %.5g %.4f %.4f %.4f %.4f %.4f %.2g %+.4f %d %.3g %.4f\n", h,
                  cells, amplitude, pressures[k] / slope / material.contact_modulus, w,
                  r.error / std::abs(w), r.cell_error / std::abs(w), r.scatter / std::abs(w),
                  r.level_error / std::abs(w), r.ratio_error / std::abs(w),
                  r.solver_error / std::abs(w), actual / std::abs(w), r.levels,
                  r.window / motion.normal_amplitude, converged[k].scatter / std::abs(w));
      ++cases;
      const bool holds = std::abs(actual) <= r.error;
      held_of_all += holds;
      if (!(r.error < std::abs(w))) {
        ++unstated;
        continue;
      }
      ++stated;
      held += holds;
      over_actual.push_back(r.error / std::abs(actual));
    }
    std::fflush(stdout);
  }
  std::printf(
      "# %d cases, %d with a number, %d n/a; stated errors hold %.1f %% (%.1f %% with those n/a); "
      "median of stated over actual %.2f\n",
      cases, stated, unstated, 100.0 * held / std::max(1, stated),
      100.0 * held_of_all / std::max(1, cases), median(over_actual));
}
