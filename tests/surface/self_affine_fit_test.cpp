// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <salebra/base/error.hpp>
#include <salebra/generators/composite.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/self_affine_fit.hpp>
#include <utility>
#include <vector>

#include "base/fft.hpp"
#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// The law of a surface with a lay: C ∝ max(u, u_r)^(−2−2H) up to u_s, in the elliptic wave number
/// u. Wavelengths are those across the lay, in units of the side of the crop.
struct Lay {
  double hurst, rolloff, short_cutoff, stretch, angle;
};

/// A crop of n × n points of a field of twice the side, which is white noise times the square root
/// of the law. blur: standard deviation of the point spread function of a lens, in points.
Surface crop_with_lay(const Lay& lay, Index n, unsigned seed, double blur = 0) {
  const Index size = 2 * n;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Field heights(size, size);
  for (double& height : heights.reshaped()) height = normal(engine);
  RealFft2D<double> fft(size, size);
  std::vector<std::complex<double>> modes(static_cast<std::size_t>(size * fft.modes_y()));
  fft.forward(heights.data(), modes.data());
  const double c = std::cos(lay.angle), s = std::sin(lay.angle);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < fft.modes_y(); ++j) {
      const double qx = pi * double(2 * i > size ? i - size : i), qy = pi * double(j);
      const double u = std::hypot(c * qy - s * qx, lay.stretch * (c * qx + s * qy));
      const double law = u > 2 * pi / lay.short_cutoff
                             ? 0
                             : std::pow(std::max(u, 2 * pi / lay.rolloff), -1 - lay.hurst);
      modes[static_cast<std::size_t>(i * fft.modes_y() + j)] *=
          law * std::exp(-(qx * qx + qy * qy) * blur * blur / 2 / double(n * n));
    }
  fft.backward(modes.data(), heights.data());
  return detrended({{n, n, 1, 1}, heights.topLeftCorner(n, n).eval(), false, ""}, Detrend::plane);
}

bool holds(const IntervalEstimate& interval, double truth) {
  return interval.low <= truth && truth <= interval.high;
}

}  // namespace

TEST_CASE("The laws across and along a lay have limits that hold", "[self_affine]") {
  Lay lay{.hurst = 0.7, .rolloff = 1.0 / 12, .short_cutoff = 2.5 / 256, .stretch = 3, .angle = 0};
  constexpr int surfaces = 10;
  int across = 0, along = 0, rolloffs = 0, held_rolloffs = 0, mean = 0, ends = 0;
  for (unsigned seed = 1; seed <= surfaces; ++seed) {
    // Along the grid and between its axes in turn.
    lay.angle = seed % 2 == 0 ? 0 : 0.5;
    const Surface surface = crop_with_lay(lay, 256, seed);
    const PowerSpectrum spectrum = power_spectrum(surface);
    const auto fit = fit_self_affine(spectrum, surface_lay(surface));
    across += holds(fit.across.hurst, lay.hurst);
    along += !fit.along.hurst.found() || holds(fit.along.hurst, lay.hurst);
    for (const auto& [found, truth] : {std::pair(fit.across.rolloff, lay.rolloff),
                                       {fit.along.rolloff, lay.stretch * lay.rolloff}}) {
      rolloffs += found.found();
      held_rolloffs += holds(found, truth);
    }
    ends += holds(fit.across.short_cutoff, lay.short_cutoff);
    mean += holds(fit_self_affine(spectrum).rolloff, lay.rolloff);
  }
  INFO("across " << across << ", along " << along << ", roll-off " << held_rolloffs << " of "
                 << rolloffs << ", cut-off " << ends << ", mean " << mean);
  // At a coverage of 0.95, fewer than 7 of 10 have a probability of 0.001.
  CHECK(across >= 7);
  CHECK(along >= 7);
  CHECK(rolloffs >= 5);
  CHECK(held_rolloffs >= 0.75 * rolloffs);
  CHECK(ends >= 7);
  // The mean over all directions has a roll-off between those of both directions.
  CHECK(mean < 5);
}

