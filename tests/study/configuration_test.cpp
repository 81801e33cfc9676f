// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <numbers>
#include <salebra/base/error.hpp>
#include <salebra/generators/non_gaussian.hpp>
#include <salebra/study/configuration.hpp>
#include <salebra/study/realisation.hpp>

#include "study_text.hpp"

using namespace salebra;
using Catch::Contains;
using Catch::StartsWith;

namespace {

const std::string material = "[material]\ncontact_modulus = 1e9\npoisson = 0.25\n";
const std::string contact =
    "[contact]\npressures = [\"0.1MPa\", \"0.2MPa\", \"300kPa\", \"4e5Pa\"]\n";
const std::string damping =
    "[damping]\nnormal_amplitude = \"1nm\"\ndrag_velocity = 0.01\nangular_frequency = 100\n";

StudyConfiguration parse(const std::string& text) {
  return parse_study_configuration(text, "x.toml", "/folder");
}

}  // namespace

TEST_CASE("Numbers are SI and strings have units", "[configuration]") {
  const auto configuration = parse(
      "[surface]\npoints = [32, 16]\nsize_x = \"4um\"\nhurst = 0.5\nlong_cutoff = 2e-6\n"
      "short_cutoff = \"1um\"\nrms_slope = 0.1\nmethod = \"random-phase\"\nfirst_seed = "
      "5\nseed_count = 3\n" +
      material + contact + damping);
  const auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  CHECK(surfaces.grid == Grid2D{32, 16, 4e-6, 2e-6});
  CHECK(surfaces.spectrum.long_cutoff == 2e-6);
  CHECK_FALSE(surfaces.spectrum.rms_height.has_value());
  CHECK(surfaces.method == GenerationMethod::random_phase);
  CHECK(surfaces.seeds == std::vector<std::uint64_t>{5, 6, 7});
  CHECK(configuration.pressures == std::vector{1e5, 2e5, 3e5, 4e5});
  CHECK_FALSE(configuration.relative_pressures);
  CHECK(configuration.material.modulus_ratio() == Approx(1.5 / 1.75).epsilon(1e-14));
  CHECK(std::get<Drag>(configuration.motion).angular_frequency == 100);
}

TEST_CASE("An array has units at all of its numbers or at none", "[configuration]") {
  const std::string surface =
      "[surface]\npoints = 32\nsize_x = 4e-6\nhurst = 0.5\nrolloff = 2e-6\n"
      "short_cutoff = 1e-6\nrms_slope = 0.1\nseed_count = 3\n";
  const auto with = [&](const std::string& pressures) {
    return parse(surface + material + "[contact]\npressures = " + pressures + "\n" + damping);
  };
  CHECK(with("[1e5, 2e5, 3e5, 4e5]").pressures == std::vector{1e5, 2e5, 3e5, 4e5});
  for (const char* mixed :
       {"[10, 20, \"50MPa\"]", "[\"10\", \"20\", \"50MPa\"]", "\"10,20,50MPa\""})
    CHECK_THROWS_WITH(with(mixed),
                      StartsWith("x.toml:13: contact.pressures: '10,20,50MPa' has a unit "
                                 "on only some of its numbers; write 10MPa,20MPa,50MPa"));
}

TEST_CASE("A measured surface is looked for beside its configuration", "[configuration]") {
  const auto configuration =
      parse("[surface]\nfile = \"scan.txt\"\nsize_x = \"10um\"\ndetrend = \"mean\"\n" + material +
            contact + damping);
  const auto& surface = std::get<MeasuredSurface>(configuration.surfaces);
  CHECK(surface.file == "/folder/scan.txt");
  CHECK(surface.size_x == 1e-5);
  CHECK(surface.detrend == Detrend::mean);
}

TEST_CASE("The surfaces of a study have the lay and the heights of their keys", "[configuration]") {
  const std::string texture =
      "stretch_along = 4\nlay_angle = \"30deg\"\nskewness = -1\nkurtosis = 5\n";
  const auto read = [&](const std::string& keys) {
    return parse(study_text(keys + "seeds = [7]"));
  };
  const auto configuration = read(texture);
  const auto& surfaces = std::get<GeneratedSurfaces>(configuration.surfaces);
  const Surface drawn = study_surface(configuration, 7);
  // The same surface, made by the generators themselves.
  const AnisotropicSpectrum spectrum(
      std::make_shared<SelfAffineSpectrum>(SelfAffineParameters{
          .hurst = 0.8, .rolloff = 1e-6, .short_cutoff = 0.5e-6, .rms_height = 10e-9}),
      {.along = 4, .angle = std::numbers::pi / 6});
  const auto made =
      non_gaussian(surfaces.grid, spectrum, johnson_heights(-1, 5), 7, {.exact = Exact::process});
  CHECK((drawn.heights == made.surface.heights).all());
  const auto warnings = study_loads(configuration).warnings;
  CHECK(
      std::ranges::any_of(warnings, [](const std::string& w) { return w.find("lay") != w.npos; }));
  CHECK_THROWS_WITH(read("skewness = -1\n"), Contains("surface.skewness"));
  CHECK_THROWS_WITH(read("lay_angle = 1\n"), Contains("surface.lay_angle"));
  CHECK_THROWS_WITH(read("stretch_along = -1\n"), Contains("surface.stretch_along"));
  CHECK_THROWS_WITH(read("skewness = 2\nkurtosis = 3\n"), Contains("kurtosis"));
  CHECK_THROWS_WITH(read(texture + "method = \"random-phase\"\n"), Contains("surface.method"));
}

