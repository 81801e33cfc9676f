// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>
#include <salebra/io/write_surface.hpp>
#include <salebra/surface/moments.hpp>

#include "io/loaded_surface.hpp"
#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

const std::filesystem::path measured = SALEBRA_SURFACES;

}  // namespace

TEST_CASE("Measured surfaces have the statistics of the reference", "[read]") {
  const auto reference = nlohmann::json::parse(std::ifstream(measured / "reference.json"));
  for (const char* name :
       {"matrix-2.txt", "matrix-3.txt", "gwyddion-export-english.txt", "gwyddion-export-german.txt",
        "txt_example.txt", "xyz-1.txt", "xyz-2.txt", "sur-2.sur", "x3p-2.x3p"}) {
    INFO(name);
    const nlohmann::json& expected = reference.at(name);
    const auto number = [&](const char* key) { return expected.at(key).get<double>(); };
    const Surface surface = read_surface(measured / name);
    CHECK(surface.grid.nx == expected.at("nx").get<Index>());
    CHECK(surface.grid.ny == expected.at("ny").get<Index>());
    CHECK(surface.undefined_points() == expected.at("undefined_points").get<Index>());
    CHECK_FALSE(surface.periodic);
    const HeightStatistics statistics = height_statistics(surface);
    // Both sides sum about 10⁵ doubles. SurfaceTopography multiplies by the unit before the sum,
    // salebra after it.
    CHECK(surface.grid.lx == Approx(number("size_x_m")).epsilon(1e-12));
    CHECK(surface.grid.ly == Approx(number("size_y_m")).epsilon(1e-12));
    CHECK(statistics.minimum == Approx(number("min_m")).epsilon(1e-12));
    CHECK(statistics.maximum == Approx(number("max_m")).epsilon(1e-12));
    CHECK(statistics.mean ==
          Approx(number("mean_m")).epsilon(1e-10).margin(1e-15 * number("max_m")));
    CHECK(statistics.rms_height == Approx(number("rms_height_m")).epsilon(1e-10));
    CHECK(surface.heights(0, 0) == Approx(number("height_00_m")).epsilon(1e-12));
    CHECK(surface.heights(0, 1) == Approx(number("height_01_m")).epsilon(1e-12));
    if (!expected.at("height_10_m").is_null())
      CHECK(surface.heights(1, 0) == Approx(number("height_10_m")).epsilon(1e-12));
    if (expected.contains("rms_slope"))
      CHECK(difference_moments(surface).rms_slope() == Approx(number("rms_slope")).epsilon(1e-10));
  }
}

TEST_CASE("A bare array needs its size from the user and keeps its axes", "[read]") {
  CHECK_THROWS_WITH(read_surface(measured / "example-2d.npy"),
                    Contains("example-2d.npy") && Contains("size_x") && Contains("give `size_x`"));
  CHECK_THROWS_AS(read_surface(measured / "example-2d.npy", {.size_x = 1, .size_y = 0}),
                  InvalidInput);
  const Surface surface =
      read_surface(measured / "example-2d.npy", {.size_x = 2, .size_y = 1, .height_unit = "nm"});
  CHECK(surface.heights(0, 0) == Approx(0.1e-9));
  CHECK(surface.heights(0, 1) == Approx(1e-9));
  CHECK(surface.heights(1, 0) == Approx(4e-9));
  CHECK(surface.grid == Grid2D{2, 2, 2, 1});
}

TEST_CASE("Files that are broken on purpose give one line that names them", "[read]") {
  for (const char* name : {"wrongnpyfile.npy", "nonsense_txt_file.txt", "absent.txt", "."}) {
    INFO(name);
    CHECK_THROWS_AS(read_surface(measured / name), InvalidInput);
    CHECK_THROWS_WITH(read_surface(measured / name), Contains(name) && !Contains("\n"));
  }
}

