// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/surface/scan_spectrum.hpp>

#include "rough_patches.hpp"
#include "surface/twin_response.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

constexpr double micro = 1e-6;

/// Mean periodogram of plane waves of amplitude 1 µm with one wave number, over directions and
/// phases.
std::vector<double> of_plane_waves(const Grid2D& grid, double kappa, bool drift) {
  const twin_detail::ScanModes modes(grid);
  const double q = modes.wavenumber(kappa);
  ScanInstrument instrument;
  instrument.line_drift = drift;
  std::vector<double> mean;
  constexpr int directions = 48;
  for (int direction = 0; direction < directions; ++direction)
    for (const double phase : {0.0, pi / 2}) {
      const double angle = (direction + 0.5) / directions * pi;
      // cos(qx + qy + phase) from the cosines and sines of its two terms.
      const auto along = [](Index n, double step, double at) {
        return (step * Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1)) + at).eval();
      };
      const Eigen::ArrayXd x = along(grid.nx, q * std::cos(angle) * grid.dx(), phase),
                           y = along(grid.ny, q * std::sin(angle) * grid.dy(), 0);
      ScanSpectrum spectrum;
      if (grid.ny == 1) {
        const Eigen::ArrayXd heights = micro * x.cos();
        const std::vector<double> line(heights.begin(), heights.end());
        spectrum = profile_spectrum(line, grid.lx, instrument);
      } else {
        const Field heights = micro * (x.cos().matrix() * y.cos().matrix().transpose() -
                                       x.sin().matrix() * y.sin().matrix().transpose())
                                          .array();
        spectrum = scan_spectrum(heights, grid, instrument);
      }
      mean.resize(spectrum.psd.size());
      for (std::size_t bin = 0; bin < mean.size(); ++bin)
        mean[bin] += spectrum.psd[bin] / (2 * directions);
    }
  return mean;
}

}  // namespace

TEST_CASE("The response to a plane wave is the mean periodogram of such waves", "[twin]") {
  // Square, wide and oblong-celled maps, and a line. With some 200 points and 48 directions, means
  // differ from those of a continuum with all directions by less than 1.5 % of the sum.
  for (const auto& [grid, drift] : {std::pair{Grid2D{192, 192, 1e-4, 1e-4}, false},
                                    std::pair{Grid2D{192, 192, 1e-4, 1e-4}, true},
                                    std::pair{Grid2D{256, 128, 2e-4, 1e-4}, false},
                                    std::pair{Grid2D{128, 256, 1e-4, 1e-4}, false},
                                    std::pair{Grid2D{256, 1, 1e-4, 1e-4}, false}}) {
    const twin_detail::Response response = twin_detail::response_of(grid, drift);
    const twin_detail::ScanModes modes(grid);
    const bool square = grid.nx == grid.ny;
    for (const double about : square ? std::vector{0.2, 0.7, 1.6, 4.2} : std::vector{0.2, 1.6}) {
      std::size_t cell = 0;
      while (response.limits[cell + 1] < about) ++cell;
      const double kappa = response.middle[cell];
      const std::vector<double> measured = of_plane_waves(grid, kappa, drift);
      // C of the waves is a ring with the area of the cell that contains their mean square.
      const double a = response.limits[cell], b = response.limits[cell + 1];
      const double density =
          micro * micro / 2 / (pi * (b * b - a * a)) * std::pow(modes.side / (2 * pi), 2);
      double most = 0;
      for (const double power : measured) most = std::max(most, power);
      REQUIRE(most > 0);
      for (std::size_t bin = 0; bin < 12; ++bin) {
        INFO(grid.nx << " x " << grid.ny << ", drift " << drift << ", kappa " << kappa << ", bin "
                     << bin);
        CHECK(response.weight(cell, bin) * density == Approx(measured[bin]).margin(0.015 * most));
      }
    }
  }
}

TEST_CASE("White noise has its own density in every bin", "[twin]") {
  RoughPatches patches(5);
  const Grid2D grid{256, 256, 1e-4, 1e-4};
  Field heights(256, 256);
  for (double& height : heights.reshaped()) height = micro * patches.normal();
  const ScanSpectrum spectrum = scan_spectrum(heights, grid, {});
  const double density = micro * micro * grid.cell_area() / (4 * pi * pi);
  double sum = 0, modes = 0;
  for (std::size_t bin = 2; bin < spectrum.psd.size(); ++bin) {
    // Five standard deviations, with Hann's quarter of the modes being independent.
    const double deviation = 1 / std::sqrt(0.25 * static_cast<double>(spectrum.modes[bin]) / 2);
    CHECK(spectrum.psd[bin] / density == Approx(1).margin(5 * deviation));
    sum += spectrum.psd[bin] * static_cast<double>(spectrum.modes[bin]);
    modes += static_cast<double>(spectrum.modes[bin]);
  }
  // Mean over all 40 000 modes, a quarter of which are independent.
  CHECK(sum / modes / density == Approx(1).margin(0.04));
  // The bins are as documented and contain the modes of their rings.
  CHECK(spectrum.modes[0] == 8);
  CHECK(spectrum.modes[1] == 12);
  CHECK(spectrum.modes[2] == 16);
  CHECK(spectrum.modes[3] == 32);

  // The heights in every band, 65 000 and 240 points, are Gaussian.
  for (const HeightBand& band : spectrum.bands) {
    const double count = static_cast<double>(band.blocks);
    CHECK(std::abs(band.skewness) < 6 * std::sqrt(6 / count));
    CHECK(std::abs(band.kurtosis - 3) < 6 * std::sqrt(24 / count));
  }
  REQUIRE(spectrum.bands.size() >= 3);
  // Subtracting the mean over nine blocks, one of which is the block itself, removes a ninth of the
  // variance.
  CHECK(spectrum.bands[0].rms_height == Approx(micro * std::sqrt(8.0 / 9)).epsilon(0.02));
  CHECK(spectrum.bands[1].rms_height == Approx(micro / 2 * std::sqrt(8.0 / 9)).epsilon(0.04));
}

