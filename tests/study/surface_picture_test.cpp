// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <salebra/io/result_file.hpp>
#include <salebra/study/study_file.hpp>

#include "small_study.hpp"

using namespace salebra;

TEST_CASE("The picture of a study shows where its first surface touches under each load",
          "[picture]") {
  const StudyResult result = run_study(small_study());
  REQUIRE(result.realisations.size() == 3);
  CHECK(result.realisations[1].picture.empty());
  CHECK(result.realisations[2].picture.empty());
  const Realisation& first = result.realisations[0];
  const SurfacePicture& picture = first.picture;
  REQUIRE(picture.stride == 1);
  REQUIRE(picture.first_load.size() == 64 * 64);

  double square = 0;
  for (const float height : picture.heights) square += double(height) * double(height);
  // Single precision holds seven digits of a height.
  CHECK(std::sqrt(square / (64 * 64)) == Approx(first.heights.rms_height).epsilon(1e-6));

  for (std::size_t k = 0; k < result.pressures.size(); ++k) {
    const auto touching = std::ranges::count_if(
        picture.first_load, [&](int load) { return load >= 0 && load <= int(k); });
    // Contacts at growing load are nested, except for single cells at the rim that may leave again.
    CHECK(
        double(touching) / (64 * 64) ==
        Approx(first.of(ContactModel::bem).curve.samples[k].contact_area_fraction).epsilon(0.005));
  }
  // The maps of one load have every cell, so their means are those of the contact, to the seven
  // digits of floats.
  const ForceSample& mapped =
      first.of(ContactModel::bem).curve.samples[std::size_t(picture.mapped_load)];
  REQUIRE(picture.mapped_load == Index(result.pressures.size() / 2));
  REQUIRE(picture.gap.size() == 64 * 64);
  double pressure = 0, gap = 0;
  for (std::size_t i = 0; i < picture.gap.size(); ++i) {
    pressure += double(picture.contact_pressure[i]) / (64 * 64);
    gap += double(picture.gap[i]) / (64 * 64);
    // In contact the solver leaves a gap within its tolerance.
    CHECK((picture.contact_pressure[i] == 0 || picture.gap[i] < 1e-4 * mapped.mean_gap));
  }
  CHECK(pressure == Approx(mapped.pressure).epsilon(1e-5));
  CHECK(gap == Approx(mapped.mean_gap).epsilon(1e-5));
}

TEST_CASE("The law drawn with a random-phase surface is its spectrum", "[picture]") {
  StudyConfiguration study = small_study();
  std::get<GeneratedSurfaces>(study.surfaces).method = GenerationMethod::random_phase;
  const SurfacePicture picture = picture_of(study_surface(study, 1), study);
  CHECK(picture.law == "asked for");
  int compared = 0;
  for (std::size_t i = 0; i < picture.wavenumber.size(); ++i) {
    if (std::isnan(picture.law_psd[i]) || picture.psd[i] == 0) continue;
    // The mean of q^-3.6 over a ring of an eighth of an octave differs from the value at the mean q
    // by 1 %. A ring across a limit of the law has modes beyond it.
    const double wavelength = 2 * std::numbers::pi / picture.wavenumber[i];
    if (wavelength < 1.1 * 0.5e-6 || std::abs(wavelength / 1e-6 - 1) < 0.1) continue;
    CHECK(picture.psd[i] == Approx(picture.law_psd[i]).epsilon(0.02));
    ++compared;
  }
  CHECK(compared >= 3);
}

TEST_CASE("A picture shows every point of a small surface and a sample of a large one",
          "[picture]") {
  Surface surface;
  surface.grid = {1200, 16, 12e-6, 0.16e-6};
  surface.heights = Field::Zero(1200, 16);
  for (Index ix = 0; ix < 1200; ++ix)
    for (Index iy = 0; iy < 16; ++iy) surface.heights(ix, iy) = 1e-9 * double(ix + 2000 * iy);
  surface.origin = "a ramp";
  StudyConfiguration study = small_study();
  study.surfaces = MeasuredSurface{};
  const SurfacePicture picture = picture_of(surface, study);
  CHECK(picture.stride == 3);
  REQUIRE(picture.nx == 400);
  REQUIRE(picture.ny == 6);
  CHECK(picture.step_x == Approx(30e-9));
  CHECK(picture.heights[1] - picture.heights[0] == Approx(6000e-9).epsilon(1e-5));
  CHECK(picture.heights[6] - picture.heights[0] == Approx(3e-9).epsilon(1e-3));
  CHECK(picture.origin == "a ramp");
}

TEST_CASE("A study file holds the picture, on axes with units", "[picture]") {
  const auto file = std::filesystem::temp_directory_path() /
                    ("salebra-picture-" + std::to_string(getpid()) + ".h5");
  const StudyResult result = run_study(small_study());
  write_study(file, result, {}, {.overwrite = true});
  {
    const ResultReader reader(file);
    CHECK(reader.shape("picture/heights") == std::vector<Index>{64, 64});
    CHECK(reader.coordinates("picture/first_load") == std::vector<std::string>{"x", "y"});
    CHECK(reader.numbers("picture/x")[1] == Approx(4e-6 / 64));
    CHECK(reader.text_attribute("picture/heights", "units") == "m");
    const auto loads = reader.numbers("picture/first_load");
    CHECK(std::ranges::equal(loads, result.realisations[0].picture.first_load));
  }
  std::filesystem::remove(file);
}