TEST_CASE("Text is read in the spellings of many programs", "[read]") {
  const Scratch scratch;
  const std::string header = "# Width: 3 µm\n# Height: 2000 nm\n# Value units: nm\n";
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("surface.txt", text));
  };
  const auto check = [&](const std::string& text) {
    INFO(text);
    const Surface surface = read(text);
    REQUIRE(surface.heights.rows() == 3);
    REQUIRE(surface.heights.cols() == 2);
    CHECK(surface.grid.lx == Approx(3e-6));
    CHECK(surface.grid.ly == Approx(2e-6));
    CHECK(surface.heights(1, 0) == Approx(2.5e-9));
    CHECK(surface.heights(0, 1) == Approx(-4e-9));
  };
  check(header + "1.0 2.5 3\n-4 5 6\n");
  check(header + "+1.0\t+2.5e0\t3\t\r\n-4\t5\t6\t\r\n");
  check("\xef\xbb\xbf" + header + "1;2.5;3;\n-4;5;6;");
  check(header + "1, 2.5, 3\n\n-4, 5, 6\n");
  check(header + "1.0,2.5,3\n-4,5,6\n");
  check(header + "1,0 2,5 3,0\n-4 5 6\n");
  check(header + "1,0;2,5;3\n-4;5;6\n");
  // The first row does not show whether commas are decimal.
  check(header + "1;2,5;3\n-4;5;6\n");
  check("# Breite: 3 \xb5m\r# H\xf6he: 2 \xb5m\r# Value units: nm\r1 2.5 3\r-4 5 6\r");
  check(
      "w=3 h=2\npixel size=1e-006 m\ndata unit=rad\nheight conversion factor (-> m)=1e-9\n"
      "1 2.5 3\n-4 5 6\n");
  CHECK(std::isnan(read(header + "1;;3\n4;5;6\n").heights(1, 0)));
  CHECK(read(header + "nan 2 3\n4 5 NaN\n").undefined_points() == 2);
}

TEST_CASE("Text that is read by pieces has the heights of the whole", "[read]") {
  // Pieces have a megabyte: their ends cut lines, numbers and line ends. The comparison reads the
  // content from memory as a whole.
  const Scratch scratch;
  const auto require_same = [&](const std::string& text) {
    const std::filesystem::path file = scratch.file("large.txt", text);
    const Surface read = read_surface(file, {.size_x = 1e-6, .size_y = 1e-6});
    const detail::LoadedSurface whole = detail::read_content(file, text);
    REQUIRE(read.heights.size() == whole.heights.size());
    CHECK(std::memcmp(read.heights.data(), whole.heights.data(),
                      std::size_t(read.heights.size()) * sizeof(double)) == 0);
  };
  const auto rows = [](int count, int columns, char separator, const std::string& end) {
    std::string text;
    for (int k = 0; k < count * columns; ++k) {
      text += fmt::format("{:.{}e}", 1e-7 * std::sin(double(k)), 3 + k % 11);
      if (k % columns == columns - 1)
        text += end;
      else
        text += separator;
    }
    return text;
  };
  require_same("\xef\xbb\xbf# a comment\n" + rows(3000, 60, '\t', "\n"));
  require_same(rows(3001, 61, ' ', "\r\n"));
  require_same(rows(3001, 61, ';', "\r"));
  require_same(rows(2, 150000, ' ', "\n"));  // lines longer than a piece
  const std::string unended = rows(3000, 60, ',', "\n");
  require_same(unended.substr(0, unended.size() - 1));
  // A value is missing between two tabs in the last line, so the whole file is read again.
  std::string gaps = rows(3000, 60, '\t', "\n");
  gaps.insert(gaps.rfind('\t'), "\t").erase(gaps.rfind('\t') + 1, gaps.size());
  require_same(gaps + "\n");
  std::string bytes = rows(3000, 60, '\t', "\n");
  bytes[bytes.size() - 100] = '\0';
  CHECK_THROWS_WITH(read_surface(scratch.file("bytes.txt", bytes)), Contains("NUL bytes"));
}