TEST_CASE("A lens changes neither the roll-off nor the end of a law that it does not show",
          "[self_affine]") {
  const Lay isotropic{
      .hurst = 0.8, .rolloff = 1.0 / 12, .short_cutoff = 2.0 / 256, .stretch = 1, .angle = 0};
  int found = 0, held = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const SelfAffineFit fit =
        fit_self_affine(power_spectrum(crop_with_lay(isotropic, 256, seed, 1)));
    CHECK_FALSE(fit.short_cutoff.found());
    found += fit.rolloff.found();
    held += holds(fit.rolloff, isotropic.rolloff);
  }
  INFO(held << " of " << found);
  CHECK(found >= 6);
  CHECK(held >= 0.75 * found);
}

TEST_CASE("What a lens blurs across the lay does not enter the law along it", "[self_affine]") {
  const Lay lay{
      .hurst = 0.6, .rolloff = 1.0 / 20, .short_cutoff = 1.0 / 256, .stretch = 5, .angle = 0.3};
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Surface surface = crop_with_lay(lay, 256, seed, 2);
    const auto fit = fit_self_affine(power_spectrum(surface), surface_lay(surface));
    INFO(fit.across.hurst.value << ", " << fit.along.hurst.value);
    CHECK((!fit.along.hurst.found() || holds(fit.along.hurst, lay.hurst)));
  }
  CHECK_THROWS_AS(fit_self_affine(power_spectrum(white({64, 64, 1, 1}, true)), SurfaceLay{}),
                  InvalidInput);
}

TEST_CASE("The 95 % intervals of H and of the roll-off hold the truth for 90 to 99 of 100 surfaces",
          "[self_affine]") {
  constexpr double hurst = 0.7, rolloff = 0.25, short_cutoff = 3.0 / 128;
  const SelfAffineSpectrum target(
      {.hurst = hurst, .rolloff = rolloff, .short_cutoff = short_cutoff, .rms_height = 1});
  int found = 0, covered = 0, found_rolloff = 0, covered_rolloff = 0, ended = 0;
  constexpr int surfaces = 100;
  for (int seed = 0; seed < surfaces; ++seed) {
    const SelfAffineFit fit = fit_self_affine(
        power_spectrum(filtered_noise({128, 128, 1, 1}, target, static_cast<std::uint64_t>(seed))));
    if (fit.hurst.found()) {
      ++found;
      covered += fit.hurst.low <= hurst && hurst <= fit.hurst.high;
    }
    if (fit.rolloff.found()) {
      ++found_rolloff;
      covered_rolloff += fit.rolloff.low <= rolloff && rolloff <= fit.rolloff.high;
    }
    // Without noise and window, the spectrum ends between two modes.
    ended += fit.short_cutoff.low <= short_cutoff * 1.0001 &&
             short_cutoff <= fit.short_cutoff.high * 1.0001;
  }
  INFO("H: " << covered << " of " << found << ", roll-off: " << covered_rolloff << " of "
             << found_rolloff << ", end: " << ended);
  CHECK(found > 0.95 * surfaces);
  CHECK(found_rolloff > 0.95 * surfaces);
  CHECK(covered >= 0.90 * found);
  CHECK(covered <= 0.99 * found);
  CHECK(covered_rolloff >= 0.90 * found_rolloff);
  CHECK(covered_rolloff <= 0.99 * found_rolloff);
  CHECK(ended >= 0.99 * found);
}

TEST_CASE("A crop that is not periodic has honest intervals of H too", "[self_affine]") {
  // The window correlates neighbouring modes. Intervals from the scatter of few rings alone would
  // be too short: they covered 88 to 90 %.
  constexpr double hurst = 0.5;
  const SelfAffineSpectrum target(
      {.hurst = hurst, .rolloff = 0.25, .short_cutoff = 3.0 / 128, .rms_height = 1});
  int found = 0, covered = 0, ended = 0;
  constexpr int surfaces = 100;
  for (int seed = 0; seed < surfaces; ++seed) {
    const Surface periodic =
        filtered_noise({128, 128, 1, 1}, target, static_cast<std::uint64_t>(seed));
    const SelfAffineFit fit = fit_self_affine(power_spectrum(crop_surface(periodic, 0, 0, 96, 96)));
    const HurstEstimate& interval = fit.hurst;
    if (!interval.found()) continue;
    ++found;
    ended += fit.short_cutoff.low <= 3.0 / 128 && 3.0 / 128 <= fit.short_cutoff.high;
    covered += interval.low <= hurst && hurst <= interval.high;
  }
  INFO(covered << " of " << found << ", end: " << ended);
  // The window smears the end of the spectrum over two modes, which the interval includes.
  CHECK(ended >= 0.99 * found);
  CHECK(found >= 0.95 * surfaces);
  CHECK(covered >= 0.90 * found);
  CHECK(covered <= 0.99 * found);
}

