// SPDX-License-Identifier: GPL-3.0-or-later
// Reading options: they correct what a file states, and change heights before use.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/fill.hpp>
#include <salebra/surface/spikes.hpp>

#include "io/surface_importer.hpp"
#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// A surface of gentle waves: 60 by 40 points, 1 µm apart.
Surface waves() {
  Surface surface{{60, 40, 60e-6, 40e-6}, Field(60, 40), false, "test"};
  for (Index ix = 0; ix < 60; ++ix)
    for (Index iy = 0; iy < 40; ++iy)
      surface.heights(ix, iy) = 1e-7 * std::sin(0.3 * double(ix)) * std::cos(0.5 * double(iy));
  return surface;
}

struct Reading {
  Surface surface;
  std::vector<std::string> warnings;
};

Reading read(const std::filesystem::path& file, ReadOptions options) {
  Reading result;
  options.warnings = &result.warnings;
  result.surface = read_surface(file, options);
  return result;
}

}  // namespace

TEST_CASE("Distances of points stand in place of sizes", "[read]") {
  const Scratch scratch;
  const auto file = scratch.file("scan.txt", "0 1e-9 0 0\n1e-9 0 1e-9 0\n");
  const Surface surface = read_surface(file, {.pixel_size = {{1.1e-6, 1.3e-6}}});
  CHECK(surface.grid.lx == Approx(4.4e-6).epsilon(1e-14));
  CHECK(surface.grid.ly == Approx(2.6e-6).epsilon(1e-14));
  CHECK_THROWS_WITH(read_surface(file, {.size_x = 1, .pixel_size = {{1, 1}}}),
                    Contains("give one of them"));
  CHECK_THROWS_AS(read_surface(file, {.pixel_size = {{0, 1}}}), InvalidInput);
  CHECK_THROWS_WITH(read_surface(file), Contains("`pixel_size`"));
}

TEST_CASE("Coordinates without a unit take that of the option, and are doubted without it",
          "[read]") {
  const Scratch scratch;
  std::string points;
  for (int ix = 0; ix < 4; ++ix)
    for (int iy = 0; iy < 3; ++iy)
      points += std::to_string(2 * ix) + " " + std::to_string(iy) + " 0\n";
  const auto bare = scratch.file("points.xyz", points);
  const Reading metres = read(bare, {});
  REQUIRE(metres.warnings.size() == 1);
  CHECK_THAT(metres.warnings[0], Contains("is 8 m long") && Contains("see `lateral_unit`"));
  const Reading microns = read(bare, {.lateral_unit = "um"});
  CHECK(microns.warnings.empty());
  CHECK(microns.surface.grid.lx == Approx(8e-6).epsilon(1e-14));
  CHECK(microns.surface.grid.ly == Approx(3e-6).epsilon(1e-14));
  CHECK_THROWS_WITH(read(bare, {.lateral_unit = "V"}), Contains("unit of length"));
  const Reading stated =
      read(scratch.file("mm.xyz", "x [mm] y [mm] z [mm]\n" + points), {.lateral_unit = "um"});
  CHECK(stated.surface.grid.lx == Approx(8e-3).epsilon(1e-14));
  REQUIRE(stated.warnings.size() == 1);
  CHECK_THAT(stated.warnings[0], Contains("`lateral_unit` um was not used"));
}

TEST_CASE("A transposed file has its axes exchanged, with their sizes", "[read]") {
  const Scratch scratch;
  const auto file = scratch.file("scan.txt", "# Width: 4 um\n# Height: 6 um\n1 2\n3 4\n5 6\n");
  const Surface surface = read_surface(file, {.transpose = true});
  CHECK(surface.grid == Grid2D{3, 2, 6e-6, 4e-6});
  CHECK(surface.heights(2, 0) == 5);
  CHECK(surface.heights(0, 1) == 2);
  // Sizes that suit exchanged axes better give a warning; square cells do not.
  std::string rows;
  for (int iy = 0; iy < 32; ++iy) {
    for (int ix = 0; ix < 24; ++ix) rows += "0 ";
    rows += "\n";
  }
  const auto array = scratch.file("array.txt", rows);
  const Reading doubted = read(array, {.size_x = 35.2e-6, .size_y = 31.2e-6});
  REQUIRE(doubted.warnings.size() == 1);
  CHECK_THAT(doubted.warnings[0], Contains("24 x 32 points along x and y, cells of 1.47 \u00b5m x "
                                           "975 nm; with `transpose` they are 1.1 \u00b5m x "
                                           "1.3 \u00b5m"));
  CHECK(read(array, {.transpose = true, .size_x = 35.2e-6, .size_y = 31.2e-6}).warnings.empty());
  CHECK(read(array, {.size_x = 24e-6, .size_y = 32e-6}).warnings.empty());
}

TEST_CASE("Spikes are named with what they do, or taken out", "[read]") {
  const Scratch scratch;
  Surface surface = waves();
  surface.heights(7, 9) += 8e-6;
  surface.heights(30, 11) -= 8e-6;
  write_surface(scratch / "scan.h5", surface);
  const Reading kept = read(scratch / "scan.h5", {});
  CHECK(kept.surface.undefined_points() == 0);
  REQUIRE(kept.warnings.size() == 1);
  CHECK_THAT(kept.warnings[0],
             Contains("1 point is isolated, up to 8 \u00b5m above its neighbours, "
                      "and would touch first; `despike`"));
  const Reading despiked = read(scratch / "scan.h5", {.despike = 6});
  CHECK(despiked.surface.undefined_points() == 2);
  CHECK(std::isnan(despiked.surface.heights(7, 9)));
  REQUIRE(despiked.warnings.size() == 1);
  CHECK_THAT(despiked.warnings[0], Contains("2 points far from their neighbours, up to"));
  // A pit touches nothing, so it gives no warning.
  surface.heights(7, 9) -= 8e-6;
  write_surface(scratch / "pit.h5", surface);
  CHECK(read(scratch / "pit.h5", {}).warnings.empty());
  // A periodic surface is generated and has no spikes of an instrument.
  surface.heights(7, 9) += 8e-6;
  surface.periodic = true;
  write_surface(scratch / "periodic.h5", surface);
  CHECK(read(scratch / "periodic.h5", {}).warnings.empty());
}

