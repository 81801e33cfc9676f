// SPDX-License-Identifier: GPL-3.0-or-later
// The same scan in the variants that programs of instruments write.
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <salebra/base/error.hpp>
#include <salebra/io/read_surface.hpp>

#include "scratch.hpp"

using namespace salebra;
using Catch::Contains;

namespace {

constexpr Index columns = 7, rows = 5;
constexpr double pixel_x = 1.1, pixel_y = 1.3;  // µm

/// Heights of a scan with two undefined points, one at the end of a row, in hundredths of a µm.
int hundredths(Index ix, Index iy) { return int((37 * ix + 53 * iy + 11 * ix * iy) % 100 - 50); }
bool undefined(Index ix, Index iy) { return (ix == 2 && iy == 1) || (ix == 6 && iy == 3); }

std::string number(double value, char point) {
  std::string text = std::to_string(value).substr(0, value < 0 ? 5 : 4);
  text[text.find('.')] = point;
  return text;
}

std::string matrix(const std::string& separator, char point, const std::string& mark,
                   const std::string& end = "\n") {
  std::string text;
  for (Index iy = 0; iy < rows; ++iy)
    for (Index ix = 0; ix < columns; ++ix)
      text += (ix ? separator : "") +
              (undefined(ix, iy) ? mark : number(hundredths(ix, iy) / 100., point)) +
              (ix + 1 == columns ? end : "");
  return text;
}

/// The scan as points. Undefined points have `mark` as z; they are left out if `mark` is empty.
std::string points(const std::string& separator, char point, const std::string& mark) {
  std::string text;
  for (Index iy = 0; iy < rows; ++iy)
    for (Index ix = 0; ix < columns; ++ix) {
      if (undefined(ix, iy) && mark.empty()) continue;
      const std::string z = undefined(ix, iy) ? mark : number(hundredths(ix, iy) / 100., point);
      text += number(double(ix) * pixel_x, point) + separator +
              number(double(iy) * pixel_y, point) + separator + z + "\n";
    }
  return text;
}

std::string utf16(const std::string& ascii, bool big) {
  std::string text = big ? "\xfe\xff" : "\xff\xfe";
  for (const char symbol : ascii)
    text += big ? std::string{'\0', symbol} : std::string{symbol, '\0'};
  return text;
}

std::string gzip(const std::string& content) {
  z_stream stream = {};
  REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string packed(deflateBound(&stream, uLong(content.size())) + 32, '\0');
  std::string given = content;
  stream.next_in = reinterpret_cast<Bytef*>(given.data());
  stream.avail_in = uInt(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

const std::string sizes = "Pixel size X: 1.1 um\nPixel size Y: 1.3 um\nHeight unit: um\n";
const std::string german =
    "Pixelgr\xf6\xdf"
    "e X: 1,1 \xb5m\nPixelgr\xf6\xdf"
    "e Y: 1,3 \xb5m\nEinheit H\xf6he: \xb5m\n";

}  // namespace

TEST_CASE("One scan in the files of many programs is one surface", "[read]") {
  const Scratch scratch;
  const std::string titles = "X [\u00b5m]\tY [\u00b5m]\tZ [\u00b5m]\n";
  const auto [what, content] = GENERATE_COPY(table<std::string, std::string>({
      {"CSV", sizes + matrix(",", '.', "nan")},
      {"CSV with empty fields", sizes + matrix(",", '.', "")},
      {"CSV of Windows", sizes + matrix(", ", '.', "NA", "\r\n")},
      {"German CSV in Latin-1 with empty fields", german + matrix(";", ',', "")},
      {"German CSV with stars", german + matrix(";", ',', "***")},
      {"semicolons with points, one behind each row", sizes + matrix(";", '.', "", ";\n")},
      {"tabs with empty fields", sizes + matrix("\t", '.', "")},
      {"tabs with commas and empty fields", german + matrix("\t", ',', "")},
      {"blanks", sizes + matrix("  ", '.', "---")},
      {"UTF-16 of Windows", utf16(sizes + matrix("\t", '.', "BAD"), false)},
      {"UTF-16, big-endian", utf16(sizes + matrix(",", '.', ""), true)},
      {"gzip", gzip(sizes + matrix(" ", '.', "nan"))},
      {"gzip of UTF-16 in two members",
       gzip(utf16(sizes, false)) + gzip(utf16(matrix(";", ',', ""), false).substr(2))},
      {"points with titles", titles + points("\t", '.', "No Data")},
      {"points with holes", titles + points("\t", '.', "")},
      {"German points", "X/\xb5m;Y/\xb5m;Z/\xb5m\n" + points(";", ',', "***")},
  }));
  INFO(what);
  std::vector<std::string> warnings;
  ReadOptions options;
  options.warnings = &warnings;
  const Surface surface = read_surface(scratch.file("scan.dat", content), options);
  REQUIRE(surface.grid.nx == columns);
  REQUIRE(surface.grid.ny == rows);
  // Coordinates have three digits, and the step follows from the last coordinate.
  CHECK(surface.grid.dx() == Approx(1e-6 * pixel_x).epsilon(1e-12));
  CHECK(surface.grid.dy() == Approx(1e-6 * pixel_y).epsilon(1e-12));
  for (Index ix = 0; ix < columns; ++ix)
    for (Index iy = 0; iy < rows; ++iy)
      if (undefined(ix, iy))
        CHECK(std::isnan(surface.heights(ix, iy)));
      else
        CHECK(surface.heights(ix, iy) == Approx(1e-8 * hundredths(ix, iy)).margin(1e-20));
  CHECK(warnings.empty());
}

TEST_CASE("A row that begins with an empty field is a row", "[read]") {
  const Scratch scratch;
  const auto read = [&](const std::string& text) {
    return read_surface(scratch.file("scan.csv", text), {.size_x = 3, .size_y = 3}).heights;
  };
  for (const std::string text : {";;3.5;4\n5;6;7;8\n", ",,3.5,4\n5,6,7,8\n"}) {
    const Field heights = read(text);
    REQUIRE(heights.cols() == 2);
    CHECK(std::isnan(heights(1, 0)));
    CHECK(heights(2, 0) == 3.5);
  }
  const Field tabs = read("\t\t3\t4\n5\t6\t\t8\n5\t6\t7\t8\n");
  REQUIRE(tabs.rows() == 4);
  CHECK(std::isnan(tabs(0, 0)));
  CHECK(std::isnan(tabs(2, 1)));
  CHECK(tabs(3, 1) == 8);
  // Several tabs that align columns count as one separator if all rows then have equal length.
  CHECK(read("1\t\t2\n3\t4\n").rows() == 2);
}

TEST_CASE("Packed files that are cut, damaged or without end are refused", "[read]") {
  const Scratch scratch;
  const std::string packed = gzip(sizes + matrix(" ", '.', "nan"));
  const auto read = [&](const std::string& content) {
    read_surface(scratch.file("scan.gz", content));
  };
  CHECK_NOTHROW(read(packed + std::string(512, '\0')));  // padding, as tapes have it
  CHECK_THROWS_WITH(read(packed.substr(0, packed.size() - 9)), Contains("truncated or damaged"));
  CHECK_THROWS_WITH(read(packed.substr(0, 40)), Contains("truncated or damaged"));
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // in the checksum
  CHECK_THROWS_WITH(read(damaged), Contains("truncated or damaged"));
  // Zeros shrink a thousandfold: 400 MB in 25 copies of one packed member of 16 MiB.
  const std::string zeros = gzip(std::string(std::size_t{16} << 20, '\0'));
  std::string members;
  for (int k = 0; k < 25; ++k) members += zeros;
  CHECK_THROWS_WITH(read(members), Contains("unpacks to more than"));
  // 36 million heights become doubles, though they need few bytes each in 30 to 90 MB of content.
  const std::string row = "0 0 0\n";
  std::string text;
  for (int k = 0; k < 1'000'000; ++k) text += row;
  const std::string rows = gzip(text);
  const std::string gsf = gzip("Gwyddion Simple Field 1.0\nXRes = 6000\nYRes = 6000\n\n");
  std::string header = "{'descr': '|i1', 'fortran_order': False, 'shape': (6000, 6000), }";
  header += std::string(117 - header.size(), ' ') + "\n";
  const std::string npy = gzip(std::string("\x93NUMPY\x01\0\x76\0", 10) + header);
  for (const auto& [head, block] : {std::pair{rows, rows}, {gsf, zeros}, {npy, zeros}}) {
    std::string bomb = head;
    for (int k = 0; k < 12; ++k) bomb += block;
    CHECK_THROWS_WITH(read(bomb), Contains("unpacks to more than"));
  }
  CHECK_THROWS_WITH(read(std::string("\xff\xfe") + "1\0\xd8"), Contains("truncated"));
  CHECK_THROWS_WITH(read("\xfe\xff\xd8" + std::string(3, '\0')), Contains("begins like UTF-16"));
}
