// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "run_program.hpp"

namespace {

const std::string law = "--hurst 0.8 --rolloff 2um --short-cutoff 500nm --rms-height 30nm --seed ";
const std::string body = " --contact-modulus 10GPa --poisson 0.3 ";
const std::string drag = " --normal-amplitude 5nm --drag-velocity 1um/s --frequency 20kHz ";

/// A folder with three maps of different size, points and format, a truncated one and a text
/// without size: "maps/1.h5", "maps/2.gsf", "maps/3.gwy", "maps/4.gwy" and "maps/5.txt".
void make_maps(const ProgramTest& test) {
  std::filesystem::create_directory(test.folder() / "maps");
  test.done("generate --points 64 --size-x 8um " + law + "1 -o maps/1.h5");
  test.done("generate --points 96,48 --size-x 12um " + law + "2 -o maps/2.gsf");
  test.done("generate --points 80 --size-x 10um " + law + "3 -o maps/3.gwy");
  test.write("maps/4.gwy", test.read("maps/3.gwy").substr(0, 9000));
  test.write("maps/5.txt", "1 2 3 1\n2 3 4 1\n3 4 6 1\n");
}

/// The cells of the line of a table that begins with `first`, split at blanks.
std::vector<std::string> line_of(const std::string& text, const std::string& first) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::vector<std::string> found;
    for (std::string cell; cells >> cell;) found.push_back(cell);
    if (!found.empty() && found.front() == first) return found;
  }
  return {};
}

/// Rows of a CSV file without quotes, comments and the heading: "file" → column → text.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& text) {
  std::vector<std::map<std::string, std::string>> rows;
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char symbol : line)
      if (symbol == '"')
        quoted = !quoted;
      else if (symbol == ',' && !quoted)
        cells.emplace_back();
      else
        cells.back() += symbol;
    if (names.empty()) {
      names = cells;
      continue;
    }
    REQUIRE(cells.size() == names.size());
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < cells.size(); ++k) row[names[k]] = cells[k];
  }
  return rows;
}

}  // namespace

TEST_CASE("Three commands give the tables of a folder in which two maps are broken", "[several]") {
  const ProgramTest test;
  make_maps(test);
  const auto check_failures = [](const ProgramTest::Result& result) {
    CHECK(result.status == 1);
    CHECK(result.out.find("2 of 5 files failed") != std::string::npos);
    CHECK(result.out.find("\n  4.gwy: ") != std::string::npos);
    CHECK(result.out.find("\n  5.txt: ") != std::string::npos);
    CHECK(result.err.find("2 of 5 files failed") != std::string::npos);
  };

  const auto statistics = test.run("statistics maps --csv roughness.csv");
  check_failures(statistics);
  const auto roughness = rows_of(test.read("roughness.csv"));
  REQUIRE(roughness.size() == 5);
  double sum = 0, squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto alone = test.answer("statistics --all " + roughness[k].at("file"));
    CHECK(roughness[k].at("error").empty());
    for (const char* name : {"Sq", "Sa", "Sdq"})
      CHECK(std::stod(roughness[k].at(name)) == number(alone, std::string("/areal/") + name));
    CHECK(std::stod(roughness[k].at("Ra_y")) == number(alone, "/profiles_y/Ra"));
    CHECK(std::stod(roughness[k].at("size_y")) == number(alone, "/size_y"));
    sum += std::stod(roughness[k].at("Sq"));
    squares += std::pow(std::stod(roughness[k].at("Sq")), 2);
  }
  CHECK(roughness[3].at("Sq").empty());
  CHECK(roughness[4].at("error").find("--size-x") != std::string::npos);
  // Points and size take three and five words: "96 x 48", "12 µm x 6 µm". Three digits are printed.
  const auto mean = line_of(statistics.out, "mean"), spread = line_of(statistics.out, "spread");
  REQUIRE(mean.size() > 4);
  CHECK(mean[2] == "3");
  CHECK(std::stod(mean[3]) * 1e-9 == Approx(sum / 3).epsilon(0.01));
  REQUIRE(spread.size() > 2);
  CHECK(std::stod(spread[1]) * (spread[2] == "pm" ? 1e-12 : 1e-9) ==
        Approx(std::sqrt((squares - sum * sum / 3) / 2)).epsilon(0.01));

  const auto contact =
      test.run("contact maps --pressure 20MPa,5MPa --stiffness --csv contact.csv" + body);
  check_failures(contact);
  const auto pressed = rows_of(test.read("contact.csv"));
  REQUIRE(pressed.size() == 2 * 3 + 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string& file = pressed[2 * k].at("file");
    CHECK(pressed[2 * k + 1].at("file") == file);
    CHECK(std::stod(pressed[2 * k].at("pressure")) == Approx(5e6));
    const auto alone = test.answer("contact " + file + " --stiffness --pressure 20MPa" + body);
    // A contact of a curve starts from the one before; both are solved to a residual of 1e-10.
    for (const char* name : {"contact_area_fraction", "mean_gap", "normal_stiffness_per_area"})
      CHECK(std::stod(pressed[2 * k + 1].at(name)) ==
            Approx(number(alone, std::string("/") + name)).epsilon(1e-6));
  }

  const auto damping =
      test.run("damping --surface maps --pressure 5MPa,20MPa --csv damping.csv" + body + drag);
  check_failures(damping);
  const auto lost = rows_of(test.read("damping.csv"));
  REQUIRE(lost.size() == 2 * 3 + 2);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto alone = test.answer("damping --surface " + lost[2 * k].at("file") +
                                   " --pressure 5MPa,20MPa" + body + drag);
    const double area = number(alone, "/force/1") / 20e6;
    CHECK(std::stod(lost[2 * k + 1].at("damping_constant_per_area")) ==
          Approx(number(alone, "/damping_constant/1") / area).epsilon(1e-12));
    CHECK(lost[2 * k].at("validity") == alone["validity"]);
  }
}