TEST_CASE("Text that can be read in two ways, or not at all, is refused with its line", "[read]") {
  const Scratch scratch;
  const std::string header = "# Width: 3 um\n# Height: 2 um\n";
  const auto message = [&](const std::string& text) -> std::string {
    try {
      read_surface(scratch.file("surface.txt", text));
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(message(header + "1,5\n2,5\n"), Contains("line 3") && Contains("decimal"));
  CHECK_THAT(message(header + "1,5 2.5\n1 2\n"), Contains("mixes"));
  CHECK_THAT(message(header + "1.5;2\n2,5;3\n"), Contains("line 4") && Contains("after"));
  CHECK_THAT(message(header + "1 2 3\n4,5,6\n"), Contains("line 4") && Contains("differently"));
  CHECK_THAT(message(header + "1;2;3\n4,5,6\n"), Contains("line 4") && Contains("differently"));
  CHECK_THAT(message(header + "1.5 2\n2.5,3\n"), Contains("line 4") && Contains("differently"));
  CHECK_THAT(message(header + "1.5 2\n2.5;3\n"), Contains("line 4") && Contains("differently"));
  CHECK_THAT(message(header + "1.5 2\n2,5 3\n"), Contains("line 4") && Contains("after"));
  CHECK_THAT(message(header + "1.5 2\n2 ,5\n"), Contains("line 4") && Contains("decimal"));
  CHECK_THAT(message(header + "1 2 3\n4 5\n"), Contains("line 4") && Contains("2 values"));
  CHECK_THAT(message(header + "1 2 3\n4 five 6\n"), Contains("line 4") && Contains("five"));
  CHECK_THAT(message(header + "1 2 3\n4 5.5.5 6\n"), Contains("line 4"));
  CHECK_THAT(message(header + "1 2 inf\n4 5 6\n"), Contains("infinite"));
  CHECK_THAT(message(header + "1 2 1e999\n4 5 6\n"), Contains("infinite"));
  CHECK_THAT(message("# Width: 3 um\n1 2 3 4\n"), Contains("size_y"));
  CHECK_THAT(message("# Width: -3 um\n# Height: 3 um\n1 2 3\n"), Contains("size_x"));
  CHECK_THAT(message("1 2 3 4\n5 6 7 8\n"), Contains("size_x"));
  CHECK_THAT(message("w=4 h=650\npixel size=1 um\n1 2 3 4\n"), Contains("650 rows"));
  CHECK_THAT(message(header + "# Points: 4\n1 2 3\n"), Contains("4 points") && Contains("holds 3"));
  CHECK_THAT(message("# Points: 5\n0 0 1\n0 1 1\n1 0 1\n1 1 1\n"), Contains("holds 4"));
  CHECK_THAT(message(header + "# Value units: V\n1 2 3\n"), Contains("unit of length"));
  CHECK_THAT(message("height conversion factor (-> m)=0\n1 2 3\n"), Contains("conversion factor"));
  CHECK_THAT(message(std::string("1\0 2\0", 6)), Contains("NUL"));
  CHECK_THAT(message("\xff\xfe" + header), Contains("UTF-16"));
  CHECK_THAT(message(header + "# Value units: \x1b[2J\tm\n1 2 3\n"),
             Contains("'Value units: \\x1b[2J\\x09m'"));
  CHECK_THAT(message(""), Contains("empty"));
  CHECK_THAT(message("# Width: 3 um\n# Height: 2 um\n"), Contains("no numbers"));
}

TEST_CASE("XYZ points are put on their grid, whatever their order, or refused", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("points.xyz", text));
  };
  const Surface surface = read("1 5 12\n0 5 2\n0 3 1\n2 3 21\n1 3 11\n");
  CHECK(surface.grid == Grid2D{3, 2, 3, 4});
  CHECK(surface.heights(1, 0) == 11);
  CHECK(surface.heights(0, 1) == 2);
  CHECK(std::isnan(surface.heights(2, 1)));
  // A coordinate may begin with the same digits as that of the line before and yet differ.
  for (const bool turned : {false, true}) {
    std::string text;
    for (const auto& [x, y] : {std::pair("0", "0"), {"0", "0.5"}, {"0.5", "0.5"}, {"0.5", "0"}})
      text += std::string(turned ? y : x) + ' ' + (turned ? x : y) + " 1\n";
    CHECK(read(text).grid == Grid2D{2, 2, 1, 1});
  }
  CHECK_THROWS_WITH(read("0 0 1\n1 0 1\n3 0 1\n0 1 1\n1 1 1\n3 1 1\n"), Contains("equally spaced"));
  CHECK_THROWS_WITH(read("0 0 1\n1 0 1\n0 1 1\n1 1 1\n1 1 2\n"), Contains("twice"));
  CHECK_THROWS_WITH(read("0 0 1\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n"), Contains("half"));
  CHECK_THROWS_WITH(read("0 nan 1\n1 1 1\n"), Contains("coordinates"));
  CHECK_THROWS_WITH(read("1 1 1\n1 1 1\n"), Contains("vary"));
}

TEST_CASE("XYZ points with units, and with lines that are missing, are put on their grid",
          "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("points.xyz", text));
  };
  const Surface units =
      read("# Lateral units: µm\n# Value units: nm\n0 0 1\n0 2 2\n1 0 3\n1 2 4\n");
  CHECK(units.grid.lx == Approx(2e-6));
  CHECK(units.grid.ly == Approx(4e-6));
  CHECK(units.heights(1, 0) == Approx(3e-9));
  CHECK(units.heights(0, 1) == Approx(2e-9));
  CHECK_THROWS_WITH(read("# Lateral units: V\n0 0 1\n0 2 2\n1 0 3\n1 2 4\n"),
                    Contains("'Lateral units: V'"));
  // One grid line of twelve is missing; coordinates are rounded to a tenth of a step.
  std::string text;
  for (int ix = 0; ix < 12; ++ix)
    for (int iy = 0; iy < 2 && ix != 5; ++iy)
      text += std::to_string(0.3 * ix + (ix % 2 ? 0.01 : 0)) + " " + std::to_string(iy) + " " +
              std::to_string(ix) + "\n";
  const Surface gap = read(text);
  CHECK(gap.grid.nx == 12);
  CHECK(gap.undefined_points() == 2);
  CHECK(gap.heights(11, 1) == 11);
  CHECK(gap.grid.lx == Approx(12 * (0.3 * 11 + 0.01) / 11));
}