TEST_CASE("Few undefined points are filled, and many refused with the part that serves", "[read]") {
  const Scratch scratch;
  const Surface whole = waves();
  Surface surface = whole;
  surface.heights.block(10, 10, 3, 3).setConstant(undefined);
  write_surface(scratch / "few.h5", surface);
  CHECK(read(scratch / "few.h5", {}).surface.undefined_points() == 9);
  const Reading filled_few = read(scratch / "few.h5", {.undefined = Undefined::fill_few});
  CHECK((filled_few.surface.heights == filled(surface).heights).all());
  REQUIRE(filled_few.warnings.size() == 1);
  CHECK_THAT(
      filled_few.warnings[0],
      Contains("9 points of 2400 (0.38 %) had no height; the smoothest surface was filled in"));

  surface.heights.block(20, 0, 6, 30).setConstant(undefined);
  write_surface(scratch / "many.h5", surface);
  std::string refusal;
  try {
    read(scratch / "many.h5", {.undefined = Undefined::fill_few});
  } catch (const InvalidInput& error) {
    refusal = error.what();
  }
  CHECK_THAT(refusal, Contains("many.h5: has 189 undefined points of 2400 (7.9 %), holes up to 6 "
                               "\u00b5m wide; `crop` 26um,0um,60um,40um selects the largest "
                               "part without undefined points, 57 % of the area; `fill`"));
  // The suggested crop works, and then nothing needs to be filled.
  const Rectangle offered{26e-6, 0, 60e-6, 40e-6};
  const Reading part =
      read(scratch / "many.h5", {.crop = offered, .undefined = Undefined::fill_few});
  CHECK(part.warnings.empty());
  CHECK(part.surface.grid.nx == 34);
  CHECK(part.surface.grid.ny == 40);
  CHECK(part.surface.grid.lx == Approx(34e-6).epsilon(1e-14));
  CHECK(part.surface.heights(0, 5) == whole.heights(26, 5));
  // For a cropped part, the suggestion is in coordinates of the whole surface.
  CHECK_THROWS_WITH(read(scratch / "many.h5", {.crop = Rectangle{15e-6, 2e-6, 40e-6, 40e-6},
                                               .undefined = Undefined::fill_few}),
                    Contains("`crop` 26um,2um,40um,40um"));
  CHECK(read(scratch / "many.h5", {.undefined = Undefined::fill}).surface.undefined_points() == 0);
}

TEST_CASE("Spikes are gone before undefined points are filled", "[read]") {
  const Scratch scratch;
  Surface surface = waves();
  surface.heights(7, 9) += 8e-6;
  write_surface(scratch / "scan.h5", surface);
  const Reading clean = read(scratch / "scan.h5", {.despike = 6, .undefined = Undefined::fill_few});
  CHECK(std::abs(clean.surface.heights(7, 9) - waves().heights(7, 9)) < 2e-8);
  CHECK(clean.warnings.size() == 2);
}

namespace {

std::filesystem::path asked, given;

std::vector<std::string> import_waves(const std::filesystem::path& from,
                                      const std::filesystem::path& to, const std::string&,
                                      const UnknownFormat&) {
  asked = from;
  given = to;
  write_surface(to, waves());
  return {"channel 3 of several"};
}

std::vector<std::string> import_nothing(const std::filesystem::path& from,
                                        const std::filesystem::path&, const std::string&,
                                        const UnknownFormat& refusal) {
  throw InvalidInput(from.string(), refusal.statement() + "; nor by the importer");
}

}  // namespace

TEST_CASE("An importer is asked for files of unknown formats only", "[read]") {
  const Scratch scratch;
  const auto binary = scratch.file("scan.opd", std::string("\1\0\2\0", 4));
  const auto zygo = scratch.file("scan.asc", "Zygo ASCII\n0 0 0 0 \"date\"\n1 2 3\n");
  const auto ambiguous = scratch.file("comma.txt", "# Width: 3 um\n# Height: 2 um\n1,5\n2,5\n");
  for (const auto& file : {binary, zygo}) CHECK_THROWS_AS(read_surface(file), UnknownFormat);
  set_surface_importer(import_waves);
  for (const auto& file : {binary, zygo}) {
    const Reading reading = read(file, {});
    CHECK(asked == file);
    CHECK_FALSE(std::filesystem::exists(given.parent_path()));
    CHECK((reading.surface.heights == waves().heights).all());
    CHECK(reading.surface.origin == file.string());
    REQUIRE(reading.warnings.size() == 1);
    CHECK_THAT(reading.warnings[0], Contains(file.filename().string() + ": channel 3 of several"));
  }
  // The importer is not called for a file that can be read in two ways.
  CHECK_THROWS_WITH(read_surface(ambiguous), Contains("decimal"));
  CHECK(asked != ambiguous);
  set_surface_importer(import_nothing);
  CHECK_THROWS_WITH(read_surface(binary), Contains("NUL bytes") && Contains("nor by the importer"));
  set_surface_importer(nullptr);
}
