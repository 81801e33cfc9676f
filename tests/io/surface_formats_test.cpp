// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the table of formats with docs/formats.md, and tests Gwyddion's own format byte by byte.
#include "io/surface_formats.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Components of Gwyddion's containers, made independently of the writer.
template <class T>
std::string raw(T value) {
  return std::string(reinterpret_cast<const char*>(&value), sizeof value);
}
std::string name(const std::string& text) { return text + '\0'; }
std::string whole(const std::string& key, std::int32_t value) {
  return name(key) + 'i' + raw(value);
}
std::string real(const std::string& key, double value) { return name(key) + 'd' + raw(value); }
std::string text(const std::string& key, const std::string& value) {
  return name(key) + 's' + name(value);
}
std::string object(const std::string& type, const std::string& content) {
  return name(type) + raw(static_cast<std::uint32_t>(content.size())) + content;
}
std::string member(const std::string& key, const std::string& type, const std::string& content) {
  return name(key) + 'o' + object(type, content);
}
std::string reals(const std::string& key, const std::vector<double>& values) {
  std::string bytes = name(key) + 'D' + raw(static_cast<std::uint32_t>(values.size()));
  for (const double value : values) bytes += raw(value);
  return bytes;
}
std::string unit(const std::string& key, const std::string& value) {
  return member(key, "GwySIUnit", text("unitstr", value));
}
/// A channel of three by two points on 3 µm by 1 µm.
std::string channel(const std::string& key, const std::string& height_unit,
                    const std::vector<double>& values) {
  return member(key, "GwyDataField",
                whole("xres", 3) + whole("yres", 2) + real("xreal", 3e-6) + real("yreal", 1e-6) +
                    real("xoff", 5e-6) + unit("si_unit_xy", "m") + unit("si_unit_z", height_unit) +
                    reals("data", values));
}
std::string gwy(const std::string& content) { return "GWYP" + object("GwyContainer", content); }

const std::vector<double> hills{1e-9, 2e-9, 3e-9, 4e-9, 5e-9, 6e-9};

}  // namespace

TEST_CASE("The table of docs/formats.md is that of the program", "[formats]") {
  std::ifstream page(SALEBRA_FORMATS_PAGE);
  REQUIRE(page);
  std::vector<std::string> rows;
  // Read the first table of the page.
  for (std::string line; std::getline(page, line) && (rows.empty() || line.starts_with("|"));)
    if (line.starts_with("| ") && !line.starts_with("| format |")) rows.push_back(line);
  std::vector<std::string> expected;
  for (const SurfaceFormat& format : surface_formats()) {
    std::string extensions;
    for (const std::string_view extension : format.extensions)
      extensions += (extensions.empty() ? "`" : ", `") + std::string(extension) + '`';
    std::string row = "|";
    for (const std::string_view column :
         {format.title, std::string_view(extensions), format.read,
          format.written.empty() ? std::string_view("no") : format.written, format.heights,
          format.size, format.undefined_points, format.periodic, format.provenance})
      row += (column.empty() ? "" : " ") + std::string(column) + " |";
    expected.push_back(row);
  }
  CHECK(rows == expected);
}

TEST_CASE("A file of Gwyddion: the first channel of heights, its mask, its size", "[formats]") {
  const Scratch scratch;
  // Components of every type come before and between those that are read; channel 10 follows
  // channel 2.
  const std::string others = name("/flag") + 'b' + '\1' + name("/letter") + 'c' + 'x' +
                             name("/long") + 'q' + raw(std::int64_t{1}) + name("/letters") + 'C' +
                             raw(std::uint32_t{2}) + "ab" + name("/numbers") + 'I' +
                             raw(std::uint32_t{1}) + raw(std::int32_t{7}) + name("/longs") + 'Q' +
                             raw(std::uint32_t{1}) + raw(std::int64_t{7}) + name("/texts") + 'S' +
                             raw(std::uint32_t{2}) + name("a") + name("b") + name("/units") + 'O' +
                             raw(std::uint32_t{1}) + object("GwySIUnit", text("unitstr", "m"));
  const auto file = scratch.file(
      "scan.gwy",
      gwy(others + channel("/10/data", "m", {9, 9, 9, 9, 9, 9}) +
          channel("/0/data", "V", {8, 8, 8, 8, 8, 8}) + text("/2/data/title", "Height") +
          channel("/2/mask", "", {0, 0, 0, 0, 1, 0}) + channel("/2/data", "nm", hills) +
          channel("/2/show", "m", {7, 7, 7, 7, 7, 7})));
  const Surface surface = read_surface(file);
  CHECK(surface.grid == Grid2D{3, 2, 3e-6, 1e-6});
  CHECK_FALSE(surface.periodic);
  CHECK(surface.heights(0, 0) == Approx(1e-18));
  CHECK(surface.heights(2, 0) == Approx(3e-18));  // rows run along x
  CHECK(surface.heights(0, 1) == Approx(4e-18));
  CHECK(std::isnan(surface.heights(1, 1)));
  CHECK(surface.undefined_points() == 1);
}