TEST_CASE("NPY arrays of every kind are read alike", "[read]") {
  const Scratch scratch;
  const auto npy = [](char version, const std::string& dict, const std::string& data) {
    std::string header = dict + "\n", file = "\x93NUMPY";
    file += version;
    file += '\0';
    file += static_cast<char>(header.size());
    file += std::string(version == 1 ? 1 : 3, '\0');
    return file + header + data;
  };
  const ReadOptions size{.size_x = 1, .size_y = 1};
  const auto read = [&](const std::string& content) {
    return read_surface(scratch.file("array.npy", content), size).heights;
  };
  Field expected(2, 3);
  expected << 1, 2, 3, 4, 5, 6;
  const std::string bytes("\1\2\3\4\5\6", 6), columns("\1\4\2\5\3\6", 6);
  const auto shorts = [&](bool big) {
    std::string result;
    for (const char byte : bytes) result += big ? std::string{'\0', byte} : std::string{byte, '\0'};
    return result;
  };
  CHECK((read(npy(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }", bytes)) ==
         expected)
            .all());
  CHECK((read(npy(2, "{'descr': '|i1', 'fortran_order': True, 'shape': (2, 3)}", columns)) ==
         expected)
            .all());
  CHECK((read(npy(3, "{\"shape\": (2, 3), 'descr': '>i2', 'fortran_order': False}",
                  shorts(true))) == expected)
            .all());
  CHECK((read(npy(1, "{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3)}", shorts(false))) ==
         expected)
            .all());
  const auto refused = [&](const std::string& content, const std::string& why) {
    INFO(why);
    CHECK_THROWS_WITH(read(content), Contains(why) && Contains("array.npy"));
  };
  const std::string tail = ", 'fortran_order': False, 'shape': (2, 3)}";
  refused(npy(1, "{'descr': '|u1'" + tail, "\1\2\3\4\5"), "truncated");
  refused(
      npy(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (4294967296, 4294967296)}", bytes),
      "truncated");
  refused(npy(1, "{'descr': '<c16'" + tail, bytes), "<c16");
  refused(npy(1, "{'descr': [('a', '<f8')]" + tail, bytes), "records");
  refused(npy(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (6,)}", bytes),
          "two-dimensional");
  refused(npy(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (0, 6)}", bytes),
          "two-dimensional");
  refused(npy(1, "{'descr': '|u1', 'shape': (2, 3)}", bytes), "broken");
  refused(npy(1, "{'descr': '|u1", bytes), "broken");
  refused(npy(9, "", ""), "version 9");
  refused("\x93NUMPY\1", "truncated");
  refused(std::string("\x93NUMPY\1\0\xff\xff{", 11), "truncated");
}

TEST_CASE("An entry of a sidecar that is not used is refused if it may change the heights",
          "[read]") {
  const Scratch scratch;
  write_surface(scratch / "scan.npy", Surface{{6, 4, 1, 1}, Field::Random(6, 4), true, "test"});
  std::ifstream stream(scratch / "scan.npy.json");
  const std::string written{std::istreambuf_iterator<char>(stream), {}};
  const auto read_with = [&](const std::string& entry) {
    scratch.file("scan.npy.json", "{" + entry + "," + written.substr(written.find('{') + 1));
    return read_surface(scratch / "scan.npy");
  };
  for (const char* key : {"unit", "height_unit", "scale", "z_factor", "pixel_size", "nodata", "Lx"})
    CHECK_THROWS_WITH(read_with("\"" + std::string(key) + "\": 2"),
                      Contains("entry '" + std::string(key) + "', which salebra does not apply"));
  for (const char* entry : {"\"serial\": 4711", "\"comment\": \"3 nm of gold\"",
                            "\"measured on date\": \"2024-05-01\"", "\"anything\": true"})
    CHECK_NOTHROW(read_with(entry));
}

TEST_CASE("A unit that the file states is not given by the user as well", "[read]") {
  const Scratch scratch;
  const std::string size = "# Width: 2 um\n# Height: 2 um\n", heights = "1 2\n3 4\n";
  const auto stated = scratch.file("stated.txt", size + "# Value units: nm\n" + heights);
  const auto bare = scratch.file("bare.txt", size + heights);
  CHECK_THROWS_WITH(read_surface(stated, {.height_unit = "um"}),
                    Contains("states the unit of its heights, 'nm'"));
  CHECK(read_surface(stated, {.height_unit = "nm"}).heights(0, 0) == Approx(1e-9));
  CHECK(read_surface(bare, {.height_unit = "um"}).heights(0, 0) == Approx(1e-6));
}

TEST_CASE("A GSF header that promises more than the file holds is refused", "[read]") {
  const Scratch scratch;
  Surface surface{{6, 4, 1, 1}, Field::Random(6, 4), true, "test"};
  const std::string name = "surface.gsf";
  write_surface(scratch / name, surface);
  std::ifstream stream(scratch / name, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  for (std::size_t length = 4; length < content.size(); ++length)
    CHECK_THROWS_AS(read_surface(scratch.file(name, content.substr(0, length))), InvalidInput);
  CHECK_NOTHROW(read_surface(scratch.file(name, content)));
  CHECK_THROWS_WITH(
      read_surface(scratch.file("bomb.gsf",
                                "Gwyddion Simple Field 1.0\nXRes = 4000000000000000000\n"
                                "YRes = 4000000000000000000\n" +
                                    std::string(4, '\0'))),
      Contains("more than it holds"));
}

TEST_CASE("A SUR file is refused where it is cut or of another kind", "[read]") {
  const Scratch scratch;
  std::ifstream stream(measured / "sur-2.sur", std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  const auto refused = [&](std::size_t at, char byte, const std::string& why) {
    std::string changed = content;
    changed[at] = byte;
    CHECK_THROWS_WITH(read_surface(scratch.file("a.sur", changed)), Contains(why));
  };
  CHECK_THROWS_AS(read_surface(scratch.file("a.sur", content.substr(0, 511))), InvalidInput);
  CHECK_THROWS_WITH(read_surface(measured / "sur-2.sur", {.height_unit = "um"}),
                    Contains("states the unit of its heights, 'mm'"));
  CHECK_NOTHROW(read_surface(measured / "sur-2.sur", {.height_unit = "mm"}));
  CHECK_THROWS_AS(read_surface(scratch.file("a.sur", content.substr(0, content.size() - 1))),
                  InvalidInput);
  // A private zone of more than 32767 bytes puts the heights beyond the end.
  refused(337, '\x90', "truncated");
  refused(290, 4, "inversion");
  refused(111, 0x7f, "truncated");      // points along x
  refused(111, '\x80', "points");       // a negative number of points
  refused(98, 8, "bits");               // bits per point
  refused(14, 2, "one surface");        // objects in the file
  refused(212, 'V', "unit of length");  // unit of heights
  refused(180, '\0', "only one axis");
  CHECK_THROWS_WITH(read_surface(scratch.file("a.sur", "DSCOMPRESSED" + content.substr(12))),
                    Contains("is a compressed SUR file"));
  // If a file states no unit of its heights, the user gives it.
  std::string bare = content;
  bare.replace(212, 16, 16, ' ');
  const Field stated = read_surface(measured / "sur-2.sur").heights;
  const Field given = read_surface(scratch.file("bare.sur", bare), {.height_unit = "um"}).heights;
  CHECK((stated.isNaN() || (given - 1e-3 * stated).abs() <= 1e-15 * stated.abs()).all());
}

TEST_CASE("A SUR file of a replica is turned over, with the axis that it names", "[read]") {
  const Scratch scratch;
  std::ifstream stream(measured / "sur-2.sur", std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(stream), {}};
  const auto read = [&](char inversion) {
    std::string changed = content;
    changed[290] = inversion;
    return read_surface(scratch.file("a.sur", changed)).heights;
  };
  const auto same = [](const Field& a, const Field& b) {
    return ((a == b) || (a.isNaN() && b.isNaN())).all();
  };
  const Field plain = read(0);
  CHECK(same(read(1), -plain));
  CHECK(same(read(2), -plain.colwise().reverse()));
  CHECK(same(read(3), -plain.rowwise().reverse()));
  // Each axis has its own unit of 16 characters: x at 180, y at 196.
  const auto size_with = [&](std::size_t place) {
    std::string changed = content;
    changed.replace(place, 16, std::string("m").append(15, ' '));
    return read_surface(scratch.file("b.sur", changed)).grid;
  };
  const Grid2D grid = read_surface(scratch.file("b.sur", content)).grid;
  CHECK(size_with(180).lx > 100 * grid.lx);
  CHECK(size_with(180).ly == grid.ly);
  CHECK(size_with(196).ly > 100 * grid.ly);
  CHECK(size_with(196).lx == grid.lx);
}

TEST_CASE("A damaged HDF5 file is refused, without a word on standard error", "[read]") {
  const Scratch scratch;
  const auto file = scratch.file("damaged.h5", "\x89HDF\r\n\x1a\n and then nothing of use");
  CHECK_THROWS_WITH(read_surface(file), Contains("damaged.h5") && Contains("HDF5"));
}

TEST_CASE("Heights whose slopes no surface has are doubted as they are read", "[read]") {
  const Scratch scratch;
  const auto warnings_of = [&](const std::string& header, const std::string& unit = "") {
    const auto file = scratch.file(
        "scan.txt", "# Width: 40 um\n# Height: 30 um\n" + header + "0 1 0 1\n1 0 1 0\n0 1 0 1\n");
    std::vector<std::string> warnings;
    ReadOptions options;
    options.height_unit = unit;
    options.warnings = &warnings;
    read_surface(file, options);
    return warnings;
  };
  // Steps of 1 over cells of 10 um: with heights in um the slope is 0.1 along either axis.
  const auto forgotten = warnings_of("");
  REQUIRE(forgotten.size() == 1);
  CHECK_THAT(forgotten[0], Contains("scan.txt: rms slope 1.4") &&
                               Contains("heights in \u00b5m? Then the rms slope would be 0.14") &&
                               Contains("`height_unit`"));
  CHECK(warnings_of("", "um").empty());
  CHECK(warnings_of("# Value units: um\n").empty());
  // If the file names the unit, the warning does not mention the option.
  const auto named = warnings_of("# Value units: mm\n");
  REQUIRE(named.size() == 1);
  CHECK_THAT(named[0], Contains("heights in \u00b5m?") && !Contains("height_unit"));
}

TEST_CASE("Units beside the names of columns are those of the points", "[read]") {
  const Scratch scratch;
  const auto points = [](const std::string& separator) {
    std::string text;
    for (int ix = 0; ix < 4; ++ix)
      for (int iy = 0; iy < 3; ++iy)
        text += std::to_string(1.5 * ix) + separator + std::to_string(2 * iy) + separator +
                std::to_string(0.01 * (ix - iy)) + "\n";
    return text;
  };
  const auto check = [&](const std::string& header, const std::string& separator,
                         double plane = 1e-6, double height = 1e-6) {
    INFO(header);
    std::vector<std::string> warnings;
    ReadOptions options;
    options.warnings = &warnings;
    const Surface surface =
        read_surface(scratch.file("points.txt", header + "\n" + points(separator)), options);
    CHECK(surface.grid.lx == Approx(6 * plane).epsilon(1e-12));
    CHECK(surface.grid.ly == Approx(6 * plane).epsilon(1e-12));
    CHECK(surface.heights(3, 0) == Approx(0.03 * height).epsilon(1e-12));
    CHECK(warnings.empty());
  };
  check("X [\u00b5m]\tY [\u00b5m]\tZ [\u00b5m]", "\t");
  check("X [\u00b5m] Y [\u00b5m] Z [\u00b5m]", " ");
  check("X [\xb5m]\tY [\xb5m]\tZ [\xb5m]", "\t");  // Latin-1
  check("# x (um), y (um), z (nm)", ",", 1e-6, 1e-9);
  check("x/mm;y/mm;z/\u00c5", ";", 1e-3, 1e-10);
  check("X \u00b5m Y \u00b5m Z \u00b5m", " ");
  check("x in mm, y in mm, z in \u03bcm", ",", 1e-3);
  check("X_um,Y_um,Height_nm", ",", 1e-6, 1e-9);
  check("Position X [mm];Position Y [mm];H\u00f6he [\u00b5m]", ";", 1e-3);
  check("\"X (mm)\",\"Y (mm)\",\"Height Sensor (\u00b5m)\"", ",", 1e-3);
  check("X,Y,Z\nmm,mm,nm", ",", 1e-3, 1e-9);
  check("# Columns: x [mm] y [mm] z [nm]", " ", 1e-3, 1e-9);
  check("# XY unit: mm\n# Z unit: nm", " ", 1e-3, 1e-9);
  check("Units=mm", " ", 1e-3, 1e-3);
  // x and y may differ.
  const Surface surface =
      read_surface(scratch.file("mixed.txt", "X [mm] Y [um] Z [nm]\n" + points(" ")));
  CHECK(surface.grid.lx == Approx(6e-3).epsilon(1e-12));
  CHECK(surface.grid.ly == Approx(6e-6).epsilon(1e-12));
}

TEST_CASE("Headers of German and English instruments state sizes and units", "[read]") {
  const Scratch scratch;
  const auto check = [&](const std::string& header, double size_x, double size_y, double unit) {
    INFO(header);
    std::vector<std::string> warnings;
    ReadOptions options;
    options.warnings = &warnings;
    const Surface surface = read_surface(
        scratch.file("scan.csv", header + "\n0,01;0,02;0,03;0,01\n0,02;0,03;0,04;0,02\n"), options);
    CHECK(surface.grid.lx == Approx(size_x).epsilon(1e-12));
    CHECK(surface.grid.ly == Approx(size_y).epsilon(1e-12));
    CHECK(surface.heights(2, 0) == Approx(0.03 * unit).epsilon(1e-12));
    CHECK(warnings.empty());
  };
  check(
      "Pixelgr\u00f6\u00dfe X: 1,1 \u00b5m\nPixelgr\u00f6\u00dfe Y: 1,3 \u00b5m\nEinheit "
      "H\u00f6he: \u00b5m",
      4.4e-6, 2.6e-6, 1e-6);
  check(
      "Pixelgr\xf6\xdf"
      "e: 1,1 \xb5m\nEinheit H\xf6he;\xb5m",
      4.4e-6, 2.2e-6, 1e-6);
  check("Pixel size [\u00b5m] = 1.1\nHeight unit = nm", 4.4e-6, 2.2e-6, 1e-9);
  check("Pixel spacing: 1.1 um/pixel\nZ [nm]", 4.4e-6, 2.2e-6, 1e-9);
  check("Size X (mm): 0.35\nSize Y (mm): 0.31\nUnit: [\u00b5m]", 3.5e-4, 3.1e-4, 1e-6);
}

TEST_CASE("A line of the header that names a length and is not used is quoted", "[read]") {
  const Scratch scratch;
  const auto warnings_of = [&](const std::string& header) {
    std::vector<std::string> warnings;
    ReadOptions options;
    options.size_x = options.size_y = 4e-6;
    options.height_unit = "m";
    options.warnings = &warnings;
    read_surface(scratch.file("scan.txt", header + "\n0 1e-9 0 0\n1e-9 0 1e-9 0\n0 1e-9 0 1e-9\n"),
                 options);
    return warnings;
  };
  for (const std::string line : {"Objective 50x, 1.1 \u00b5m/pixel", "Sampling: 1.1 um", "Scan 5 m",
                                 "Lateral resolution [nm] 200", "Pixel: 1,1 mm"}) {
    INFO(line);
    const auto warnings = warnings_of("Measured on Monday\n" + line);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Contains("scan.txt: line 2, '" + line +
                                     "', has a unit or a number that is not known"));
  }
  CHECK(warnings_of("Sampling: 1.1 um\nText\nTip radius 2 um\nFilter 8 um").size() == 1);
  // Without `height_unit` the file is refused.
  CHECK_THROWS_WITH(read_surface(scratch.file("scan.txt", "Sampling: 1.1 um\n0 1e-9\n1e-9 0\n"),
                                 {.size_x = 1e-6, .size_y = 1e-6}),
                    Contains("'Sampling: 1.1 um'") && Contains("`height_unit`"));
  for (const std::string line :
       {"Measured by M. on 2026-03-17 at 10:30 pm", "Messung um 10:30", "Speed 10 um/s", "x y z",
        "Magnification 50", "# Channel: heights", "Area 3 mm2", "Temperature 20 C", "Load 5 mN"}) {
    INFO(line);
    CHECK(warnings_of(line).empty());
  }
  // Quotes in warnings contain no control characters for a terminal.
  CHECK_THAT(warnings_of("\x1b[31m 5 um").at(0), Contains("'\\x1b[31m 5 um'"));
}

TEST_CASE("An empty last field is an undefined point", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("scan.csv", text), {.size_x = 3, .size_y = 3}).heights;
  };
  const Field later = read("1;2;3;4\n5;6;7;\n8;9;1;2\n");
  REQUIRE(later.rows() == 4);
  CHECK(std::isnan(later(3, 1)));
  CHECK(later(0, 2) == 8);
  // The first rows may be the shorter ones.
  const Field first = read("1,5,0,\n3.5,4,0,\n5,6.5,0,7\n8,9,0,\n");
  REQUIRE(first.rows() == 4);
  CHECK(std::isnan(first(3, 0)));
  CHECK(std::isnan(first(3, 1)));
  CHECK(first(3, 2) == 7);
  CHECK(std::isnan(first(3, 3)));
  CHECK(first(0, 1) == 3.5);
  CHECK(first(1, 3) == 9);
  // Two values may be undefined.
  CHECK(std::isnan(read("1;2;3;4\n4;5;;\n")(3, 1)));
  // If every row ends with a separator, it has no meaning, and a shorter row lacks a value.
  CHECK(read("1;2;3;4;\n4;5;6;7;\n").rows() == 4);
  CHECK_THROWS_WITH(read("1;2;3;\n4;5;\n"), Contains("holds 2 values"));
  CHECK_THROWS_WITH(read("1;2;3\n4;5\n"), Contains("holds 2 values"));
}

