// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "run_program.hpp"

namespace {

const std::string rough =
    "generate --points 64 --size-x 1um --hurst 0.7 --rolloff 250nm --short-cutoff 62.5nm "
    "--rms-height 2nm --method random-phase --seed 4 -o rough.h5";

/// Σ of a table on the trapezoids of its first column.
double integral(const nlohmann::json& x, const nlohmann::json& y) {
  double sum = 0;
  for (std::size_t k = 1; k < x.size(); ++k)
    sum += (x[k].get<double>() - x[k - 1].get<double>()) *
           (y[k].get<double>() + y[k - 1].get<double>()) / 2;
  return sum;
}

}  // namespace

TEST_CASE("The statistics of a surface agree with each other", "[statistics]") {
  const ProgramTest test;
  test.done(rough);
  const auto found = test.answer("statistics rough.h5 --all");
  const double rms_height = found["rms_height"];
  CHECK(found["areal"]["Sq"] == Approx(rms_height).epsilon(1e-12));
  // What is printed without --all is a part of it, in the same words.
  const auto shown = test.answer("statistics rough.h5");
  for (const auto& [name, value] : shown.items()) CHECK(found[name] == value);
  CHECK(keys(shown) ==
        "nx ny size_x size_y periodic undefined_points filled_points mean rms_height skewness "
        "kurtosis moment0 moment2 moment4 rms_slope nayak hurst rolloff short_cutoff summits "
        "reliability");
  CHECK(found["correlation"]["autocorrelation"][0] ==
        Approx(rms_height * rms_height).epsilon(1e-12));
  // S(dx) = dx² ⟨(Δh/dx)²⟩, and the first entry of the scale-dependent slope is the slope by
  // differences.
  const double dx = 1e-6 / 64, slope = found["scale_x"]["profile_slope"][0];
  CHECK(found["correlation_x"]["structure"][1] == Approx(slope * slope * dx * dx).epsilon(1e-9));
  // Σ modes·C·d²q = h_rms².
  double sum = 0;
  for (std::size_t k = 0; k < found["psd"]["modes"].size(); ++k)
    sum += found["psd"]["modes"][k].get<double>() * found["psd"]["psd"][k].get<double>();
  const double cell = std::pow(2 * std::numbers::pi / 1e-6, 2);
  CHECK(sum * cell == Approx(rms_height * rms_height).epsilon(1e-10));
  CHECK(integral(found["bearing"]["area_fraction"], found["bearing"]["height"]) ==
        Approx(0).margin(0.01 * rms_height));
  double fraction = 0;
  for (const auto& points : found["histogram"]["points"]) fraction += points.get<double>();
  CHECK(fraction == 64 * 64);
  CHECK(found["reliability"]["wavelength"] == Approx(2 * dx));
}

TEST_CASE("Tables are written as CSV, JSON and HDF5 with the same numbers", "[statistics]") {
  const ProgramTest test;
  test.done(rough);
  test.done("statistics rough.h5 -o scan.csv");
  test.done("statistics rough.h5 -o scan.json --quiet");
  test.done("statistics rough.h5 -o scan.h5");
  const auto files = test.files();
  for (const char* name : {"scan.csv", "scan.psd.csv", "scan.correlation_x.csv", "scan.bearing.csv",
                           "scan.histogram.csv", "scan.scale_y.csv", "scan.profile_psd_x.csv"})
    CHECK(files.count(name) == 1);
  // A file holds everything, with --all or without.
  const auto json = nlohmann::json::parse(test.read("scan.json"));
  CHECK(json == test.answer("statistics rough.h5 --all"));
  std::istringstream csv(test.read("scan.psd.csv"));
  std::string line;
  while (std::getline(csv, line) && line.starts_with("#")) {
  }
  CHECK(line == "wavenumber,psd,modes");
  std::getline(csv, line);
  double wavenumber = 0, density = 0;
  REQUIRE(std::sscanf(line.c_str(), "%lf,%lf", &wavenumber, &density) == 2);
  CHECK(wavenumber == json["psd"]["wavenumber"][0].get<double>());
  CHECK(density == json["psd"]["psd"][0].get<double>());
  CHECK(test.read("scan.csv").find("areal.Sdr,") != std::string::npos);
  check_refused(test.run("statistics rough.h5 -o scan.csv"), "scan.csv");
}

TEST_CASE("A convention changes the numbers of the spectrum and says so", "[statistics]") {
  const ProgramTest test;
  test.done(rough);
  const auto own = test.answer("statistics rough.h5 --all")["psd"];
  const auto theirs =
      test.answer("statistics rough.h5 --convention surface-topography --all")["psd"];
  CHECK(theirs["psd"][3] ==
        Approx(4 * std::pow(std::numbers::pi, 2) * own["psd"][3].get<double>()).epsilon(1e-12));
  CHECK(own["note"] != theirs["note"]);
  const auto gwyddion = test.answer("statistics rough.h5 --convention gwyddion --all")["psd"];
  CHECK(gwyddion["units"]["psd"] == "m^3");
}

TEST_CASE("Undefined points take no part, and are filled on request only", "[statistics]") {
  const ProgramTest test;
  std::string matrix = "# Channel: test\n# Width: 8 um\n# Height: 6 um\n# Value units: nm\n";
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column)
      matrix +=
          row == 2 && column == 3 ? "nan\t" : std::to_string((row * 5 + column * 3) % 7) + "\t";
    matrix += "\n";
  }
  test.write("scan.txt", matrix);
  const auto without = test.done("statistics scan.txt --all --json --detrend mean");
  CHECK(without.err.find("--fill") != std::string::npos);
  const auto found = without.json();
  CHECK(found["undefined_points"] == 1);
  CHECK(found.count("psd") == 0);
  CHECK(found["hurst"]["value"].is_null());
  const auto filled = test.answer("statistics scan.txt --all --json --detrend mean --fill");
  CHECK(filled["filled_points"] == 1);
  CHECK(filled.count("psd") == 1);
  // What needs no filling is the same.
  CHECK(filled["areal"]["Sq"] == found["areal"]["Sq"]);
}

TEST_CASE("Measured surfaces are read as another program reads them", "[statistics]") {
  const std::filesystem::path folder = SALEBRA_SURFACES;
  const ProgramTest test;
  const auto reference = nlohmann::json::parse(std::ifstream(folder / "reference.json"));
  int compared = 0;
  for (const auto& [name, expected] : reference.items()) {
    const auto found = test.answer("statistics " + (folder / name).string() + " --detrend none");
    CHECK(found["nx"] == expected["nx"]);
    CHECK(found["ny"] == expected["ny"]);
    CHECK(found["undefined_points"] == expected["undefined_points"]);
    // Both sides sum some 10⁵ doubles and multiply by the unit in different places.
    CHECK(found["size_x"] == Approx(expected["size_x_m"]).epsilon(1e-12));
    CHECK(found["size_y"] == Approx(expected["size_y_m"]).epsilon(1e-12));
    const double rms_height = expected["rms_height_m"];
    CHECK(found["rms_height"] == Approx(rms_height).epsilon(1e-10));
    CHECK(found["mean"] == Approx(expected["mean_m"]).margin(1e-10 * rms_height));
    ++compared;
  }
  CHECK(compared == 9);
}
