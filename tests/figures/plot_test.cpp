// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/plot.hpp"

#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <salebra/base/error.hpp>
#include <sstream>

#include "figures/gnuplot_script.hpp"
#include "figures/plot_raster.hpp"
#include "io/scratch.hpp"

using namespace salebra;
using namespace salebra::figures;
using Catch::Contains;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

Figure force_figure() {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.title = "Hertz";
  panel.x = {.label = "indentation", .unit = "m"};
  panel.y = {.label = "force", .unit = "N"};
  panel.curves.push_back({.name = "theory",
                          .x = {1e-9, 2e-9, 300e-9},
                          .y = {1e3, 2e3, 9e3},
                          .low = {0.5e3, 1e3, 8e3},
                          .high = {2e3, 3e3, 10e3}});
  return figure;
}

/// Replaces PATH during a test.
class SearchPath {
 public:
  explicit SearchPath(const std::string& path) : before_(std::getenv("PATH")) {
    setenv("PATH", path.c_str(), 1);
  }
  SearchPath(const SearchPath&) = delete;
  SearchPath& operator=(const SearchPath&) = delete;
  ~SearchPath() { setenv("PATH", before_.c_str(), 1); }

 private:
  std::string before_;
};

void make_program(const std::filesystem::path& file, const std::string& script) {
  std::ofstream(file) << "#!/bin/sh\n" << script;
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
}

}  // namespace

TEST_CASE("An SVG shows titles, names and axes whose SI prefix suits the values", "[plot]") {
  const Scratch scratch;
  Figure figure = force_figure();
  figure.title = "one figure";
  write_plot(scratch / "a.svg", figure);
  const std::string text = content(scratch / "a.svg");
  for (const std::string part :
       {"indentation (nm)", "force (kN)", "theory", "Hertz", "one figure", "300"})
    CHECK_THAT(text, Contains(">" + part) || Contains(part));
  CHECK(files_in(scratch.folder()) == 1);
}

TEST_CASE("A PDF is whole and has one page of the size of its panels", "[plot]") {
  const Scratch scratch;
  write_plot(scratch / "a.pdf", force_figure());
  const std::string text = content(scratch / "a.pdf");
  CHECK_THAT(text, Catch::StartsWith("%PDF-"));
  CHECK_THAT(text, Catch::EndsWith("%%EOF\n"));
  // Since 1.17.6, Cairo compresses the dictionary of the page, so its text cannot be checked.
  if (text.find("/ObjStm") != std::string::npos) return;
  // In points of 1/72 inch: a panel of 520 x 390 pixels at 100 pixels per inch.
  CHECK_THAT(text, Contains("/MediaBox [ 0 0 374 280 ]"));
  CHECK_THAT(text, Contains("/Count 1"));
}

TEST_CASE("A PNG has the size of its panels, and maps on logarithmic axes can be drawn", "[plot]") {
  const Scratch scratch;
  Figure figure = force_figure();
  Panel& map = figure.panels.emplace_back();
  map.x = {.label = "frequency", .unit = "Hz", .logarithmic = true};
  map.y = {.label = "amplitude", .unit = "m"};
  Image image;
  image.x = {1e3, 1e4, 1e5, 2e5};
  image.y = {1e-9, 2e-9, 3e-9};
  image.values = Field(4, 3);
  for (Index i = 0; i < 4; ++i)
    for (Index j = 0; j < 3; ++j)
      image.values(i, j) = i == 0 && j == 0 ? std::nan("") : std::pow(10.0, i - j);
  image.scale = {.label = "damping", .unit = "N s/m", .logarithmic = true};
  image.contours = {1, 1e9};
  map.image = image;
  write_plot(scratch / "b.png", figure);
  const std::string png = content(scratch / "b.png");
  REQUIRE(png.size() > 10000);
  CHECK(png.substr(1, 3) == "PNG");
  const auto size_at = [&](std::size_t at) {
    return (static_cast<unsigned char>(png[at + 2]) << 8) + static_cast<unsigned char>(png[at + 3]);
  };
  // Two panels side by side, at twice 520 × 390.
  CHECK(size_at(16) == 2 * 2 * 520);
  CHECK(size_at(20) == 2 * 390);
}

TEST_CASE("A field without contrast, a single point and an infinite value can be drawn", "[plot]") {
  const Scratch scratch;
  Figure figure;
  Panel& map = figure.panels.emplace_back();
  map.image = Image{.x = {0, 1}, .y = {0, 1}, .values = Field::Zero(2, 2), .contours = {0}};
  map.image->palette = GENERATE(Palette::sequential, Palette::diverging, Palette::grey);
  Panel& point = figure.panels.emplace_back();
  point.curves.push_back({.x = {1}, .y = {0}, .style = Style::points});
  Panel& pole = figure.panels.emplace_back();
  pole.y.logarithmic = true;
  pole.curves.push_back({.x = {0, 1, 2, 3}, .y = {1, INFINITY, 0, 2}});
  CHECK_NOTHROW(write_plot(scratch / "a.svg", figure));
}