TEST_CASE("A study of several surfaces has a row for each surface and pressure", "[several]") {
  const ProgramTest test;
  make_maps(test);
  const std::string what = " --pressures 5MPa:40MPa:4 --no-stick" + body + drag;
  const auto result = test.run("study 'maps/[1-3].*' --csv study.csv" + what);
  INFO(result.err);
  CHECK(result.status == 0);
  const auto rows = rows_of(test.read("study.csv"));
  REQUIRE(rows.size() == 12);
  const auto alone = test.answer("study --surface maps/2.gsf" + what);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& row = rows[4 + k];
    CHECK(row.at("file") == "maps/2.gsf");
    const std::string load = "/" + std::to_string(k);
    const double pressure = number(alone, "/damping/pressure" + load),
                 area = number(alone, "/damping/force" + load) / pressure;
    CHECK(area == Approx(12e-6 * 6e-6));
    CHECK(std::stod(row.at("pressure")) == pressure);
    CHECK(std::stod(row.at("damping_constant_per_area")) ==
          Approx(number(alone, "/damping/damping_constant/mean" + load) / area).epsilon(1e-12));
  }
  // One study file serves all; a surface beside it is studied alone, as with --surface.
  test.write("one.toml",
             "[material]\ncontact_modulus = 1e10\npoisson = 0.3\n[contact]\npressures = "
             "[5e6, 1e7, 2e7, 4e7]\ntangential_stiffness = \"proportional\"\n[damping]\n"
             "mode = \"drag\"\nnormal_amplitude = 5e-9\ndrag_velocity = 1e-6\nfrequency "
             "= 2e4\n");
  const auto several = test.run("study one.toml maps/1.h5 maps/2.gsf --json --quiet");
  CHECK(several.status == 0);
  const auto answers = nlohmann::json::parse(several.out);
  REQUIRE(answers.size() == 2);
  CHECK(answers[1]["file"] == "maps/2.gsf");
  CHECK(answers[1]["damping"]["damping_constant"] == alone["damping"]["damping_constant"]);
  CHECK(test.answer("study one.toml maps/2.gsf")["damping"]["damping_constant"] ==
        alone["damping"]["damping_constant"]);
}

