// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/base/parallel.hpp>
#include <salebra/generators/exact_rms.hpp>
#include <salebra/generators/filtered_noise.hpp>
#include <salebra/generators/forecast.hpp>
#include <salebra/generators/radial_spectrum.hpp>
#include <salebra/generators/random_phase.hpp>
#include <vector>

#include "mode_power.hpp"

using namespace salebra;

namespace {

constexpr double pi = std::numbers::pi;

// Even, odd, mixed and rectangular grids; the last two have non-square cells. The shortest
// wavelength is two cells of the coarser axis, which gives a Nyquist line power.
struct Case {
  Grid2D grid;
  double short_cutoff;
};
Case grid_case() {
  return GENERATE(Case{{16, 16, 1.0, 1.0}, 2.0 / 16}, Case{{15, 15, 1.0, 1.0}, 2.0 / 15},
                  Case{{16, 15, 1.0, 1.0}, 2.0 / 15}, Case{{15, 16, 1.0, 1.0}, 2.0 / 15},
                  Case{{20, 12, 1.0, 1.0}, 2.0 / 12}, Case{{12, 18, 3.0, 2.0}, 0.5},
                  Case{{32, 8, 4.0, 1.0}, 0.25});
}

SelfAffineSpectrum spectrum_of(const Case& c) {
  return SelfAffineSpectrum({.hurst = 0.7,
                             .rolloff = 3 * c.short_cutoff,
                             .short_cutoff = c.short_cutoff,
                             .rms_height = 1e-6});
}

double target_power(const Spectrum& spectrum, const Grid2D& grid, Index i, Index j) {
  if (i == 0 && j == 0) return 0;
  return spectrum.density(2 * pi * double(i) / grid.lx, 2 * pi * double(j) / grid.ly) * (2 * pi) *
         (2 * pi) / grid.area();
}

std::string line_of(const Grid2D& grid, Index i, Index j) {
  const bool own_x = i == 0 || 2 * i == grid.nx, own_y = j == 0 || 2 * j == grid.ny;
  if (own_x && own_y) return "corner";
  if (j == 0) return "ky = 0";
  if (i == 0) return "kx = 0";
  if (own_y) return "ky Nyquist";
  if (own_x) return "kx Nyquist";
  return "bulk";
}

template <class Visit>
void for_each_mode(const Grid2D& grid, Visit visit) {
  for (Index a = 0; a < grid.nx; ++a)
    for (Index b = 0; b < grid.ny; ++b) visit(signed_wave(a, grid.nx), signed_wave(b, grid.ny));
}

}  // namespace

TEST_CASE("Random phase gives every mode its target power", "[generators][random_phase]") {
  const Case c = grid_case();
  const SelfAffineSpectrum spectrum = spectrum_of(c);
  std::map<std::string, int> modes_with_power;
  for (const std::uint64_t seed : {0u, 1u, 77u}) {
    const FourierCoefficients a(random_phase(c.grid, spectrum, seed));
    double total = spectrum.lattice_moments(c.grid).moment0;
    for_each_mode(c.grid, [&](Index i, Index j) {
      const double power = std::norm(a(i, j)), target = target_power(spectrum, c.grid, i, j);
      // Two transforms have rounding errors of a few 1e-16 of the rms height; compared amplitudes
      // are at least 1e-2 of it.
      if (target > 0)
        CHECK(power == Approx(target).epsilon(1e-12));
      else
        CHECK(power < 1e-28 * total);
      if (target > 0) ++modes_with_power[line_of(c.grid, i, j)];
    });
  }
  // Make sure that every case contains modes to compare.
  CHECK(modes_with_power["ky = 0"] > 0);
  CHECK(modes_with_power["kx = 0"] > 0);
  CHECK(modes_with_power["bulk"] > 0);
  if (c.grid == Grid2D{16, 16, 1.0, 1.0}) CHECK(modes_with_power["corner"] == 3 * 2);
  if (c.grid == Grid2D{12, 18, 3.0, 2.0}) CHECK(modes_with_power["kx Nyquist"] == 0);
}

TEST_CASE("Random phase has the moments of the lattice sum for every seed",
          "[generators][random_phase]") {
  const Case c = grid_case();
  const SelfAffineSpectrum spectrum = spectrum_of(c);
  const SpectralMoments lattice = spectrum.lattice_moments(c.grid);
  const Surface surface = random_phase(c.grid, spectrum, 5);
  CHECK(std::abs(surface.heights.mean()) < 1e-13 * lattice.rms_height());
  CHECK(std::sqrt(surface.heights.square().mean()) == Approx(lattice.rms_height()).epsilon(1e-12));
  const FourierCoefficients a(surface);
  double slope_x = 0, slope_y = 0;
  for_each_mode(c.grid, [&](Index i, Index j) {
    slope_x += std::pow(2 * pi * double(i) / c.grid.lx, 2) * std::norm(a(i, j));
    slope_y += std::pow(2 * pi * double(j) / c.grid.ly, 2) * std::norm(a(i, j));
  });
  CHECK(slope_x == Approx(lattice.moment2_x).epsilon(1e-12));
  CHECK(slope_y == Approx(lattice.moment2_y).epsilon(1e-12));
}