TEST_CASE("A tilt is nothing, and drift of lines leaves what is used of them", "[twin]") {
  RoughPatches patches(6);
  const Grid2D grid{128, 96, 2e-5, 1.5e-5};
  Field heights(128, 96);
  for (double& height : heights.reshaped()) height = 1e-8 * patches.normal();
  ScanInstrument afm{.kind = Instrument::afm, .tip_radius = 1e-8};
  const ScanSpectrum plain = scan_spectrum(heights, grid, afm);
  Field tilted = heights;
  for (Index i = 0; i < 128; ++i)
    for (Index j = 0; j < 96; ++j)
      tilted(i, j) += 3e-6 + 1e-8 * static_cast<double>(i) - 4e-8 * static_cast<double>(j);
  const ScanSpectrum level = scan_spectrum(tilted, grid, afm);
  for (std::size_t bin = 0; bin < plain.psd.size(); ++bin)
    CHECK(level.psd[bin] == Approx(plain.psd[bin]).epsilon(1e-6));

  double walk = 0;
  Field drifted = heights;
  for (Index j = 0; j < 96; ++j) {
    walk += 1e-7 * patches.normal();
    drifted.col(j) += walk;
  }
  const ScanSpectrum kept = scan_spectrum(drifted, grid, afm);
  afm.line_drift = false;
  const ScanSpectrum spoiled = scan_spectrum(drifted, grid, afm);
  const ScanSpectrum whole = scan_spectrum(heights, grid, afm);
  // In the longest waves the offsets have a hundred times the power of the heights. Beyond |k| = 2
  // the tapers leak a thousandth of it, and Hann's window nothing.
  CHECK(spoiled.psd[2] > 100 * whole.psd[2]);
  for (std::size_t bin = 0; bin < plain.psd.size(); ++bin) {
    if (plain.modes[bin] < 4) continue;
    INFO("bin " << bin);
    CHECK(kept.psd[bin] - plain.psd[bin] <
          0.02 * (spoiled.psd[bin] - whole.psd[bin]) + 1e-9 * plain.psd[bin]);
    if (plain.wavenumber[bin] > 13 * 2 * pi / std::sqrt(grid.area()))
      CHECK(kept.psd[bin] == Approx(plain.psd[bin]).epsilon(1e-6));
  }
}

TEST_CASE("A scan's spectrum has the same bits for every number of threads", "[twin]") {
  RoughPatches patches(7);
  Field heights(200, 144);
  for (double& height : heights.reshaped()) height = 1e-8 * patches.normal();
  const int before = parallel::threads();
  parallel::set_threads(1);
  const ScanSpectrum one = scan_spectrum(heights, {200, 144, 1e-5, 2e-5}, {});
  parallel::set_threads(3);
  const ScanSpectrum three = scan_spectrum(heights, {200, 144, 1e-5, 2e-5}, {});
  parallel::set_threads(before);
  CHECK(one.psd == three.psd);
}

TEST_CASE("A scan that says nothing is refused by name", "[twin]") {
  const Field flat = Field::Zero(64, 64);
  const Grid2D grid{64, 64, 1e-4, 1e-4};
  const auto field_of = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InvalidInput& error) {
      return error.field();
    }
    return "none";
  };
  CHECK(field_of([&] { scan_spectrum(flat, grid, {.kind = Instrument::optical}); }) ==
        "resolution");
  CHECK(field_of([&] { scan_spectrum(flat, grid, {.kind = Instrument::afm}); }) == "tip_radius");
  CHECK(field_of([&] { scan_spectrum(flat, grid, {}, 0); }) == "weight");
  CHECK(field_of([&] { scan_spectrum(flat, {64, 64, 1e-3, 1e-4}, {}); }) == "grid");
  CHECK(field_of([&] { scan_spectrum(flat, {64, 32, 1e-4, 1e-4}, {}); }) == "heights");
  CHECK(field_of([&] { scan_spectrum(Field::Zero(64, 8), {64, 8, 1e-4, 1e-4}, {}); }) == "grid");
  Field hole = flat;
  hole(3, 4) = std::nan("");
  CHECK(field_of([&] { scan_spectrum(hole, grid, {}); }) == "heights");
  CHECK(field_of([&] { profile_spectrum(std::vector<double>(20), 1e-3, {}); }) == "heights");
}