TEST_CASE("Marks of thousands are read where they can be nothing else", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("scan.csv", text), {.size_x = 3, .size_y = 3}).heights;
  };
  for (const std::string row :
       {"1,234.5;2.5;-12,345.25", "1.234,5;2,5;-12.345,25", "1'234.5;2.5;-12'345.25",
        "1 234,5;2,5;-12 345,25", "1 234.5\t2.5\t-12 345.25", "1'234.5 2.5 -12'345.25",
        "1\u202f234,5;2,5;-12\u202f345,25", "\"1,234.5\",\"2.5\",\"-12,345.25\""}) {
    INFO(row);
    // The two rows are equal, so they cannot be points x, y, z that fill a grid.
    const Field heights = read("# Width: 3 um\n# Height: 2 um\n" + row + "\n" + row + "\n");
    REQUIRE(heights.rows() == 3);
    CHECK(heights(0, 0) == 1234.5);
    CHECK(heights(1, 1) == 2.5);
    CHECK(heights(2, 1) == -12345.25);
  }
  // A thousands separator seen in another line also applies to a number with this mark alone.
  CHECK(read("1,234.5;2.5\n1,234;2.5\n")(0, 1) == 1234);
  CHECK_THROWS_WITH(read("1,234;2\n2,345.5;2.5\n"), Contains("line 2") && Contains("','"));
  CHECK_THROWS_WITH(read("1,234.5;2'000.5\n"), Contains("another thousands separator"));
}