TEST_CASE("Filtered noise has its target power in the mean on every line of modes",
          "[generators][filtered_noise]") {
  const Case c = grid_case();
  const SelfAffineSpectrum spectrum = spectrum_of(c);
  const int seeds = 200;
  struct Line {
    double sum = 0;       // of power over target
    double variance = 0;  // of that sum
  };
  std::map<std::string, Line> lines;
  for (int seed = 0; seed < seeds; ++seed) {
    const FourierCoefficients a(filtered_noise(c.grid, spectrum, std::uint64_t(seed)));
    for_each_mode(c.grid, [&](Index i, Index j) {
      const double target = target_power(spectrum, c.grid, i, j);
      if (target == 0) return;
      // Power over target is χ²₂/2 for a complex Gaussian amplitude (variance 1) and χ²₁ for a real
      // one (variance 2). A conjugate pair is one random number, so it adds 2 to the sum and 4 to
      // its variance.
      const std::string name = line_of(c.grid, i, j);
      Line& line = lines[name];
      line.sum += std::norm(a(i, j)) / target - 1;
      line.variance += 2;
    });
  }
  for (const auto& [name, line] : lines) {
    CAPTURE(c.grid.nx, c.grid.ny, name, line.sum, line.variance);
    // Three standard errors. With half or double the power, a line of n modes would be off by at
    // least √(200 n/8) standard errors, 5 for a single mode.
    CHECK(std::abs(line.sum) < 3 * std::sqrt(line.variance));
  }
}

TEST_CASE("Filtered noise and random phase of one seed have the same phases",
          "[generators][filtered_noise]") {
  const Grid2D grid{16, 16, 1.0, 1.0};
  const SelfAffineSpectrum spectrum({.rolloff = 0.5, .short_cutoff = 2.0 / 16, .rms_height = 1.0});
  const FourierCoefficients noise(filtered_noise(grid, spectrum, 3));
  const FourierCoefficients fixed(random_phase(grid, spectrum, 3));
  for_each_mode(grid, [&](Index i, Index j) {
    if (target_power(spectrum, grid, i, j) > 0)
      // The relative rounding error grows for small amplitudes; 1e-11 suffices for amplitudes down
      // to 1e-5.
      CHECK(std::abs(std::arg(noise(i, j) / fixed(i, j))) < 1e-11);
  });
}

TEST_CASE("A generator can be stopped at any of its reports, and reports change nothing",
          "[generators]") {
  const Grid2D grid{96, 80, 1, 1};
  const SelfAffineSpectrum spectrum(
      {.hurst = 0.7, .rolloff = 0.5, .short_cutoff = 0.05, .rms_height = 1e-6});
  using Generator = Surface (*)(const Grid2D&, const Spectrum&, std::uint64_t, const Progress&,
                                const Communicator&);
  const Generator exact = [](const Grid2D& g, const Spectrum& s, std::uint64_t seed,
                             const Progress& told, const Communicator&) {
    return exact_rms(g, s, seed, Rms::slope, told);
  };
  for (const int threads : {1, 3}) {
    parallel::set_threads(threads);
    for (const Generator make : {Generator(filtered_noise), Generator(random_phase), exact}) {
      std::vector<double> fractions;
      const Surface told = make(grid, spectrum, 3,
                                [&](const ProgressReport& report) {
                                  CHECK(report.stage == "surface");
                                  fractions.push_back(report.fraction);
                                  return true;
                                },
                                {});
      CHECK((told.heights == make(grid, spectrum, 3, {}, {}).heights).all());
      REQUIRE(fractions.size() >= 2);
      CHECK(std::is_sorted(fractions.begin(), fractions.end()));
      CHECK(fractions.back() == 1);
      const auto stop_at = [&](std::size_t report) {
        std::size_t reports = 0;
        CHECK_THROWS_AS(
            make(grid, spectrum, 3, [&](const ProgressReport&) { return ++reports < report; }, {}),
            Interrupted);
        // After a stop, the callback is not called again.
        CHECK(reports == report);
      };
      stop_at(1);
      // The number of reports depends on the distribution of rows over threads.
      if (threads == 1) stop_at(fractions.size());
    }
  }
  parallel::set_threads(0);
  const auto stop = [](const ProgressReport&) { return false; };
  CHECK_THROWS_AS(spectrum.lattice_moments(grid, stop), Interrupted);
  CHECK_THROWS_AS(forecast(grid, spectrum, stop), Interrupted);
  CHECK_THROWS_AS(forecast(grid, spectrum,
                           [](const ProgressReport& report) { return report.stage == "moments"; }),
                  Interrupted);
}

TEST_CASE("A generator that is stopped leaves its work undone", "[generators]") {
  const Grid2D grid{256, 256, 1, 1};
  std::atomic<int> waves = 0;
  const FunctionSpectrum spectrum(
      [&](double) {
        ++waves;
        return 1e-18;
      },
      6, 300, "counted");
  parallel::set_threads(1);
  const auto count = [&](const auto& work) {
    waves = 0;
    work();
    return waves.load();
  };
  const auto stop = [](const ProgressReport&) { return false; };
  const int all = count([&] { filtered_noise(grid, spectrum, 1); });
  // A report follows every 16 of 48 columns.
  CHECK(count([&] { CHECK_THROWS_AS(filtered_noise(grid, spectrum, 1, stop), Interrupted); }) <
        all / 2);
  const int sums = count([&] { spectrum.lattice_moments(grid); });
  CHECK(count([&] { CHECK_THROWS_AS(spectrum.lattice_moments(grid, stop), Interrupted); }) <
        sums / 10);
  const int whole = count([&] { forecast(grid, spectrum); });
  const auto at_scatter = [](const ProgressReport& report) { return report.stage == "moments"; };
  CHECK(count([&] { CHECK_THROWS_AS(forecast(grid, spectrum, at_scatter), Interrupted); }) <
        whole / 2);
  parallel::set_threads(0);
}
