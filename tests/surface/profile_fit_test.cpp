// SPDX-License-Identifier: GPL-3.0-or-later
#include <gsl/gsl_integration.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/profile_fit.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// Row `iy` of a surface as a profile along x.
Surface line(const Surface& surface, Index iy, Index points) {
  const double step = surface.grid.dx();
  Surface profile{{points, 1, double(points) * step, step}, Field(points, 1), false, "line"};
  profile.heights = surface.heights.block(0, iy, points, 1);
  return profile;
}

Surface rough(double hurst, double rolloff, double short_cutoff, std::uint64_t seed) {
  SelfAffineParameters parameters;
  parameters.hurst = hurst;
  parameters.rolloff = rolloff;
  parameters.short_cutoff = short_cutoff;
  parameters.rms_slope = 0.1;
  return filtered_noise({8192, 128, 8192e-6, 128e-6}, SelfAffineSpectrum(parameters), seed);
}

}  // namespace

TEST_CASE("The spectrum of a profile is the integral of that of its surface", "[profile]") {
  struct Case {
    double q, hurst, rolloff, cutoff;
  };
  for (const Case& at : {Case{2, 0.8, 3, 50},
                         {3, 0.3, 3, 50},
                         {10, 0.5, 3, 50},
                         {49, 1, 3, 50},
                         {0.01, 0.7, 3, 50}}) {
    INFO(at.q);
    gsl_function law{
        [](double k, void* data) {
          const Case& c = *static_cast<Case*>(data);
          const double p = std::hypot(c.q, k);
          return p > c.cutoff ? 0 : p < c.rolloff ? 1 : std::pow(p / c.rolloff, -2 - 2 * c.hurst);
        },
        const_cast<Case*>(&at)};
    // The plateau up to the kink, and the power law from there to the end.
    const double kink = at.q < at.rolloff ? std::sqrt(at.rolloff * at.rolloff - at.q * at.q) : 0;
    const double end = std::sqrt(at.cutoff * at.cutoff - at.q * at.q);
    double after, error;
    gsl_integration_workspace* work = gsl_integration_workspace_alloc(200);
    gsl_integration_qag(&law, kink, end, 0, 1e-9, 200, GSL_INTEG_GAUSS61, work, &after, &error);
    gsl_integration_workspace_free(work);
    // The tolerance is that of the 16-point rule, for a power of the cosine that vanishes at the
    // end.
    CHECK(profile_density(at.q, at.hurst, at.rolloff, at.cutoff) ==
          Approx(2 * (kink + after)).epsilon(2e-5));
  }
  CHECK(profile_density(51, 0.8, 3, 50) == 0);
}

TEST_CASE("A profile of a generated surface gives the law that made it", "[profile]") {
  const double hurst = GENERATE(0.4, 0.8);
  const double rolloff = 400e-6, short_cutoff = 8e-6;
  int inside = 0, lines = 0, cutoffs = 0;
  double sum = 0, slope = 0;
  const Surface surface = rough(hurst, rolloff, short_cutoff, 1);
  for (Index iy = 0; iy < 128; iy += 12) {
    const ProfileFit fit = fit_profile(line(surface, iy, 6000));
    INFO("H " << fit.hurst.low << " " << fit.hurst.value << " " << fit.hurst.high);
    REQUIRE(fit.hurst.found());
    CHECK(fit.hurst.low < fit.hurst.value);
    CHECK(fit.hurst.value < fit.hurst.high);
    inside += fit.hurst.low <= hurst && hurst <= fit.hurst.high;
    sum += fit.hurst.value;
    slope += fit.surface_slope * fit.surface_slope;
    // The profile is fifteen roll-offs long, so the plateau has some ten waves, too few to be seen
    // in most lines.
    if (!std::isnan(fit.rolloff)) CHECK(std::abs(std::log(fit.rolloff / rolloff)) < std::log(2.5));
    if (!std::isnan(fit.short_cutoff)) {
      ++cutoffs;
      // A bin is 12 % wide, and the end of the spectrum of a profile is smeared compared with its
      // surface.
      CHECK(fit.short_cutoff == Approx(short_cutoff).epsilon(0.125));
    }
    ++lines;
  }
  // At 95 % coverage, fewer than 8 of 11 have a probability of 0.2 %.
  CHECK(inside >= 8);
  CHECK(cutoffs >= 9);
  CHECK(sum / lines == Approx(hurst).margin(0.05));
  // For waves of eight points, differences of neighbours underestimate the slope by 2 %.
  CHECK(std::sqrt(slope / lines) == Approx(0.1).epsilon(0.05));
}

TEST_CASE("A profile of sixty roll-offs shows where its plateau ends", "[profile]") {
  const double rolloff = 100e-6;
  const Surface surface = rough(0.8, rolloff, 8e-6, 1);
  int lines = 0, rolloffs = 0;
  for (Index iy = 0; iy < 128; iy += 12) {
    const ProfileFit fit = fit_profile(line(surface, iy, 6000));
    ++lines;
    if (std::isnan(fit.rolloff)) continue;
    ++rolloffs;
    CHECK(std::abs(std::log(fit.rolloff / rolloff)) < std::log(2.5));
  }
  // Ten of eleven are seen. Neighbouring lines are correlated, so the test only requires most of
  // them.
  CHECK(rolloffs > lines / 2);
}

TEST_CASE("What a profile does not show is not found in it", "[profile]") {
  // The roll-off is far beyond the profile, and the sampling is coarser than the shortest wave.
  const Surface surface = rough(0.7, 8000e-6, 2e-6, 3);
  int rolloffs = 0, cutoffs = 0;
  for (Index iy = 0; iy < 128; iy += 16) {
    const ProfileFit fit = fit_profile(line(surface, iy, 1024));
    rolloffs += !std::isnan(fit.rolloff);
    cutoffs += !std::isnan(fit.short_cutoff);
    CHECK(fit.hurst.value == Approx(0.7).margin(0.2));
  }
  CHECK(rolloffs <= 2);
  CHECK(cutoffs <= 2);
  const Surface flat = sampled({100, 1, 100, 1}, false, [](double x, double) { return 3 * x; });
  CHECK_FALSE(fit_profile(flat).hurst.found());
  CHECK(fit_profile(flat).rms_slope < 1e-12);
  CHECK_THROWS_AS(fit_profile(rough(0.7, 80e-6, 8e-6, 1)), InvalidInput);
}
