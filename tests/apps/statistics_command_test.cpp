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

TEST_CASE("A map is filtered alike wherever it is read", "[statistics]") {
  const ProgramTest test;
  test.done(rough);
  const std::string filters = " --s-filter 70nm --l-filter 400nm ";
  test.done("convert rough.h5 filtered.h5 --detrend mean" + filters);
  // The filters are those of the heights: the file holds them, and statistics see the same. The
  // heights are stored as doubles.
  const auto direct = test.answer("statistics rough.h5 --all" + filters);
  const auto stored = test.answer("statistics filtered.h5 --all");
  CHECK(number(direct, "/s_filter") == 70e-9);
  CHECK(number(direct, "/l_filter") == 400e-9);
  for (const char* path : {"/rms_height", "/rms_slope", "/areal/Sa", "/areal/Sdq", "/areal/Sz"})
    CHECK(number(direct, path) == Approx(number(stored, path)).epsilon(1e-9));
  // A profile filter also removes waves that are long along the profile and short across it, which
  // the filter of the surface leaves.
  CHECK(number(direct, "/profiles_x/Rq") < number(stored, "/profiles_x/Rq"));
  CHECK(number(direct, "/profiles_x/sections") == 2);
  const std::string press = " --pressure 2MPa --contact-modulus 10GPa";
  CHECK(number(test.answer("contact rough.h5" + press + filters), "/mean_gap") ==
        Approx(number(test.answer("contact filtered.h5" + press), "/mean_gap")).epsilon(1e-9));
  const std::string study =
      "[material]\ncontact_modulus = 1e10\npoisson = 0.3\n[contact]\npressures = "
      "\"0.2MPa:40MPa:12\"\n[damping]\nmode = \"drag\"\nnormal_amplitude = 1e-10\ndrag_velocity = "
      "1e-6\nfrequency = 2e4\nintervals = 0\n[surface]\n";
  test.write("filters.toml", study + "file = \"rough.h5\"\ns_filter = 70e-9\nl_filter = 400e-9\n");
  test.write("stored.toml", study + "file = \"filtered.h5\"\n");
  const std::string path = "/decay_length/mean";
  CHECK(number(test.answer("study filters.toml"), path) ==
        Approx(number(test.answer("study stored.toml"), path)).epsilon(1e-6));
  CHECK(number(test.answer("study stored.toml"), path) !=
        Approx(number(test.answer("study stored.toml --surface rough.h5"), path)).epsilon(1e-3));
}
