// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/surface/plain_average.hpp>

using namespace salebra;
using std::numbers::pi;

namespace {

/// a cos(2πkx/l) on n × m points of a square.
Field wave(Index n, Index m, double amplitude, int k) {
  Field heights(n, m);
  for (Index i = 0; i < n; ++i)
    heights.row(i).setConstant(
        amplitude * std::cos(2 * pi * k * static_cast<double>(i) / static_cast<double>(n)));
  return heights;
}

}  // namespace

TEST_CASE("A wave stands in its bin of the plain average with its power", "[plain_average]") {
  // Hann's window distributes a wave of mode k over k and k ± 1 in the shares 4/6, 1/6 and 1/6;
  // ⟨h²⟩ = a²/2 = 2Σ C₁ dq.
  constexpr double amplitude = 1e-8, length = 1e-4;
  for (const Index m : {Index{1}, Index{8}, Index{9}}) {
    const PlainSpectrum spectrum =
        plain_spectrum(wave(128, m, amplitude, 2), {128, m, length, length});
    // Each of the modes 1, 2 and 3 has its own bin.
    double power = 0;
    for (std::size_t at = 0; at < 3; ++at) {
      CHECK(spectrum.wavenumber[at] ==
            Approx(2 * pi * static_cast<double>(at + 1) / length).epsilon(1e-12));
      power += 2 * spectrum.psd[at] * 2 * pi / length;
    }
    CHECK(power == Approx(amplitude * amplitude / 2).epsilon(1e-10));
  }
}

TEST_CASE("The plain average is the mean of what stands in a bin", "[plain_average]") {
  const PlainSpectrum coarse = plain_spectrum(wave(64, 64, 1e-7, 3), {64, 64, 1e-3, 1e-3}),
                      fine = plain_spectrum(wave(64, 64, 3e-9, 4), {64, 64, 1e-4, 1e-4});
  const PlainSpectrum both = plain_average({coarse, fine});
  // The same lattice a decade apart has the same bins, shifted by ten.
  CHECK(fine.bin.front() == coarse.bin.front() + 10);
  CHECK(both.bin.size() < coarse.bin.size() + fine.bin.size());
  const auto value = [](const PlainSpectrum& spectrum, Index bin) {
    for (std::size_t at = 0; at < spectrum.bin.size(); ++at)
      if (spectrum.bin[at] == bin) return spectrum.psd[at];
    return -1.0;
  };
  int shared = 0;
  for (std::size_t at = 0; at < both.bin.size(); ++at) {
    const double one = value(coarse, both.bin[at]), other = value(fine, both.bin[at]);
    shared += one >= 0 && other >= 0;
    const double mean = one < 0 ? other : other < 0 ? one : (one + other) / 2;
    CHECK(both.psd[at] == Approx(mean).margin(1e-40));
    CHECK(both.scans[at] == (one >= 0) + (other >= 0));
  }
  CHECK(shared > 0);
  CHECK_THROWS_AS(plain_average({}), InvalidInput);
}
