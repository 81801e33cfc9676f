// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/profile_fit.hpp>
#include <salebra/surface/scale_dependence.hpp>
#include <salebra/surface/self_affine_fit.hpp>

#include "fractional_brownian.hpp"
#include "rough_patches.hpp"

using namespace salebra;

namespace {

constexpr double cell = 1e-6;

Surface measured(const Field& heights) {
  Surface surface{{heights.rows(), heights.cols(), double(heights.rows()) * cell,
                   double(heights.cols()) * cell},
                  heights,
                  false,
                  "measured"};
  return surface;
}

HurstEstimate of_map(const Surface& scan, double shortest = 0) {
  return estimate_hurst(power_spectrum(detrended(scan, Detrend::plane)), shortest);
}

struct Coverage {
  int found = 0, covered = 0;
  double width = 0;
  void add(const IntervalEstimate& hurst, double truth) {
    if (!hurst.found()) return;
    ++found;
    covered += hurst.low <= truth && truth <= hurst.high;
    width += (hurst.high - hurst.low) / 2;
  }
};

}  // namespace

TEST_CASE("Intervals of H hold the truth of exact fractional Brownian profiles", "[hurst]") {
  // Points alias waves shorter than two cells; pixels attenuate the others.
  const Index pixel = GENERATE(1, 8);
  Coverage all;
  for (const double hurst : {0.2, 0.5, 0.8})
    for (unsigned seed = 0; seed < 12; ++seed)
      all.add(fit_profile(
                  measured(1e-9 * pixel_means(FractionalBrownian(seed).profile(4000 * pixel, hurst),
                                              pixel)))
                  .hurst,
              hurst);
  INFO(all.covered << " of " << all.found << ", half-width " << all.width / all.found);
  CHECK(all.found == 36);
  // At 95 %, fewer than 31 of 36 have a probability of 1 %. With a fixed floor and attenuation, the
  // interval covered only 10 of the 36 with points.
  CHECK(all.covered >= 31);
  // The interval must also be narrow enough to be useful.
  CHECK(all.width / all.found < 0.15);
}

TEST_CASE("Intervals of H hold the truth of fractional Brownian maps of points and of pixels",
          "[hurst]") {
  const Index pixel = GENERATE(1, 3);
  Coverage all;
  for (const double hurst : {0.2, 0.5, 0.8})
    for (unsigned seed = 0; seed < 4; ++seed)
      all.add(of_map(measured(
                  1e-8 * pixel_means(FractionalBrownian(seed).surface(128 * pixel, hurst), pixel))),
              hurst);
  INFO(all.covered << " of " << all.found << ", half-width " << all.width / all.found);
  // An interval that covers 0 … 1 is not shown; a map of 128² may give one for H = 0.2.
  CHECK(all.found >= 11);
  // At 95 %, fewer than 9 of 11 have a probability of 2 %.
  CHECK(all.covered >= 9);
}

TEST_CASE("Waves that the instrument does not show take no part in H", "[hurst]") {
  const double hurst = 0.5, shortest = 5 * cell;
  const Surface line = measured(1e-9 * FractionalBrownian(3).profile(4000, hurst));
  // A mean over 13 cells removes the shorter waves.
  Surface blurred = line;
  for (Index i = 6; i + 6 < line.grid.nx; ++i)
    blurred.heights(i, 0) = line.heights.block(i - 6, 0, 13, 1).mean();
  const ProfileFit fit = fit_profile(blurred, 30 * cell);
  CHECK(fit.hurst.low <= hurst);
  CHECK(fit.hurst.high >= hurst);
  CHECK(std::isnan(fit.short_cutoff));

  const Surface scan = measured(1e-8 * FractionalBrownian(3).surface(128, hurst));
  const HurstEstimate whole = of_map(scan), part = of_map(scan, shortest);
  CHECK(whole.wavenumber_max > 2 * std::numbers::pi / shortest);
  REQUIRE(part.found());
  CHECK(part.wavenumber_max <= 2 * std::numbers::pi / shortest);
  // No usable waves remain.
  CHECK_FALSE(of_map(scan, 60 * cell).found());
  CHECK_FALSE(fit_profile(line, 1).hurst.found());
}

