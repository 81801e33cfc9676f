// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <salebra/base/error.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/moments.hpp>
#include <salebra/surface/spectrum.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

double integral(const PowerSpectrum& spectrum) {
  double sum = 0;
  for (Index i = 0; i < spectrum.grid.nx; ++i)
    for (Index j = 0; j < spectrum.psd.cols(); ++j)
      sum += spectrum.multiplicity(j) * spectrum.psd(i, j) * spectrum.cell();
  return sum;
}

}  // namespace

TEST_CASE("Parseval: the PSD of a periodic surface integrates to its variance, odd and even grids",
          "[psd]") {
  const Index nx = GENERATE(16, 15), ny = GENERATE(12, 13, 1);
  const Surface surface = white({nx, ny, 2e-3, 3e-3}, true);
  const double rms_height = height_statistics(surface).rms_height;
  const PowerSpectrum spectrum = power_spectrum(surface);
  CHECK(integral(spectrum) == Approx(rms_height * rms_height).epsilon(1e-13));
  const RadialSpectrum radial = radial_spectrum(spectrum);
  CHECK(std::accumulate(radial.modes.begin(), radial.modes.end(), Index{0}) == nx * ny - 1);
  double sum = 0;
  for (std::size_t k = 0; k < radial.modes.size(); ++k) {
    CHECK(radial.modes[k] > 0);
    if (k > 0) CHECK(radial.wavenumber[k] > radial.wavenumber[k - 1]);
    sum += static_cast<double>(radial.modes[k]) * radial.psd[k] * spectrum.cell();
  }
  CHECK(sum == Approx(rms_height * rms_height).epsilon(1e-13));
}

TEST_CASE("A wave has its power in its mode: a²/4 at q and at −q over the cell of a mode",
          "[psd]") {
  const double lx = 2.0, ly = 3.0, amplitude = 0.7;
  const Surface wave = sampled({16, 18, lx, ly}, true, [&](double x, double y) {
    return 5 + amplitude * std::cos(2 * pi * (3 * x / lx - 2 * y / ly) + 1);
  });
  const PowerSpectrum spectrum = power_spectrum(wave);
  // The half-spectrum stores (3, −2) as its conjugate (−3, 2).
  CHECK(spectrum.psd(13, 2) ==
        Approx(amplitude * amplitude / 4 * lx * ly / (4 * pi * pi)).epsilon(1e-13));
  CHECK(spectrum.wavenumber_x(13) == Approx(-2 * pi * 3 / lx));
  CHECK(spectrum.wavenumber_y(2) == Approx(2 * pi * 2 / ly));
}

TEST_CASE("The PSD of a generated surface is the one asked, with a window too", "[psd]") {
  const SelfAffineSpectrum target(
      {.hurst = 0.7, .rolloff = 0.1, .short_cutoff = 8.0 / 512, .rms_height = 1});
  Surface surface = filtered_noise({512, 512, 1, 1}, target, 3);
  const bool windowed = GENERATE(false, true);
  surface.periodic = !windowed;
  const RadialSpectrum radial = radial_spectrum(power_spectrum(surface));
  for (std::size_t k = 0; k < radial.modes.size(); ++k) {
    const double q = radial.wavenumber[k], independent = static_cast<double>(radial.modes[k]) / 2;
    if (independent < 100 || q > 0.85 * 2 * pi * 64) continue;
    if (std::abs(std::log2(q / (2 * pi * 10))) < 0.3) continue;  // the ring with the kink
    INFO("q = " << q);
    // The tolerance includes 4 standard deviations of the mean of n exponential variates (1.94
    // times as wide with the window), and the curvature of C within a ring (2^(1/4) wide: 1 %) and
    // within the window, (1/6)·3.4²/(qL/2π)².
    const double waves = q / (2 * pi);
    const double tolerance = 4 * (windowed ? 1.94 : 1) / std::sqrt(independent) + 0.02 +
                             (windowed ? 2 / (waves * waves) : 0);
    CHECK(radial.psd[k] == Approx(target.density(q, 0)).epsilon(tolerance));
  }
}

