// SPDX-License-Identifier: GPL-3.0-or-later
#include <zip.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const double undefined = std::numeric_limits<double>::quiet_NaN();

using Members = std::map<std::string, std::string>;

/// An archive of these members, stored without compression or deflated.
std::filesystem::path archive(const Scratch& scratch, const Members& members,
                              int compression = ZIP_CM_STORE) {
  const auto file = scratch / "made.x3p";
  std::filesystem::remove(file);
  zip_t* zip = zip_open(file.c_str(), ZIP_CREATE, nullptr);
  REQUIRE(zip);
  for (const auto& [name, content] : members) {
    const auto index = zip_file_add(zip, name.c_str(),
                                    zip_source_buffer(zip, content.data(), content.size(), 0), 0);
    zip_set_file_compression(zip, static_cast<zip_uint64_t>(index), compression, 0);
  }
  REQUIRE(zip_close(zip) == 0);
  return file;
}

template <class Stored>
std::string bytes_of(std::initializer_list<Stored> values) {
  return {reinterpret_cast<const char*>(values.begin()), values.size() * sizeof(Stored)};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Three points along x, two along y, 16-bit heights in steps of 1 nm above 5 nm; no checksums.
const std::string main_xml = R"(<?xml version="1.0"?>
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
  <Record1>
    <Revision>ISO5436 - 2000</Revision>
    <FeatureType>SUR</FeatureType>
    <Axes>
      <CX><AxisType>I</AxisType><DataType>L</DataType><Increment>1e-6</Increment></CX>
      <CY><AxisType>I</AxisType><DataType>L</DataType><Increment>2e-006</Increment></CY>
      <CZ><AxisType>A</AxisType><DataType>I</DataType><Increment>1E-9</Increment><Offset>+5e-9</Offset></CZ>
    </Axes>
  </Record1>
  <Record3>
    <MatrixDimension><SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ></MatrixDimension>
    <DataLink><PointDataLink>data.bin</PointDataLink></DataLink>
  </Record3>
</p:ISO5436_2>)";
const std::string heights = bytes_of<std::int16_t>({0, 10, 20, 100, -200, 32767});

}  // namespace

TEST_CASE("X3P keeps x fastest, scale and offset of integer heights", "[x3p]") {
  const Scratch scratch;
  const Surface surface = read_surface(
      archive(scratch, {{"main.xml", main_xml}, {"data.bin", heights}}, ZIP_CM_DEFLATE));
  CHECK(surface.grid.nx == 3);
  CHECK(surface.grid.ny == 2);
  CHECK(surface.grid.lx == Approx(3e-6));
  CHECK(surface.grid.ly == Approx(4e-6));
  CHECK_FALSE(surface.periodic);
  CHECK(surface.heights(0, 0) == Approx(5e-9));
  CHECK(surface.heights(1, 0) == Approx(15e-9));
  CHECK(surface.heights(0, 1) == Approx(105e-9));
  CHECK(surface.heights(1, 1) == Approx(-195e-9));
  CHECK(surface.heights(2, 1) == Approx(32772e-9));
}

TEST_CASE("X3P reads every type of heights", "[x3p]") {
  const Scratch scratch;
  const auto read = [&](const std::string& type, const std::string& data) {
    const std::string xml =
        replaced(main_xml, "<DataType>I</DataType>", "<DataType>" + type + "</DataType>");
    return read_surface(archive(scratch, {{"main.xml", xml}, {"data.bin", data}})).heights;
  };
  const auto check = [](const Field& field) {
    CHECK(field(0, 0) == Approx(6e-9));
    CHECK(field(2, 0) == Approx(8e-9));
    CHECK(field(0, 1) == Approx(-99995e-9));
    CHECK(field(2, 1) == Approx(11e-9));
  };
  check(read("L", bytes_of<std::int32_t>({1, 2, 3, -100000, 5, 6})));
  check(read("F", bytes_of<float>({1, 2, 3, -100000, 5, 6})));
  check(read("D", bytes_of<double>({1, 2, 3, -100000, 5, 6})));
  const Field field = read("D", bytes_of<double>({1, undefined, 3, 4, 5, 6}));
  CHECK(std::isnan(field(1, 0)));
  CHECK(field.isNaN().count() == 1);
}