TEST_CASE("Failures do not stop the other files, and decide on the exit status", "[several]") {
  const ProgramTest test;
  make_maps(test);
  const auto some = test.run("statistics maps/1.h5 maps/4.gwy --json --quiet");
  CHECK(some.status == 1);
  const auto answers = nlohmann::json::parse(some.out);
  REQUIRE(answers.size() == 2);
  CHECK(answers[0]["rms_height"] == test.answer("statistics maps/1.h5")["rms_height"]);
  CHECK(answers[1]["error"].get<std::string>().starts_with("maps/4.gwy: "));
  // If all fail nothing is written.
  const auto all = test.run("statistics maps/4.gwy maps/5.txt --csv none.csv");
  CHECK(all.status == 2);
  CHECK(all.out.find("2 of 2 files failed") != std::string::npos);
  CHECK(!std::filesystem::exists(test.folder() / "none.csv"));
  // A mistake in an option is that of no file.
  check_refused(test.run("contact maps/1.h5 maps/2.gsf --pressure -1 " + body), "--pressure");
  // Holes are bad input for a contact, but not for statistics.
  test.write("holes.txt", "nan nan nan nan 1\n1 2 nan 3 4\n3 nan nan 1 1\n2 1 4 1 3\n1 2 1 2 2\n");
  const std::string units = " --height-unit nm --size-x 5um --size-y 5um ";
  test.write("whole.txt", "1 3 2 1 1\n1 2 1 3 4\n3 2 1 1 1\n2 1 4 1 3\n1 2 1 2 2\n");
  CHECK(test.run("statistics holes.txt whole.txt" + units).status == 0);
  const auto holed = test.run("contact holes.txt whole.txt --pressure 1MPa" + units + body);
  CHECK(holed.status == 1);
  CHECK(line_of(holed.out, "whole.txt").size() > 3);
  CHECK(holed.out.find("holes.txt: ") != std::string::npos);
}

TEST_CASE("Folders, patterns and names mean the same files", "[several]") {
  const ProgramTest test;
  make_maps(test);
  test.write("maps/.hidden", "x");
  test.done("convert maps/1.h5 maps/6.npy");  // with the sidecar 6.npy.json
  const auto table = [&](const std::string& names) {
    return test.run("statistics --quiet " + names).out;
  };
  const std::string folder = table("maps");
  CHECK(folder.find("2 of 6 files failed") != std::string::npos);
  // A pattern has the sidecar too, which is no surface.
  CHECK(table("'maps/*.*'").find("3 of 7 files failed") != std::string::npos);
  CHECK(table("maps maps/1.h5") == folder);
  CHECK(table("maps/1.h5 maps/2.gsf") == table("'maps/{1,2}.*'"));
  // Filters are those of each file.
  const auto filtered = nlohmann::json::parse(
      test.run("statistics maps/1.h5 maps/2.gsf --l-filter 3um --json --quiet").out);
  const auto alone = test.answer("statistics maps/2.gsf --l-filter 3um --all");
  CHECK(filtered[1]["areal"] == alone["areal"]);
  CHECK(filtered[1]["profiles_x"] == alone["profiles_x"]);
  CHECK(number(alone, "/rms_height") < number(test.answer("statistics maps/2.gsf"), "/rms_height"));
  // The law is that of the heights before the filters.
  CHECK(alone["hurst"] == test.answer("statistics maps/2.gsf")["hurst"]);
}

TEST_CASE("Losses on rubber of several surfaces have the 95 % interval of their mean",
          "[several]") {
  const ProgramTest test;
  test.write("rubber.toml",
             "[base]\nyoung = 3e6\npoisson = 0.5\n[[relaxation]]\nweight = 2\ntime = 0.02\n");
  for (const std::string seed : {"1", "2", "3"})
    test.done(
        "generate --points 16 --size-x 1mm --hurst 0.8 --rolloff 500um --short-cutoff 500um "
        "--rms-height 5um --seed " +
        seed + " -o " + seed + ".h5");
  const std::string text =
      test.done(
              "viscoelastic 1.h5 2.h5 3.h5 --body rubber.toml --pressure 10kPa --frequency 10 "
              "--mode equal-frequency --normal-amplitude 0.3um --tangential-amplitude 0.3um "
              "--phase 90deg --steps 16")
          .out;
  // The losses per area, which follow the damping constants.
  const double mean = std::stod(line_of(text, "mean").at(4)),
               spread = std::stod(line_of(text, "spread").at(2)),
               low = std::stod(line_of(text, "mean,").at(5)),
               high = std::stod(line_of(text, "to").at(2));
  double sum = 0;
  for (const std::string file : {"1.h5", "2.h5", "3.h5"})
    sum += std::stod(line_of(text, file).at(2));
  CHECK(mean == Approx(sum / 3).epsilon(0.01));
  // Student's t for three values is 4.303.
  const double arm = 4.303 * spread / std::sqrt(3.0);
  REQUIRE(arm < mean);
  CHECK(low == Approx(mean - arm).margin(0.02 * mean));
  CHECK(high == Approx(mean + arm).margin(0.02 * mean));
}