TEST_CASE("Waves that a tip which is not stated has rounded take no part in H", "[hurst]") {
  // Tip radius over the radius of curvature of the unscanned heights at one cell. Such tips shift H
  // by up to 0.3.
  const double severity = GENERATE(3, 10);
  Coverage all;
  int asymmetric = 0;
  const auto scanned = [&](Surface surface) {
    const ScaleDependence scales = scale_dependence(surface, Axis::x);
    surface.heights = dilated(surface.heights, cell, severity / scales.profile_curvature[0]);
    asymmetric += power_spectrum(surface).asymmetric_wavelength >= 8 * cell;
    return surface;
  };
  for (const double hurst : {0.2, 0.5, 0.8})
    for (unsigned seed = 0; seed < 6; ++seed)
      all.add(fit_profile(scanned(measured(1e-8 * FractionalBrownian(seed).profile(4000, hurst))))
                  .hurst,
              hurst);
  for (const double hurst : {0.2, 0.5, 0.8})
    all.add(of_map(scanned(measured(1e-8 * FractionalBrownian(7).surface(192, hurst)))), hurst);
  INFO(all.covered << " of " << all.found << ", asymmetric " << asymmetric);
  CHECK(asymmetric == 21);
  // At 95 %, fewer than 15 of 18 profiles have a probability of 1 %; if all waves are used, 11 and
  // 7 of the 21 are covered. In most cases a map of 192 points keeps too few waves for an interval.
  CHECK(all.found >= 14);
  CHECK(all.covered >= all.found - 3);
}

TEST_CASE("Peaks and valleys of Gaussian heights do not differ, those of other surfaces do",
          "[hurst]") {
  int asymmetric = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    asymmetric +=
        power_spectrum(measured(FractionalBrownian(seed).surface(64, 0.7))).asymmetric_wavelength >
        0;
    asymmetric += power_spectrum(measured(FractionalBrownian(seed).profile(2000, 0.7)))
                      .asymmetric_wavelength > 0;
  }
  // Forty tests of some ten lags with a probability of 3e-4 each: two failures have a probability
  // of 1 %.
  CHECK(asymmetric <= 1);
  // Cusps in valleys along y only, and a plane and a bow, which have no peaks.
  const Index n = 96;
  Field heights = FractionalBrownian(3).surface(n, 0.7);
  const double rough =
      std::sqrt((heights.rightCols(n - 1) - heights.leftCols(n - 1)).square().mean());
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) heights(i, j) += rough * (0.1 * double(i) + 1e-4 * double(i * i));
  CHECK(power_spectrum(measured(heights)).asymmetric_wavelength == 0);
  for (Index j = 0; j < n; j += 5) heights.col(j) -= 8 * rough;
  Surface grooved = measured(heights);
  CHECK(power_spectrum(grooved).asymmetric_wavelength > 0);
  grooved.heights = Field(heights.transpose());
  CHECK(power_spectrum(grooved).asymmetric_wavelength > 0);
  // Periodic surfaces are generated, so no instrument has distorted them.
  grooved.periodic = true;
  CHECK(power_spectrum(grooved).asymmetric_wavelength == 0);
}

TEST_CASE("A tip that is stated does not shift H", "[hurst]") {
  const double hurst = 0.5, radius = 4e-6;
  Coverage all;
  for (unsigned seed = 0; seed < 4; ++seed) {
    Surface scan = measured(2e-6 * FractionalBrownian(seed).surface(128, hurst));
    scan.heights = dilated(scan.heights, cell, radius);
    all.add(of_map(scan, short_wavelength_limit(scan, {.tip_radius = radius}).wavelength()), hurst);
  }
  // At 95 %, one or none of four has a probability of 5e-4.
  CHECK(all.covered >= all.found - 2);
}