TEST_CASE("Names are shown as they are and never run", "[plot]") {
  const Scratch scratch;
  Figure figure = force_figure();
  const std::string nasty =
      "my_file^2 {a} `touch " + (scratch / "ran").string() + "` it's \\ \"x\"";
  Panel& panel = figure.panels[0];
  panel.lines.push_back({.at = 100e-9, .vertical = true});
  panel.lines.push_back({.at = 5e3});
  const std::array<std::string*, 6> texts = {&figure.title,        &panel.title,
                                             &panel.x.label,       &panel.curves[0].name,
                                             &panel.lines[0].name, &panel.lines[1].name};
  for (std::size_t k = 0; k < texts.size(); ++k)
    *texts[k] = plain_text(std::to_string(k) + nasty + "\\");
  write_plot(scratch / "a.svg", figure);
  CHECK_FALSE(std::filesystem::exists(scratch / "ran"));
  const std::string text = content(scratch / "a.svg");
  for (std::size_t k = 0; k < texts.size(); ++k)
    CHECK_THAT(text, Contains(std::to_string(k) + nasty + "\\"));
}

TEST_CASE("A figure that cannot be drawn is refused by name", "[plot]") {
  const Scratch scratch;
  Figure figure = force_figure();
  CHECK_THROWS_WITH(write_plot(scratch / "a.jpg", figure), Contains(".png, .svg, .pdf or .json"));
  CHECK_THROWS_AS(write_plot(scratch / "a.jpg", figure), InvalidInput);
  CHECK_THROWS_WITH(write_plot(scratch / "no" / "a.png", figure), Contains("does not exist"));
  const auto taken = scratch.file("taken.png", "precious");
  CHECK_THROWS_WITH(write_plot(taken, figure), Contains("exists"));
  CHECK(content(taken) == "precious");
  write_plot(taken, figure, {.overwrite = true});
  CHECK(content(taken).size() > 8);

  CHECK_THROWS_WITH(write_plot(scratch / "a.png", Figure{}), Contains("panels"));
  figure.panels[0].curves[0].y.pop_back();
  CHECK_THROWS_WITH(write_plot(scratch / "a.png", figure),
                    Contains("theory") && Contains("3 and 2"));
  figure.panels[0].curves[0].y = {-1, 0, -2};
  figure.panels[0].curves[0].low = figure.panels[0].curves[0].high = {};
  figure.panels[0].y.logarithmic = true;
  CHECK_THROWS_WITH(write_plot(scratch / "a.png", figure), Contains("force"));
  figure.panels[0].curves.clear();
  CHECK_THROWS_AS(write_plot(scratch / "a.png", figure), InvalidInput);
  figure = force_figure();
  figure.panels[0].image = Image{.x = {0, 2, 1}, .y = {0, 1}, .values = Field::Zero(3, 2)};
  CHECK_THROWS_WITH(write_plot(scratch / "a.png", figure), Contains("increase"));
  CHECK(files_in(scratch.folder()) == 1);
}

TEST_CASE(
    "Where gnuplot is missing, fails or stops half-way, the reason is told and no file is left",
    "[plot]") {
  const Scratch scratch;
  std::filesystem::create_directory(scratch / "bin");
  const SearchPath path((scratch / "bin").string());
  const auto picture = scratch / "a.png";
  CHECK_THROWS_WITH(require_plot(picture), Contains("gnuplot-nox"));
  CHECK_THROWS_AS(write_plot(picture, force_figure()), IoError);
  make_program(scratch / "bin" / "gnuplot", "echo 'line 3: unknown terminal' >&2; exit 1\n");
  CHECK_NOTHROW(require_plot(picture));
  CHECK_THROWS_WITH(write_plot(picture, force_figure()), Contains("unknown terminal"));
  make_program(scratch / "bin" / "gnuplot", "kill -9 $$\n");
  CHECK_THROWS_WITH(write_plot(picture, force_figure()), Contains("signal 9"));
  make_program(scratch / "bin" / "gnuplot", "exit 0\n");
  CHECK_THROWS_WITH(write_plot(picture, force_figure()), Contains("incomplete"));
  CHECK(files_in(scratch.folder()) == 1);
}