TEST_CASE("Points that X3P lists against an axis come out along it", "[x3p]") {
  const Scratch scratch;
  const auto read = [&](const std::string& xml) {
    return read_surface(archive(scratch, {{"main.xml", xml}, {"data.bin", heights}}));
  };
  const Field plain = read(main_xml).heights;
  const Surface along_x = read(replaced(main_xml, "<Increment>1e-6<", "<Increment>-1e-6<"));
  CHECK((along_x.heights == plain.colwise().reverse()).all());
  CHECK(along_x.grid.lx == Approx(3e-6));
  const Surface along_y = read(replaced(main_xml, "<Increment>2e-006<", "<Increment>-2e-006<"));
  CHECK((along_y.heights == plain.rowwise().reverse()).all());
}

TEST_CASE("X3P masks points by bits, the least first", "[x3p]") {
  const Scratch scratch;
  const std::string xml =
      replaced(main_xml, "</DataLink>", "<ValidPointsLink>valid.bin</ValidPointsLink></DataLink>");
  // Points 1 and 3, (1, 0) and (0, 1), are not valid.
  const Field field = read_surface(archive(scratch, {{"main.xml", xml},
                                                     {"data.bin", heights},
                                                     {"valid.bin", std::string(1, '\x35')}}))
                          .heights;
  CHECK(field.isNaN().count() == 2);
  CHECK(std::isnan(field(1, 0)));
  CHECK(std::isnan(field(0, 1)));
  CHECK_THROWS_WITH(read_surface(archive(scratch, {{"main.xml", xml}, {"data.bin", heights}})),
                    Contains("valid.bin"));
  CHECK_THROWS_WITH(read_surface(archive(scratch, {{"main.xml", xml},
                                                   {"data.bin", heights},
                                                   {"valid.bin", std::string(2, '\xff')}})),
                    Contains("valid.bin") && Contains("states 1"));
}

TEST_CASE("X3P that was packed as a folder is read, several folders are not", "[x3p]") {
  const Scratch scratch;
  const std::string xml = replaced(main_xml, ">data.bin", ">bindata/data.bin");
  const Members one{{"scan/main.xml", xml}, {"scan/bindata/data.bin", heights}};
  CHECK(read_surface(archive(scratch, one)).heights(1, 0) == Approx(15e-9));
  Members two = one;
  two["other/main.xml"] = xml;
  CHECK_THROWS_WITH(read_surface(archive(scratch, two)), Contains("several folders"));
}

TEST_CASE("Infinite heights of X3P are undefined points", "[x3p]") {
  const Scratch scratch;
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string xml = replaced(main_xml, "<DataType>I</DataType>", "<DataType>D</DataType>");
  std::vector<std::string> warnings;
  const Surface surface = read_surface(
      archive(scratch, {{"main.xml", xml},
                        {"data.bin", bytes_of<double>({1, infinity, 3, -infinity, 5, 6})}}),
      {.warnings = &warnings});
  CHECK(std::isnan(surface.heights(1, 0)));
  CHECK(std::isnan(surface.heights(0, 1)));
  CHECK(surface.undefined_points() == 2);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("2 infinite heights"));
}

TEST_CASE("An entry of X3P that the standard does not have is refused by name", "[x3p]") {
  const Scratch scratch;
  const auto [from, to, name] = GENERATE(table<std::string, std::string, std::string>(
      {{"</CZ>", "<Unit>um</Unit></CZ>", "Record1/Axes/CZ/Unit"},
       {"<Increment>1E-9", "<Increment unit=\"um\">1E-9", "Record1/Axes/CZ/Increment/@unit"},
       {"</Axes>", "<Scale>2</Scale></Axes>", "Record1/Axes/Scale"},
       {"</Record1>", "<Unit>um</Unit></Record1>", "Record1/Unit"}}));
  CHECK_THROWS_WITH(read_surface(archive(scratch, {{"main.xml", replaced(main_xml, from, to)},
                                                   {"data.bin", heights}})),
                    Contains(name + " in its main.xml, which salebra does not apply"));
}

