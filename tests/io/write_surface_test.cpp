// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>
#include <set>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

Surface example() {
  Surface surface{{5, 3, 1.0 / 3e6, 2e-6}, Field(5, 3), true, "random phase, seed 7"};
  for (Index ix = 0; ix < 5; ++ix)
    for (Index iy = 0; iy < 3; ++iy)
      surface.heights(ix, iy) = std::sin(1.0 + static_cast<double>(7 * ix + iy)) * 1e-8;
  surface.heights(4, 1) = std::numeric_limits<double>::quiet_NaN();
  return surface;
}

bool same(const Field& a, const Field& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         ((a == b) || (a.isNaN() && b.isNaN())).all();
}

}  // namespace

TEST_CASE("A surface survives every format to the last bit", "[write]") {
  const Scratch scratch;
  const std::string extension = GENERATE(".h5", ".hdf5", ".npy", ".txt", ".asc", ".gwy");
  const Surface surface = example();
  const auto file = scratch / ("surface" + extension);
  write_surface(file, surface, {.command_line = "salebra generate", .seed = 7});
  const Surface read = read_surface(file);
  CHECK(read.grid == surface.grid);
  CHECK(same(read.heights, surface.heights));
  CHECK(read.origin == file.string());
  const bool keeps_period = extension != ".txt" && extension != ".asc" && extension != ".gwy";
  CHECK(read.periodic == keeps_period);
}

TEST_CASE("A GSF file keeps float32 of the heights, whatever the length of its header", "[write]") {
  const Scratch scratch;
  std::set<std::size_t> lengths;
  for (const double size : {1.0, 12.0, 1.5, 1.25}) {
    Surface surface = example();
    surface.grid.lx = size;
    const auto file = scratch / ("surface" + std::to_string(size) + ".gsf");
    write_surface(file, surface);
    const Surface read = read_surface(file);
    CHECK(read.grid == surface.grid);
    CHECK(same(read.heights, surface.heights.cast<float>().cast<double>()));
    std::ifstream stream(file, std::ios::binary);
    std::string header;
    std::getline(stream, header, '\0');
    lengths.insert(header.size() % 4);
  }
  // The padding has 1 to 4 bytes: every length was written and read.
  CHECK(lengths == std::set<std::size_t>{0, 1, 2, 3});
}

TEST_CASE("The HDF5 file of a surface says where it comes from", "[write]") {
  const Scratch scratch;
  write_surface(
      scratch / "surface.h5", example(),
      {.command_line = "salebra generate --seed 7", .configuration = "a = 1\n", .seed = 7});
  const ResultReader reader(scratch / "surface.h5");
  CHECK(reader.text_attribute("/", "program") == "salebra");
  CHECK(reader.text_attribute("/", "command_line") == "salebra generate --seed 7");
  CHECK(reader.text_attribute("/", "configuration") == "a = 1\n");
  CHECK(reader.number_attribute("/", "seed") == 7.0);
  CHECK(reader.text_attribute("/", "version").value().find('.') != std::string::npos);
  CHECK(reader.text_attribute("/", "created").value().size() == 20);
  CHECK_FALSE(reader.text_attribute("/", "started"));
  CHECK_FALSE(reader.text_attribute("/", "revision"));
  write_surface(scratch / "run.h5", example(),
                {.started = "2026-01-31T12:34:00Z", .revision = "0123456789ab"});
  const ResultReader run(scratch / "run.h5");
  CHECK(run.text_attribute("/", "started") == "2026-01-31T12:34:00Z");
  CHECK(run.text_attribute("/", "revision") == "0123456789ab");
  CHECK_THAT(reader.text_attribute("/", "libraries").value(),
             Contains("HDF5 1.") && Contains("FFTW 3."));
  CHECK(reader.text_attribute("heights", "units") == "m");
  CHECK(reader.text_attribute("heights", "origin") == "random phase, seed 7");
  CHECK(reader.coordinates("heights") == std::vector<std::string>{"x", "y"});
  CHECK(reader.numbers("x").at(1) == example().grid.dx());
}

TEST_CASE("What cannot be written is refused before a file appears", "[write]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(write_surface(scratch / "surface.png", example()), Contains(".png"));
  CHECK_THROWS_WITH(write_surface(scratch / "none/surface.h5", example()),
                    Contains("does not exist"));
  CHECK_THROWS_AS(write_surface(scratch / "surface.h5", Surface{}), InvalidInput);
  CHECK_THROWS_AS(write_surface(scratch.folder() / "", example()), InvalidInput);
  CHECK(std::filesystem::is_empty(scratch.folder()));
}