TEST_CASE("Equal frequencies, dead weights and two elastic bodies can be asked for",
          "[configuration]") {
  const auto configuration =
      parse("[material]\nyoung = [\"200GPa\", \"70GPa\"]\npoisson = [0.3, 0.33]\n" + contact +
            "[damping]\nmode = \"equal-frequency\"\nnormal_amplitude = 1e-9\ntangential_amplitude "
            "= 2e-9\n"
            "phase = \"90deg\"\nfrequency = \"1kHz\"\nhold = \"force\"\namplitude = \"small\"\n");
  const auto& motion = std::get<EqualFrequency>(configuration.motion);
  CHECK(motion.phase == Approx(std::numbers::pi / 2).epsilon(1e-15));
  CHECK(motion.angular_frequency == Approx(2000 * std::numbers::pi).epsilon(1e-15));
  CHECK(configuration.damping.hold == Hold::force);
  CHECK(configuration.damping.amplitude == Amplitude::small);
  CHECK(configuration.material.contact_modulus ==
        Approx(1 / (0.91 / 2e11 + (1 - 0.33 * 0.33) / 7e10)).epsilon(1e-14));
}

TEST_CASE("What the library itself refuses is told with file, line and key", "[configuration]") {
  CHECK_THROWS_WITH(
      parse("\n[material]\ncontact_modulus = 1e9\n\npoisson = 0.6\n" + contact + damping),
      StartsWith("x.toml:5: material.poisson: 0.6 "));
  CHECK_THROWS_WITH(parse(material + "[contact]\npressures = \"1:x:3\"\n" + damping),
                    StartsWith("x.toml:5: contact.pressures: "));
  CHECK_THROWS_WITH(parse(material + contact), StartsWith("x.toml:1: damping: "));
  CHECK_THROWS_WITH(parse("[material"), StartsWith("x.toml:1: is not TOML: "));
  CHECK_THROWS_AS(parse("surface = 3\n"), InvalidInput);
}

TEST_CASE("Seeds end below 2^63, and none occurs twice", "[configuration]") {
  const auto with = [](const std::string& seeds) {
    return parse(
        "[surface]\npoints = 32\nsize_x = \"4um\"\nhurst = 0.5\nrolloff = \"2um\"\n"
        "short_cutoff = \"1um\"\nrms_height = 1e-8\n" +
        seeds + material + contact + damping);
  };
  const auto configuration = with("first_seed = 9223372036854775806\nseed_count = 2\n");
  CHECK(std::get<GeneratedSurfaces>(configuration.surfaces).seeds.back() == (1ull << 63) - 1);
  CHECK_THROWS_WITH(with("first_seed = 9223372036854775807\nseed_count = 2\n"),
                    Catch::Contains("surface.first_seed: 9223372036854775807 must be from 0 to "
                                    "9223372036854775806"));
  CHECK_THROWS_WITH(with("first_seed = -1\nseed_count = 2\n"),
                    Catch::Contains("first_seed: -1 must be"));
  CHECK_THROWS_WITH(with("seeds = [3, 1, 3]\n"), Catch::Contains("seeds: 3 occurs twice"));
}

TEST_CASE("The configurations that come with the program are valid", "[configuration]") {
  for (const std::string name : {"quickstart.toml", "paper.toml", "measured.toml"}) {
    INFO(name);
    CHECK_NOTHROW(read_study_configuration(std::string(SALEBRA_DATA) + "/" + name));
  }
}

TEST_CASE("Where one surface is alone, small grids are halved and larger ones compared",
          "[configuration]") {
  StudyConfiguration study = parse(study_text("seed_count = 1", 4));
  const auto of = [&](Index points, std::uint64_t seed) {
    return surface_damping_options(study, {points, points, 1e-5, 1e-5}, seed);
  };
  const std::uint64_t only = std::get<GeneratedSurfaces>(study.surfaces).seeds.front();
  CHECK(of(256, only).refinements == 1);
  CHECK_FALSE(of(256, only).coarsen);
  CHECK(of(257, only).refinements == 0);
  CHECK(of(257, only).coarsen);
  study.relative_error = 0.1;
  CHECK(of(2048, only).refinements == 1);
  CHECK_FALSE(of(2048, only).coarsen);
}
