// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <sstream>

#include "run_program.hpp"

using Catch::Contains;

namespace {

const double undefined = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> written{".h5", ".npy", ".gsf", ".txt", ".xyz", ".gwy"};

/// Four by three points on 8 µm by 3 µm without any symmetry, one undefined, with five digits,
/// which float32 keeps.
const std::string scan =
    "# Width: 8 um\n# Height: 3 um\n# Value units: nm\n"
    "1.25 2 -3.5 4\n5 nan 7 0.5\n9.75 -10 11 12.5\n";

}  // namespace

TEST_CASE("convert draws the surface that it writes", "[files][plot]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  test.done("convert scan.txt scan.h5 --plot scan.svg");
  CHECK_THAT(test.read("scan.svg"), Contains("µm"));
  CHECK(test.files() == "scan.txt scan.h5 scan.svg");
}

TEST_CASE(
    "convert leads from every written format to every other and keeps heights, sizes and axes",
    "[files]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  const auto check = [&](const std::string& file) {
    INFO(file);
    const auto result = test.run("convert " + file + " seen.txt --overwrite");
    INFO(result.err);
    REQUIRE(result.status == 0);
    std::istringstream text(test.read("seen.txt"));
    std::string line;
    for (const double size : {0., 8e-6, 3e-6, 0., 0.}) {  // channel, width, height, unit, points
      std::getline(text, line);
      if (size > 0)
        CHECK(std::stod(line.substr(line.find(':') + 1)) == Approx(size).epsilon(1e-12));
    }
    CHECK(line == "# Points: 12");
    for (const double expected :
         {1.25, 2., -3.5, 4., 5., undefined, 7., .5, 9.75, -10., 11., 12.5}) {
      std::string word;
      REQUIRE(text >> word);
      if (std::isnan(expected))
        CHECK(word == "nan");
      else
        CHECK(std::stod(word) == Approx(1e-9 * expected).epsilon(1e-7));
    }
  };
  for (const std::string& from : written) {
    test.done("convert scan.txt from" + from);
    const auto described = test.answer("statistics from" + from + " --detrend none");
    CHECK(described["nx"] == 4);
    CHECK(described["undefined_points"] == 1);
    for (const std::string& to : written) {
      test.done("convert from" + from + " to" + to + " --overwrite");
      check("to" + to);
    }
  }
}

TEST_CASE("statistics refuses each broken file with status 2 and one line", "[files][bad-input]") {
  const ProgramTest test;
  test.write("scan.txt", scan);
  for (const std::string& format : written) {
    test.done("convert scan.txt whole" + format);
    const std::string whole = test.read("whole" + format);
    for (const std::size_t part : {whole.size() - 1, whole.size() / 2, whole.size() / 8}) {
      test.write("cut" + format, whole.substr(0, part));
      std::filesystem::remove(test.folder() / ("cut" + format + ".json"));
      const auto result = test.run("statistics cut" + format);
      INFO(format << " cut to " << part << ": " << result.err);
      // Text that loses its last line end is whole.
      if (part + 1 == whole.size() && (format == ".txt" || format == ".xyz")) {
        CHECK(result.status == 0);
        continue;
      }
      check_refused(result, "cut" + format);
    }
  }
}

TEST_CASE("statistics reads text with a byte order mark, CR LF and decimal commas", "[files]") {
  const ProgramTest test;
  const auto content =
      GENERATE(as<std::string>(),
               "\xef\xbb\xbf# Width: 3 um\r\n# Height: 3 um\r\n"
               "1,5;2;3\r\n3;4,25;1\r\n5;6;7,25\r\n",
               "# Width: 3 \xb5m\r# Height: 3 \xb5m\r1.5\t2\t3\r3\t4.25\t1\r5\t6\t7.25\r",
               "# Width: 3e-6 m\n# Height: 3e-6 m\n1.5,2,3\n3,4.25,1\n5,6,7.25\n");
  test.write("scan.txt", content);
  const auto result = test.answer("statistics scan.txt --detrend none");
  CHECK(result["size_x"] == Approx(3e-6));
  CHECK(result["mean"] == Approx(33. / 9));
}