TEST_CASE("Blocks of rows may be channels", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("scan.txt", text), {.size_x = 3, .size_y = 3}).heights;
  };
  const std::string block = "1.5 2 4 8\n3 4 7 5\n";
  CHECK_THROWS_WITH(read(block + "# second\n" + block), Contains("line 3, '# second'"));
  CHECK_THROWS_WITH(read(block + "\n" + block), Contains("the empty line after row 2"));
  CHECK(read("1.5 2 4 8\n\n3 4 7 5\n").cols() == 2);
  CHECK(read(block + "\n# end\n").cols() == 2);
}

TEST_CASE("Factors of conversion are read where they are of heights", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& line) {
    return read_surface(
               scratch.file("scan.txt", "# Pixel size: 1 um\n" + line + "\n1 2 3 4\n4 5 7 9\n"))
        .heights(2, 0);
  };
  for (const char* line :
       {"# Height conversion factor (-> m): 2e-9", "# Height conversion factor (-> um): 2e-3",
        "# Z conversion factor: 2.0D-09 m", "# Umrechnungsfaktor H\u00f6he [nm]: 2",
        "# Height factor: 2 nm/digit"}) {
    INFO(line);
    CHECK(read(line) == Approx(6e-9).epsilon(1e-12));
  }
  for (const char* line : {"Lateral conversion factor (-> m): 1e-6", "Z scale: 2.5 nm",
                           "Sensitivity: 2.5 nm/V", "Heights multiplied by 10"}) {
    INFO(line);
    CHECK_THROWS_WITH(read(line), Contains(line));
  }
}

