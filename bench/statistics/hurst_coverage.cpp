// SPDX-License-Identifier: GPL-3.0-or-later
// How often the 95 % intervals of Hurst exponents hold the truth on surfaces and profiles that the
// library's generators did not make: exact fractional Brownian ones, read by points, by pixels, and
// by a tip.
//   hurst_coverage [each [points of profiles [points of surfaces [first seed]]]]
// One line for each kind: with an interval, covered, bias, scatter and half-width.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>

#include "surface/fractional_brownian.hpp"
#include "surface/rough_patches.hpp"

namespace {

using namespace salebra;

struct Total {
  int cases = 0, found = 0, covered = 0;
} all;

unsigned first_seed = 0;

void measure(const char* name, double truth, int cases,
             const std::function<IntervalEstimate(unsigned)>& estimate) {
  int found = 0, covered = 0;
  double sum = 0, square = 0, width = 0;
  for (int seed = 0; seed < cases; ++seed) {
    const IntervalEstimate hurst = estimate(first_seed + static_cast<unsigned>(seed));
    if (!hurst.found()) continue;
    const double off = hurst.value - truth;
    ++found;
    covered += hurst.low <= truth && truth <= hurst.high;
    sum += off, square += off * off, width += (hurst.high - hurst.low) / 2;
  }
  const double n = found;
  std::printf("%-28s H %.1f  %3d of %3d  covered %3d  bias %+.3f  scatter %.3f  half-width %.3f\n",
              name, truth, found, cases, covered, sum / n,
              std::sqrt(std::max(0.0, square / n - sum * sum / n / n)), width / n);
  std::fflush(stdout);
  all.cases += cases, all.found += found, all.covered += covered;
}

Surface surface_of(Field heights) {
  const double nx = double(heights.rows()), ny = double(heights.cols());
  Surface surface{{heights.rows(), heights.cols(), nx * 1e-6, ny * 1e-6}, {}, false, "fractional"};
  surface.heights = 1e-8 * heights;
  return surface;
}

IntervalEstimate of_surface(Field heights, double shortest = 0) {
  return fit_self_affine(power_spectrum(detrended(surface_of(std::move(heights)), Detrend::plane)),
                         shortest)
      .hurst;
}

}  // namespace

int main(int argc, char** argv) {
  const int each = argc > 1 ? std::atoi(argv[1]) : 20;
  const Index line = argc > 2 ? std::atoi(argv[2]) : 4000;
  const Index side = argc > 3 ? std::atoi(argv[3]) : 192;
  if (argc > 4) first_seed = static_cast<unsigned>(std::atoi(argv[4]));
  for (const double hurst : {0.2, 0.5, 0.8}) {
    measure("profile, points", hurst, each, [&](unsigned seed) {
      return fit_profile(surface_of(FractionalBrownian(seed).profile(line, hurst))).hurst;
    });
    measure("profile, 8 points a pixel", hurst, each, [&](unsigned seed) {
      return fit_profile(
                 surface_of(pixel_means(FractionalBrownian(seed).profile(8 * line, hurst), 8)))
          .hurst;
    });
    if (side < 16) continue;
    measure("surface, points", hurst, each, [&](unsigned seed) {
      return of_surface(FractionalBrownian(seed).surface(side, hurst));
    });
    measure("surface, 3 x 3 a pixel", hurst, each, [&](unsigned seed) {
      return of_surface(pixel_means(FractionalBrownian(seed).surface(3 * side, hurst), 3));
    });
    for (const bool known : {true, false})
      measure(known ? "surface, tip that is stated" : "surface, tip that is not", hurst, each,
              [&](unsigned seed) {
                // A cell of 1 µm; the tip's cap is as wide as some cells where H is small.
                const double radius = 4e-6;
                Surface scan = surface_of(FractionalBrownian(seed).surface(side, hurst));
                scan.heights *= 2e-7 / 1e-8 * std::pow(double(side), hurst);
                scan.heights = dilated(scan.heights, 1e-6, radius);
                const double shortest =
                    known ? short_wavelength_limit(scan, {.tip_radius = radius}).wavelength() : 0;
                return of_surface(1e8 * scan.heights, shortest);
              });
  }
  std::printf("covered %d of %d with an interval, of %d\n", all.covered, all.found, all.cases);
}