TEST_CASE(
    "Under a window the spectrum holds the mean square of the weighted heights about their "
    "weighted mean",
    "[psd]") {
  // A parabola along x makes the weighted mean differ from the mean; the cell is longer along y.
  Surface surface = white({24, 30, 1.0, 2.0}, false);
  for (Index ix = 0; ix < 24; ++ix) surface.heights.row(ix) += 0.01 * double(ix * ix);
  const auto at_edges = [](Index i, Index n) { return 2 * pi * (double(i) + 0.5) / double(n); };
  const auto hann = [&](Index i, Index n) { return 0.5 - 0.5 * std::cos(at_edges(i, n)); };
  const auto blackman = [&](Index i, Index n) {
    return 0.42 - 0.5 * std::cos(at_edges(i, n)) + 0.08 * std::cos(2 * at_edges(i, n));
  };
  const auto welch = [](Index i, Index n) {
    return 1 - std::pow(double(2 * i + 1) / double(n) - 1, 2);
  };
  const auto mean_square = [](const Field& weights, const Field& heights) {
    const double mean = (weights * heights).sum() / weights.sum();
    return (weights * (heights - mean)).square().sum() / weights.square().sum();
  };
  const Window window =
      GENERATE(Window::hann, Window::blackman, Window::welch, Window::radial_hann);
  Field weights(24, 30);
  for (Index ix = 0; ix < 24; ++ix) {
    for (Index iy = 0; iy < 30; ++iy) {
      const double r = std::hypot(double(ix - 12) / 24, double(iy - 15) / 15);
      weights(ix, iy) = window == Window::hann       ? hann(ix, 24) * hann(iy, 30)
                        : window == Window::blackman ? blackman(ix, 24) * blackman(iy, 30)
                        : window == Window::welch    ? welch(ix, 24) * welch(iy, 30)
                        : r < 0.5                    ? 0.5 + 0.5 * std::cos(2 * pi * r)
                                                     : 0;
    }
  }
  const PowerSpectrum spectrum = power_spectrum(surface, window);
  CHECK(integral(spectrum) == Approx(mean_square(weights, surface.heights)).epsilon(1e-12));
  const double w4 = weights.square().square().mean(), w2 = weights.square().mean();
  CHECK(spectrum.correlated_modes == Approx(w4 / (w2 * w2)).epsilon(1e-12));

  if (window == Window::radial_hann) return;
  const ProfilePsd profiles = profile_psd(surface, Axis::x, window);
  double sum = 0, expected = 0;
  for (std::size_t k = 0; k < profiles.psd.size(); ++k)
    sum += double(profiles.modes[k]) * profiles.psd[k] * profiles.step() / 30;
  for (Index iy = 0; iy < 30; ++iy) {
    Field line = surface.heights.col(iy), line_weights(24, 1);
    for (Index ix = 0; ix < 24; ++ix)
      line_weights(ix, 0) = window == Window::hann       ? hann(ix, 24)
                            : window == Window::blackman ? blackman(ix, 24)
                                                         : welch(ix, 24);
    expected += mean_square(line_weights, line) / 30;
  }
  CHECK(sum == Approx(expected).epsilon(1e-12));
}

TEST_CASE("A spectrum needs every height", "[psd]") {
  Surface surface = white({8, 8, 1, 1}, false);
  surface.heights(2, 2) = std::nan("");
  CHECK_THROWS_WITH(power_spectrum(surface), Catch::Contains("power spectrum"));
  CHECK_THROWS_AS(power_spectrum(Surface{}), InvalidInput);
}

TEST_CASE("The Hurst exponent is found, and its interval covers it", "[hurst]") {
  const double hurst = GENERATE(0.3, 0.8);
  const bool periodic = GENERATE(true, false);
  const SelfAffineSpectrum target(
      {.hurst = hurst, .rolloff = 0.2, .short_cutoff = 4.0 / 256, .rms_height = 1});
  int covered = 0, found = 0;
  double sum = 0;
  constexpr int runs = 40;
  for (int seed = 0; seed < runs; ++seed) {
    // A part of a periodic surface is not periodic.
    Surface surface = filtered_noise({256, 256, 1, 1}, target, static_cast<std::uint64_t>(seed));
    if (!periodic)
      surface = {
          {160, 160, 0.625, 0.625}, surface.heights.topLeftCorner(160, 160).eval(), false, ""};
    const HurstEstimate estimate = estimate_hurst(power_spectrum(surface));
    if (!estimate.found()) continue;
    ++found;
    covered += estimate.low <= hurst && hurst <= estimate.high;
    sum += estimate.value;
    CHECK(estimate.wavenumber_max <= 2 * pi * 64 * 1.0001);
  }
  INFO("covered " << covered << " of " << found << ", mean " << sum / found);
  // An interval that covers 0 … 1 is not shown; a few small parts give one for H = 0.3.
  CHECK(found >= runs - 3);
  CHECK(sum / found == Approx(hurst).margin(0.03));
  // 95 % of 40 are 38; at 93 %, 33 or fewer have a probability of 1 in 100.
  CHECK(covered >= 33);
}

TEST_CASE("Where there is no power law there is no Hurst exponent", "[hurst]") {
  CHECK_FALSE(estimate_hurst(power_spectrum(white({128, 128, 1, 1}, true))).found());
  CHECK_FALSE(estimate_hurst(power_spectrum(white({5, 4, 1, 1}, true))).found());
  Surface flat = white({64, 64, 1, 1}, true);
  flat.heights.setZero();
  CHECK_FALSE(estimate_hurst(power_spectrum(flat)).found());
  const Surface wave =
      sampled({64, 64, 1, 1}, true, [](double x, double) { return std::cos(2 * pi * 5 * x); });
  CHECK_FALSE(estimate_hurst(power_spectrum(wave)).found());
}

TEST_CASE("Fixed amplitudes give the Hurst exponent of the spectrum itself", "[hurst]") {
  // A ring that contains both sides of the kink is excluded, wherever the kink lies in it.
  const double rolloff = GENERATE(0.25, 0.11, 0.093);
  const SelfAffineSpectrum target(
      {.hurst = 0.5, .rolloff = rolloff, .short_cutoff = 8.0 / 512, .rms_height = 1});
  const HurstEstimate estimate =
      estimate_hurst(power_spectrum(random_phase({512, 512, 1, 1}, target, 1)));
  // Every mode lies on the power law, so only rounding affects the fit.
  CHECK(estimate.value == Approx(0.5).epsilon(1e-6));
  CHECK(estimate.high - estimate.low < 1e-6);
}
