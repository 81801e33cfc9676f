// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/psd_convention.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/surface/detrend.hpp>
#include <salebra/surface/moments.hpp>

#include "test_surfaces.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// Trapezoidal rule in ln q, as a reader of a log–log table would use.
double integral(const std::vector<double>& q, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t k = 1; k < q.size(); ++k)
    sum += (q[k] * values[k] + q[k - 1] * values[k - 1]) / 2 * std::log(q[k] / q[k - 1]);
  return sum;
}

}  // namespace

TEST_CASE("The mean square height is the same in every convention", "[psd]") {
  // A finely sampled Gaussian spectrum, without a grid or rings.
  const Grid2D grid{100, 100, 2e-3, 2e-3};
  const double rms = 3e-6, length = 1e-4;
  RadialSpectrum spectrum;
  for (double q = 1e1; q < 1e5; q *= 1.01) {
    spectrum.wavenumber.push_back(q);
    spectrum.psd.push_back(rms * rms * length * length / (4 * pi) *
                           std::exp(-q * q * length * length / 4));
    spectrum.modes.push_back(1);
  }
  const auto mean_square = [&](PsdConvention convention) {
    const ConvertedPsd psd = converted(spectrum, grid, convention);
    std::vector<double> ring(psd.psd);
    if (convention != PsdConvention::gwyddion)
      for (std::size_t k = 0; k < ring.size(); ++k) ring[k] *= psd.wavenumber[k];
    const double sum = integral(psd.wavenumber, ring);
    if (convention == PsdConvention::gwyddion) return sum;
    return convention == PsdConvention::surface_topography ? sum / (2 * pi) : 2 * pi * sum;
  };
  // Steps of 1 % and the disc below the first wave number cause errors of 1e-5.
  for (const auto convention :
       {PsdConvention::salebra, PsdConvention::surface_topography, PsdConvention::gwyddion,
        PsdConvention::tamaas, PsdConvention::rfgen})
    CHECK(mean_square(convention) == Approx(rms * rms).epsilon(1e-4));
  // A wave of ten cells has 1/10 cycles per sample and 10 waves per side.
  spectrum.wavenumber = {2 * pi / (10 * grid.dx())};
  spectrum.psd = {1};
  CHECK(converted(spectrum, grid, PsdConvention::rfgen).wavenumber.front() == Approx(0.1));
  CHECK(converted(spectrum, grid, PsdConvention::tamaas).wavenumber.front() == Approx(10));
  CHECK_THROWS_AS(converted(spectrum, {100, 100, 2, 1}, PsdConvention::tamaas), InvalidInput);
}

TEST_CASE("Profiles of a periodic surface: their spectrum is that of the surface summed across",
          "[psd]") {
  const Index nx = GENERATE(16, 17), ny = GENERATE(12, 13);
  const Surface surface = white({nx, ny, 2e-3, 3e-3}, true);
  const PowerSpectrum area = power_spectrum(surface);
  const ProfilePsd along_x = profile_psd(surface, Axis::x);
  REQUIRE(along_x.wavenumber.size() == static_cast<std::size_t>(nx / 2));
  CHECK(along_x.profiles == ny);
  for (Index i = 1; i <= nx / 2; ++i) {
    double sum = 0;
    for (Index j = 0; j < area.psd.cols(); ++j) {
      // Add both (i, j) and (i, −j); the latter is the conjugate of (−i, j).
      sum += area.psd(i, j);
      if (area.multiplicity(j) == 2) sum += area.psd((nx - i) % nx, j);
    }
    const auto k = static_cast<std::size_t>(i - 1);
    CHECK(along_x.psd[k] == Approx(sum * 2 * pi / surface.grid.ly).epsilon(1e-12));
    CHECK(along_x.modes[k] == (2 * i == nx ? 1 : 2) * ny);
  }
}

TEST_CASE("Parseval: the spectrum of profiles holds their variance about their means", "[psd]") {
  const Index n = GENERATE(20, 21);
  const Surface surface = white({n, 6, 2e-3, 3e-3}, true);
  double variance = 0;
  for (Index iy = 0; iy < 6; ++iy)
    variance += (surface.heights.col(iy) - surface.heights.col(iy).mean()).square().mean() / 6;
  const ProfilePsd psd = profile_psd(surface, Axis::x);
  double sum = 0;
  for (std::size_t k = 0; k < psd.psd.size(); ++k)
    sum += static_cast<double>(psd.modes[k]) * psd.psd[k] * psd.step() / 6;
  CHECK(sum == Approx(variance).epsilon(1e-13));
  // The other convention is twice as large over q > 0.
  const ConvertedPsd other = converted(psd, PsdConvention::surface_topography);
  CHECK(other.psd[3] == Approx(2 * pi * psd.psd[3]));
}

TEST_CASE("Every window keeps the expectation of short waves", "[psd]") {
  const auto window =
      GENERATE(Window::none, Window::hann, Window::blackman, Window::welch, Window::radial_hann);
  // White heights have C = ⟨h²⟩ dx dy/(2π)² at every wave vector.
  const Surface surface = white({120, 90, 2.0, 2.0}, false);
  const RadialSpectrum radial = radial_spectrum(power_spectrum(surface, window));
  const double exact = 1.0 / 3 * surface.grid.cell_area() / (4 * pi * pi);
  double sum = 0, modes = 0;
  for (std::size_t k = 0; k < radial.modes.size(); ++k) {
    sum += static_cast<double>(radial.modes[k]) * radial.psd[k];
    modes += static_cast<double>(radial.modes[k]);
  }
  // Four standard deviations of the mean of w²h² over 10800 points are 4·√(12/10800), with
  // ⟨w⁴⟩ ≈ 4 to 7 and ⟨h⁴⟩/⟨h²⟩² = 1.8.
  CHECK(sum / modes == Approx(exact).epsilon(window == Window::none ? 0.04 : 0.14));
  const ProfilePsd profiles = profile_psd(surface, Axis::x, window);
  double mean = 0;
  for (const double density : profiles.psd)
    mean += density / static_cast<double>(profiles.psd.size());
  CHECK(mean == Approx(1.0 / 3 * surface.grid.dx() / (2 * pi)).epsilon(0.08));
}

TEST_CASE("A window takes the leakage of a tilt out of the short waves", "[psd]") {
  // A plane has no short waves. Its steps at the edges give C ∝ q⁻² along the axes, or q⁻⁶ with a
  // Hann window.
  const Surface plane = sampled({128, 128, 1, 1}, false, [](double x, double) { return x; });
  const auto high = [&](Window window) {
    const ProfilePsd psd = profile_psd(plane, Axis::x, window);
    return psd.psd[50] / psd.psd[0];
  };
  CHECK(high(Window::none) > 1e-4);
  CHECK(high(Window::hann) < 1e-9);
  CHECK(high(Window::blackman) < 1e-9);
  // The Welch window ends with a slope, so C ∝ q⁻⁴ with 50⁻⁴ = 1.6e-7; the first mode of a plane
  // deviates from that law.
  CHECK(high(Window::welch) < 1e-6);
}

TEST_CASE("Neighbouring modes count as one as often as the window mixes them", "[psd]") {
  const Surface surface = white({64, 80, 1, 1}, false);
  CHECK(power_spectrum(surface, Window::none).correlated_modes == 1);
  // ⟨v⁴⟩/⟨v²⟩² = (35/128)/(9/64) along each axis, exact for more than four points.
  CHECK(power_spectrum(surface).correlated_modes == Approx(std::pow(35.0 / 18, 2)).epsilon(1e-12));
}
