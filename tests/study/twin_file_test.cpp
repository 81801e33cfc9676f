// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of the file of a surface twin, of the list of its scans, and of its use in a study.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/random_phase.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/study/study.hpp>
#include <salebra/study/twin_file.hpp>

#include "base/random.hpp"
#include "small_study.hpp"
#include "study/estimate.hpp"

using namespace salebra;
using std::numbers::pi;

namespace {

/// A separate folder, removed at the end.
struct Folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("salebra-twin-" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path with(const std::string& name, const std::string& text) const {
    std::ofstream(path / name) << text;
    return path / name;
  }
};

TwinDraw corner_law(double hurst, double rolloff, double short_cutoff, double slope) {
  TwinDraw draw;
  draw.hurst = hurst;
  draw.rolloff = rolloff;
  draw.short_cutoff = short_cutoff;
  draw.rms_slope = slope;
  draw.rms_height = 1e-8;
  draw.reference = 1e6;
  draw.amplitude = -60;
  return draw;
}

}  // namespace

TEST_CASE("A list of scans names each mistake with its line", "[twin]") {
  const Folder folder;
  const auto refused = [&](const std::string& text, const std::string& message) {
    CHECK_THROWS_WITH(read_twin_measurements(folder.with("t.toml", text)),
                      Catch::Contains(message));
  };
  const std::string one = "[[measurement]]\nfile = \"a.h5\"\n";
  refused("# none\n", "measurement: is missing; add a table [[measurement]] for each scan");
  refused("[measurement]\nfile = \"a.h5\"\n", "must be tables; write [[measurement]]");
  refused("[[measurement]]\ninstrument = \"afm\"\n", "measurement.file: is missing");
  refused(one, "measurement.instrument: is missing; give optical, stylus or afm");
  refused(one + "instrument = \"optic\"\n", "t.toml:3: measurement.instrument");
  refused(one + "instrument = \"optical\"\n",
          "measurement.resolution: must be given for an optical");
  refused(one + "instrument = \"afm\"\ntip_radius = \"1nm\"\nresolution = \"1um\"\n",
          "t.toml:5: measurement.resolution: must be given for an optical");
  refused(one + "instrument = \"stylus\"\n",
          "measurement.tip_radius: must be given for a stylus or afm");
  refused(one + "instrument = \"ideal\"\ntip = \"1nm\"\n", "t.toml:4: measurement.tip");
  const auto two = read_twin_measurements(folder.with(
      "t.toml", one + "instrument = \"optical\"\nresolution = \"1.5um\"\nsize_x = \"200um\"\n" +
                    one +
                    "instrument = \"afm\"\ntip_radius = \"50nm\"\nline_drift = false\n"
                    "height_calibration = \"2%\"\nweight = 2\nname = \"the old one\"\n"));
  REQUIRE(two.size() == 2);
  CHECK(two[0].surface.file == folder.path / "a.h5");
  CHECK(*two[0].surface.size_x == Approx(2e-4));
  CHECK(two[0].instrument.resolution == Approx(1.5e-6));
  CHECK(two[0].instrument.height_calibration == 0.05);
  CHECK(two[1].instrument.kind == Instrument::afm);
  CHECK(two[1].instrument.height_calibration == Approx(0.02));
  CHECK_FALSE(two[1].instrument.drifts());
  CHECK(two[1].instrument.name == "the old one");
  CHECK(two[1].weight == 2);
}

TEST_CASE("A twin of files is that of their heights, and its file holds its draws", "[twin]") {
  const Folder folder;
  const SelfAffineSpectrum spectrum({.hurst = 0.7,
                                     .long_cutoff = {},
                                     .rolloff = 4e-6,
                                     .short_cutoff = 4e-7,
                                     .rms_height = 2e-8,
                                     .rms_slope = {}});
  std::vector<ScanSpectrum> scans;
  std::string list;
  for (int seed = 1; seed <= 3; ++seed) {
    const Surface scan = random_phase({128, 128, 1e-5, 1e-5}, spectrum, std::uint64_t(seed));
    const std::string name = "scan" + std::to_string(seed) + ".h5";
    write_surface(folder.path / name, scan);
    list +=
        "[[measurement]]\nfile = \"" + name + "\"\ninstrument = \"ideal\"\ndetrend = \"none\"\n";
    scans.push_back(scan_spectrum(scan.heights, scan.grid, {}, 1, name));
  }
  // For periodic surfaces, which have no longer waves, the automatic choice would be a table.
  const TwinOptions options{.form = SpectrumForm::corner};
  const SurfaceTwin twin = twin_of(read_twin_measurements(folder.with("t.toml", list)), options);
  SurfaceTwin direct = fit_twin(scans, options);
  CHECK(twin.hurst.value == direct.hurst.value);
  CHECK(twin.rms_slope.low == direct.rms_slope.low);
  write_twin(folder.path / "twin.h5", twin, {});
  const std::vector<TwinDraw> draws = read_twin_draws(folder.path / "twin.h5");
  REQUIRE(draws.size() == twin.draws.size());
  for (std::size_t i = 0; i < draws.size(); i += 97)
    for (const double q : {2e5, 1e6, 5e6, 2e7})
      CHECK(draws[i].density(q) == Approx(twin.draws[i].density(q)).epsilon(1e-14));
  CHECK(draws.front().stretch == 1);
  CHECK(draws.front().kurtosis == 3);
  CHECK_THROWS_WITH(read_twin_draws(folder.path / "scan1.h5"),
                    Catch::Contains("scan1.h5: is not a surface twin"));
}

