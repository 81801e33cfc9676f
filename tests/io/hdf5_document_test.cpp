// SPDX-License-Identifier: GPL-3.0-or-later
// Impossible outlines of HDF5 files, which a compromised reading process might hand over.
#include "io/hdf5_document.hpp"

#include <hdf5_hl.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/result_file.hpp>
#include <salebra/io/write_surface.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/archive.hpp"
#include "io/hdf5_runner.hpp"
#include "scratch.hpp"

using namespace salebra;
using namespace salebra::detail::hdf5;

namespace {

std::string handed_over;

void hand_over(const Hdf5Reading& reading) {
  std::memcpy(reading.location(handed_over.size()).data(), handed_over.data(), handed_over.size());
}

struct Installed {
  Installed() { set_hdf5_runner(hand_over); }
  Installed(const Installed&) = delete;
  Installed& operator=(const Installed&) = delete;
  ~Installed() { set_hdf5_runner(nullptr); }
};

}  // namespace

TEST_CASE("An outline that cannot be is refused, whoever hands it over", "[hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "few.h5";
  ResultFile(file, {}).commit();
  const Installed installed;
  Objects objects(2);
  auto& [root, group] = objects[0];
  auto& [name, numbers] = objects[1];
  root = "/";
  group.kind = Object::Kind::group;
  group.members = {{"a", Object::Kind::numbers}};
  group.attributes = {{"units", std::string("m")}, {"count", 3.0}, {"odd", Json::Null()}};
  name = "/a";
  numbers.kind = Object::Kind::numbers;
  numbers.shape = {2, 1};
  numbers.numbers = {1, 2};
  const auto judge = [&] {
    handed_over = detail::bytes_of(objects);
    return Document(detail::InputFile(file));
  };
  const Document document = judge();
  CHECK(document.group("/").text("units") == "m");
  CHECK(document.group("/").number("count") == 3);
  CHECK_FALSE(document.group("/").number("odd"));
  CHECK(document.numeric("a").numbers == numbers.numbers);

  SECTION("no root") { root = "/b"; }
  SECTION("an object of no kind") { numbers.kind = Object::Kind(4); }
  SECTION("a member of no kind") { group.members[0].second = Object::Kind(255); }
  SECTION("fewer numbers than the shape says") { numbers.numbers->pop_back(); }
  SECTION("numbers of what is refused") { numbers.refusal = "is not a list of names"; }
  SECTION("more points than a number counts") { numbers.shape = {1ull << 32, 1ull << 32}; }
  SECTION("more points than the file may hold") { numbers.shape = {1ull << 40}; }
  SECTION("a place behind the end of the file") {
    numbers.numbers.reset();
    numbers.location = std::filesystem::file_size(file) - 15;
  }
  SECTION("a place before which addresses begin anew") { numbers.location = ~0ull - 7; }
  CHECK_THROWS_WITH(judge(), Catch::Contains("few.h5: makes the HDF5 library return wrong values"));
}

TEST_CASE("Numbers are those that were stored, read from their place or through HDF5", "[hdf5]") {
  const Scratch scratch;
  const std::string file = (scratch / "stored.h5").string();
  std::vector<double> stored(100 * 150);  // too many values for the outline
  for (std::size_t i = 0; i < stored.size(); ++i) stored[i] = 0.25 * static_cast<double>(i) - 9;
  const auto [type, chunked] =
      GENERATE(std::pair(H5T_IEEE_F64LE, false), std::pair(H5T_IEEE_F64LE, true),
               std::pair(H5T_IEEE_F64BE, false), std::pair(H5T_IEEE_F32LE, false),
               std::pair(H5T_STD_I64LE, false));
  if (type == H5T_STD_I64LE)
    for (double& value : stored) value = std::floor(value);
  {
    const hid_t layout = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t shape[] = {100, 150}, chunk[] = {10, 150};
    if (chunked) H5Pset_chunk(layout, 2, chunk);
    const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                space = H5Screate_simple(2, shape, nullptr);
    const hid_t dataset = H5Dcreate2(made, "a", type, space, H5P_DEFAULT, layout, H5P_DEFAULT);
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored.data());
    H5Dclose(dataset);
    H5Sclose(space);
    H5Fclose(made);
    H5Pclose(layout);
  }
  const Document document{detail::InputFile(file)};
  CHECK(document.numeric("a").location.has_value() == (type == H5T_IEEE_F64LE && !chunked));
  std::vector<double> read(stored.size());
  document.numbers("a", read);
  CHECK(read == stored);
  const RowPartition rows(Communicator(), 100);
  std::ranges::fill(read, 0);
  document.rows("a", rows, read);
  CHECK(read == stored);
  // A file that is truncated while it is read is refused.
  if (document.numeric("a").location) {
    std::filesystem::resize_file(file, *document.numeric("a").location + 8);
    CHECK_THROWS_WITH(document.numbers("a", read), Catch::Contains("ended while it was read"));
  }
}

TEST_CASE("Bytes of an outline are judged before anything is made of them", "[hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "few.h5";
  ResultFile(file, {}).commit();
  const Installed installed;
  Objects objects(1);
  objects[0].first = "/";
  objects[0].second.kind = Object::Kind::group;
  const std::string whole = detail::bytes_of(objects);
  const auto refused = [&] {
    CHECK_THROWS_WITH(Document(detail::InputFile(file)), Catch::Contains("return wrong values"));
  };
  for (std::size_t size = 0; size < whole.size(); ++size) {
    INFO(size);
    handed_over = whole.substr(0, size);
    refused();
  }
  // No memory is allocated for a count that exceeds the remaining bytes.
  handed_over = whole;
  handed_over.replace(0, sizeof(std::size_t), detail::bytes_of(std::size_t(1) << 40));
  refused();
  CHECK(detail::from_bytes<bool>("\1", "truth"));
  CHECK_THROWS_WITH(detail::from_bytes<bool>("\2", "truth"), Catch::Contains("damaged"));
}