TEST_CASE("A map of more cells than a picture draws is averaged, each cell about its middle",
          "[plot]") {
  // 2400 columns at 0.5, 1.5 … are drawn as 1200: each is the mean of a pair, or the value of the
  // pair that is a number.
  Image image;
  for (int i = 0; i < 2400; ++i) image.x.push_back(i + 0.5);
  image.y = {0, 1};
  image.values = Field(2400, 2);
  for (Index i = 0; i < 2400; ++i) image.values.row(i) = double(i);
  image.values(10, 0) = std::nan("");
  image.values(12, 1) = image.values(13, 1) = std::nan("");
  const Raster raster = rasterise(image, {}, {});
  REQUIRE(raster.values.rows() == 1200);
  REQUIRE(raster.values.cols() == 2);
  CHECK(raster.x0 == Approx(1));
  CHECK(raster.dx == Approx(2));
  CHECK(raster.y0 == Approx(0).margin(1e-12));
  CHECK(raster.dy == Approx(1));
  CHECK(raster.values(0, 0) == Approx(0.5));
  CHECK(raster.values(1199, 1) == Approx(2398.5));
  CHECK(raster.values(5, 0) == Approx(11));
  CHECK(raster.values(5, 1) == Approx(10.5));
  CHECK(std::isnan(raster.values(6, 1)));
}

TEST_CASE("A band is drawn between its limits, the curve through its values", "[plot]") {
  const std::string script = gnuplot_script(force_figure(), PictureFormat::svg);
  // The columns are x, y, lower and upper limit, in nm and kN.
  CHECK_THAT(script, Contains("\n2 2 1 3\n"));
  CHECK_THAT(script, Contains("using 1:3:4 with filledcurves") && Contains("using 1:2 with lines"));
}

TEST_CASE(
    "A value that is constant to within a percent is not magnified, prefixes give short numbers",
    "[plot]") {
  Figure figure = force_figure();
  Panel& panel = figure.panels[0];
  panel.curves = {{.x = {1, 2}, .y = {5000, 5001}}};
  // In kN, with 2 % of 5 kN on either side.
  CHECK_THAT(gnuplot_script(figure, PictureFormat::svg), Contains("set yrange [4.89998:5.10102]"));
  // The prefix of 1/m belongs to the metre, and a logarithmic axis has that of its middle.
  panel.y = {.label = "density", .unit = "1/m"};
  panel.curves = {{.x = {1, 2}, .y = {1e7, 4e7}}};
  panel.x.unit = "s";
  CHECK_THAT(gnuplot_script(figure, PictureFormat::svg), Contains("'density (1/µm)'"));
  // A density over a length has the inverse of its unit.
  panel.x.unit = "m";
  panel.curves[0].x = {10e-9, 20e-9};
  CHECK_THAT(gnuplot_script(figure, PictureFormat::svg), Contains("'density (1/nm)'"));
  panel.y = {.label = "velocity", .unit = "m/s", .logarithmic = true};
  panel.curves = {{.x = {1, 2}, .y = {1e-6, 1e-3}}};
  CHECK_THAT(gnuplot_script(figure, PictureFormat::svg), Contains("'velocity (µm/s)'"));
}

TEST_CASE("A logarithmic axis has more than one number, and its lines stay in its panel",
          "[plot]") {
  Figure figure = force_figure();
  Panel& panel = figure.panels[0];
  panel.y.logarithmic = true;
  // Only one power of ten lies between the limits, which are 140 N and 8 kN plus a margin.
  panel.curves[0].y = {0.14e3, 2e3, 8e3};
  panel.curves[0].low = panel.curves[0].high = {};
  panel.lines = {{.at = 5e3}, {.at = 7e-9, .vertical = true}, {.at = 5e4}};
  const std::string script = gnuplot_script(figure, PictureFormat::svg);
  CHECK_THAT(script, Contains("'0.2'") && Contains("'1'") && Contains("'5'"));
  for (const auto& [low, high] : {std::pair(1.2e3, 1.9e3), {9e2, 4e5}, {2.1e3, 2.2e3}, {3e-9, 8}}) {
    panel.y.low = low, panel.y.high = high;
    const std::string narrow = gnuplot_script(figure, PictureFormat::svg, 0.085);
    const auto from = narrow.find("set ytics (");
    const std::string tics = narrow.substr(from, narrow.find('\n', from) - from);
    CAPTURE(tics);
    static const std::regex labelled("'[^']+'");
    CHECK(std::distance(std::sregex_iterator(tics.begin(), tics.end(), labelled), {}) >= 2);
  }
  CHECK_THAT(script, Contains("graph 0,first 0.698970004 to") && Contains("first 7,graph 0 to"));
  CHECK_THAT(script, !Contains("first 1.69897"));
}