TEST_CASE("A study counts loads by the draw of median slope, on waves that its grid carries",
          "[twin]") {
  const std::vector<TwinDraw> draws{corner_law(0.7, 4e-6, 4e-7, 0.1),
                                    corner_law(0.8, 4e-6, 1e-8, 0.3),
                                    corner_law(0.6, 4e-6, 4e-7, 0.2)};
  const Grid2D grid{64, 32, 1e-5, 5e-6};
  const std::vector<SpectrumTable> tables = tables_of(draws, grid);
  REQUIRE(tables.size() == 4);
  CHECK(tables[0].psd == tables[3].psd);
  CHECK(tables[1].wavenumber.back() == Approx(2 * pi / 4e-7));
  CHECK(tables[1].wavenumber.front() == Approx(pi / 1e-5));
  // The cells are 156 nm, so the second law is cut off at two cells.
  CHECK(tables[2].wavenumber.back() == Approx(pi / grid.dx()));
}

TEST_CASE("A prediction interval holds the next value", "[twin]") {
  constexpr int trials = 4000, count = 8;
  int held = 0;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> values;
    for (int i = 0; i <= count; ++i) {
      const auto [u, v] = uniform_pair(7, trial, i, 9);
      values.push_back(std::exp(0.6 * std::sqrt(-2 * std::log(u)) * std::cos(2 * pi * v)));
    }
    const double next = values.back();
    values.pop_back();
    const EnsembleMean interval = prediction(values);
    held += next > interval.low && next < interval.high;
  }
  // Exactly 95 % for log-normal values; four standard deviations of 4000 trials are 1.4 %.
  CHECK(held > 0.936 * trials);
  CHECK(held < 0.964 * trials);
  CHECK(std::isnan(prediction({3}).low));
  // Values of both signs have no logarithms. t(0.975, 1) = 12.706, s = √2, √(1 + 1/2).
  CHECK(prediction({-1, 1}).high == Approx(12.7062047 * std::sqrt(2) * std::sqrt(1.5)));
}

TEST_CASE("A study tells what the scans leave open from what differs from place to place",
          "[twin][study]") {
  StudyConfiguration study = small_study();
  auto& surfaces = std::get<GeneratedSurfaces>(study.surfaces);
  const SelfAffineSpectrum spectrum(surfaces.spectrum);
  const double corner = 2 * pi / *surfaces.spectrum.rolloff, end = spectrum.highest_wavenumber();
  const auto table = [&](double factor) {
    const double level = factor * factor * spectrum.plateau();
    return SpectrumTable{{1e-3 * corner, corner, end},
                         {level, level, level * std::pow(end / corner, -3.6)}};
  };
  surfaces.seeds = {2, 3, 4, 5, 6, 7, 8, 9};
  study.intervals = 0;
  study.stick = false;
  CHECK_FALSE(study.of_twin());
  surfaces.tables = {table(1), table(1), table(1), table(1), table(1)};
  CHECK(study.of_twin());
  const StudyResult alike = run_study(study);
  surfaces.tables = {table(1), table(0.5), table(1), table(2), table(4)};
  const StudyResult open = run_study(study);
  // Four pairs from one law: the expected share is 0, with a wide scatter. From laws that differ by
  // 8 in height: most of the scatter, although few patches carry such small surfaces.
  CHECK(alike.scan_share() < 0.6);
  CHECK(open.scan_share() > 0.75);
  CHECK(std::isnan(run_study(small_study()).scan_share()));
  const auto flagged = [](const StudyResult& result) {
    return std::ranges::any_of(result.ensemble_warnings,
                               [](const auto& flag) { return flag.name == "twin"; });
  };
  CHECK(flagged(open));
  const EnsembleMean length = open.decay_length();
  CHECK(length.low < length.mean / 1.5);
  CHECK(length.high > 1.5 * length.mean);
}

TEST_CASE("The surfaces of a draw with a lay have its rms height, slope and texture", "[twin]") {
  TwinDraw draw;
  draw.hurst = 0.7;
  draw.rolloff = 20e-6;
  draw.short_cutoff = 4e-6;
  draw.reference = 1e6;
  draw.amplitude = std::log(1e-26);
  draw.stretch = 5;
  draw.lay_angle = 0.6;
  draw.skewness = -0.8;
  draw.kurtosis = 4;
  GeneratedSurfaces surfaces{.grid = {512, 512, 1e-3, 1e-3}, .spectrum = {}, .seeds = {1}};
  surfaces.tables = tables_of({draw, draw}, surfaces.grid);
  surfaces.textures = textures_of({draw, draw});
  CHECK(surfaces.texture_of(4).skewness == -0.8);
  CHECK(surfaces.texture_of(4).lay.angle == 0.6);
  // ∫C d²q over the plane with C = density(q_e), by polar coordinates of the elliptic wave vector:
  // an area d²q is d²q_e over the stretch.
  double height = 0, slope = 0;
  const double end = 2 * std::numbers::pi / draw.short_cutoff, step = end / 20000;
  for (double q = step / 2; q < end; q += step) {
    const double power = 2 * std::numbers::pi * q * draw.density(q) * step / draw.stretch;
    height += power;
    slope += power * q * q * (1 + 1 / (draw.stretch * draw.stretch)) / 2;
  }
  // The grid has 50 roll-offs across the lay and 10 along it, so that sums over its modes are
  // close to the integrals.
  const SpectralMoments moments = surfaces.spectrum_of(4)->lattice_moments(surfaces.grid);
  CHECK(moments.rms_height() == Approx(std::sqrt(height)).epsilon(0.01));
  CHECK(moments.rms_slope() == Approx(std::sqrt(slope)).epsilon(0.01));
}