TEST_CASE("Of several channels of Gwyddion the one that is named is read", "[formats]") {
  const Scratch scratch;
  const auto ones = [](double height) { return std::vector<double>(6, height); };
  const auto file = scratch.file(
      "channels.gwy", gwy(channel("/0/data", "V", ones(8)) + text("/0/data/title", "Error") +
                          channel("/2/data", "m", ones(2)) + text("/2/data/title", "Trace") +
                          channel("/3/data", "m", ones(3)) + text("/3/data/title", "Retrace") +
                          channel("/5/data", "m", ones(5)) + text("/5/data/title", "Retrace")));
  std::vector<std::string> warnings;
  const auto height = [&](const std::string& wanted) {
    return read_surface(file, {.channel = wanted, .warnings = &warnings}).heights(0, 0);
  };
  CHECK(height("") == 2);
  REQUIRE_FALSE(warnings.empty());
  CHECK_THAT(warnings[0], Contains("channel 2 (Trace) was read; the others are 3 (Retrace), 5 "
                                   "(Retrace); choose one with `channel`"));
  warnings.clear();
  CHECK(height("Trace") == 2);
  CHECK(height("5") == 5);
  for (const std::string& warning : warnings) CHECK_THAT(warning, !Contains("channel"));
  CHECK_THROWS_WITH(height("Retrace"), Contains("name of several channels"));
  CHECK_THROWS_WITH(height("4"), Contains("channel: 4 is no channel of") && Contains("0 (Error)"));
  CHECK_THROWS_WITH(height("Error"), Contains("'V', which is not a unit of length"));
  write_surface(scratch / "one.gsf", read_surface(file));
  CHECK_THROWS_WITH(read_surface(scratch / "one.gsf", {.channel = "2"}),
                    Contains("a format that holds only one surface"));
}

TEST_CASE("A file of Gwyddion without units is in metres, or as the user says", "[formats]") {
  const Scratch scratch;
  const auto file = scratch.file("bare.gwy", gwy(channel("/0/data", "", hills)));
  CHECK(read_surface(file).heights(2, 1) == 6e-9);
  ReadOptions options;
  options.height_unit = "nm";
  CHECK(read_surface(file, options).heights(2, 1) == Approx(6e-18));
}

TEST_CASE("Units of a simple field come from it, or from the user where it has none", "[formats]") {
  const Scratch scratch;
  const auto field = [&](const std::string& entries) {
    std::string text =
        "Gwyddion Simple Field 1.0\nXRes = 2\nYRes = 2\nXReal = 4\nYReal = 4\n" + entries;
    text.append(4 - text.size() % 4, '\0');
    for (const float height : {1.f, 2.f, 3.f, 4.f})
      text.append(reinterpret_cast<const char*>(&height), sizeof height);
    return scratch.file("field.gsf", text);
  };
  const Surface bare = read_surface(field(""), {.lateral_unit = "um", .height_unit = "nm"});
  CHECK(bare.grid.lx == Approx(4e-6));
  CHECK(bare.heights(1, 0) == Approx(2e-9));
  std::vector<std::string> warnings;
  const auto stated = field("XYUnits = m\nZUnits = m\n");
  CHECK(read_surface(stated, {.lateral_unit = "um", .warnings = &warnings}).grid.lx == 4);
  CHECK_THROWS_WITH(read_surface(stated, {.height_unit = "nm"}),
                    Catch::Contains("states the unit of its heights"));
  for (const std::string entry : {"ZUnit = nm", "ZScale = 1e-9", "Pixel size = 2 um", "NoData = 4",
                                  "Lx = 4e-6", "Mystery = nm"})
    CHECK_THROWS_WITH(read_surface(field("ZUnits = m\n" + entry + "\n")),
                      Contains("'" + entry + "'"));
  for (const std::string entry : {"Serial number = 4711", "Date = 2024-05-01 12:30", "Bias = 1 V",
                                  "Comment = 3 nm of gold", "XOffset = 2", "Mystery = yes"})
    CHECK(read_surface(field("ZUnits = m\n" + entry + "\n")).heights(1, 0) == 2);
}