TEST_CASE("Marks of instruments are undefined points", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("scan.csv", text), {.size_x = 3, .size_y = 3}).heights;
  };
  for (const std::string mark :
       {"***", "*****", "---", "NA", "n/a", "BAD", "bad", "No Data", "NODATA", "nan"}) {
    INFO(mark);
    for (const std::string separator : {";", ",", " ", "\t", ", "}) {
      INFO(separator);
      const Field heights =
          read("1.5" + separator + mark + separator + "2.5" + separator + "7.5\n3.5" + separator +
               "4.5" + separator + mark + separator + "5.5\n");
      CHECK(std::isnan(heights(1, 0)));
      CHECK(std::isnan(heights(2, 1)));
      CHECK(heights(1, 1) == 4.5);
    }
    // The mark may also be the first value of the first line, with decimal commas.
    const Field first = read(mark + ";1,4674;1,445;2\n2,5;1;" + mark + ";2\n");
    REQUIRE(first.cols() == 2);
    CHECK(std::isnan(first(0, 0)));
    CHECK(first(1, 0) == 1.4674);
    CHECK(std::isnan(first(2, 1)));
  }
  CHECK(std::isnan(read("***;***;***;***\n1;2;3;4\n")(1, 0)));
  // Rules of dashes and titles in a header are no marks.
  CHECK(read("*** Heights ***\nX Y\n--- ---\n-------\n1 2\n3 4\n").cols() == 2);
  CHECK_THROWS_WITH(read("1;abc;2\n"), Contains("line 1 holds 'abc', which is not a number"));
}