TEST_CASE("Fixed amplitudes give the cut-offs of the spectrum itself", "[self_affine]") {
  const SelfAffineSpectrum target(
      {.hurst = 0.5, .rolloff = 0.1, .short_cutoff = 4.0 / 256, .rms_height = 1});
  const SelfAffineFit fit =
      fit_self_affine(power_spectrum(random_phase({256, 256, 1, 1}, target, 1)));
  // Rings are 1/64 wide in ln q; one of them contains the kink.
  CHECK(fit.rolloff.value == Approx(0.1).epsilon(0.01));
  CHECK(fit.short_cutoff.value == Approx(4.0 / 256).epsilon(0.01));
}

TEST_CASE("A law without a plateau has no roll-off, and white heights no cut-off",
          "[self_affine]") {
  const SelfAffineSpectrum law(
      {.hurst = 0.8, .rolloff = 1, .short_cutoff = 2.0 / 128, .rms_height = 1});
  const SelfAffineFit fit =
      fit_self_affine(power_spectrum(filtered_noise({128, 128, 1, 1}, law, 3)));
  CHECK(fit.hurst.found());
  CHECK_FALSE(fit.rolloff.found());
  const SelfAffineFit none = fit_self_affine(power_spectrum(white({64, 64, 1, 1}, true)));
  CHECK_FALSE(none.rolloff.found());
  CHECK_FALSE(none.short_cutoff.found());
}

TEST_CASE("Neighbours that a window has made alike widen the interval of the roll-off",
          "[self_affine]") {
  const SelfAffineSpectrum target(
      {.hurst = 0.8, .rolloff = 0.08, .short_cutoff = 4.0 / 256, .rms_height = 1});
  Surface surface = filtered_noise({256, 256, 1, 1}, target, 4);
  surface.periodic = false;
  PowerSpectrum spectrum = power_spectrum(surface);
  REQUIRE(spectrum.correlated_modes > 3);
  const auto honest = fit_self_affine(spectrum).rolloff;
  // If twice as many modes count as one, the interval is about √2 times as wide.
  spectrum.correlated_modes *= 2;
  const auto cautious = fit_self_affine(spectrum).rolloff;
  REQUIRE((honest.found() && cautious.found()));
  CHECK(cautious.high - cautious.low > 1.2 * (honest.high - honest.low));
}

TEST_CASE("The fitted range of H leaves out the waves that a window mixes, and counts its modes",
          "[self_affine]") {
  const SelfAffineSpectrum target(
      {.hurst = 0.8, .rolloff = 1, .short_cutoff = 4.0 / 128, .rms_height = 1});
  Surface surface = filtered_noise({128, 128, 1, 1}, target, 2);
  surface.periodic = GENERATE(true, false);
  const PowerSpectrum spectrum = power_spectrum(surface);
  const HurstEstimate fit = estimate_hurst(spectrum);
  REQUIRE(fit.found());
  const double longest = 2 * std::numbers::pi;
  if (!surface.periodic) CHECK(fit.wavenumber_min > 3 * longest);
  Index modes = 0;
  for (Index i = 0; i < 128; ++i) {
    for (Index j = 0; j < spectrum.psd.cols(); ++j) {
      const double q = std::hypot(spectrum.wavenumber_x(i), spectrum.wavenumber_y(j));
      // The limits are the wave numbers of the outermost modes.
      if (q > fit.wavenumber_min * (1 - 1e-9) && q < fit.wavenumber_max * (1 + 1e-9))
        modes += static_cast<Index>(spectrum.multiplicity(j));
    }
  }
  CHECK(fit.modes == modes);
}