TEST_CASE("Of several maps of HDF5 the one that is named is read", "[hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "maps.h5";
  const auto written = [&](const std::vector<const char*>& names) {
    const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    H5Gclose(H5Gcreate2(made, "scan", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const hsize_t shape[]{2, 2};
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::vector<double> values(4, double(i + 1));
      H5LTmake_dataset_double(made, names[i], 2, shape, values.data());
      H5LTset_attribute_string(made, names[i], "units", i == 2 ? "Pa" : "m");
    }
    H5Fclose(made);
  };
  std::vector<std::string> warnings;
  const auto height = [&](const std::string& channel) {
    warnings.clear();
    return read_surface(file, {.size_x = 1, .size_y = 1, .channel = channel, .warnings = &warnings})
        .heights(0, 0);
  };
  written({"heights", "backward", "pressure", "scan/trace"});
  CHECK(height("") == 1);
  REQUIRE_FALSE(warnings.empty());
  CHECK_THAT(warnings[0],
             Catch::Contains(
                 "channel heights was read; the others are backward; choose one with `channel`"));
  CHECK(height("backward") == 2);
  CHECK(height("scan/trace") == 4);
  CHECK_THROWS_WITH(height("pressure"), Catch::Contains("'Pa'"));
  CHECK_THROWS_WITH(height("forward"), Catch::Contains("channel: forward is no channel of"));
  written({"a", "b"});
  CHECK_THROWS_WITH(height(""),
                    Catch::Contains("a and b among them") && Catch::Contains("`channel`"));
  CHECK(height("b") == 2);
}

TEST_CASE("An attribute at the root of HDF5 that may change the heights is refused", "[hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "scaled.h5";
  const auto read_with = [&](const char* attribute) {
    write_surface(file, {{2, 2, 1, 1}, Field::Zero(2, 2), true, "test"}, {}, {.overwrite = true});
    const hid_t opened = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const double value = 2;
    H5LTset_attribute_double(opened, "/", attribute, &value, 1);
    H5Fclose(opened);
    return read_surface(file);
  };
  for (const char* attribute : {"z_scale", "scale_factor", "Height unit"})
    CHECK_THROWS_WITH(read_with(attribute), Catch::Contains(std::string("attribute ") + attribute));
  CHECK_NOTHROW(read_with("serial"));
}

TEST_CASE("Attributes of the conventions for climate data make heights of stored numbers",
          "[hdf5]") {
  const Scratch scratch;
  const auto file = scratch / "cf.h5";
  const auto written = [&](const std::vector<std::pair<const char*, double>>& numbers,
                           std::optional<std::string> text_named = {}) {
    const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hsize_t shape[]{2, 2};
    const hid_t space = H5Screate_simple(2, shape, nullptr), one = H5Screate(H5S_SCALAR);
    const hid_t heights =
        H5Dcreate2(made, "heights", H5T_NATIVE_INT16, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const std::int16_t stored[]{1, 2, -9999, 40};
    H5Dwrite(heights, H5T_NATIVE_INT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, stored);
    const auto put = [&](const char* name, hid_t type, const void* value) {
      const hid_t attribute = H5Acreate2(heights, name, type, one, H5P_DEFAULT, H5P_DEFAULT);
      H5Awrite(attribute, type, value);
      H5Aclose(attribute);
    };
    for (const auto& [name, value] : numbers) put(name, H5T_NATIVE_DOUBLE, &value);
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, 2);
    put("units", text, "nm");
    if (text_named) put(text_named->c_str(), text, "ab");
    H5Tclose(text);
    H5Dclose(heights);
    H5Sclose(space);
    H5Sclose(one);
    H5Fclose(made);
    return file;
  };
  const ReadOptions size{.size_x = 1e-6, .size_y = 1e-6};
  const Surface scaled = read_surface(
      written(
          {{"_FillValue", -9999}, {"scale_factor", 0.5}, {"add_offset", 10}, {"valid_max", 39}}),
      size);
  // The unit in metres is rounded.
  CHECK(scaled.heights(0, 0) == Approx(10.5e-9).epsilon(1e-15));
  CHECK(scaled.heights(0, 1) == Approx(11e-9).epsilon(1e-15));
  CHECK(std::isnan(scaled.heights(1, 0)));
  CHECK(std::isnan(scaled.heights(1, 1)));
  CHECK(std::isnan(read_surface(written({{"missing_value", -9999}}), size).heights(1, 0)));
  CHECK(read_surface(written({{"serial", 7}}), size).heights(1, 0) == Approx(-9.999e-6));
  for (const char* name : {"valid_range", "Z_Scale", "gain", "nodata_value", "height_unit"})
    CHECK_THROWS_WITH(read_surface(written({{name, 2}}), size),
                      Catch::Contains("has an attribute " + std::string(name)));
  CHECK_THROWS_WITH(read_surface(written({}, "_FillValue"), size),
                    Catch::Contains("has an attribute _FillValue that is not a single number"));
}