TEST_CASE("X3P that is no height map, or damaged, says what it lacks", "[x3p]") {
  const Scratch scratch;
  const auto refused = [&](const Members& members, const std::string& why) {
    INFO(why);
    const auto file = archive(scratch, members);
    CHECK_THROWS_AS(read_surface(file), InvalidInput);
    CHECK_THROWS_WITH(read_surface(file), Contains("made.x3p") && Contains(why) && !Contains("\n"));
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    return Members{{"main.xml", replaced(main_xml, from, to)}, {"data.bin", heights}};
  };
  refused({{"readme.txt", "x"}}, "without main.xml");
  refused({{"main.xml", "not XML <"}}, "not XML");
  refused({{"main.xml", "<html/>"}}, "ISO 25178-72");
  refused({{"main.xml", main_xml}}, "lacks its member data.bin");
  refused(changed("SUR", "PRF"), "PRF");
  refused(changed("<CX><AxisType>I", "<CX><AxisType>A"), "CX/AxisType");
  refused(changed("<SizeX>3", "<SizeX>-3"), "SizeX = '-3'");
  refused(changed("<SizeX>3", "<SizeX>4"), "states 16");
  refused(changed("<SizeX>3", "<SizeX>9000000000000000000"), "memory");
  refused(changed("<SizeZ>1", "<SizeZ>2"), "layers");
  refused(changed("<Increment>1e-6", "<Increment>0"), "CX/Increment");
  refused(changed("<Increment>1e-6", "<Increment>1,5"), "CX/Increment = '1,5'");
  refused(changed("<Increment>1e-6", "<Increment>inf"), "CX/Increment");
  refused(changed("<DataType>I", "<DataType>Q"), "DataType = 'Q'");
  refused(changed("<DataLink><PointDataLink>data.bin</PointDataLink></DataLink>", "<DataList/>"),
          "within main.xml");
  refused(changed("</Axes>", "<Rotation><r33>0</r33></Rotation></Axes>"), "plane");
  refused(changed("<PointDataLink>data.bin", "<PointDataLink>../../etc/passwd"),
          "lacks its member");
}

TEST_CASE("A cut or changed X3P archive is refused, never read in part", "[x3p]") {
  const Scratch scratch;
  const auto file =
      archive(scratch, {{"main.xml", main_xml}, {"data.bin", heights}}, ZIP_CM_DEFLATE);
  std::ifstream stream(file, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t length = 4; length < content.size(); ++length)
    CHECK_THROWS_AS(read_surface(scratch.file("cut.x3p", content.substr(0, length))), InvalidInput);
  // The heights come first in the archive. Changing one of their bytes breaks their CRC.
  const auto at = content.find("data.bin") + 8 + 4;
  std::string changed = content;
  changed[at] = static_cast<char>(changed[at] ^ 0x10);
  CHECK_THROWS_AS(read_surface(scratch.file("changed.x3p", changed)), InvalidInput);
}

TEST_CASE("A ZIP bomb in X3P is refused before it fills the memory", "[x3p]") {
  const Scratch scratch;
  // 32 MiB of zeros as main.xml and as heights, with the true size in the archive's directory.
  const std::string zeros(std::size_t{1} << 25, '\0');
  CHECK_THROWS_WITH(read_surface(archive(scratch, {{"main.xml", zeros}}, ZIP_CM_DEFLATE)),
                    Contains("more than it can hold"));
  CHECK_THROWS_WITH(
      read_surface(archive(scratch, {{"main.xml", main_xml}, {"data.bin", zeros}}, ZIP_CM_DEFLATE)),
      Contains("states 12"));
  // The directory declares 2 GiB of heights for 12 bytes.
  const auto file =
      archive(scratch, {{"main.xml", replaced(replaced(main_xml, "<SizeX>3", "<SizeX>32768"),
                                              "<SizeY>2", "<SizeY>32768")},
                        {"data.bin", heights}});
  std::ifstream stream(file, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  const auto directory = content.find("PK\x01\x02");
  const std::uint32_t size = 0x80000000u;
  std::memcpy(content.data() + directory + 24, &size, 4);
  CHECK_THROWS_WITH(read_surface(scratch.file("lie.x3p", content)), Contains("lie.x3p"));
}