TEST_CASE("What is written for Gwyddion is a container of its data fields", "[formats]") {
  const Scratch scratch;
  Surface surface{{3, 2, 3e-6, 1e-6}, Field(3, 2), false, "here"};
  for (Index i = 0; i < 6; ++i) surface.heights(i % 3, i / 3) = hills[std::size_t(i)];
  surface.heights(1, 1) = std::numeric_limits<double>::quiet_NaN();
  write_surface(scratch / "a.gwy", surface);
  const std::string written = bytes_of(scratch / "a.gwy");
  const auto field = [](const std::string& key, const std::string& height_unit,
                        const std::vector<double>& values) {
    return member(key, "GwyDataField",
                  whole("xres", 3) + whole("yres", 2) + real("xreal", 3e-6) + real("yreal", 1e-6) +
                      unit("si_unit_xy", "m") + unit("si_unit_z", height_unit) +
                      reals("data", values));
  };
  // The undefined point holds the mean of the others, 16e-9/5.
  double mean = 0;
  for (const double height : {1e-9, 2e-9, 3e-9, 4e-9, 6e-9}) mean += height;
  std::vector<double> filled = hills;
  filled[4] = mean / 5;
  const std::string end = field("/0/data", "m", filled) + field("/0/mask", "", {0, 0, 0, 0, 1, 0});
  REQUIRE(written.size() > end.size() + 21);
  CHECK(written.ends_with(end));
  CHECK(written.substr(0, 21) ==
        "GWYP" + name("GwyContainer") + raw(static_cast<std::uint32_t>(written.size() - 21)));
  CHECK_THAT(written, Contains(std::string("/0/meta\0oGwyContainer", 21)));
  // The reader needs every byte: a file without its last byte is refused.
  CHECK(read_surface(scratch / "a.gwy").undefined_points() == 1);
  CHECK_THROWS_AS(read_surface(scratch.file("cut.gwy", written.substr(0, written.size() - 1))),
                  InvalidInput);
}

TEST_CASE("Damaged files of Gwyddion are refused", "[formats]") {
  const Scratch scratch;
  const std::string facts =
      whole("xres", 3) + whole("yres", 2) + real("xreal", 1) + real("yreal", 1);
  const std::uint32_t much = std::numeric_limits<std::uint32_t>::max();
  const auto field = [](const std::string& content) {
    return gwy(member("/0/data", "GwyDataField", content));
  };
  const auto [content, expected] = GENERATE_REF(table<std::string, std::string>({
      {"GWYP", "that does not end"},
      {"GWYP" + object("GwyBrick", ""), "GwyContainer"},
      {"GWYP" + name("GwyContainer") + raw(much), "declares more bytes"},
      {gwy(""), "not contain a channel"},
      {gwy(channel("/0/data", "V", hills)), "'V'"},
      {gwy(channel("/0/data", "m", {1, 2})), "a different number"},
      {gwy(channel("/0/data", "m", hills) + channel("/0/mask", "", {1})), "a different number"},
      {gwy(name("/x") + '?'), "unknown type"},
      {gwy(name("/x") + 'D' + raw(much)), "declares more bytes"},
      {gwy(name("/x") + 'Z' + raw(much)), "unknown type"},
      {gwy(name("/x") + 'S' + raw(much) + "no end"), "that does not end"},
      {field(whole("xres", 0) + whole("yres", 2) + reals("data", {})), "0 x 2"},
      {field(whole("xres", 65536) + whole("yres", 65536) + reals("data", {})), "65536 x 65536"},
      {field(facts), "a different number"},
      {field(real("xres", 3) + whole("yres", 2) + reals("data", hills)), "xres"},
      {field(whole("xres", 3) + whole("yres", 2) + reals("data", hills)), "xreal"},
      {field(facts + reals("data", {1, 2, 3, 4, 5, INFINITY})), "infinite"},
      {field(facts + unit("si_unit_xy", "s") + reals("data", hills)), "'s'"},
  }));
  INFO(expected);
  CHECK_THROWS_WITH(read_surface(scratch.file("damaged.gwy", content)), Contains(expected));
  // Objects nested 1000 deep do no harm: objects that are not needed are not parsed.
  std::string deep;
  for (int i = 0; i < 1000; ++i) deep = member("a", "GwyContainer", deep);
  CHECK_NOTHROW(read_surface(scratch.file("deep.gwy", gwy(deep + channel("/0/data", "m", hills)))));
}
